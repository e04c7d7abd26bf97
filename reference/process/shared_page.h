// Memory that a process shares with a child, which finds it by an inherited descriptor.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <new>
#include <string>

#include "core/types/check.h"
#include "reference/process/worker_process.h"

namespace contactcheck::process {

/// Maps the file's first bytes, which stand for a T; null when it cannot.
template <typename T>
T* map_page(int fd) {
  void* const page = mmap(nullptr, sizeof(T), PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
  return page == MAP_FAILED ? nullptr : static_cast<T*>(page);
}

/// The parent's side: makes the T, whose atomic `supervisor` is this process's id. What the child
/// changes beside lock-free atomics is seen after those.
template <typename T>
class SharedPage {
 public:
  /// @throws InputError when there is no memory
  explicit SharedPage(const char* label) : file_(label) {
    T* const page = ftruncate(file_.fd(), sizeof(T)) == 0 ? map_page<T>(file_.fd()) : nullptr;
    if (page == nullptr)
      throw InputError(std::string("cannot make shared memory: ") + std::strerror(errno));
    value_ = new (page) T;
    value_->supervisor = getpid();
  }
  ~SharedPage() { munmap(value_, sizeof(T)); }
  SharedPage(const SharedPage&) = delete;
  SharedPage& operator=(const SharedPage&) = delete;

  int fd() const { return file_.fd(); }
  T& value() const { return *value_; }

 private:
  MemoryFile file_;
  T* value_;
};

/// The child's side: gives the descriptor back; null when it is none of a page. Ends this process
/// if its supervisor has died before it could be told. A copy of this process that a library lets
/// run on does not have the page.
template <typename T>
T* join_page(int fd) {
  T* const page = map_page<T>(fd);
  if (page == nullptr) return nullptr;
  close(fd);
  madvise(page, sizeof(T), MADV_DONTFORK);
  if (getppid() != page->supervisor) _exit(1);
  return page;
}

}  // namespace contactcheck::process
