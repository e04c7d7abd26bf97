#include "reference/tune/cost_book.h"

#include <utility>

#include "core/types/check.h"
#include "reference/statistics/statistics.h"

namespace contactcheck {

void CostBook::set_unit(double anchor_ms) {
  CONTACTCHECK_INVARIANT(anchor_ms > 0.0, "a time to count in");
  unit_ms_ = anchor_ms;
  models_[{}].cost->anchor_ms = {anchor_ms, anchor_ms, anchor_ms};
}

void CostBook::add_model(const ModelKey& key, const Cost& step) { models_[key].cost->step = step; }

void CostBook::take_anchor(const ModelKey& key, const PairedRun& run) {
  if (key == ModelKey{} || run.empty()) return;
  Model& model = models_.at(key);
  model.scales.push_back(relative_cost({run}));
  const Ratio scale = median_ratio(model.scales);
  model.cost->anchor_ms = {unit_ms_ * scale.value, unit_ms_ * scale.low, unit_ms_ * scale.high};
}

void CostBook::take(std::size_t candidate, PairedRun run) {
  if (!run.empty()) paired_[candidate].push_back(std::move(run));
}

bool CostBook::price(std::size_t candidate, const ModelKey& key, Measurement& m) const {
  const Model& model = models_.at(key);
  const auto runs = paired_.find(candidate);
  if (runs == paired_.end() || (key != ModelKey{} && model.scales.empty())) return false;
  m.beside_anchor = relative_cost(runs->second);
  m.model = model.cost;
  return true;
}

}  // namespace contactcheck
