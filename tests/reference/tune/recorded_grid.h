// Measurements that a run has written, as a grid to hold the search against.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "core/detect/registry.h"
#include "core/types/shortest.h"
#include "tests/reference/tune/grids.h"
#include "tests/support/files.h"

namespace contactcheck::test {

/// The choices that a name stands for are read off the catalogue.
inline tune::TuneCandidate recorded_candidate(const nlohmann::json& row,
                                              const DetectorCatalog& catalog) {
  tune::TuneCandidate candidate;
  candidate.detector = row.at("detector");
  candidate.lattice = row.at("lattice");
  const DetectorSpec spec = catalog.parse(candidate.detector);
  candidate.choices.push_back({"detector", spec.id});
  for (const auto& [option, value] : spec.options) candidate.choices.push_back({option, value});
  candidate.choices.push_back({"lattice", shortest(candidate.lattice)});
  candidate.usual = candidate.detector == spec.id && candidate.lattice == 1.0;
  return candidate;
}

inline tune::Measurement recorded_measurement(const nlohmann::json& row) {
  tune::Measurement m;
  m.failure = row.value("failure", "");
  if (!m.failure.empty()) return m;
  m.beside_anchor = {row.at("cost_ms"), row.at("cost_ms_low"), row.at("cost_ms_high")};
  m.missed = row.at("missed");
  m.spurious = row.at("spurious");
  if (!row.at("hover_gap_max").is_null()) m.hover = row.at("hover_gap_max").get<double>();
  if (!row.at("late_frames").is_null()) m.late_frames = row.at("late_frames").get<long>();
  m.deviation = row.at("deviation_max");
  return m;
}

/// What `tune --exhaustive` measured, in the order of its file (fixtures/README.md, "Tune").
inline Grid recorded_grid(const std::filesystem::path& tune_json) {
  DetectorCatalog catalog;
  register_core_detectors(catalog);
  const nlohmann::json document = nlohmann::json::parse(text_of(tune_json));
  Grid grid;
  for (const nlohmann::json& row : document.at("measured")) {
    grid.candidates.push_back(recorded_candidate(row, catalog));
    grid.truth.push_back(recorded_measurement(row));
  }
  return grid;
}

}  // namespace contactcheck::test
