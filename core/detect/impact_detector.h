// Detectors of elementary impacts: asked about one vertex and one triangle, or two edges, at a
// time.
#pragma once

#include <optional>

#include "core/types/impact.h"

namespace contactcheck {

/// What a detector answers to an ImpactQuery.
struct ReportedImpact {
  bool contact = false;
  /// The time of the first contact, in [0, 1]; none: the detector reports no times.
  std::optional<double> time = std::nullopt;
  /// Metres: elements that come as near as this are contact to it in this query. None: as declared.
  std::optional<double> tolerance = std::nullopt;
};

/// Answers depend on the query alone.
class ImpactDetector {
 public:
  virtual ~ImpactDetector() = default;
  ImpactDetector(const ImpactDetector&) = delete;
  ImpactDetector& operator=(const ImpactDetector&) = delete;

  /// @throws RefusedInput for what it must not answer
  virtual ReportedImpact query(const ImpactQuery& query) = 0;

  /// The query that the detector answers in its own precision, when it is given `query`, and does
  /// not refuse it.
  virtual ImpactQuery fed(const ImpactQuery& query) const { return query; }

  /// What it declares to call contact although nothing meets; it may depend on its options.
  virtual ImpactTolerance tolerance() const { return {}; }

 protected:
  ImpactDetector() = default;
};

}  // namespace contactcheck
