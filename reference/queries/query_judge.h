// Judges detectors of elementary impacts, query by query, by the oracle.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/types/impact.h"
#include "reference/queries/query_file.h"
#include "reference/queries/query_session.h"

namespace contactcheck::queries {

/// How answers compare with one truth.
struct ImpactScore {
  std::uint64_t truth = 0, reported = 0, hit = 0, missed = 0, spurious = 0;
  /// Reports that are not true, but whose elements come as near as the detector's tolerance, under
  /// the cap; and those of which subdivision did not decide it.
  std::uint64_t near = 0, undecided = 0;
  double near_max = 0;  ///< metres: the largest of the smallest distances of those in `near`
  std::optional<std::size_t> first_missed, first_spurious;  ///< lines of the file
};

/// Errors of times of contact, over hits with a time; fractions of the step. Early: true time less
/// reported time, late the other way round, each at least 0.
struct TimeErrors {
  std::uint64_t timed = 0;
  /// Hits that are not among them: reported at t = 0, when the elements were within the tolerance.
  std::uint64_t near_at_start = 0;
  std::uint64_t before = 0, after = 0;  ///< reported before or after the true interval
  double early_median = 0, early_99 = 0, early_max = 0;
  double late_median = 0, late_99 = 0, late_max = 0;
};

/// Microseconds a query.
struct QueryCost {
  double median = 0, mean = 0, percentile_99 = 0, worst = 0;
  std::size_t worst_line = 0;
};

/// By the longest edge of the elements at t = 0: from 10^decade metres to ten times that.
struct DecadeScore {
  std::optional<int> decade;  ///< none: the elements are points
  ImpactScore score;
  double early_max = 0, late_max = 0;
  std::uint64_t timed = 0;  ///< hits with a time
  double micros = 0;        ///< median of a query that it answered
  std::uint64_t answered = 0;
};

/// The queries of a decade.
struct DecadeTruth {
  std::optional<int> decade;
  std::uint64_t queries = 0, contacts = 0;
};

/// One detector on one file.
struct DetectorScore {
  std::string detector;
  Precision precision = Precision::kDouble;
  std::uint64_t queries = 0;
  /// Queries whose rationals are no doubles, which it is not asked, and those that it refuses.
  std::uint64_t refused = 0;
  ImpactScore score;  ///< against the truth for the doubles
  std::optional<ImpactScore>
      score_fed;  ///< single precision: against the truth for what it was fed
  TimeErrors times;
  QueryCost cost;
  /// Times that are no number or outside [0, 1], tolerances that are none.
  std::uint64_t errors = 0;
  std::optional<std::size_t> first_error;
  std::string first_error_is;  ///< "a time of nan"
  ImpactTolerance tolerance;   ///< as it is declared, with its options
  /// One sentence: it crashed, hung or failed, and was asked no more; empty otherwise.
  std::string failure;
  std::optional<std::size_t> failed_at;  ///< the line of the query that it did not answer
  std::vector<DecadeScore> decades;      ///< ascending; those that occur
};

/// One file (or value of a family), its own truth, and all detectors that answer its kind.
struct FileScore {
  std::string name;  ///< of a file its path
  ImpactKind kind = ImpactKind::vertex_triangle;
  std::uint64_t queries = 0, contacts = 0, starts_in_contact = 0, not_doubles = 0;
  std::uint64_t file_truths = 0, file_wrong = 0;  ///< queries with a truth in a file; of them wrong
  std::vector<std::size_t> wrong_lines;           ///< the first few
  std::vector<DecadeTruth> decades;               ///< ascending; those that occur
  std::vector<std::string> of_another_kind;       ///< detectors that were not asked
  QueryCost oracle;
  std::vector<DetectorScore> detectors;
};

struct QueryTargets {
  std::filesystem::path file;
  ImpactKind kind = ImpactKind::vertex_triangle;
  std::optional<std::filesystem::path> truth;
};

/// Gives the next query; false when there is none.
using NextQuery = std::function<bool(FileQuery&)>;

/// Farther than either of these, no report is near, whatever a detector tolerates: metres, and a
/// share of the distance at the start.
inline constexpr ImpactTolerance kNoCap = {std::numeric_limits<double>::infinity(),
                                           std::numeric_limits<double>::infinity()};

/// Asks each detector about all queries of a block in turn, block by block.
FileScore judge_queries(const std::string& name, ImpactKind kind, const NextQuery& next,
                        const std::vector<QueryDetector>& detectors,
                        const ImpactTolerance& cap = kNoCap);

/// The same, of a file, which is read once.
/// @throws InputError for a bad file, naming it and the line
FileScore judge_queries(const QueryTargets& targets, const std::vector<QueryDetector>& detectors,
                        const ImpactTolerance& cap = kNoCap);

}  // namespace contactcheck::queries
