#include "core/broad/triangle_hash.h"

#include <algorithm>
#include <cmath>

#include "core/types/check.h"

namespace contactcheck {
namespace {

Aabb box_of(const Triangle& t, std::span<const Vec3> vertices) {
  const Vec3 &a = vertices[t[0]], &b = vertices[t[1]], &c = vertices[t[2]];
  return {a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)};
}

/// Over all triangles of all bodies. 0 without any; infinite where edges overflow.
double mean_rest_edge(const std::vector<Body>& bodies) {
  double count = 0.0, mean = 0.0;
  for (const Body& body : bodies) count += 3.0 * body.shape->mesh.triangles.size();
  for (const Body& body : bodies)
    for (const Triangle& t : body.shape->mesh.triangles)
      // Divided first: a sum of edges could overflow where their mean does not.
      mean += (box_of(t, body.shape->mesh.vertices).extent() / count).sum();
  return mean;
}

bool meets_any(const std::vector<Aabb>& regions, const Aabb& box) {
  return std::any_of(regions.begin(), regions.end(),
                     [&](const Aabb& region) { return region.overlaps(box); });
}

}  // namespace

void TriangleHash::prepare(const std::vector<Body>& bodies) {
  meshes_.clear();
  for (const Body& body : bodies) meshes_.push_back(&body.shape->mesh);
  cell_size_ = settings_.cell * mean_rest_edge(bodies);
  // Triangles that are points at rest, or edges beyond the range of doubles, still need a grid.
  if (!(cell_size_ > 0.0) || !std::isfinite(cell_size_)) cell_size_ = settings_.cell;
  boxes_.clear();
}

void TriangleHash::fit_bounds(const Frame& frame) {
  bounds_.assign(meshes_.size(), Aabb{});
  for (std::size_t body = 0; body < meshes_.size(); ++body)
    for (const Vec3& v : frame.bodies[body].vertices) bounds_[body].extend(v);
  regions_.resize(meshes_.size());
  for (std::vector<Aabb>& regions : regions_) regions.clear();
  for (std::size_t a = 0; a < meshes_.size(); ++a) {
    for (std::size_t b = a + 1; b < meshes_.size(); ++b) {
      if (!bounds_[a].overlaps(bounds_[b])) continue;
      const Aabb common{bounds_[a].lo.cwiseMax(bounds_[b].lo),
                        bounds_[a].hi.cwiseMin(bounds_[b].hi)};
      regions_[a].push_back(common);
      regions_[b].push_back(common);
    }
  }
}

void TriangleHash::collect_boxes(std::uint32_t body, std::span<const Vec3> vertices) {
  if (regions_[body].empty()) return;
  const std::vector<Triangle>& triangles = meshes_[body]->triangles;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const Aabb box = box_of(triangles[t], vertices);
    if (meets_any(regions_[body], box)) boxes_.push_back({box, body, t});
  }
}

void TriangleHash::update(const Frame& frame) {
  CONTACTCHECK_INVARIANT(frame.bodies.size() == meshes_.size(), "one state per prepared body");
  fit_bounds(frame);
  boxes_.clear();
  for (std::uint32_t body = 0; body < meshes_.size(); ++body)
    collect_boxes(body, frame.bodies[body].vertices);
}

void TriangleHash::find_pairs() {
  pairs_.clear();
  BoxPairSettings settings;
  settings.cell_size = cell_size_;
  settings.table_size = settings_.table_size;
  finder_.find(boxes_, settings, pairs_);
  visited_ = finder_.visited();
}

}  // namespace contactcheck
