// Detectors of elementary impacts: asked about one vertex and one triangle, or two edges, at a
// time.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/types/impact.h"
#include "core/types/semantics.h"

namespace contactcheck {

/// What a detector answers to an ImpactQuery.
struct ReportedImpact {
  bool contact = false;
  std::optional<double> time;  ///< of the first contact, in [0, 1]; none: it reports no times
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

 protected:
  ImpactDetector() = default;
};

/// A detector by name, what it claims, and how to make one.
struct ImpactDetectorInfo {
  std::string name;
  std::string summary;  ///< one line for lists
  Precision precision = Precision::kDouble;
  std::vector<ImpactKind> kinds = {ImpactKind::vertex_triangle, ImpactKind::edge_edge};
  std::function<std::unique_ptr<ImpactDetector>()> make;
};

/// `exact`, which is find_impact(), and `root-finder`, a plain one in doubles to compare with.
std::vector<ImpactDetectorInfo> core_impact_detectors();

}  // namespace contactcheck
