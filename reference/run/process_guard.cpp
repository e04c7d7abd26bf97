#include "reference/run/process_guard.h"

#include <sys/stat.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <clocale>
#include <cstring>
#include <filesystem>
#include <locale>

namespace contactcheck {
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

// glibc's sigaction (2.36, x86-64) sets this flag for itself, and shows it to whoever asks; it is
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

}  // namespace contactcheck
