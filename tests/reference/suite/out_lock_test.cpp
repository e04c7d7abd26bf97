#include "reference/suite/out_lock.h"

#include <gmock/gmock.h>

#include <optional>

#include "reference/process/worker_process.h"
#include "tests/reference/scene/scratch.h"

namespace contactcheck::suite {
namespace {

using test::Scratch;
using test::sentence_of;
using testing::HasSubstr;

std::string refusal(const std::filesystem::path& folder) {
  return sentence_of([&] { OutLock lock(folder); });
}

TEST(OutLock, HoldsAFolderUntilItsEndAndLeavesNoFile) {
  const Scratch scratch;
  {
    const OutLock lock(scratch.folder());
    EXPECT_THAT(refusal(scratch.folder()), HasSubstr(scratch.folder().string() + ": another run"));
    EXPECT_TRUE(std::filesystem::is_empty(scratch.folder()));
  }
  EXPECT_EQ(refusal(scratch.folder()), "");
}

TEST(OutLock, HoldsOnWhenItIsMoved) {
  const Scratch scratch;
  std::optional<OutLock> first(scratch.folder());
  const OutLock second(std::move(*first));
  first.reset();
  EXPECT_NE(refusal(scratch.folder()), "");
}

TEST(OutLock, IsNotHandedOnToProcessesThatAreStartedMeanwhile) {
  const Scratch scratch;
  std::optional<OutLock> lock(scratch.folder());
  const process::MemoryFile page("page");
  const process::WorkerProcess sleeper("/bin/sleep", {"60"}, page.fd());
  lock.reset();
  EXPECT_FALSE(sleeper.has_ended());
  EXPECT_EQ(refusal(scratch.folder()), "");
}

TEST(OutLock, FolderThatCannotBeOpenedIsPassedOver) { EXPECT_EQ(refusal("/nonexistent"), ""); }

}  // namespace
}  // namespace contactcheck::suite
