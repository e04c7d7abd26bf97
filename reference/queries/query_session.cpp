#include "reference/queries/query_session.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "core/types/check.h"

namespace contactcheck::queries {
namespace {

using Clock = std::chrono::steady_clock;
using Micros = std::chrono::duration<double, std::micro>;

/// Between two readings of the clock, which every measured time holds as well.
double clock_cost() {
  double least = 1e9;
  for (int i = 0; i < 1000; ++i) {
    const auto start = Clock::now();
    least = std::min(least, Micros(Clock::now() - start).count());
  }
  return least;
}

class LocalSession final : public QuerySession {
 public:
  explicit LocalSession(std::unique_ptr<ImpactDetector> detector)
      : detector_(std::move(detector)), clock_cost_(clock_cost()) {}

  void ask(std::span<const ImpactQuery> queries, std::vector<TimedAnswer>& answers) override {
    answers.clear();
    for (const ImpactQuery& query : queries) {
      TimedAnswer answer;
      try {
        const auto start = Clock::now();
        answer.impact = detector_->query(query);
        answer.micros = std::max(0.0, Micros(Clock::now() - start).count() - clock_cost_);
      } catch (const RefusedInput&) {
        answer = {};
        answer.refused = true;
      }
      answers.push_back(answer);
    }
  }

  ImpactTolerance tolerance() const override { return detector_->tolerance(); }
  ImpactQuery fed(const ImpactQuery& query) const override { return detector_->fed(query); }

 private:
  std::unique_ptr<ImpactDetector> detector_;
  double clock_cost_;
};

}  // namespace

QueryDetector local_detector(const ImpactDetectorInfo& info, const DetectorSpec& spec) {
  return {spec.name, info.precision, info.kinds,
          [make = info.make, options = spec.options] { return local_session(make(options)); }};
}

std::unique_ptr<QuerySession> local_session(std::unique_ptr<ImpactDetector> detector) {
  return std::make_unique<LocalSession>(std::move(detector));
}

}  // namespace contactcheck::queries
