#include "reference/queries/query_judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <map>
#include <memory>
#include <stdexcept>
#include <utility>

#include "core/types/check.h"
#include "reference/oracle/impact_distance.h"
#include "reference/text/counted.h"

namespace contactcheck::queries {
namespace {

using Clock = std::chrono::steady_clock;

/// Queries that are read and judged before the detectors are asked: what the oracle leaves in the
/// caches is gone by the second one, and memory stays small.
constexpr std::size_t kBlock = 4096;
constexpr std::size_t kLinesNamed = 5;

struct Judged {
  FileQuery query;
  Impact truth;
};

/// Values of which a median, a percentile and the largest are wanted. Floats: a gigabyte of queries
/// has some three million.
class Values {
 public:
  void add(double value) { values_.push_back(static_cast<float>(value)); }
  std::size_t size() const { return values_.size(); }
  /// The value below which a share of the others lies; 0 of none.
  double at(double share) {
    if (values_.empty()) return 0;
    const auto place = static_cast<std::size_t>(share * static_cast<double>(values_.size() - 1));
    std::nth_element(values_.begin(), values_.begin() + static_cast<std::ptrdiff_t>(place),
                     values_.end());
    return values_[place];
  }

 private:
  std::vector<float> values_;
};

class CostMeter {
 public:
  void add(double exact_micros, std::size_t line) {
    // Rounded as the others are, so that none is above the worst.
    const double micros = static_cast<float>(exact_micros);
    values_.add(micros);
    sum_ += micros;
    if (micros > worst_) {
      worst_ = micros;
      worst_line_ = line;
    }
  }
  QueryCost cost() {
    if (values_.size() == 0) return {};
    return {values_.at(0.5), sum_ / static_cast<double>(values_.size()), values_.at(0.99), worst_,
            worst_line_};
  }

 private:
  Values values_;
  double sum_ = 0, worst_ = 0;
  std::size_t worst_line_ = 0;
};

/// How a report compares with a truth.
struct Verdict {
  bool truth = false, reported = false;
  oracle::NearVerdict near = oracle::NearVerdict::kSpurious;  ///< of a report that is not true
  double distance = 0;  ///< metres; of one that is near: at least as large as the smallest
};

Verdict verdict_on(const ImpactQuery& query, bool truth, const ReportedImpact& answer,
                   const ImpactTolerance& tolerance, const ImpactTolerance& cap) {
  Verdict verdict{truth, answer.contact};
  if (truth || !answer.contact || (tolerance.absolute == 0 && tolerance.of_start == 0))
    return verdict;
  verdict.near = oracle::NearVerdict::kNear;
  for (const ImpactTolerance& limit :
       {tolerance, ImpactTolerance{cap.absolute, 0}, ImpactTolerance{0, cap.of_start}}) {
    if (!std::isfinite(limit.absolute) || !std::isfinite(limit.of_start)) continue;
    const oracle::NearMiss miss = oracle::near_miss(query, limit);
    if (miss.verdict != oracle::NearVerdict::kNear) {
      verdict.near = miss.verdict;
      return verdict;
    }
  }
  // Within a large tolerance the distance itself is not looked for; without one it is.
  verdict.distance = oracle::near_miss(query, {}).at_most;
  return verdict;
}

void add(ImpactScore& score, const Verdict& verdict, std::size_t line) {
  score.truth += verdict.truth ? 1 : 0;
  score.reported += verdict.reported ? 1 : 0;
  if (verdict.truth && verdict.reported) ++score.hit;
  if (verdict.truth && !verdict.reported && score.missed++ == 0) score.first_missed = line;
  if (verdict.truth || !verdict.reported) return;
  if (verdict.near == oracle::NearVerdict::kNear) {
    ++score.near;
    score.near_max = std::max(score.near_max, verdict.distance);
  } else if (verdict.near == oracle::NearVerdict::kUndecided) {
    ++score.undecided;
  } else if (score.spurious++ == 0) {
    score.first_spurious = line;
  }
}

bool within_at_start(const ImpactQuery& query, double tolerance) {
  if (tolerance == 0) return false;
  const ImpactQuery resting{query.kind, query.start, query.start};
  return oracle::near_miss(resting, {tolerance, 0}).verdict == oracle::NearVerdict::kNear;
}

/// The decade of the longest edge at t = 0.
std::optional<int> decade_of(const ImpactQuery& query) {
  const auto& p = query.start;
  const double longest = query.kind == ImpactKind::vertex_triangle
                             ? std::max({(p[1] - p[2]).stableNorm(), (p[2] - p[3]).stableNorm(),
                                         (p[3] - p[1]).stableNorm()})
                             : std::max((p[0] - p[1]).stableNorm(), (p[2] - p[3]).stableNorm());
  if (!(longest > 0)) return std::nullopt;
  // Beyond the largest double, and below 2 sqrt(3) times that.
  if (!std::isfinite(longest)) return 308;
  return static_cast<int>(std::floor(std::log10(longest)));
}

/// One detector while a file is judged.
class Asked {
 public:
  Asked(const QueryDetector& detector, const ImpactTolerance& cap)
      : session_(detector.open()), cap_(cap) {
    score_.detector = detector.name;
    score_.precision = detector.precision;
    score_.tolerance = session_->tolerance();
    if (detector.precision == Precision::kSingle) score_.score_fed.emplace();
  }

  void ask(const std::vector<Judged>& block) {
    if (!score_.failure.empty()) return;
    std::vector<ImpactQuery> queries;
    std::vector<const Judged*> asked;
    for (const Judged& judged : block) {
      if (!judged.query.in_doubles || is_beyond_precision(judged.query.query)) {
        ++score_.queries;
        ++score_.refused;
        continue;
      }
      queries.push_back(judged.query.query);
      asked.push_back(&judged);
    }
    std::vector<TimedAnswer> answers;
    try {
      session_->ask(queries, answers);
    } catch (const std::runtime_error& e) {
      score_.failure = e.what();
      score_.failed_at = asked.at(answers.size())->query.line;
    }
    for (std::size_t i = 0; i < answers.size(); ++i) {
      ++score_.queries;
      if (answers[i].refused) {
        ++score_.refused;
        continue;
      }
      meter_.add(answers[i].micros, asked[i]->query.line);
      decades_[decade_of(asked[i]->query.query)].micros.add(answers[i].micros);
      judge(*asked[i], answers[i].impact);
    }
  }

  DetectorScore finish() {
    score_.cost = meter_.cost();
    TimeErrors& times = score_.times;
    times.timed = early_.size();
    times.early_median = early_.at(0.5);
    times.early_99 = early_.at(0.99);
    times.late_median = late_.at(0.5);
    times.late_99 = late_.at(0.99);
    for (auto& [number, decade] : decades_) {
      decade.score.decade = number;
      decade.score.answered = decade.micros.size();
      decade.score.micros = decade.micros.at(0.5);
      score_.decades.push_back(decade.score);
    }
    return std::move(score_);
  }

 private:
  /// No float holds some coordinate of it: there is no query that it would answer.
  bool is_beyond_precision(const ImpactQuery& query) const {
    if (!score_.score_fed) return false;
    const ImpactQuery fed = session_->fed(query);
    return !std::ranges::all_of(fed.start, &Vec3::allFinite) ||
           !std::ranges::all_of(fed.end, &Vec3::allFinite);
  }

  /// What it calls contact in this query.
  ImpactTolerance tolerance_of(const ReportedImpact& answer) const {
    ImpactTolerance tolerance = session_->tolerance();
    if (answer.tolerance) tolerance = {*answer.tolerance, 0};
    return tolerance;
  }

  void judge(const Judged& judged, const ReportedImpact& answer) {
    const std::size_t line = judged.query.line;
    const ImpactQuery& query = judged.query.query;
    const Impact& truth = judged.truth;
    const bool time_is_none = answer.time && !(*answer.time >= 0 && *answer.time <= 1);
    const bool tolerance_is_none =
        answer.tolerance && !(*answer.tolerance >= 0 && std::isfinite(*answer.tolerance));
    if (answer.contact && (time_is_none || tolerance_is_none)) {
      // Neither a hit nor a miss.
      if (score_.errors++ == 0) {
        score_.first_error = line;
        score_.first_error_is = time_is_none
                                    ? fmt::format("a time of {:g}", *answer.time)
                                    : fmt::format("a tolerance of {:g} m", *answer.tolerance);
      }
      return;
    }
    const ImpactTolerance tolerance = tolerance_of(answer);
    DecadeScore& decade = decades_[decade_of(query)].score;
    const Verdict verdict = verdict_on(query, truth.contact, answer, tolerance, cap_);
    add(score_.score, verdict, line);
    add(decade.score, verdict, line);
    if (score_.score_fed) {
      const ImpactQuery fed = session_->fed(query);
      const bool truth_fed = oracle::elementary_impact(fed).contact;
      add(*score_.score_fed, verdict_on(fed, truth_fed, answer, tolerance, cap_), line);
    }
    if (!truth.contact || !answer.contact || !answer.time) return;
    if (*answer.time == 0 && !truth.starts_in_contact &&
        within_at_start(query, std::min(tolerance.absolute, cap_.absolute))) {
      ++score_.times.near_at_start;
      return;
    }
    const double early = std::max(0.0, truth.earliest - *answer.time);
    const double late = std::max(0.0, *answer.time - truth.latest);
    early_.add(early);
    late_.add(late);
    TimeErrors& times = score_.times;
    times.before += early > 0 ? 1 : 0;
    times.after += late > 0 ? 1 : 0;
    times.early_max = std::max(times.early_max, early);
    times.late_max = std::max(times.late_max, late);
    ++decade.timed;
    decade.early_max = std::max(decade.early_max, early);
    decade.late_max = std::max(decade.late_max, late);
  }

  std::unique_ptr<QuerySession> session_;
  ImpactTolerance cap_;
  DetectorScore score_;
  struct Decade {
    DecadeScore score;
    Values micros;
  };
  std::map<std::optional<int>, Decade> decades_;
  CostMeter meter_;
  Values early_, late_;
};

}  // namespace

FileScore judge_queries(const std::string& name, ImpactKind kind, const NextQuery& next,
                        const std::vector<QueryDetector>& detectors, const ImpactTolerance& cap) {
  FileScore result;
  result.name = name;
  result.kind = kind;
  std::vector<Asked> asked;
  for (const QueryDetector& detector : detectors)
    if (std::find(detector.kinds.begin(), detector.kinds.end(), kind) != detector.kinds.end())
      asked.emplace_back(detector, cap);
    else
      result.of_another_kind.push_back(detector.name);
  CostMeter oracle_cost;
  std::vector<Judged> block;
  std::map<std::optional<int>, DecadeTruth> decades;
  for (bool more = true; more;) {
    block.clear();
    while (block.size() < kBlock) {
      Judged judged;
      more = next(judged.query);
      if (!more) break;
      const FileQuery& query = judged.query;
      const auto start = Clock::now();
      judged.truth = query.in_doubles ? oracle::elementary_impact(query.query)
                                      : oracle::elementary_impact(query.rational);
      oracle_cost.add(std::chrono::duration<double, std::micro>(Clock::now() - start).count(),
                      query.line);
      ++result.queries;
      result.contacts += judged.truth.contact ? 1 : 0;
      result.starts_in_contact += judged.truth.starts_in_contact ? 1 : 0;
      result.not_doubles += query.in_doubles ? 0 : 1;
      if (query.in_doubles) {
        DecadeTruth& decade = decades[decade_of(query.query)];
        ++decade.queries;
        decade.contacts += judged.truth.contact ? 1 : 0;
      }
      if (query.truth) {
        ++result.file_truths;
        if (*query.truth != judged.truth.contact) {
          ++result.file_wrong;
          if (result.wrong_lines.size() < kLinesNamed) result.wrong_lines.push_back(query.line);
        }
      }
      block.push_back(std::move(judged));
    }
    for (Asked& detector : asked) detector.ask(block);
  }
  result.oracle = oracle_cost.cost();
  for (auto& [decade, truth] : decades) {
    truth.decade = decade;
    result.decades.push_back(truth);
  }
  for (Asked& detector : asked) result.detectors.push_back(detector.finish());
  return result;
}

FileScore judge_queries(const QueryTargets& targets, const std::vector<QueryDetector>& detectors,
                        const ImpactTolerance& cap) {
  QueryReader reader(targets.file, targets.kind);
  std::vector<bool> truths;
  if (targets.truth) truths = read_truth(*targets.truth);
  std::size_t read = 0;
  const auto fail = [&](const std::string& how_many) {
    throw InputError(targets.truth->string() + ": " + text::counted(truths.size(), "truth") +
                     ", and " + targets.file.string() + " has " + how_many);
  };
  const auto next = [&](FileQuery& query) {
    if (!reader.next(query)) return false;
    if (targets.truth) {
      if (read == truths.size()) fail("more queries");
      query.truth = truths[read];
    }
    ++read;
    return true;
  };
  FileScore result = judge_queries(targets.file.string(), targets.kind, next, detectors, cap);
  if (targets.truth && truths.size() != read) fail(text::counted(read, "query", "queries"));
  return result;
}

}  // namespace contactcheck::queries
