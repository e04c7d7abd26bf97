// Candidates measured by runs of the suite: judged on every frame, timed one after another in the
// same passes.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/types/semantics.h"
#include "reference/run/suite_run.h"
#include "reference/tune/candidate.h"
#include "reference/tune/cost_book.h"

namespace contactcheck {

struct MeasuringRequest {
  std::filesystem::path scene_file;
  /// Recordings of the same scene moved by other deformers, by TuneCandidate::deformer.
  std::map<std::string, std::filesystem::path> other_deformers;
  Question question = Question::kBody;
  RunSettings settings;
  std::filesystem::path work;        ///< scenes in other lattices are kept here
  std::filesystem::path executable;  ///< see SuiteRequest
  KnownDefects known_defects;
  SuiteListener listener;
  /// The detector that costs are taken against; empty: the first that is measured and answers.
  std::string anchor;
};

/// The machine may be faster in one run than in the next, and for a moment busy with something
/// else. So the first detector that answers stays for all runs as what costs are taken against, and
/// all that the runs say is kept in one book (cost_book.h). What a run could not time costs what
/// earlier ones say.
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
  using Times = std::map<std::pair<std::string, std::string>, QuestionSamples>;

  ModelKey key_of(const TuneCandidate& candidate) const;
  const Model& own_model() const { return models_.at({}); }
  SceneTask task_of(const ModelKey& key, const std::vector<std::size_t>& batch) const;
  Model make_model(const ModelKey& key) const;
  results::Results run(const std::vector<ModelKey>& keys, const std::vector<std::size_t>& batch,
                       Times& times) const;
  void choose_anchor(const results::Index& rows, const std::vector<std::size_t>& batch);
  void take_times(const std::vector<ModelKey>& keys, const std::vector<std::size_t>& batch,
                  const Times& times);
  Measurement read(std::size_t index, const results::Index& rows) const;

  const std::vector<TuneCandidate>& candidates_;
  MeasuringRequest request_;
  std::string anchor_;  ///< name of the detector that costs are taken against
  std::map<ModelKey, Model> models_;
  CostBook book_;
};

}  // namespace contactcheck
