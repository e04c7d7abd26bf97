#include "core/deform/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>
#include <utility>

#include "core/types/check.h"

namespace contactcheck {
namespace {

/// Closes its descriptor and removes the temporary file unless `keep` was called.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::filesystem::path& target) : target_(target) {
    // Two writers of one folder never share a name: process, then a number within it.
    static std::atomic<unsigned> next = 0;
    temporary_ = target;
    temporary_ += "." + std::to_string(getpid()) + "-" + std::to_string(next++) + ".tmp";
    descriptor_ = open(temporary_.c_str(), O_CREAT | O_TRUNC | O_WRONLY | O_CLOEXEC, 0666);
    if (descriptor_ < 0) fail("create");
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    if (descriptor_ >= 0) close(descriptor_);
    if (!kept_) unlink(temporary_.c_str());
  }

  void write_all(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t written = write(descriptor_, bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail("write");
      bytes.remove_prefix(static_cast<std::size_t>(written));
    }
  }
  void keep() {
    // Without this a crash of the machine may leave the new name with the content missing.
    if (fsync(descriptor_) != 0) fail("write");
    const int descriptor = std::exchange(descriptor_, -1);
    if (close(descriptor) != 0) fail("write");
    if (std::rename(temporary_.c_str(), target_.c_str()) != 0) fail("rename the finished file to");
    kept_ = true;
  }

 private:
  // Called from the constructor too, where no destructor follows; but then no file exists.
  [[noreturn]] void fail(const char* action) const {
    throw InputError(std::string("cannot ") + action + " \"" + target_.string() +
                     "\": " + std::strerror(errno) + ".");
  }

  std::filesystem::path target_, temporary_;
  int descriptor_ = -1;
  bool kept_ = false;
};

}  // namespace

void write_file_atomically(const std::filesystem::path& file, std::string_view bytes) {
  TemporaryFile temporary(file);
  temporary.write_all(bytes);
  temporary.keep();
}

}  // namespace contactcheck
