// How detectors are asked about queries and measured: in this process, or in a worker.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/detect/impact_detector.h"
#include "core/detect/registry.h"
#include "core/types/impact.h"
#include "core/types/semantics.h"

namespace contactcheck::queries {

/// What a detector answered to one query, and what it took.
struct TimedAnswer {
  bool refused = false;  ///< it must not answer this one; then nothing else is set
  ReportedImpact impact;
  double micros = 0;  ///< the cost of the clock subtracted
};

/// One detector while a file is judged.
class QuerySession {
 public:
  virtual ~QuerySession() = default;
  QuerySession(const QuerySession&) = delete;
  QuerySession& operator=(const QuerySession&) = delete;

  /// Asks one query after the other. `answers` gets one for each, in order; after an exception it
  /// has those that were given before, and nothing more may be asked.
  /// @throws std::runtime_error, one sentence, when the detector failed, crashed or hung
  virtual void ask(std::span<const ImpactQuery> queries, std::vector<TimedAnswer>& answers) = 0;

  virtual ImpactTolerance tolerance() const = 0;
  /// ImpactDetector::fed()
  virtual ImpactQuery fed(const ImpactQuery& query) const = 0;

 protected:
  QuerySession() = default;
};

/// A detector with its options, as it is judged.
struct QueryDetector {
  std::string name;
  Precision precision = Precision::kDouble;
  std::vector<ImpactKind> kinds;
  std::function<std::unique_ptr<QuerySession>()> open;  ///< anew for each file
};

/// Asks it in this process. @pre `spec` is one of this detector
QueryDetector local_detector(const ImpactDetectorInfo& info, const DetectorSpec& spec);

/// Asks a detector that was made here.
std::unique_ptr<QuerySession> local_session(std::unique_ptr<ImpactDetector> detector);

}  // namespace contactcheck::queries
