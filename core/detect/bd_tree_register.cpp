#include "core/detect/families.h"

#include <memory>

#include "core/detect/bd_tree_detector.h"
#include "core/detect/option_info.h"

namespace contactcheck {
namespace {

ReferenceKind reference_kind(const std::string& word) {
  if (word == "affine") return ReferenceKind::kAffine;
  return word == "rigid" ? ReferenceKind::kRigid : ReferenceKind::kNone;
}

}  // namespace

void register_bd_tree(DetectorCatalog& catalog) {
  DetectorInfo info;
  info.id = "bd-tree";
  info.summary =
      "tree of spheres computed from the lattice nodes when visited (James & Pai 2004); exact "
      "triangle test";
  info.options = {
      numeric_option("leaf", "4", 1, 64, true, "triangles in a leaf, at most"),
      choice_option("reference", "affine", {"affine", "rigid", "none"},
                    "motion that is taken out of the displacements"),
      choice_option("bound", "tight", {"tight", "paper"},
                    "radii: paper, by weight differences; tight, the least of that and two more"),
      precision_option()};
  info.make = [](const Options& options) -> std::unique_ptr<Detector> {
    BdSettings settings;
    settings.leaf_size = static_cast<std::uint32_t>(number_option(options, "leaf"));
    settings.reference = reference_kind(options.at("reference"));
    settings.paper_bound = options.at("bound") == "paper";
    if (in_single(options)) return std::make_unique<BdTreeDetectorOf<float>>(settings);
    return std::make_unique<BdTreeDetector>(settings);
  };
  catalog.add(std::move(info));
}

}  // namespace contactcheck
