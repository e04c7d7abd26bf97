#include "reference/adapters/libccd_adapter.h"

#include <ccd/ccd.h>

#include <memory>
#include <utility>
#include <vector>

#include "core/detect/option_info.h"
#include "reference/adapters/libccd_pieces.h"

namespace contactcheck {
namespace {

struct Variant {
  const char* id;
  const char* summary;
  CcdAlgorithm algorithm;
  OptionInfo tolerance;
};

CcdSettings settings_from(const Options& options, CcdAlgorithm algorithm) {
  CcdSettings settings;
  settings.algorithm = algorithm;
  settings.scale = number_option(options, "scale");
  settings.iterations = static_cast<std::uint32_t>(number_option(options, "iterations"));
  if (algorithm == CcdAlgorithm::kGjk) {
    settings.epa_tolerance = number_option(options, "epa_tolerance");
  } else {
    settings.mpr_tolerance = number_option(options, "tolerance");
  }
  return settings;
}

void add_detector(DetectorCatalog& catalog, const Variant& variant) {
  DetectorInfo info;
  info.id = variant.id;
  info.summary = variant.summary;
  info.options = {choice_option("pieces", "triangles", {"triangles", "boxes"},
                                "what is convex: triangles, or the cells' mapped FFD-AABBs"),
                  numeric_option("iterations", "100", 1, 100000, true,
                                 "rounds of an algorithm on one pair before it is given up"),
                  numeric_option("scale", "1", 1e-6, 1e6, false,
                                 "units of libccd in a metre; a power of two rounds nothing"),
                  variant.tolerance};
  info.make = [algorithm = variant.algorithm](const Options& options) {
    const CcdSettings settings = settings_from(options, algorithm);
    return options.at("pieces") == "boxes" ? make_ccd_boxes(settings)
                                           : make_ccd_triangles(settings);
  };
  catalog.add(std::move(info));
}

}  // namespace

void register_libccd_detectors(DetectorCatalog& catalog) {
  add_detector(catalog,
               {"libccd-gjk", "libccd's GJK on triangles, or GJK and EPA on the cells' boxes",
                CcdAlgorithm::kGjk,
                numeric_option("epa_tolerance", "1e-4", 1e-15, 1, false,
                               "square units: EPA stops growing its polytope; depths only")});
  add_detector(catalog, {"libccd-mpr",
                         "libccd's portal refinement (MPR) on triangles, or on the cells' boxes",
                         CcdAlgorithm::kMpr,
                         numeric_option("tolerance", "1e-4", 1e-15, 1, false,
                                        "units: MPR stops refining its portal")});
}

std::string libccd_version() {
  std::string said = CONTACTCHECK_CCD_VERSION;
  // 2.1, the one release after 2.0, kept 2.0 as its number in its CMake, pkg-config and library
  // names; this macro is new in its headers.
#ifdef CCD_EXPORT
  if (said == "2.0") return "2.1 (its own files say 2.0)";
#endif
  return said;
}

}  // namespace contactcheck
