// Results written by hand.
#pragma once

#include "reference/results/results.h"

namespace contactcheck::test {

/// A run that found 10 of 10 true triangle pairs and no others.
inline results::Run perfect_run(const std::string& scene, const std::string& detector) {
  results::Run run;
  run.scene = scene;
  run.detector = detector;
  run.levels[Level::kTriangle].truth = 10;
  run.geometry.covered_length_fraction = 1.0;
  run.geometry.missed_length = 0.0;
  run.geometry.late_frames = 0;
  run.contact_hash = "0x1";
  return run;
}

/// Timed at so many milliseconds a frame.
inline results::Run timed_run(const std::string& scene, const std::string& detector, double ms) {
  results::Run run = perfect_run(scene, detector);
  run.times.resize(1);
  run.times[0].playback.frame = ms;
  return run;
}

inline results::Results results_of(std::vector<results::Run> runs) {
  results::Results results;
  results.version = "1.0.0";
  results.machine = {"A", "AVX2", "Debian 12", "g++ 12", "Release", 2};
  results.runs = std::move(runs);
  return results;
}

}  // namespace contactcheck::test
