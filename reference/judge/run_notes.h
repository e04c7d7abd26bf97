// What a run records about a detector besides its counts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "reference/judge/judge.h"
#include "reference/process/float_environment.h"
#include "reference/results/results.h"

namespace contactcheck::judge {

/// Notes that `call` changed the floating-point environment, and restores it.
void note_environment(const process::FloatEnvironmentGuard& guard, const char* call,
                      results::Run& run);

/// Counts the frames in which a detector gave each of its notes.
class FrameNotes {
 public:
  void add_frame(const std::vector<std::string>& sentences);
  /// "SENTENCE (in 3 of 60 frames)", without the brackets where all frames have it, in order of
  /// first appearance.
  std::vector<std::string> summary() const;

 private:
  struct Line {
    std::string sentence;
    std::size_t frames = 0;
  };
  std::vector<Line> lines_;
  std::size_t frames_ = 0;
};

/// Detects answers whose pairs name the triangle of the other body first.
class ExchangedPairs {
 public:
  /// A frame of level `triangle`.
  void add_frame(const LevelComparison& comparison);
  /// A note if at least half of the missed pairs are such pairs; else "".
  std::string sentence() const;

 private:
  std::uint64_t missed_ = 0, exchanged_ = 0;
};

}  // namespace contactcheck::judge
