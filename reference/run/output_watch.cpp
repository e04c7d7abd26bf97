#include "reference/run/output_watch.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <iostream>

#include "reference/run/printable.h"

namespace contactcheck {
namespace {

// Out of the way of libraries that close the small numbers one after the other.
constexpr int kHighDescriptor = 100;
constexpr std::size_t kFirstBytes = 4096;  // of what was written; the first line is in there

void flush_streams() {
  std::fflush(nullptr);  // all of them: stdout itself may have been closed
  std::cout.clear();
  std::cout.flush();
  std::cerr.clear();
}

}  // namespace

OutputWatch::OutputWatch(bool active) {
  if (!active) return;
  streams_ = {{1, &stdout, "standard output"}, {2, &stderr, "standard error"}};
  for (Stream& stream : streams_) {
    struct stat status = {};
    fstat(stream.number, &status);
    stream.device = status.st_dev;
    stream.inode = status.st_ino;
    stream.kept = fcntl(stream.number, F_DUPFD_CLOEXEC, kHighDescriptor);
  }
}

OutputWatch::~OutputWatch() {
  for (const Stream& stream : streams_)
    if (stream.kept >= 0) close(stream.kept);
}

std::vector<std::string> OutputWatch::take() {
  std::vector<std::string> notes;
  if (streams_.empty()) return notes;
  flush_streams();
  for (Stream& stream : streams_) {
    if (!restore(stream)) notes.push_back(std::string("closed or replaced ") + stream.name);
    const std::string text = take_text(stream);
    if (!text.empty())
      notes.push_back(std::string("wrote to ") + stream.name + ": \"" + text + "\"");
  }
  return notes;
}

bool OutputWatch::is_file_of(const Stream& stream, int descriptor) {
  struct stat status = {};
  return fstat(descriptor, &status) == 0 && status.st_dev == stream.device &&
         status.st_ino == stream.inode;
}

// True when nothing had to be done. A library may also have closed the second descriptor.
bool OutputWatch::restore(Stream& stream) {
  if (stream.kept < 0) return true;
  bool whole = is_file_of(stream, stream.number);
  if (!is_file_of(stream, stream.kept))
    stream.kept = whole ? fcntl(stream.number, F_DUPFD_CLOEXEC, kHighDescriptor) : -1;
  if (!whole) {
    // Never leave the number free: the next file to be opened would get it, the answer for one.
    const int other = stream.kept >= 0 ? stream.kept : open("/dev/null", O_WRONLY | O_CLOEXEC);
    dup2(other, stream.number);
    if (other != stream.kept && other != stream.number) close(other);
  }
  if (fileno(*stream.file) < 0) {
    *stream.file = fdopen(stream.number, "w");  // it was closed as a FILE
    whole = false;
  }
  return whole;
}

std::string OutputWatch::take_text(const Stream& stream) {
  struct stat status = {};
  if (stream.kept < 0 || fstat(stream.kept, &status) != 0 || status.st_size == 0) return "";
  std::string text(kFirstBytes, '\0');
  const ssize_t size = pread(stream.kept, text.data(), text.size(), 0);
  text.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
  // The supervisor opened the file for appending: the next byte goes to its new beginning.
  if (ftruncate(stream.kept, 0) != 0) return "";
  const std::string line = printable_line(text);
  return line.empty() ? "(nothing that can be printed)" : line;
}

}  // namespace contactcheck
