#include "reference/process/surroundings.h"

#include <gmock/gmock.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <unistd.h>

#include <clocale>
#include <filesystem>
#include <locale>
#include <sstream>

namespace contactcheck::process {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

struct DecimalComma : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
};

std::string half() {
  std::ostringstream text;
  text << 0.5;
  return text.str();
}

void ignore(int) {}

TEST(ProcessGuard, SeesNothingWhenNothingChanged) {
  const ProcessGuard guard;
  EXPECT_THAT(guard.check_and_restore(), IsEmpty());
}

TEST(ProcessGuard, RestoresTheLocaleOfTheProcess) {
  const ProcessGuard guard;
  ASSERT_NE(std::setlocale(LC_ALL, "C.UTF-8"), nullptr);
  EXPECT_THAT(guard.check_and_restore(), ElementsAre("changed the locale"));
  EXPECT_STREQ(std::setlocale(LC_ALL, nullptr), "C");
  EXPECT_THAT(guard.check_and_restore(), IsEmpty());
}

TEST(ProcessGuard, RestoresTheLocaleOfStreams) {
  const ProcessGuard guard;
  std::locale::global(std::locale(std::locale::classic(), new DecimalComma));
  EXPECT_EQ(half(), "0,5");
  EXPECT_THAT(guard.check_and_restore(), ElementsAre("changed the locale"));
  EXPECT_EQ(half(), "0.5");
}

TEST(ProcessGuard, RestoresTheLocaleOfTheThread) {
  const ProcessGuard guard;
  const locale_t other = newlocale(LC_ALL_MASK, "C.UTF-8", nullptr);
  ASSERT_NE(other, nullptr);
  uselocale(other);
  EXPECT_THAT(guard.check_and_restore(), ElementsAre("changed the locale"));
  EXPECT_EQ(uselocale(nullptr), LC_GLOBAL_LOCALE);
  freelocale(other);
}

TEST(ProcessGuard, RestoresTheWorkingDirectory) {
  const auto before = std::filesystem::current_path();
  const ProcessGuard guard;
  std::filesystem::current_path(before.root_path());
  ASSERT_NE(std::filesystem::current_path(), before);
  EXPECT_THAT(guard.check_and_restore(), ElementsAre("changed the working directory"));
  EXPECT_EQ(std::filesystem::current_path(), before);
}

TEST(ProcessGuard, RestoresTheFileModeMask) {
  const ProcessGuard guard;
  const mode_t before = umask(0123);
  EXPECT_THAT(guard.check_and_restore(), ElementsAre("changed the file mode mask"));
  EXPECT_EQ(umask(before), before);
}

TEST(ProcessGuard, RestoresHandlersAndNamesTheirSignals) {
  const ProcessGuard guard;
  signal(SIGUSR1, ignore);
  signal(SIGPIPE, SIG_IGN);
  const std::string numbers = std::to_string(SIGUSR1) + ", " + std::to_string(SIGPIPE);
  EXPECT_THAT(guard.check_and_restore(), ElementsAre("changed the handling of signals " + numbers));
  EXPECT_THAT(guard.check_and_restore(), IsEmpty()) << "said once";
  EXPECT_EQ(signal(SIGUSR1, SIG_DFL), SIG_DFL);
  EXPECT_EQ(signal(SIGPIPE, SIG_DFL), SIG_DFL);
}

TEST(ProcessGuard, RestoresAHandlerThatWasThereBefore) {
  signal(SIGUSR1, ignore);
  {
    const ProcessGuard guard;
    signal(SIGUSR1, SIG_DFL);
    EXPECT_EQ(guard.check_and_restore().size(), 1u);
  }
  EXPECT_EQ(signal(SIGUSR1, SIG_DFL), ignore);
}

TEST(ProcessGuard, StopsTimers) {
  const ProcessGuard guard;
  alarm(1000);
  EXPECT_THAT(guard.check_and_restore(), ElementsAre("left a timer running"));
  EXPECT_EQ(alarm(0), 0u);
}

TEST(ProcessGuard, UnblocksSignalsAndDiscardsThoseThatWait) {
  const ProcessGuard guard;
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGUSR2);
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
  raise(SIGUSR2);  // would end this process once unblocked
  EXPECT_THAT(guard.check_and_restore(), ElementsAre("changed which signals are blocked"));
  pthread_sigmask(SIG_BLOCK, nullptr, &set);
  EXPECT_EQ(sigismember(&set, SIGUSR2), 0);
}

}  // namespace
}  // namespace contactcheck::process
