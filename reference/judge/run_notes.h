// What a run writes down about a detector beside its counts.
#pragma once

#include <string>
#include <vector>

#include "reference/process/float_environment.h"
#include "reference/results/results.h"

namespace contactcheck::judge {

/// Notes that `call` left the floating-point environment changed, and restores it.
void note_environment(const process::FloatEnvironmentGuard& guard, const char* call,
                      results::Run& run);

/// Counts in how many frames a detector said each of its sentences.
class FrameNotes {
 public:
  void add_frame(const std::vector<std::string>& sentences);
  /// "SENTENCE (in 3 of 60 frames)", in order of first appearance.
  std::vector<std::string> summary() const;

 private:
  struct Line {
    std::string sentence;
    std::size_t frames = 0;
  };
  std::vector<Line> lines_;
  std::size_t frames_ = 0;
};

}  // namespace contactcheck::judge
