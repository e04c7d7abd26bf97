// What detectors write to the worker's standard output and error, which the supervisor has pointed
// at files of its own: noted in the row of the detector that wrote it.
#pragma once

#include <sys/types.h>

#include <cstdio>
#include <string>
#include <vector>

namespace contactcheck {

/// Watches both streams. Between detectors only: it empties buffers and makes system calls.
class OutputWatch {
 public:
  /// `active` false: watches nothing (a worker that was started by hand has the user's streams).
  explicit OutputWatch(bool active);
  ~OutputWatch();
  OutputWatch(const OutputWatch&) = delete;
  OutputWatch& operator=(const OutputWatch&) = delete;

  /// What was written since the last call, one sentence for each stream ("wrote to standard output:
  /// "first line""), and whether a stream was closed or replaced. Empties the files and restores
  /// the streams.
  std::vector<std::string> take();

 private:
  struct Stream {
    int number = -1;  ///< 1 or 2
    FILE** file = nullptr;
    const char* name = "";
    int kept = -1;  ///< a second descriptor of the file; -1: given up
    dev_t device = 0;
    ino_t inode = 0;
  };

  static bool is_file_of(const Stream& stream, int descriptor);
  static bool restore(Stream& stream);
  static std::string take_text(const Stream& stream);

  std::vector<Stream> streams_;
};

}  // namespace contactcheck
