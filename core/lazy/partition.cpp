#include "core/lazy/partition.h"

#include <algorithm>
#include <numeric>

#include "core/lazy/lattice_tree.h"

namespace contactcheck {
namespace {

std::uint32_t owner_of(const Embedding& embedding, const Triangle& t) {
  const std::uint32_t a = embedding.home_cell[t[0]], b = embedding.home_cell[t[1]],
                      c = embedding.home_cell[t[2]];
  return b == c ? b : a;
}

class Splitter {
 public:
  Splitter(const BodyShape& shape, Partition& out) : shape_(shape), out_(out) {
    for (const Triangle& t : shape.mesh.triangles) {
      const std::vector<Vec3>& v = shape.mesh.vertices;
      centers_.push_back((v[t[0]] + v[t[1]] + v[t[2]]) / 3.0);
    }
  }

  void grow(Part& part) {
    part.children = {{part.first, part.last, {}}};
    while (part.children.size() < kBlockWidth) {
      const auto largest = std::max_element(
          part.children.begin(), part.children.end(),
          [](const Part& a, const Part& b) { return a.last - a.first < b.last - b.first; });
      if (largest->last - largest->first <= kLeafTriangles) break;
      const Part second{split(*largest), largest->last, {}};
      largest->last = second.first;
      part.children.insert(largest + 1, second);
    }
    for (Part& child : part.children)
      if (child.last - child.first > kLeafTriangles) grow(child);
  }

 private:
  auto begin(const Part& part) { return out_.order.begin() + part.first; }
  auto end(const Part& part) { return out_.order.begin() + part.last; }

  /// Sorts the range into two and returns where the second begins.
  std::uint32_t split(const Part& part) {
    if (!shape_.lattice) return split_at_median(part);
    const std::uint32_t cell = out_.owner[*begin(part)];
    const bool one_cell =
        std::all_of(begin(part), end(part), [&](std::uint32_t t) { return out_.owner[t] == cell; });
    return one_cell ? split_at_median(part) : split_between_cells(part);
  }

  std::uint32_t split_at_median(const Part& part) {
    Aabb box;
    std::for_each(begin(part), end(part), [&](std::uint32_t t) { box.extend(centers_[t]); });
    Eigen::Index axis;
    box.extent().maxCoeff(&axis);
    const std::uint32_t count = part.last - part.first;
    // Whole leaves on the left, at least one and about half of them.
    const std::uint32_t leaves = (count + kLeafTriangles - 1) / kLeafTriangles;
    const std::uint32_t left = std::min(leaves / 2 * kLeafTriangles, count - 1);
    std::nth_element(begin(part), begin(part) + left, end(part),
                     [&](std::uint32_t a, std::uint32_t b) {
                       const double x = centers_[a][axis], y = centers_[b][axis];
                       return x != y ? x < y : a < b;
                     });
    return part.first + left;
  }

  // Of all planes between cells the one that parts the triangles most evenly.
  std::uint32_t split_between_cells(const Part& part) {
    const std::uint32_t count = part.last - part.first;
    int best_axis = 0;
    std::uint32_t best_plane = 0, best_left = 0;
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<std::uint32_t> below(shape_.lattice->lines[axis].size(), 0);
      std::for_each(begin(part), end(part),
                    [&](std::uint32_t t) { ++below[grid_index(t, axis) + 1]; });
      std::partial_sum(below.begin(), below.end(), below.begin());
      for (std::uint32_t plane = 1; plane < below.size(); ++plane) {
        if (std::min(below[plane], count - below[plane]) <= std::min(best_left, count - best_left))
          continue;
        best_axis = axis, best_plane = plane, best_left = below[plane];
      }
    }
    std::stable_partition(begin(part), end(part),
                          [&](std::uint32_t t) { return grid_index(t, best_axis) < best_plane; });
    return part.first + best_left;
  }

  std::uint32_t grid_index(std::uint32_t triangle, int axis) const {
    return shape_.lattice->cells[out_.owner[triangle]][axis];
  }

  const BodyShape& shape_;
  Partition& out_;
  std::vector<Vec3> centers_;
};

}  // namespace

Partition partition_triangles(const BodyShape& shape) {
  Partition out;
  const std::vector<Triangle>& triangles = shape.mesh.triangles;
  out.order.resize(triangles.size());
  std::iota(out.order.begin(), out.order.end(), 0u);
  out.owner.assign(triangles.size(), 0);
  if (shape.lattice)
    for (std::size_t t = 0; t < triangles.size(); ++t)
      out.owner[t] = owner_of(shape.embedding, triangles[t]);
  out.root = {0, static_cast<std::uint32_t>(triangles.size()), {}};
  Splitter(shape, out).grow(out.root);
  return out;
}

}  // namespace contactcheck
