// What all runs so far have timed, candidate by candidate and model by model.
#pragma once

#include <compare>
#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "reference/tune/measurement.h"
#include "reference/tune/paired_cost.h"

namespace contactcheck {

/// A scene in some lattices, moved by some deformer; as made: the scene's own.
struct ModelKey {
  double lattice = 1.0;
  std::string deformer;  ///< empty: the scene's own

  auto operator<=>(const ModelKey&) const = default;
};

/// A candidate costs its ratio to the anchor in its own model, all runs pooled. The anchor's own
/// time is known in the scene's own model, from one run; in any other it is that times what all
/// runs so far say in the middle (median_ratio), for every candidate of the model alike.
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
    std::vector<Ratio> scales;  ///< of the anchor, one of each run
  };

  double unit_ms_ = 0.0;
  std::map<ModelKey, Model> models_;
  std::map<std::size_t, std::vector<PairedRun>> paired_;  ///< by candidate
};

}  // namespace contactcheck
