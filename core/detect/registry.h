// Names of detectors: `ID[+tri][:option=value,...]`, and the catalogue they are made from.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/detect/detector.h"
#include "core/detect/impact_detector.h"
#include "core/types/impact.h"
#include "core/types/semantics.h"

namespace contactcheck {

struct OptionInfo {
  std::string name;
  std::string default_value;
  std::vector<std::string> choices;  ///< allowed words; empty: a number in [min, max]
  double min = 0.0, max = 0.0;
  bool integer = false;
  std::string help;
  double step = 2.0;  ///< numbers: the factor from one value worth trying to the next
};

/// Options by name, complete: every option of the detector has a value here.
using Options = std::map<std::string, std::string>;

struct DetectorInfo {
  std::string id;       ///< includes "+tri" where that is a separate variant
  std::string summary;  ///< one line
  std::vector<OptionInfo> options;
  std::function<std::unique_ptr<Detector>(const Options&)> make;
  std::string given;           ///< what makes it as fast as it can be: sweep, batches, early end
  std::string absent_because;  ///< why it is not built into this program; empty if it is
};

/// A detector of elementary impacts, and what it claims.
struct ImpactDetectorInfo {
  std::string id;
  std::string summary;  ///< one line
  Precision precision = Precision::kDouble;
  std::vector<ImpactKind> kinds = {ImpactKind::vertex_triangle, ImpactKind::edge_edge};
  std::function<std::unique_ptr<ImpactDetector>(const Options&)> make;
  std::vector<OptionInfo> options;
};

struct DetectorSpec {
  std::string id;
  Options options;   ///< complete
  std::string name;  ///< canonical: options at their defaults left out, the others sorted
};

/// Detectors of frames and detectors of elementary impacts, by id; one of each may share an id.
class DetectorCatalog {
 public:
  void add(DetectorInfo info);
  void add(ImpactDetectorInfo info);
  const std::vector<DetectorInfo>& all() const { return infos_; }
  const std::vector<ImpactDetectorInfo>& impact_detectors() const { return impact_infos_; }
  const DetectorInfo* find(std::string_view id) const;
  const ImpactDetectorInfo* find_impact(std::string_view id) const;

  /// @throws InputError: unknown detector or option, option given twice, value not allowed; the
  /// sentence names both
  DetectorSpec parse(std::string_view text) const;
  /// The same for detectors of elementary impacts.
  DetectorSpec parse_impact(std::string_view text) const;
  /// @pre spec came from parse of this catalogue and the detector is not absent
  std::unique_ptr<Detector> make(const DetectorSpec& spec) const;

 private:
  std::vector<DetectorInfo> infos_;
  std::vector<ImpactDetectorInfo> impact_infos_;
};

/// Adds the detectors of core; of elementary impacts `exact`, which is find_impact(), and
/// `root-finder`, a plain one in doubles to compare with.
void register_core_detectors(DetectorCatalog& catalog);

/// @pre the option exists; values were checked by parse
double number_option(const Options& options, const std::string& name);

}  // namespace contactcheck
