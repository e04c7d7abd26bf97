// Defaults, from update + query on pairs of spheres of 33 thousand triangles (touching, deep in
// each other, one 1 % inside the other) and on a pile of eight, g++ 12:
// - leaf: 4 is best or within 5 % for boxes and within 10 % for spheres; from 1 to 4 the refit gets
//   2 (spheres: 2.5) times as fast, from 8 on queries in near-contact get slower.
// - cell: 2 mean edges cost a half to two thirds of what 1 does and a ninth of what 1/2 does, where
//   a triangle meets dozens of buckets; 4 is no better but for deep overlaps.
#include "core/detect/families.h"

#include <memory>
#include <utility>

#include "core/broad/aabb_tree.h"
#include "core/broad/triangle_hash.h"
#include "core/broad/triangle_sphere_tree.h"
#include "core/detect/option_info.h"
#include "core/detect/triangle_pair_detector.h"

namespace contactcheck {
namespace {

template <typename Broad>
std::unique_ptr<Detector> with_exact_test(Broad broad) {
  return std::make_unique<TrianglePairDetector<Broad>>(
      std::move(broad), ExactTriangles{},
      exact_triangle_semantics(kPrecision<typename Broad::Real>, kFindsSelf<Broad>));
}

// A broad phase for either precision, as it is made of these settings.
template <template <typename> class Broad, typename Settings>
std::unique_ptr<Detector> detector_of(const Options& options, const Settings& settings) {
  if (in_single(options)) return with_exact_test(Broad<float>(settings));
  return with_exact_test(Broad<double>(settings));
}

std::uint32_t leaf_size(const Options& options) {
  return static_cast<std::uint32_t>(number_option(options, "leaf"));
}

void add_aabb_tree(DetectorCatalog& catalog) {
  DetectorInfo info;
  info.id = "aabb-tree";
  info.summary =
      "tree of boxes, built once and refitted (van den Bergen 1997); exact triangle test";
  info.options = {numeric_option("leaf", "4", 1, 64, true, "triangles in a leaf, at most"),
                  precision_option()};
  info.make = [](const Options& options) {
    return detector_of<AabbTreesOf>(options, leaf_size(options));
  };
  catalog.add(std::move(info));
}

void add_spatial_hash(DetectorCatalog& catalog) {
  DetectorInfo info;
  info.id = "spatial-hash";
  info.summary = "boxes of triangles hashed in every frame (Teschner 2003); exact triangle test";
  info.options = {
      numeric_option("cell", "2", 1e-3, 1e3, false,
                     "hash grid cell, in mean edges of the triangles' boxes at rest"),
      numeric_option("table", "0", 0, 1 << 24, true, "hash buckets; 0: as many as entries"),
      precision_option()};
  info.make = [](const Options& options) {
    TriangleHashSettings settings;
    settings.cell = number_option(options, "cell");
    settings.table_size = static_cast<std::uint32_t>(number_option(options, "table"));
    return detector_of<TriangleHashOf>(options, settings);
  };
  catalog.add(std::move(info));
}

void add_sphere_tree(DetectorCatalog& catalog) {
  DetectorInfo info;
  info.id = "sphere-tree";
  info.summary = "tree of spheres, built once and refitted (Quinlan 1994); exact triangle test";
  info.options = {numeric_option("leaf", "4", 1, 64, true, "triangles in a leaf, at most"),
                  precision_option()};
  info.make = [](const Options& options) {
    return detector_of<TriangleSphereTreesOf>(options, leaf_size(options));
  };
  catalog.add(std::move(info));
}

}  // namespace

void register_triangle_detectors(DetectorCatalog& catalog) {
  add_spatial_hash(catalog);
  add_aabb_tree(catalog);
  add_sphere_tree(catalog);
}

}  // namespace contactcheck
