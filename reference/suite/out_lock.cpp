#include "reference/suite/out_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
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
  if (fd_ < 0 || flock(fd_, LOCK_EX | LOCK_NB) == 0) return;
  const bool held = errno == EWOULDBLOCK;
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
