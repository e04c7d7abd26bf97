#include "reference/gate/measure.h"

#include <limits>

namespace contactcheck {
namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();

constexpr Measure kMeasures[] = {
    {"recall", MeasureKind::kLevel, "", 0, 1},
    {"missed", MeasureKind::kLevel, "", 0, kEndless},
    {"spurious", MeasureKind::kLevel, "", 0, kEndless},
    {"spurious_rate", MeasureKind::kLevel, "", 0, 1},
    {"missed_length", MeasureKind::kGeometry, "m", 0, kEndless},
    {"covered_length_fraction", MeasureKind::kGeometry, "", 0, 1},
    {"spurious_distance_max", MeasureKind::kGeometry, "m", 0, kEndless},
    {"depth_error_max", MeasureKind::kGeometry, "m", 0, kEndless},
    {"depth_error_p95", MeasureKind::kGeometry, "m", 0, kEndless},
    {"depth_error_mean", MeasureKind::kGeometry, "m", 0, kEndless},
    {"normal_error_deg_max", MeasureKind::kGeometry, "degrees", 0, 180},
    {"normal_error_deg_p95", MeasureKind::kGeometry, "degrees", 0, 180},
    {"normal_error_deg_mean", MeasureKind::kGeometry, "degrees", 0, 180},
    {"hover_gap_max", MeasureKind::kGeometry, "m", 0, kEndless},
    {"late_frames", MeasureKind::kGeometry, "", -kEndless, kEndless},
    {"stage_missed", MeasureKind::kStages, "", 0, kEndless},
    {"memory_bytes", MeasureKind::kMemory, "bytes", 0, kEndless},
    {"known_defects", MeasureKind::kDefects, "", 0, kEndless},
    {"oracle_wrong", MeasureKind::kOracle, "", 0, kEndless},
    {"contact_hash", MeasureKind::kHash, "", 0, 0},
    {"status", MeasureKind::kStatus, "", 0, 0},
    {"speedup", MeasureKind::kSpeedup, "x", 0, kEndless},
    {"slowdown", MeasureKind::kSlowdown, "x", 0, kEndless}};

}  // namespace

const Measure* find_measure(const std::string& name) {
  for (const Measure& m : kMeasures)
    if (name == m.name) return &m;
  return nullptr;
}

std::vector<std::string> measure_names() {
  std::vector<std::string> names;
  for (const Measure& m : kMeasures) names.emplace_back(m.name);
  return names;
}

bool is_timing(const Measure& measure) {
  return measure.kind == MeasureKind::kSpeedup || measure.kind == MeasureKind::kSlowdown;
}

bool is_accuracy_number(const Measure& measure) {
  return !is_timing(measure) && measure.kind != MeasureKind::kHash &&
         measure.kind != MeasureKind::kStatus;
}

}  // namespace contactcheck
