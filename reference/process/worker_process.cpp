#include "reference/process/worker_process.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "core/types/check.h"
#include "reference/text/printable.h"

namespace contactcheck::process {
namespace {

constexpr std::size_t kLongestErrorText = std::size_t{64} << 10;

int memory_file(const char* label) {
  const int low = memfd_create(label, MFD_CLOEXEC);
  if (low < 0) throw InputError(std::string("cannot make shared memory: ") + std::strerror(errno));
  // Not among the numbers that the worker's descriptors are moved to: where this program was
  // started with a stream closed, the file would have taken that number.
  const int high = fcntl(low, F_DUPFD_CLOEXEC, WorkerProcess::kInheritedFd + 1);
  close(low);
  if (high < 0) throw InputError(std::string("cannot make shared memory: ") + std::strerror(errno));
  return high;
}

/// What posix_spawn does in the child before exec.
class SpawnPlan {
 public:
  SpawnPlan() {
    posix_spawn_file_actions_init(&actions_);
    posix_spawnattr_init(&attributes_);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP);
    posix_spawnattr_setpgroup(&attributes_, 0);
  }
  ~SpawnPlan() {
    posix_spawnattr_destroy(&attributes_);
    posix_spawn_file_actions_destroy(&actions_);
  }
  SpawnPlan(const SpawnPlan&) = delete;
  SpawnPlan& operator=(const SpawnPlan&) = delete;

  void empty_input() {
    posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  }
  void move(int from, int to) { posix_spawn_file_actions_adddup2(&actions_, from, to); }
  int spawn(char** arguments, char** environment, pid_t* child) const {
    return posix_spawn(child, arguments[0], &actions_, &attributes_, arguments, environment);
  }

 private:
  posix_spawn_file_actions_t actions_;
  posix_spawnattr_t attributes_;
};

}  // namespace

MemoryFile::MemoryFile(const char* label) : fd_(memory_file(label)) {}

MemoryFile::~MemoryFile() { close(fd_); }

std::uint64_t MemoryFile::size() const {
  struct stat status = {};
  return fstat(fd_, &status) == 0 ? static_cast<std::uint64_t>(status.st_size) : 0;
}

std::string MemoryFile::text(std::size_t longest) const { return text_from(0, longest); }

std::string MemoryFile::last_text(std::size_t longest) const {
  const std::uint64_t all = size();
  return text_from(all > longest ? all - longest : 0, longest);
}

std::string MemoryFile::text_from(std::uint64_t begin, std::size_t longest) const {
  std::string out(longest, '\0');
  const ssize_t size = pread(fd_, out.data(), out.size(), static_cast<off_t>(begin));
  out.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
  return out;
}

WorkerProcess::WorkerProcess(const std::filesystem::path& executable,
                             std::vector<std::string> arguments, int inherited_fd)
    : output_("contactcheck-output"), errors_("contactcheck-errors") {
  // Shared with the worker, which empties the files between detectors: whatever comes next goes to
  // their beginning.
  for (const int fd : {output_.fd(), errors_.fd()}) fcntl(fd, F_SETFL, O_APPEND);
  start(executable, std::move(arguments), inherited_fd);
}

void WorkerProcess::start(const std::filesystem::path& executable,
                          std::vector<std::string> arguments, int inherited_fd) {
  std::string program = executable.string();
  std::vector<char*> words = {program.data()};
  for (std::string& argument : arguments) words.push_back(argument.data());
  words.push_back(nullptr);
  SpawnPlan plan;
  plan.empty_input();
  plan.move(output_.fd(), STDOUT_FILENO);
  plan.move(errors_.fd(), STDERR_FILENO);
  plan.move(inherited_fd, kInheritedFd);
  pid_t pid = 0;
  const int error = plan.spawn(words.data(), environ, &pid);
  if (error != 0)
    throw InputError("cannot start the worker " + program + ": " + std::strerror(error));
  child_.started(pid);
}

WorkerProcess::~WorkerProcess() {
  if (reaped_) return;
  kill();
  reap();
}

bool WorkerProcess::has_ended() const {
  siginfo_t info = {};
  return waitid(P_PID, static_cast<id_t>(child_.pid()), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
         info.si_pid == child_.pid();
}

void WorkerProcess::kill() {
  ::kill(-child_.pid(), SIGKILL);
  ::kill(child_.pid(), SIGKILL);  // a library may have moved it to another group
}

int WorkerProcess::reap() {
  siginfo_t info = {};
  while (waitid(P_PID, static_cast<id_t>(child_.pid()), &info, WEXITED | WNOWAIT) != 0 &&
         errno == EINTR) {
  }
  // While it is a zombie, no other process or group can have its number.
  kill();
  int status = 0;
  while (waitpid(child_.pid(), &status, 0) < 0 && errno == EINTR) {
  }
  child_.end_orphans();
  reaped_ = true;
  return status;
}

std::string describe_status(int status) {
  if (WIFSIGNALED(status)) {
    const int number = WTERMSIG(status);
    return "signal " + std::to_string(number) + " (" + strsignal(number) + ")";
  }
  return "exit code " + std::to_string(WEXITSTATUS(status));
}

std::string ended_text(int status, const std::string& error_text) {
  const std::string last_words = text::printable_line(error_text);
  return "ended in " + describe_status(status) + (last_words.empty() ? "" : ": " + last_words);
}

std::string WorkerProcess::error_text() const { return errors_.text(kLongestErrorText); }

}  // namespace contactcheck::process
