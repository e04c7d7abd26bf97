#include "core/deform/atomic_file.h"

#include <gmock/gmock.h>
#include <signal.h>
#include <sys/resource.h>

#include <iterator>

#include "reference/suite/job.h"
#include "tests/reference/scene/scratch.h"

namespace contactcheck::suite {
namespace {

using test::Scratch;
using test::sentence_of;
using testing::HasSubstr;

std::ptrdiff_t entries_in(const std::filesystem::path& folder) {
  return std::distance(std::filesystem::directory_iterator(folder), {});
}

/// Files may not grow beyond `bytes` while this lives, as on a disk that is full.
class SmallDisk {
 public:
  explicit SmallDisk(rlim_t bytes) : old_handler_(signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &old_);
    const struct rlimit small = {bytes, old_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
  }
  ~SmallDisk() {
    setrlimit(RLIMIT_FSIZE, &old_);
    signal(SIGXFSZ, old_handler_);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

 private:
  void (*old_handler_)(int);
  struct rlimit old_ = {};
};

TEST(WriteFileAtomically, WritesEveryByteAndLeavesOneFile) {
  const Scratch scratch;
  const std::string bytes("a\0b\r\n", 5);
  write_file_atomically(scratch.folder() / "x", bytes);
  EXPECT_EQ(read_text_file(scratch.folder() / "x"), bytes);
  EXPECT_EQ(entries_in(scratch.folder()), 1);
}

TEST(WriteFileAtomically, ReplacesWhatWasThere) {
  const Scratch scratch;
  const auto file = scratch.write("x", "something longer");
  write_file_atomically(file, "new");
  EXPECT_EQ(read_text_file(file), "new");
  EXPECT_EQ(entries_in(scratch.folder()), 1);
}

TEST(WriteFileAtomically, FullDiskLeavesTheOldFileAndNoRest) {
  const Scratch scratch;
  const auto file = scratch.write("x", "old");
  std::string sentence;
  {
    const SmallDisk disk(64);
    sentence = sentence_of([&] { write_file_atomically(file, std::string(1000, 'n')); });
  }
  EXPECT_THAT(sentence, HasSubstr(file.string()));
  EXPECT_THAT(sentence, HasSubstr("File too large"));
  EXPECT_EQ(read_text_file(file), "old");
  EXPECT_EQ(entries_in(scratch.folder()), 1);
}

TEST(WriteFileAtomically, MissingFolderIsRefusedWithThePath) {
  const Scratch scratch;
  const auto file = scratch.folder() / "missing" / "x";
  EXPECT_THAT(sentence_of([&] { write_file_atomically(file, "text"); }), HasSubstr(file.string()));
}

TEST(WriteFileAtomically, FolderThatTakesNoFilesIsRefused) {
  // Nobody can create files there, not even root.
  EXPECT_THAT(sentence_of([] { write_file_atomically("/proc/contactcheck", "text"); }),
              HasSubstr("/proc/contactcheck"));
}

TEST(WriteFileAtomically, FolderInPlaceOfTheFileIsRefusedAndNoRestStays) {
  const Scratch scratch;
  std::filesystem::create_directories(scratch.folder() / "x" / "y");
  EXPECT_THAT(sentence_of([&] { write_file_atomically(scratch.folder() / "x", "text"); }),
              HasSubstr((scratch.folder() / "x").string()));
  EXPECT_EQ(entries_in(scratch.folder()), 1);
}

}  // namespace
}  // namespace contactcheck::suite
