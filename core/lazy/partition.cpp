#include "core/lazy/partition.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include "core/lazy/lattice_tree.h"

namespace contactcheck {
namespace {

std::uint32_t owner_of(const Embedding& embedding, const Triangle& t) {
  const std::uint32_t a = embedding.home_cell[t[0]], b = embedding.home_cell[t[1]],
                      c = embedding.home_cell[t[2]];
  return b == c ? b : a;
}

// Two boxes with less than this share of the surface of the one round both go into two leaves.
constexpr double kFarApart = 0.65;

class Splitter {
 public:
  Splitter(const BodyShape& shape, Partition& out) : shape_(shape), out_(out) {
    for (const Triangle& t : shape.mesh.triangles) {
      Aabb& box = boxes_.emplace_back();
      for (std::uint32_t v : t) box.extend(shape.mesh.vertices[v]);
      owner_.push_back(shape.lattice ? owner_of(shape.embedding, t) : 0);
    }
  }

  void grow(Part& part) {
    part.children = {{part.first, part.last, {}}};
    std::vector<std::uint32_t> urgent = {urgency(part)};
    while (part.children.size() < kBlockWidth) {
      const auto next = std::max_element(urgent.begin(), urgent.end()) - urgent.begin();
      if (urgent[next] == 0) break;
      Part& first = part.children[next];
      const Part second{split(first), first.last, {}};
      first.last = second.first;
      urgent[next] = urgency(first);
      part.children.insert(part.children.begin() + next + 1, second);
      urgent.insert(urgent.begin() + next + 1, urgency(second));
    }
    for (std::size_t c = 0; c < part.children.size(); ++c)
      if (urgent[c] > 0) grow(part.children[c]);
  }

 private:
  auto begin(const Part& part) { return out_.order.begin() + part.first; }
  auto end(const Part& part) { return out_.order.begin() + part.last; }

  bool in_one_cell(const Part& part) {
    const std::uint32_t cell = owner_[*begin(part)];
    return std::all_of(begin(part), end(part), [&](std::uint32_t t) { return owner_[t] == cell; });
  }

  /// Largest first; 0: a leaf. Few triangles far from one another in one leaf would meet everything
  /// between them.
  std::uint32_t urgency(const Part& part) {
    const std::uint32_t count = part.last - part.first;
    if (count > kLeafTriangles) return count;
    return count > 1 && best_cut(part).share < kFarApart ? 1 : 0;
  }

  struct Cut {
    std::uint32_t at = 0;
    double share = std::numeric_limits<double>::infinity();  ///< boxes of both over that of all
  };

  /// Leaves the range sorted so that the cut divides it.
  Cut best_cut(const Part& part) {
    std::array<Cut, 3> cuts;
    for (int axis = 0; axis < 3; ++axis) cuts[axis] = best_cut(part, axis);
    const auto best = std::min_element(
        cuts.begin(), cuts.end(), [](const Cut& a, const Cut& b) { return a.share < b.share; });
    sort(part, static_cast<int>(best - cuts.begin()));
    return *best;
  }

  Cut best_cut(const Part& part, int axis) {
    sort(part, axis);
    const double whole = area(part.first, part.last);
    Cut best;
    for (std::uint32_t at = part.first + 1; at < part.last; ++at) {
      const double share = (area(part.first, at) + area(at, part.last)) / whole;
      if (share < best.share) best = {at, share};
    }
    return best;
  }

  auto in_order_along(int axis) const {
    return [this, axis](std::uint32_t a, std::uint32_t b) {
      const double x = boxes_[a].center()[axis], y = boxes_[b].center()[axis];
      return x != y ? x < y : a < b;
    };
  }

  void sort(const Part& part, int axis) { std::sort(begin(part), end(part), in_order_along(axis)); }

  void sort_about(const Part& part, std::uint32_t middle, int axis) {
    std::nth_element(begin(part), out_.order.begin() + middle, end(part), in_order_along(axis));
  }

  /// Surface of the box round the triangles of a range.
  double area(std::uint32_t first, std::uint32_t last) const {
    Aabb box;
    for (std::uint32_t i = first; i < last; ++i) box.extend(boxes_[out_.order[i]]);
    const Vec3 side = box.extent();
    return side.x() * side.y() + side.y() * side.z() + side.z() * side.x();
  }

  /// Sorts the range into two and returns where the second begins.
  std::uint32_t split(const Part& part) {
    if (part.last - part.first <= kLeafTriangles) return best_cut(part).at;
    if (!shape_.lattice || in_one_cell(part)) return split_at_median(part);
    return split_between_cells(part);
  }

  // Whole leaves on the left, at least one and about half of them, along the axis that leaves the
  // smallest boxes.
  std::uint32_t split_at_median(const Part& part) {
    const std::uint32_t count = part.last - part.first;
    const std::uint32_t leaves = (count + kLeafTriangles - 1) / kLeafTriangles;
    const std::uint32_t middle =
        part.first + std::min(std::max(leaves / 2, 1u) * kLeafTriangles, count - 1);
    int best_axis = 0;
    double best = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      sort_about(part, middle, axis);
      const double cost = area(part.first, middle) * (middle - part.first) +
                          area(middle, part.last) * (part.last - middle);
      if (cost < best) best = cost, best_axis = axis;
    }
    sort_about(part, middle, best_axis);
    return middle;
  }

  // Splits at the plane between cells that divides the triangles most evenly. Along an axis that is
  // one of the two at the cell of the median triangle, so that no loop is over the grid.
  std::uint32_t split_between_cells(const Part& part) {
    const std::uint32_t count = part.last - part.first;
    int best_axis = 0;
    std::uint32_t best_plane = 0, best_left = 0;
    std::vector<std::uint32_t> cells(count);
    for (int axis = 0; axis < 3; ++axis) {
      std::transform(begin(part), end(part), cells.begin(),
                     [&](std::uint32_t t) { return grid_index(t, axis); });
      std::nth_element(cells.begin(), cells.begin() + count / 2, cells.end());
      const std::uint32_t median = cells[count / 2];
      for (const std::uint32_t plane : {median, median + 1}) {
        const auto left = static_cast<std::uint32_t>(std::count_if(
            cells.begin(), cells.end(), [&](std::uint32_t cell) { return cell < plane; }));
        if (std::min(left, count - left) <= std::min(best_left, count - best_left)) continue;
        best_axis = axis, best_plane = plane, best_left = left;
      }
    }
    std::stable_partition(begin(part), end(part),
                          [&](std::uint32_t t) { return grid_index(t, best_axis) < best_plane; });
    return part.first + best_left;
  }

  std::uint32_t grid_index(std::uint32_t triangle, int axis) const {
    return shape_.lattice->cells[owner_[triangle]][axis];
  }

  const BodyShape& shape_;
  Partition& out_;
  std::vector<Aabb> boxes_;
  std::vector<std::uint32_t> owner_;  // per triangle: the cell
};

}  // namespace

Partition partition_triangles(const BodyShape& shape) {
  Partition out;
  out.order.resize(shape.mesh.triangles.size());
  std::iota(out.order.begin(), out.order.end(), 0u);
  out.root = {0, static_cast<std::uint32_t>(out.order.size()), {}};
  Splitter(shape, out).grow(out.root);
  return out;
}

}  // namespace contactcheck
