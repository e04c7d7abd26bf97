// What a check has found so far, frame by frame, in OUT/check.jsonl: what `check --resume` takes
// over.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "reference/check/checked_frame.h"

namespace contactcheck::check {

/// A line of JSON each: a head (schema contactcheck-checked/1, identity, command), the frames in
/// their order, and at the end of a check that ended its exit code. A line that a killed program
/// has not finished counts as none.
struct CheckLog {
  std::string identity, command;
  std::vector<CheckedFrame> frames;
  bool ended = false;

  /// Without a head where there is no such file, or another program has written it.
  static CheckLog read(const std::filesystem::path& file);
  bool empty() const { return identity.empty(); }
};

/// Of names, sizes and times of change. Cheaper than the contents, which are read once as it is.
std::string stamp_of(const std::vector<std::filesystem::path>& files);

/// Writes it anew; every line is in the file before the next frame is begun.
class CheckLogWriter {
 public:
  /// Begins with `taken`, frames of the file that it replaces: one of the two is there at any time.
  /// @throws InputError when it cannot be written
  CheckLogWriter(const std::filesystem::path& file, const std::string& identity,
                 const std::string& command, const std::vector<CheckedFrame>& taken);

  void add(const CheckedFrame& frame);
  void end(int exit_code);

 private:
  void line(const Json& json);
  [[noreturn]] void fail() const;

  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::filesystem::path path_;
  std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace contactcheck::check
