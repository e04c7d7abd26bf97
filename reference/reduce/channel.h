// Messages between this program and a worker that answers requests.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace contactcheck::reduce {

/// One end of a stream socket; messages are byte strings of any length.
class Channel {
 public:
  /// Takes ownership of the descriptor.
  explicit Channel(int fd) : fd_(fd) {}
  ~Channel();
  Channel(Channel&& other) noexcept : fd_(other.fd_) { other.fd_ = -1; }
  Channel(const Channel&) = delete;
  Channel& operator=(const Channel&) = delete;

  /// Two ends that are connected. @throws InputError when the system has none
  static std::pair<Channel, Channel> pair();

  int fd() const { return fd_; }
  /// False when the other side is gone.
  bool send(std::string_view message) const;
  /// Waits for a message; none if the other side is gone (or sends something else).
  std::optional<std::string> receive() const;
  /// True when something can be read (or the other side is gone) within the time.
  bool waits(std::chrono::milliseconds time) const;

 private:
  int fd_;
};

}  // namespace contactcheck::reduce
