// Results of a made-up run of the paper's scene "s", in figures that divide without rounding.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "reference/reproduce/paper_tables.h"

namespace contactcheck::test {

using Json = nlohmann::ordered_json;

/// The sample paper with methods that contactcheck knows: from one to two levels of spheres 40 to
/// 20 ms of collision test (2.00x), 60 to 40 ms in all (1.500x).
reproduce::PaperTables paper_of_our_methods();

/// Milliseconds per step of one detector; the test's and the total's median is the middle repeat's.
struct SampleTimes {
  double mss = 1.0, cell = 2.0, response = 1.0;
  std::vector<double> test_by_repeat;  ///< three of them
};

Json sample_step_ms(const SampleTimes& times);
/// A run with status ok and without stages, judged at the level `cell`.
Json sample_run(const std::string& detector, const Json& step_ms, const std::string& hash,
                int missed);
Json sample_closed_loop();

/// One scene, "paper-s": two bodies of 11 vertices, 16 triangles and 3 cells, simulated at 0.02 s a
/// step; machine and version filled in, no run.
Json sample_results();

/// `sample_results` with one and two levels of spheres in the readings safe and paper:
/// safe: collision tests of 6 and 4 ms (repeats 5, 6, 7 and 4, 4, 4), totals 10 and 8, one hash;
/// 40 and 10 pairs of cells into the hash;
/// paper: collision tests of 6 and 2 ms, totals 10 and 6, two hashes, 3 and 5 of 20 missed.
Json sample_reproduction_results();

}  // namespace contactcheck::test
