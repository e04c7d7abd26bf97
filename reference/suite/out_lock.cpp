#include "reference/suite/out_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <thread>
#include <utility>

#include "core/types/check.h"
#include "reference/process/worker_process.h"

namespace contactcheck::suite {
namespace {

// Above the numbers that standard streams and a worker's descriptors take: a program may be started
// with a stream closed, and would then write it into the folder.
int open_folder(const std::filesystem::path& folder) {
  const int low = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (low < 0) return -1;
  const int high = fcntl(low, F_DUPFD_CLOEXEC, process::WorkerProcess::kInheritedFd + 1);
  close(low);
  return high;
}

}  // namespace

OutLock::OutLock(const std::filesystem::path& out) : fd_(open_folder(out)) {
  // The processes of a program that was just killed end a moment after it.
  constexpr auto kPatience = std::chrono::milliseconds(200), kPoll = std::chrono::milliseconds(10);
  const auto end = std::chrono::steady_clock::now() + kPatience;
  bool held = false;
  do {
    if (fd_ < 0 || flock(fd_, LOCK_EX | LOCK_NB) == 0) return;
    held = errno == EWOULDBLOCK;
    if (held) std::this_thread::sleep_for(kPoll);
  } while (held && std::chrono::steady_clock::now() < end);
  close(std::exchange(fd_, -1));
  if (held)
    throw InputError("--out " + out.string() +
                     ": another run is writing there; wait for its end or name another folder");
}

OutLock::OutLock(OutLock&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}

OutLock::~OutLock() {
  if (fd_ >= 0) close(fd_);
}

}  // namespace contactcheck::suite
