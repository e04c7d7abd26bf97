#include "reference/queries/query_judge.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include "core/types/check.h"
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

/// Microseconds between two readings of the clock, which every measured time holds as well.
double clock_cost() {
  double least = 1e9;
  for (int i = 0; i < 1000; ++i) {
    const auto start = Clock::now();
    least =
        std::min(least, std::chrono::duration<double, std::micro>(Clock::now() - start).count());
  }
  return least;
}

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
  explicit CostMeter(double clock) : clock_(clock) {}
  void add(Clock::duration took, std::size_t line) {
    // Rounded as the others are, so that none is above the worst.
    const double micros = static_cast<float>(
        std::max(0.0, std::chrono::duration<double, std::micro>(took).count() - clock_));
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
  double clock_, sum_ = 0, worst_ = 0;
  std::size_t worst_line_ = 0;
};

void count(ImpactScore& score, bool truth, bool reported, std::size_t line) {
  score.truth += truth ? 1 : 0;
  score.reported += reported ? 1 : 0;
  if (truth && reported) ++score.hit;
  if (truth && !reported && score.missed++ == 0) score.first_missed = line;
  if (!truth && reported && score.spurious++ == 0) score.first_spurious = line;
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
  Asked(const ImpactDetectorInfo& info, double clock) : detector_(info.make()), meter_(clock) {
    score_.detector = info.name;
    score_.precision = info.precision;
    if (info.precision == Precision::kSingle) score_.score_fed.emplace();
  }

  void ask(const std::vector<Judged>& block) {
    for (const Judged& judged : block) {
      ++score_.queries;
      if (!judged.query.in_doubles) {
        ++score_.refused;
        continue;
      }
      try {
        const auto start = Clock::now();
        const ReportedImpact answer = detector_->query(judged.query.query);
        meter_.add(Clock::now() - start, judged.query.line);
        judge(judged, answer);
      } catch (const RefusedInput&) {
        ++score_.refused;
      }
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
    for (auto& [decade, score] : decades_) {
      score.decade = decade;
      score_.decades.push_back(score);
    }
    return std::move(score_);
  }

 private:
  void judge(const Judged& judged, const ReportedImpact& answer) {
    const std::size_t line = judged.query.line;
    const Impact& truth = judged.truth;
    if (answer.contact && answer.time && !(*answer.time >= 0 && *answer.time <= 1)) {
      // Neither a hit nor a miss.
      if (score_.errors++ == 0) score_.first_error = line;
      return;
    }
    DecadeScore& decade = decades_[decade_of(judged.query.query)];
    count(score_.score, truth.contact, answer.contact, line);
    count(decade.score, truth.contact, answer.contact, line);
    if (score_.score_fed) {
      const ImpactQuery fed = detector_->fed(judged.query.query);
      count(*score_.score_fed, oracle::elementary_impact(fed).contact, answer.contact, line);
    }
    if (!truth.contact || !answer.contact || !answer.time) return;
    const double early = std::max(0.0, truth.earliest - *answer.time);
    const double late = std::max(0.0, *answer.time - truth.latest);
    early_.add(early);
    late_.add(late);
    TimeErrors& times = score_.times;
    times.before += early > 0 ? 1 : 0;
    times.after += late > 0 ? 1 : 0;
    times.early_max = std::max(times.early_max, early);
    times.late_max = std::max(times.late_max, late);
    decade.early_max = std::max(decade.early_max, early);
    decade.late_max = std::max(decade.late_max, late);
  }

  std::unique_ptr<ImpactDetector> detector_;
  DetectorScore score_;
  std::map<std::optional<int>, DecadeScore> decades_;
  CostMeter meter_;
  Values early_, late_;
};

}  // namespace

FileScore judge_queries(const std::string& name, ImpactKind kind, const NextQuery& next,
                        const std::vector<ImpactDetectorInfo>& detectors) {
  FileScore result;
  result.name = name;
  result.kind = kind;
  const double clock = clock_cost();
  std::vector<Asked> asked;
  for (const ImpactDetectorInfo& info : detectors)
    if (std::find(info.kinds.begin(), info.kinds.end(), kind) != info.kinds.end())
      asked.emplace_back(info, clock);
  CostMeter oracle_cost(clock);
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
      oracle_cost.add(Clock::now() - start, query.line);
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

FileScore judge_queries(const QueryTargets& targets,
                        const std::vector<ImpactDetectorInfo>& detectors) {
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
  FileScore result = judge_queries(targets.file.string(), targets.kind, next, detectors);
  if (targets.truth && truths.size() != read) fail(text::counted(read, "query", "queries"));
  return result;
}

}  // namespace contactcheck::queries
