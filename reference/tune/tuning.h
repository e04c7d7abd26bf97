// From a scene and limits to a configuration: search, front, confirmation on held-out frames.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "reference/tune/frame_split.h"
#include "reference/tune/measuring.h"
#include "reference/tune/search.h"
#include "reference/tune/simulated_models.h"
#include "reference/tune/space.h"

namespace contactcheck::tune {

struct TuningRequest {
  std::string target;  ///< the scene as the user named it
  std::filesystem::path scene_file;
  SpaceRequest space;                  ///< without deformers: what they cost is measured first
  std::vector<std::string> deformers;  ///< to try beside the scene's own; it is simulated then
  Limits limits;
  std::optional<double> budget_ms;  ///< what the chosen one may cost per frame
  SearchSettings search;
  bool exhaustive = false;  ///< measure every candidate
  std::size_t frames = 0;   ///< to choose by; 0: see split_frames
  suite::RunSettings settings;
  /// Existing; for tune.json, tune.md, chosen.json and, in tune/, scenes and recordings.
  std::filesystem::path out;
  std::filesystem::path executable;
  results::KnownDefects known_defects;
  std::string command;  ///< for the record
  /// Runs that an interrupted search has measured, and where those of this one are kept; null:
  /// none.
  suite::KeptParts* kept = nullptr;
  /// For plug-ins, by id: the library's file, or the command.
  std::map<std::string, std::string> libraries, commands;
};

/// The state of the search, for a person who waits.
struct TuningProgress {
  std::size_t measured = 0, candidates = 0;
  std::string best;  ///< name of the cheapest that meets the limits; empty: none yet
  bool confirming = false;
  std::string simulating;  ///< with this deformer, before anything is measured; empty: not now
};

struct Tuning {
  std::string scene;
  std::vector<SimulatedModel> models;  ///< of a simulated scene, its own first
  std::vector<TuneCandidate> candidates;
  std::string anchor;  ///< name of the detector that costs are taken against
  SearchOutcome outcome;
  std::vector<std::size_t> front;  ///< indices into outcome.tried, by cost
  /// The cheapest that met the limits, measured again on the held-out frames, until one holds.
  std::vector<Tried> confirmed;
  std::optional<std::size_t> chosen;  ///< index into confirmed; none met the limits there
  /// Candidates that meet the limits and whose cost does not differ significantly from the chosen
  /// one's: on the held-out frames, or on the others if not measured there.
  std::vector<std::size_t> as_cheap;
  std::size_t frames = 0, held_out_frames = 0;
  /// What `run` takes: the scene as it was named, or a file in `out`; empty: none chosen.
  std::string chosen_scene;

  /// With deformers a frame is a step: its simulation is part of every cost.
  bool varies_deformers() const {
    return !candidates.empty() && !candidates.front().deformer.empty();
  }
  bool within_budget(const std::optional<double>& budget_ms) const;
};

/// Removes what an earlier run chose from `out` before anything is measured.
/// @throws InputError for what cannot be tuned
Tuning tune(const TuningRequest& request, const DetectorCatalog& catalog,
            const std::function<void(const TuningProgress&)>& progress);

/// tune.json (schema contactcheck-tune/1, reference/tune/README.md).
nlohmann::ordered_json to_json(const Tuning& tuning, const TuningRequest& request);

}  // namespace contactcheck::tune
