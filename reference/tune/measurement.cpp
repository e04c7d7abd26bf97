#include "reference/tune/measurement.h"

#include <array>
#include <cstdlib>

#include "reference/results/statistics.h"

namespace contactcheck::tune {
namespace {

std::array<double, 6> badness(const Measurement& m) {
  return {m.cost().ms,
          static_cast<double>(m.missed),
          static_cast<double>(m.spurious),
          m.hover.value_or(0.0),
          static_cast<double>(std::labs(m.late_frames.value_or(0))),
          m.deviation};
}

}  // namespace

Cost Measurement::cost() const {
  if (!failure.empty()) return {};
  const ModelCost shared = model ? *model : ModelCost{};
  const results::Ratio own = results::product(shared.anchor_ms, beside_anchor);
  return {own.value + shared.step.ms, own.low + shared.step.low_ms, own.high + shared.step.high_ms};
}

bool Limits::met_by(const Measurement& m) const {
  if (!m.failure.empty()) return false;
  return (!missed || m.missed <= *missed) && (!spurious || m.spurious <= *spurious) &&
         (!hover || m.hover.value_or(0.0) <= *hover) &&
         (!late_frames || std::labs(m.late_frames.value_or(0)) <= *late_frames) &&
         (!deviation || m.deviation <= *deviation);
}

bool as_cheap_within_noise(const Measurement& a, const Measurement& b) {
  if (!a.failure.empty() || !b.failure.empty()) return false;
  if (a.model == b.model)
    return a.beside_anchor.low <= b.beside_anchor.high &&
           b.beside_anchor.low <= a.beside_anchor.high;
  const Cost first = a.cost(), second = b.cost();
  return first.low_ms <= second.high_ms && second.low_ms <= first.high_ms;
}

bool dominates(const Measurement& a, const Measurement& b) {
  if (!a.failure.empty() || !b.failure.empty()) return a.failure.empty() && !b.failure.empty();
  const auto first = badness(a), second = badness(b);
  bool better = false;
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (first[i] > second[i]) return false;
    better |= first[i] < second[i];
  }
  return better;
}

}  // namespace contactcheck::tune
