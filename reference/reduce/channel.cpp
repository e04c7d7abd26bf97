#include "reference/reduce/channel.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>

#include "core/types/check.h"

namespace contactcheck::reduce {
namespace {

// Longer messages are none of ours: a frame of two meshes of 100,000 triangles has 30 MiB.
constexpr std::uint64_t kLongest = std::uint64_t{4} << 30;

// Above what a worker finds its descriptors at.
constexpr int kLowestFd = 10;

bool send_all(int fd, const char* bytes, std::size_t count) {
  while (count > 0) {
    const ssize_t sent = ::send(fd, bytes, count, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    bytes += sent;
    count -= static_cast<std::size_t>(sent);
  }
  return true;
}

bool receive_all(int fd, char* bytes, std::size_t count) {
  while (count > 0) {
    const ssize_t got = ::recv(fd, bytes, count, 0);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    bytes += got;
    count -= static_cast<std::size_t>(got);
  }
  return true;
}

}  // namespace

Channel::~Channel() {
  if (fd_ >= 0) close(fd_);
}

std::pair<Channel, Channel> Channel::pair() {
  int fds[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, fds) != 0)
    throw InputError(std::string("cannot make a pair of sockets: ") + std::strerror(errno));
  // Not among the numbers of standard streams, where this program was started without one.
  const int high[2] = {fcntl(fds[0], F_DUPFD_CLOEXEC, kLowestFd),
                       fcntl(fds[1], F_DUPFD_CLOEXEC, kLowestFd)};
  for (const int fd : fds) close(fd);
  std::pair<Channel, Channel> ends{Channel(high[0]), Channel(high[1])};
  if (high[0] < 0 || high[1] < 0)
    throw InputError(std::string("cannot make a pair of sockets: ") + std::strerror(errno));
  return ends;
}

bool Channel::send(std::string_view message) const {
  const std::uint64_t size = message.size();
  return send_all(fd_, reinterpret_cast<const char*>(&size), sizeof size) &&
         send_all(fd_, message.data(), message.size());
}

std::optional<std::string> Channel::receive() const {
  std::uint64_t size = 0;
  if (!receive_all(fd_, reinterpret_cast<char*>(&size), sizeof size) || size > kLongest)
    return std::nullopt;
  std::string message(size, '\0');
  if (!receive_all(fd_, message.data(), message.size())) return std::nullopt;
  return message;
}

bool Channel::waits(std::chrono::milliseconds time) const {
  pollfd entry = {fd_, POLLIN, 0};
  return poll(&entry, 1, static_cast<int>(time.count())) > 0;
}

}  // namespace contactcheck::reduce
