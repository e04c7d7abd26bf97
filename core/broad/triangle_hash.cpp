#include "core/broad/triangle_hash.h"

#include <algorithm>
#include <limits>

#include "core/types/check.h"

namespace contactcheck {
namespace {

template <typename T>
AabbOf<T> box_of(const Triangle& t, std::span<const Vec3Of<T>> vertices) {
  const Vec3Of<T>&a = vertices[t[0]], &b = vertices[t[1]], &c = vertices[t[2]];
  return {a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)};
}

/// Over all triangles of all bodies. 0 without any; infinite where edges overflow.
double mean_rest_edge(const std::vector<Body>& bodies) {
  double count = 0.0, mean = 0.0;
  for (const Body& body : bodies) count += 3.0 * body.shape->mesh.triangles.size();
  for (const Body& body : bodies)
    for (const Triangle& t : body.shape->mesh.triangles)
      // Divided first: a sum of edges could overflow where their mean does not.
      mean += (box_of<double>(t, body.shape->mesh.vertices).extent() / count).sum();
  return mean;
}

template <typename T>
bool meets_any(const std::vector<AabbOf<T>>& regions, const AabbOf<T>& box) {
  return std::any_of(regions.begin(), regions.end(),
                     [&](const AabbOf<T>& region) { return region.overlaps(box); });
}

}  // namespace

template <typename T>
void TriangleHashOf<T>::prepare(const std::vector<Body>& bodies) {
  using Limits = std::numeric_limits<T>;
  meshes_.clear();
  for (const Body& body : bodies) meshes_.push_back(&body.shape->mesh);
  cell_size_ = settings_.cell * mean_rest_edge(bodies);
  // Triangles that are points at rest, or edges beyond the range of numbers, still need a grid.
  if (!(cell_size_ >= Limits::denorm_min() && cell_size_ <= Limits::max()))
    cell_size_ = settings_.cell;
  boxes_.clear();
}

template <typename T>
void TriangleHashOf<T>::fit_bounds(const std::vector<std::span<const Vec3Of<T>>>& vertices) {
  bounds_.assign(meshes_.size(), AabbOf<T>{});
  for (std::size_t body = 0; body < meshes_.size(); ++body)
    for (const Vec3Of<T>& v : vertices[body]) bounds_[body].extend(v);
  regions_.resize(meshes_.size());
  for (std::vector<AabbOf<T>>& regions : regions_) regions.clear();
  for (std::size_t a = 0; a < meshes_.size(); ++a) {
    for (std::size_t b = a + 1; b < meshes_.size(); ++b) {
      if (!bounds_[a].overlaps(bounds_[b])) continue;
      const AabbOf<T> common{bounds_[a].lo.cwiseMax(bounds_[b].lo),
                             bounds_[a].hi.cwiseMin(bounds_[b].hi)};
      regions_[a].push_back(common);
      regions_[b].push_back(common);
    }
  }
}

template <typename T>
void TriangleHashOf<T>::collect_boxes(std::uint32_t body, std::span<const Vec3Of<T>> vertices) {
  if (regions_[body].empty()) return;
  const std::vector<Triangle>& triangles = meshes_[body]->triangles;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const AabbOf<T> box = box_of<T>(triangles[t], vertices);
    if (meets_any(regions_[body], box)) boxes_.push_back({box, body, t});
  }
}

template <typename T>
void TriangleHashOf<T>::update(const std::vector<std::span<const Vec3Of<T>>>& vertices) {
  CONTACTCHECK_INVARIANT(vertices.size() == meshes_.size(), "one state per prepared body");
  fit_bounds(vertices);
  boxes_.clear();
  for (std::uint32_t body = 0; body < meshes_.size(); ++body) collect_boxes(body, vertices[body]);
}

template <typename T>
void TriangleHashOf<T>::find_pairs() {
  pairs_.clear();
  BoxPairSettings settings;
  settings.cell_size = cell_size_;
  settings.table_size = settings_.table_size;
  finder_.find(boxes_, settings, pairs_);
  visited_ = finder_.visited();
}

template class TriangleHashOf<double>;
template class TriangleHashOf<float>;

}  // namespace contactcheck
