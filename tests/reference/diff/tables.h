// Tables of results written by hand.
#pragma once

#include "reference/diff/result_table.h"

namespace contactcheck::test {

/// A row that found 10 of 10 true triangle pairs and no others.
inline ResultRow perfect_row(const std::string& scene, const std::string& detector) {
  ResultRow row;
  row.scene = scene;
  row.detector = detector;
  row.status = "ok";
  row.levels["triangle"] = {10, 0, 0, false};
  row.geometry = {{"covered_length_fraction", 1.0}, {"missed_length", 0.0}, {"late_frames", 0.0}};
  row.contact_hash = "0x1";
  return row;
}

/// Timed at so many milliseconds a frame.
inline ResultRow timed_row(const std::string& scene, const std::string& detector, double cold_ms) {
  ResultRow row = perfect_row(scene, detector);
  row.times = {{"triangles", cold_ms, cold_ms}};
  return row;
}

inline ResultTable table_of(std::vector<ResultRow> rows) {
  ResultTable table;
  table.version = "1.0.0";
  table.machine = {{"cpu", "A"}, {"isa", "AVX2"}, {"compiler", "g++ 12"}, {"build", "Release"}};
  table.rows = std::move(rows);
  return table;
}

}  // namespace contactcheck::test
