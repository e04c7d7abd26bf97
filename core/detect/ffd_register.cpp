#include "core/detect/families.h"
#include "core/detect/ffd_detector.h"
#include "core/detect/option_info.h"

namespace contactcheck {
namespace {

struct Member {
  const char* id;
  const char* summary;
  CellVolume volume;
  int sphere_levels;  // fixed; 0 with `deep`: the option decides
  bool deep;
};

constexpr Member kFamily[] = {
    {"ffd-grid", "traditional FFD: the lattice cells themselves collide", CellVolume::kLatticeCell,
     0, false},
    {"ffd-aabb", "FFD-AABB: a tight box per cell, hashed", CellVolume::kFfdAabb, 0, false},
    {"ffd-aabb-sphere", "FFD-AABB behind one bounding sphere per body", CellVolume::kFfdAabb, 1,
     false},
    {"ffd-aabb-sphere2", "FFD-AABB behind two levels of spheres (Jeon et al. 2013)",
     CellVolume::kFfdAabb, 2, false},
    {"ffd-aabb-sphereN", "FFD-AABB behind a deeper hierarchy of spheres", CellVolume::kFfdAabb, 0,
     true}};

std::vector<OptionInfo> options_of(const Member& member, ElementTest element) {
  std::vector<OptionInfo> options;
  options.push_back(choice_option("bounds", element == ElementTest::kTriangle ? "safe" : "paper",
                                  {"paper", "safe"}, "how open points of the paper are read"));
  options.push_back(numeric_option("cell", "1", 1e-3, 1e3, false,
                                   "hash grid cell, in mean edges of the boxes at rest"));
  options.push_back(
      numeric_option("table", "0", 0, 1 << 24, true, "hash buckets; 0: as many as entries"));
  options.push_back(precision_option());
  if (member.sphere_levels > 1 || member.deep)
    options.push_back(numeric_option("spheres", member.deep ? "4" : "16", 1, 1024, true,
                                     "spheres into which one is split at the next level"));
  if (member.deep)
    options.push_back(numeric_option("levels", "3", 1, 8, true, "levels of spheres"));
  if (member.sphere_levels > 0 || member.deep)
    options.push_back(numeric_option(
        "radius", "1", 0.25, 4, false,
        "factor on the radii of all spheres; below 1 they may not hold what they should", 1.25));
  return options;
}

FfdConfig config_of(const Member& member, ElementTest element, const Options& options) {
  FfdConfig config;
  config.volume = member.volume;
  config.element = element;
  config.bounds = options.at("bounds") == "safe" ? BoundsReading::kSafe : BoundsReading::kPaper;
  config.hash_cell = number_option(options, "cell");
  config.table_size = static_cast<std::uint32_t>(number_option(options, "table"));
  config.sphere_levels =
      member.deep ? static_cast<int>(number_option(options, "levels")) : member.sphere_levels;
  if (options.count("spheres"))
    config.spheres = static_cast<int>(number_option(options, "spheres"));
  if (options.count("radius")) config.sphere_radius = number_option(options, "radius");
  return config;
}

}  // namespace

void register_ffd_detectors(DetectorCatalog& catalog) {
  for (ElementTest element : {ElementTest::kNodePlane, ElementTest::kTriangle}) {
    for (const Member& member : kFamily) {
      const bool triangles = element == ElementTest::kTriangle;
      DetectorInfo info;
      info.id = std::string(member.id) + (triangles ? "+tri" : "");
      info.summary = std::string(member.summary) +
                     (triangles ? "; exact triangle test" : "; node-against-plane test");
      info.options = options_of(member, element);
      info.make = [member, element](const Options& options) -> std::unique_ptr<Detector> {
        const FfdConfig config = config_of(member, element, options);
        if (in_single(options)) return std::make_unique<FfdDetectorOf<float>>(config);
        return std::make_unique<FfdDetector>(config);
      };
      catalog.add(std::move(info));
    }
  }
}

}  // namespace contactcheck
