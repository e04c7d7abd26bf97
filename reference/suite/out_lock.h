// One run at a time in a folder.
#pragma once

#include <filesystem>

namespace contactcheck::suite {

/// Holds an output folder, from its making until its end, against every other that wants it, of
/// this process or another. The lock is the kernel's: it goes with the process, however that ends,
/// and leaves no file; the processes that this one starts do not have it. Where the file system has
/// no locks, nothing is held.
class OutLock {
 public:
  /// Waits for it for .2 s. @throws InputError with the folder when it is held
  explicit OutLock(const std::filesystem::path& out);
  ~OutLock();
  OutLock(OutLock&& other) noexcept;
  OutLock& operator=(OutLock&&) = delete;

 private:
  int fd_;  ///< of the folder; -1: none
};

}  // namespace contactcheck::suite
