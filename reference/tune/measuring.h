// Candidates measured by runs of the suite: judged on every frame, timed one after another in the
// same passes.
#pragma once

#include <compare>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/types/semantics.h"
#include "reference/scene/scene.h"
#include "reference/suite/kept_work.h"
#include "reference/suite/suite_run.h"
#include "reference/tune/candidate.h"
#include "reference/tune/measurement.h"
#include "reference/tune/paired_cost.h"

namespace contactcheck::tune {

// A scene in lattices of another resolution.

/// Writes the scene of `file` with `factor` times as many kept cells per body into `folder`; the id
/// gets "-lattice-PERCENT" behind it. Returns the new file.
/// @throws InputError for what is no scene file, or has a body whose lattice gives no number of
/// cells
std::filesystem::path write_lattice_variant(const std::filesystem::path& file, double factor,
                                            const std::filesystem::path& folder);

/// The largest distance of a deformed vertex of one scene from the same vertex of the other, over
/// all frames, metres. @throws InputError when they do not have the same meshes
double deviation(const scene::Scene& scene, const scene::Scene& variant);

// What all runs so far have timed, candidate by candidate and model by model.

/// A scene in some lattices, moved by some deformer; as made: the scene's own.
struct ModelKey {
  double lattice = 1.0;
  std::string deformer;  ///< empty: the scene's own

  auto operator<=>(const ModelKey&) const = default;
};

/// A candidate costs its ratio to the anchor in its own model, over all runs. The anchor's time is
/// measured in the scene's own model, in one run; in any other model it is that time multiplied by
/// the median of what all runs say (median_ratio), for every candidate of the model alike.
class CostBook {
 public:
  /// What the anchor takes for a frame in the scene's own model. @pre above 0
  void set_unit(double anchor_ms);
  bool has_unit() const { return unit_ms_ > 0.0; }

  void add_model(const ModelKey& key, const Cost& step);

  /// The anchor in another model beside itself in the scene's own, in one run. Empty: not timed.
  /// @pre has_unit() and the model was added
  void take_anchor(const ModelKey& key, const PairedRun& run);
  /// A candidate beside the anchor in its own model, in one run. Empty: not timed.
  void take(std::size_t candidate, PairedRun run);

  /// Sets what a candidate costs by all that was taken; false, and nothing is set, where that says
  /// nothing. Later runs correct the model of what was priced before. @pre the model was added
  bool price(std::size_t candidate, const ModelKey& key, Measurement& m) const;

 private:
  struct Model {
    std::shared_ptr<ModelCost> cost = std::make_shared<ModelCost>();
    std::vector<results::Ratio> scales;  ///< of the anchor, one of each run
  };

  double unit_ms_ = 0.0;
  std::map<ModelKey, Model> models_;
  std::map<std::size_t, std::vector<PairedRun>> paired_;  ///< by candidate
};

struct MeasuringRequest {
  std::filesystem::path scene_file;
  /// Recordings of the same scene moved by other deformers, by TuneCandidate::deformer.
  std::map<std::string, std::filesystem::path> other_deformers;
  Question question = Question::kBody;
  suite::RunSettings settings;
  std::filesystem::path work;        ///< scenes in other lattices are kept here
  std::filesystem::path executable;  ///< see SuiteRequest
  results::KnownDefects known_defects;
  suite::SuiteListener listener;
  /// Runs that were measured before, and those to be kept; null: none.
  suite::KeptParts* kept = nullptr;
  /// The detector that costs are relative to; empty: the first that is measured and answers.
  std::string anchor;
};

/// The machine may be faster in one run than in the next, or briefly busy. So the first detector
/// that answers is the anchor of all runs, and one CostBook keeps all their results. What a run
/// could not time has the cost of earlier runs.
class Measuring {
 public:
  Measuring(const std::vector<TuneCandidate>& candidates, MeasuringRequest request);

  /// Measures candidates in one run; as many answers in the same order, out of all that was ever
  /// measured of each.
  /// @throws InputError for scenes that cannot be read
  std::vector<Measurement> operator()(const std::vector<std::size_t>& batch);

  /// Empty before anything was measured.
  const std::string& anchor() const { return anchor_; }

  /// The scene of a candidate: the given one, one in other lattices, or moved by another deformer.
  std::filesystem::path scene_of(const TuneCandidate& candidate) const;

 private:
  struct Model {
    std::filesystem::path file;
    std::string id;  ///< of its scene
    double deviation = 0.0;
  };

  /// What one run timed, by scene and detector.
  using Times = std::map<std::pair<std::string, std::string>, timing::QuestionSamples>;

  ModelKey key_of(const TuneCandidate& candidate) const;
  const Model& own_model() const { return models_.at({}); }
  Model make_model(const ModelKey& key) const;
  results::Results run(const std::vector<ModelKey>& keys, const std::vector<std::size_t>& batch,
                       Times& times) const;
  void choose_anchor(const results::Index& rows, const std::vector<std::size_t>& batch);

  const std::vector<TuneCandidate>& candidates_;
  MeasuringRequest request_;
  std::string anchor_;  ///< name of the detector that costs are taken against
  std::map<ModelKey, Model> models_;
  CostBook book_;
};

}  // namespace contactcheck::tune
