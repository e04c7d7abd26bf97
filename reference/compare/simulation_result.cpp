#include "reference/compare/simulation_result.h"

#include <nlohmann/json.hpp>

#include "reference/compare/nullable.h"
#include "reference/compare/run_result_json.h"
#include "reference/statistics/statistics.h"

namespace contactcheck {
namespace {

using Json = nlohmann::ordered_json;

double per_step(const StepTimes& times, double StepSum::*part) {
  std::vector<double> values;
  for (const StepSum& sum : times.sums) values.push_back(sum.*part);
  return median(std::move(values)) / static_cast<double>(times.steps);
}

}  // namespace

StepSum StepTimes::mean() const {
  return {per_step(*this, &StepSum::mss), per_step(*this, &StepSum::cell),
          per_step(*this, &StepSum::test), per_step(*this, &StepSum::response)};
}

Json to_json(const ClosedLoop& loop) {
  if (!loop.error.empty()) return {{"error", loop.error}};
  return {{"error", ""},
          {"steps", loop.steps},
          {"levels", levels_to_json(loop.levels, loop.semantics)},
          {"hover_at_rest_max", nullable(loop.hover_at_rest_max)},
          {"hover_at_rest_mean", nullable(loop.hover_at_rest_mean)},
          {"deepest_penetration", nullable(loop.deepest_penetration)},
          {"energy_gain", nullable(loop.energy_gain)},
          {"last_speed", loop.last_speed},
          {"tunnelling_events", loop.tunnelling_events}};
}

Json to_json(const StepTimes& times) {
  const StepSum mean = times.mean();
  Json tests = Json::array(), totals = Json::array();
  for (const StepSum& sum : times.sums) {
    tests.push_back(sum.test / static_cast<double>(times.steps));
    totals.push_back(sum.total() / static_cast<double>(times.steps));
  }
  return {{"steps", times.steps},     {"repeats", times.sums.size()},
          {"mss", mean.mss},          {"cell", mean.cell},
          {"test", mean.test},        {"response", mean.response},
          {"total", mean.total()},    {"test_by_repeat", tests},
          {"total_by_repeat", totals}};
}

}  // namespace contactcheck
