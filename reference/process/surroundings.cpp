#include "reference/process/surroundings.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <clocale>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <locale>

#include "reference/process/process_tree.h"
#include "reference/process/shared_page.h"
#include "reference/text/printable.h"

namespace contactcheck::process {
namespace {

// Out of the way of libraries that close the small numbers one after the other.
constexpr int kHighDescriptor = 100;
constexpr std::size_t kFirstBytes = 4096;  // of what was written; the first line is in there

void flush_streams() {
  std::fflush(nullptr);  // all of them: stdout itself may have been closed
  std::cout.clear();
  std::cout.flush();
  std::cerr.clear();
}

}  // namespace

OutputWatch::OutputWatch(bool active) {
  if (!active) return;
  streams_ = {{1, &stdout, "standard output"}, {2, &stderr, "standard error"}};
  for (Stream& stream : streams_) {
    struct stat status = {};
    fstat(stream.number, &status);
    stream.device = status.st_dev;
    stream.inode = status.st_ino;
    stream.kept = fcntl(stream.number, F_DUPFD_CLOEXEC, kHighDescriptor);
  }
}

OutputWatch::~OutputWatch() {
  for (const Stream& stream : streams_)
    if (stream.kept >= 0) close(stream.kept);
}

std::vector<std::string> OutputWatch::take() {
  std::vector<std::string> notes;
  if (streams_.empty()) return notes;
  flush_streams();
  for (Stream& stream : streams_) {
    if (!restore(stream)) notes.push_back(std::string("closed or replaced ") + stream.name);
    const std::string text = take_text(stream);
    if (!text.empty())
      notes.push_back(std::string("wrote to ") + stream.name + ": \"" + text + "\"");
  }
  return notes;
}

bool OutputWatch::is_file_of(const Stream& stream, int descriptor) {
  struct stat status = {};
  return fstat(descriptor, &status) == 0 && status.st_dev == stream.device &&
         status.st_ino == stream.inode;
}

// True when nothing had to be done. A library may also have closed the second descriptor.
bool OutputWatch::restore(Stream& stream) {
  if (stream.kept < 0) return true;
  bool whole = is_file_of(stream, stream.number);
  if (!is_file_of(stream, stream.kept))
    stream.kept = whole ? fcntl(stream.number, F_DUPFD_CLOEXEC, kHighDescriptor) : -1;
  if (!whole) {
    // Never leave the number free: the next file to be opened would get it, the answer for one.
    const int other = stream.kept >= 0 ? stream.kept : open("/dev/null", O_WRONLY | O_CLOEXEC);
    dup2(other, stream.number);
    if (other != stream.kept && other != stream.number) close(other);
  }
  if (fileno(*stream.file) < 0) {
    *stream.file = fdopen(stream.number, "w");  // it was closed as a FILE
    whole = false;
  }
  return whole;
}

std::string OutputWatch::take_text(const Stream& stream) {
  struct stat status = {};
  if (stream.kept < 0 || fstat(stream.kept, &status) != 0 || status.st_size == 0) return "";
  std::string text(kFirstBytes, '\0');
  const ssize_t size = pread(stream.kept, text.data(), text.size(), 0);
  text.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
  // The supervisor opened the file for appending: the next byte goes to its new beginning.
  if (ftruncate(stream.kept, 0) != 0) return "";
  const std::string line = text::printable_line(text);
  return line.empty() ? "(nothing that can be printed)" : line;
}

namespace {

mode_t current_umask() {
  const mode_t mask = umask(077);
  umask(mask);
  return mask;
}

std::string current_directory() {
  std::error_code error;
  const auto path = std::filesystem::current_path(error);
  return error ? "" : path.string();  // a folder that was removed has no name
}

sigset_t blocked_signals() {
  sigset_t set;
  sigemptyset(&set);
  pthread_sigmask(SIG_SETMASK, nullptr, &set);
  return set;
}

// Signals that wait behind the mask would strike the next detector.
void discard_pending() {
  sigset_t pending;
  sigemptyset(&pending);
  constexpr timespec kAtOnce = {0, 0};
  while (sigpending(&pending) == 0 && !sigisemptyset(&pending))
    if (sigtimedwait(&pending, nullptr, &kAtOnce) < 0) return;
}

bool stop_timers() {
  bool any = false;
  for (const auto which : {ITIMER_REAL, ITIMER_VIRTUAL, ITIMER_PROF}) {
    itimerval old = {}, none = {};
    setitimer(which, &none, &old);
    any = any || old.it_value.tv_sec != 0 || old.it_value.tv_usec != 0;
  }
  return any;
}

// glibc's sigaction (2.36, x86-64) sets this flag for itself, and returns it when asked; it is
// in no header.
constexpr int kRestorer = 0x04000000;

bool same_handler(const struct sigaction& a, const struct sigaction& b) {
  if ((a.sa_flags & ~kRestorer) != (b.sa_flags & ~kRestorer)) return false;
  return (a.sa_flags & SA_SIGINFO) != 0 ? a.sa_sigaction == b.sa_sigaction
                                        : a.sa_handler == b.sa_handler;
}

}  // namespace

ProcessGuard::ProcessGuard()
    : locale_(std::setlocale(LC_ALL, nullptr)),
      directory_(current_directory()),
      umask_(current_umask()),
      blocked_(blocked_signals()) {
  for (int number = 1; number < NSIG; ++number) {
    Handler handler;
    handler.number = number;
    // Fails for the two that the C library keeps for itself.
    if (sigaction(number, nullptr, &handler.action) == 0) handlers_.push_back(handler);
  }
}

std::vector<std::string> ProcessGuard::check_and_restore() const {
  std::vector<std::string> changes;
  // Handlers before timers before the mask: nothing may strike half-way.
  const std::string handlers = restore_handlers();
  if (!handlers.empty()) changes.push_back("changed the handling of signals " + handlers);
  if (stop_timers()) changes.push_back("left a timer running");
  if (restore_mask()) changes.push_back("changed which signals are blocked");
  if (restore_locale()) changes.push_back("changed the locale");
  if (restore_directory()) changes.push_back("changed the working directory");
  if (restore_umask()) changes.push_back("changed the file mode mask");
  return changes;
}

bool ProcessGuard::restore_locale() const {
  const bool own_thread = uselocale(nullptr) != LC_GLOBAL_LOCALE;
  const bool of_streams = std::locale() != std::locale::classic();
  const bool of_process = std::setlocale(LC_ALL, nullptr) != locale_;
  if (own_thread) uselocale(LC_GLOBAL_LOCALE);
  if (of_streams) std::locale::global(std::locale::classic());
  if (of_process) std::setlocale(LC_ALL, locale_.c_str());
  return own_thread || of_streams || of_process;
}

bool ProcessGuard::restore_directory() const {
  if (directory_.empty() || current_directory() == directory_) return false;
  std::error_code ignored;  // all paths of a job are absolute
  std::filesystem::current_path(directory_, ignored);
  return true;
}

bool ProcessGuard::restore_umask() const { return umask(umask_) != umask_; }

std::string ProcessGuard::restore_handlers() const {
  std::string changed;
  for (const Handler& handler : handlers_) {
    struct sigaction now = {};
    if (sigaction(handler.number, nullptr, &now) != 0 || same_handler(now, handler.action))
      continue;
    sigaction(handler.number, &handler.action, nullptr);
    changed += (changed.empty() ? "" : ", ") + std::to_string(handler.number);
  }
  return changed;
}

bool ProcessGuard::restore_mask() const {
  const sigset_t now = blocked_signals();
  bool same = true;
  for (const Handler& handler : handlers_)
    same = same && sigismember(&now, handler.number) == sigismember(&blocked_, handler.number);
  if (same) return false;
  discard_pending();
  pthread_sigmask(SIG_SETMASK, &blocked_, nullptr);
  return true;
}

namespace {

// Where memory ends, the kernel shall end this process and not its supervisor.
void volunteer_for_the_oom_killer() { std::ofstream("/proc/self/oom_score_adj") << 1000; }

}  // namespace

void end_with_supervisor() {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  adopt_orphans();
  volunteer_for_the_oom_killer();
}

SharedProgress* join_supervisor(int progress_fd, SharedProgress* fallback) {
  end_with_supervisor();
  auto* const shared = join_page<SharedProgress>(progress_fd);
  return shared != nullptr ? shared : fallback;
}

Surroundings::Surroundings(bool supervised) : output_(supervised) {}

std::vector<std::string> Surroundings::restore() {
  std::vector<std::string> notes = output_.take();
  for (std::string& note : process_.check_and_restore()) notes.push_back(std::move(note));
  return notes;
}

}  // namespace contactcheck::process
