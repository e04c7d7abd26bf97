#include "reference/run/supervisor.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <new>
#include <thread>

#include "core/types/check.h"

extern char** environ;

namespace contactcheck {
namespace {

using Clock = std::chrono::steady_clock;

/// The shared page and its descriptor, which the child inherits.
class SharedPage {
 public:
  SharedPage() : fd_(memfd_create("contactcheck-progress", 0)) {
    if (fd_ < 0 || ftruncate(fd_, sizeof(SharedProgress)) != 0)
      throw InputError(std::string("cannot make shared memory: ") + std::strerror(errno));
    void* page = mmap(nullptr, sizeof(SharedProgress), PROT_READ | PROT_WRITE, MAP_SHARED, fd_, 0);
    if (page == MAP_FAILED)
      throw InputError(std::string("cannot map shared memory: ") + std::strerror(errno));
    progress_ = new (page) SharedProgress;
  }
  ~SharedPage() {
    munmap(progress_, sizeof(SharedProgress));
    close(fd_);
  }
  SharedPage(const SharedPage&) = delete;
  SharedPage& operator=(const SharedPage&) = delete;

  int fd() const { return fd_; }
  const SharedProgress& progress() const { return *progress_; }

 private:
  int fd_;
  SharedProgress* progress_ = nullptr;
};

pid_t start(const std::filesystem::path& executable, const std::filesystem::path& job_file,
            int fd) {
  std::string program = executable.string(), command = "worker", job = job_file.string(),
              flag = "--progress-fd", number = std::to_string(fd);
  char* arguments[] = {program.data(), command.data(), job.data(),
                       flag.data(),    number.data(),  nullptr};
  pid_t child = 0;
  const int error = posix_spawn(&child, program.c_str(), nullptr, nullptr, arguments, environ);
  if (error != 0)
    throw InputError("cannot start the worker " + program + ": " + std::strerror(error));
  return child;
}

std::uint64_t resident_bytes(pid_t child) {
  std::ifstream statm("/proc/" + std::to_string(child) + "/statm");
  std::uint64_t total = 0, resident = 0;
  statm >> total >> resident;
  return resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

std::string describe_status(int status) {
  if (WIFSIGNALED(status)) {
    const int number = WTERMSIG(status);
    return "signal " + std::to_string(number) + " (" + strsignal(number) + ")";
  }
  return "exit code " + std::to_string(WEXITSTATUS(status));
}

std::string seconds_text(double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", seconds);
  return text;
}

std::optional<std::uint32_t> current_detector(const SharedProgress& progress) {
  const std::uint32_t detector = progress.detector;
  if (detector == SharedProgress::kNoDetector) return std::nullopt;
  return detector;
}

WorkerOutcome outcome_of(const SharedProgress& progress, int status, const std::string& limit) {
  WorkerOutcome out;
  // The phase decides, not the exit code: a library may call exit(0) in the middle, or crash when
  // it is torn down, after the answer was written.
  out.done = progress.phase == Phase::kDone;
  out.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
  if (out.done) return out;
  out.reason = limit.empty() ? describe_status(status) : limit;
  out.detector = current_detector(progress);
  out.frame = progress.frame;
  out.phase = progress.phase;
  return out;
}

// Watches for stand-still and memory; says which limit was passed, or "".
class Watch {
 public:
  Watch(const SharedProgress& progress, const RunSettings& settings)
      : progress_(progress), settings_(settings) {}

  std::string broken_limit(pid_t child) {
    const std::uint64_t ticks = progress_.ticks;
    const Clock::time_point now = Clock::now();
    if (ticks != last_ticks_) {
      last_ticks_ = ticks;
      last_change_ = now;
    }
    if (std::chrono::duration<double>(now - last_change_).count() > settings_.call_limit)
      return "no progress for " + seconds_text(settings_.call_limit) +
             " s (time limit of one call)";
    if (resident_bytes(child) > settings_.memory_limit)
      return "more than " + std::to_string(settings_.memory_limit >> 20) +
             " MiB resident (memory limit)";
    return "";
  }

 private:
  const SharedProgress& progress_;
  const RunSettings& settings_;
  std::uint64_t last_ticks_ = 0;
  Clock::time_point last_change_ = Clock::now();
};

}  // namespace

WorkerOutcome run_supervised(const std::filesystem::path& executable,
                             const std::filesystem::path& job_file, const RunSettings& settings,
                             const ProgressCallback& on_progress) {
  const SharedPage page;
  const pid_t child = start(executable, job_file, page.fd());
  Watch watch(page.progress(), settings);
  std::string limit;
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    if (limit.empty()) {
      limit = watch.broken_limit(child);
      if (!limit.empty()) kill(child, SIGKILL);
    }
    on_progress(page.progress().permille / 1000.0, current_detector(page.progress()));
  }
  return outcome_of(page.progress(), status, limit);
}

}  // namespace contactcheck
