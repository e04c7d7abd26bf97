#include "core/lazy/embedded_patch.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/deform/mapping.h"
#include "core/lazy/triangle_rest.h"

namespace contactcheck {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Rounding of what is computed at rest: far more than it can be.
constexpr double kUp = 1 + 1e-6, kDown = 1 - 1e-6;
constexpr std::uint32_t kMostCells = 8;  // of a patch; more are not worth a look
constexpr PatchRest kNothing = {{}, {}, {1, 1, 1}, {0, 0, 0}, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f};

float at_least(double x) { return static_cast<float>(std::min(x * kUp, 1e30)); }
float at_most(double x) { return static_cast<float>(x * kDown); }

// Of a coordinate on a line, either cell would do: F is continuous.
std::uint8_t cell_at(const std::vector<double>& lines, double x) {
  const auto above = std::upper_bound(lines.begin(), lines.end(), x);
  const auto index = std::clamp<std::ptrdiff_t>(above - lines.begin() - 1, 0,
                                                static_cast<std::ptrdiff_t>(lines.size()) - 2);
  return static_cast<std::uint8_t>(index);
}

PatchRest patch_of(const BodyShape& shape, std::uint32_t triangle, const TriangleRest& rest) {
  PatchRest out;
  Aabb box;
  for (const std::uint32_t v : shape.mesh.triangles[triangle]) box.extend(shape.mesh.vertices[v]);
  for (int k = 0; k < 3; ++k) {
    out.lo[k] = box.lo[k];
    out.hi[k] = box.hi[k];
    out.first_cell[k] = cell_at(shape.lattice->lines[k], box.lo[k]);
    out.last_cell[k] = cell_at(shape.lattice->lines[k], box.hi[k]);
  }
  out.stretch = at_least(rest.stretch);
  out.ratio = at_least(rest.ratio);
  out.edge = at_least(rest.edge);
  out.gap = at_most(rest.gap);
  out.altitude = at_most(rest.altitude);
  return out;
}

class PatchBuilder {
 public:
  PatchBuilder(const BodyShape& shape, const LatticeTree& tree, PatchTree& out)
      : shape_(shape), tree_(tree), rest_(triangles_at_rest(shape)), out_(out) {}

  PatchRest block(std::uint32_t index) {
    PatchRest all;
    for (std::uint32_t lane = 0; lane < tree_.blocks[index].children; ++lane) {
      const TreeChild child = tree_.blocks[index].child[lane];
      const PatchRest patch = child.leaf() ? leaf(child.index()) : block(child.index());
      out_.children[index * kBlockWidth + lane] = patch;
      all = lane == 0 ? patch : all.united(patch);
    }
    return all;
  }

 private:
  PatchRest leaf(std::uint32_t index) {
    const TreeLeaf& leaf = tree_.leaves[index];
    PatchRest all;
    for (std::uint32_t i = 0; i < leaf.triangles; ++i) {
      const std::uint32_t t = tree_.leaf_triangles[leaf.first_triangle + i];
      const PatchRest patch = patch_of(shape_, t, rest_[t]);
      add_to_cells(patch);
      all = i == 0 ? patch : all.united(patch);
    }
    return all;
  }

  // A triangle is in the cells that its box meets, where these are two by two by two at most.
  void add_to_cells(const PatchRest& patch) {
    const auto add = [&](PatchRest& to) { to = to.nothing() ? patch : to.united(patch); };
    const auto& first = patch.first_cell;
    const auto& last = patch.last_cell;
    if (first == last) add(out_.in_cell[out_.flat(first[0], first[1], first[2])]);
    std::array<std::uint32_t, 3> low{};
    for (int k = 0; k < 3; ++k) {
      if (last[k] > first[k] + 1) return;
      low[k] = std::max<std::uint32_t>(last[k], 1) - 1;
    }
    for (std::uint32_t z = low[2]; z <= first[2]; ++z)
      for (std::uint32_t y = low[1]; y <= first[1]; ++y)
        for (std::uint32_t x = low[0]; x <= first[0]; ++x) add(out_.in_eight[out_.flat(x, y, z)]);
  }

  const BodyShape& shape_;
  const LatticeTree& tree_;
  std::vector<TriangleRest> rest_;
  PatchTree& out_;
};

/// Entries of DF over part of a cell: middle and half-width, a column per axis at rest.
struct Range {
  Float4 lo[3], hi[3];
  void add(int axis, const Float4& middle, const Float4& half, bool first) {
    lo[axis] = first ? Float4(middle - half) : lo[axis].min(middle - half).eval();
    hi[axis] = first ? Float4(middle + half) : hi[axis].max(middle + half).eval();
  }
};

// The smallest eigenvalue of a symmetric positive semidefinite matrix, from below: Newton's method
// from 0 on the characteristic polynomial, which is concave and increasing up to its first root.
double smallest_eigenvalue(const Eigen::Matrix3d& m) {
  const double trace = m.trace();
  const double minors = m(0, 0) * m(1, 1) - m(0, 1) * m(0, 1) + m(0, 0) * m(2, 2) -
                        m(0, 2) * m(0, 2) + m(1, 1) * m(2, 2) - m(1, 2) * m(1, 2);
  const double determinant = m.determinant();
  if (!(determinant > 0.0) || !(minors > 0.0)) return 0.0;
  double x = 0.0;
  for (int i = 0; i < 4; ++i) {
    const double value = ((x - trace) * x + minors) * x - determinant;
    const double slope = (3.0 * x - 2.0 * trace) * x + minors;
    if (!(slope > 0.0)) return 0.0;
    x -= value / slope;
  }
  return std::max(0.0, x * (1 - 1e-6) - 1e-12 * trace);
}

constexpr std::uint8_t kUnknown = 0, kEmbedded = 1, kNotTold = 2;

// The conditions of the claim for one frame.
bool holds(const LazyState& state, const PatchTree& patches, const PatchRest& patch) {
  const auto& lines = state.shape->lattice->lines;
  if (!(patch.gap > 0.0f)) return false;

  // DF over the part of each cell that Q holds. Terms are those of y = 2 x - 1 in the cell.
  Range range;
  double finest = kInfinity;  // the shortest side of these cells, along axes in which Q extends
  float bend = 0.0f;          // m
  std::size_t cells = 0, kept = 0;
  bool long_row = false;  // more than two cells along an axis
  std::array<bool, 3> flat{};
  for (int k = 0; k < 3; ++k) {
    long_row = long_row || patch.last_cell[k] > patch.first_cell[k] + 1;
    flat[k] = patch.lo[k] == patch.hi[k];
  }
  for (std::uint32_t z = patch.first_cell[2]; z <= patch.last_cell[2]; ++z)
    for (std::uint32_t y = patch.first_cell[1]; y <= patch.last_cell[1]; ++y)
      for (std::uint32_t x = patch.first_cell[0]; x <= patch.last_cell[0]; ++x) {
        const std::int32_t cell = patches.kept[patches.flat(x, y, z)];
        ++cells;
        if (cell < 0 && long_row) return false;
        if (cell < 0) continue;
        const CellTerms& f = state.cells[static_cast<std::size_t>(cell)];
        const std::uint32_t at[3] = {x, y, z};
        float c[3], e[3], inverse[3];
        for (int k = 0; k < 3; ++k) {
          const double low = lines[k][at[k]], side = lines[k][at[k] + 1] - low;
          if (!flat[k]) finest = std::min(finest, side);
          const double from = std::max(-1.0, 2.0 * (patch.lo[k] - low) / side - 1.0),
                       to = std::min(1.0, 2.0 * (patch.hi[k] - low) / side - 1.0);
          c[k] = static_cast<float>(0.5 * (from + to));
          e[k] = static_cast<float>(std::max(0.0, 0.5 * (to - from))) + 1e-6f;
          inverse[k] = static_cast<float>(2.0 / side);
        }
        float mixed_norm[3];  // of the derivatives along k and the next axis
        for (int k = 0; k < 3; ++k) {
          const int i = (k + 1) % 3, j = (k + 2) % 3, all = 7;
          const Float4 &own = f.term[1 << k], &with_i = f.term[1 << k | 1 << i],
                       &with_j = f.term[1 << k | 1 << j], &mixed = f.term[all];
          const Float4 middle = own + with_i * c[i] + with_j * c[j] + mixed * (c[i] * c[j]);
          const Float4 half = (with_i + mixed * c[j]).abs() * e[i] +
                              (with_j + mixed * c[i]).abs() * e[j] + mixed.abs() * (e[i] * e[j]);
          range.add(k, middle * inverse[k], half * inverse[k], kept == 0);
          const Float4 second = (with_i + mixed * c[j]).abs() + mixed.abs() * e[j];
          mixed_norm[k] =
              flat[k] || flat[i] ? 0.0f : second.matrix().norm() * inverse[k] * inverse[i];
        }
        // The largest row sum of a symmetric matrix bounds its norm.
        for (int k = 0; k < 3; ++k) bend = std::max(bend, mixed_norm[k] + mixed_norm[(k + 2) % 3]);
        ++kept;
      }

  if (kept == 0) return false;

  // What the terms are off by: near nodes and sums of eight of them in floats.
  const double off = 64.0 * 0x1p-24 * state.reach * 2.0 / finest;
  Eigen::Matrix3d a, half;
  for (int k = 0; k < 3; ++k)
    for (int r = 0; r < 3; ++r) {
      a(r, k) = 0.5 * (double{range.lo[k][r]} + double{range.hi[k][r]});
      half(r, k) = 0.5 * (double{range.hi[k][r]} - double{range.lo[k][r]}) + off;
    }
  // What Q has no extent in takes no part; in the product below it is as large as all others.
  Eigen::Matrix3d extended = a;
  for (int k = 0; k < 3; ++k)
    if (flat[k]) extended.col(k).setZero(), half.col(k).setZero();
  Eigen::Matrix3d product = extended.transpose() * extended;
  const double all = product.trace();
  for (int k = 0; k < 3; ++k)
    if (flat[k]) product(k, k) = all;
  // Of all matrices with such entries.
  const double d =
      kUp * std::sqrt(std::min(half.squaredNorm(),
                               half.rowwise().sum().maxCoeff() * half.colwise().sum().maxCoeff()));
  const double s = std::sqrt(smallest_eigenvalue(product)) * kDown;
  // A mapped vertex, and a vertex at rest, in the body's frame.
  const double unit = state.precision == Precision::kSingle ? 0x1p-24 : 0x1p-53;
  const double error = 2.0 * mapping_error_bound(state.largest) * state.scale +
                       64.0 * unit * state.reach +
                       8.0 * 0x1p-53 * patches.largest * (a.norm() + d) + 1e-37;
  const double h = patch.edge, off_slope = 2.0 * error / patch.altitude;
  // What the terms are off by is in both ends of a cell.
  const double m = cells == 1 ? kUp * (double{bend} + 16.0 * off / finest) : kInfinity;
  const double neighbours = std::min(patch.ratio * patch.stretch * (d + off_slope),
                                     d + patch.ratio * patch.stretch * (m * h + off_slope));
  if (!(s > neighbours * kUp)) return false;
  const double r = cells <= 2 || kept == cells ? 1.0 : 1.4142136;
  const double interpolation = std::min(d * h * 0.57735027, m * h * h / 6.0) + error;
  return (s - r * d) * patch.gap > 2.0 * interpolation * kUp;
}

}  // namespace

PatchRest PatchRest::united(const PatchRest& other) const {
  PatchRest out = *this;
  for (int k = 0; k < 3; ++k) {
    out.lo[k] = std::min(lo[k], other.lo[k]);
    out.hi[k] = std::max(hi[k], other.hi[k]);
    out.first_cell[k] = std::min(first_cell[k], other.first_cell[k]);
    out.last_cell[k] = std::max(last_cell[k], other.last_cell[k]);
  }
  out.stretch = std::max(stretch, other.stretch);
  out.ratio = std::max(ratio, other.ratio);
  out.edge = std::max(edge, other.edge);
  out.gap = std::min(gap, other.gap);
  out.altitude = std::min(altitude, other.altitude);
  return out;
}

PatchTree make_patch_tree(const BodyShape& shape, const LatticeTree& tree) {
  PatchTree out;
  const Lattice& lattice = *shape.lattice;
  for (int k = 0; k < 3; ++k)
    out.cells[k] = static_cast<std::uint32_t>(lattice.lines[k].size() - 1);
  const std::size_t cells = std::size_t{out.cells[0]} * out.cells[1] * out.cells[2];
  out.kept.assign(cells, -1);
  for (std::size_t c = 0; c < lattice.cells.size(); ++c) {
    const GridIndex& at = lattice.cells[c];
    out.kept[out.flat(at[0], at[1], at[2])] = static_cast<std::int32_t>(c);
  }
  out.in_cell.assign(cells, kNothing);
  out.in_eight.assign(cells, kNothing);
  for (const Vec3& v : shape.mesh.vertices)
    out.largest = std::max(out.largest, v.cwiseAbs().maxCoeff());
  out.children.resize(tree.blocks.size() * kBlockWidth);
  PatchBuilder(shape, tree, out).block(0);
  return out;
}

namespace {

// One patch, or two together: by the cells it meets where these are few, else by itself.
bool told(LazyState& state, const PatchTree& patches, const PatchRest& patch) {
  std::uint32_t cells = 1, longest = 1;
  for (int k = 0; k < 3; ++k) {
    const std::uint32_t count = patch.last_cell[k] - patch.first_cell[k] + 1u;
    cells *= count;
    longest = std::max(longest, count);
  }
  if (cells > kMostCells) return false;
  if (longest > 2) return holds(state, patches, patch);
  const auto& first = patch.first_cell;
  const std::size_t index = patches.flat(first[0], first[1], first[2]);
  for (const bool eight : {false, true}) {
    if (!eight && cells > 1) continue;
    std::uint8_t& known = state.embedded_cells[2 * index + eight];
    if (known == kUnknown)
      known = holds(state, patches, eight ? patches.in_eight[index] : patches.in_cell[index])
                  ? kEmbedded
                  : kNotTold;
    if (known == kEmbedded) return true;
  }
  return holds(state, patches, patch);
}

bool told_alone(LazyState& state, const PatchTree& patches, std::uint32_t child) {
  std::uint8_t& known = state.embedded_children[child];
  if (known == kUnknown)
    known = told(state, patches, patches.children[child]) ? kEmbedded : kNotTold;
  return known == kEmbedded;
}

}  // namespace

bool stays_embedded(LazyState& state, const PatchTree& patches, std::uint32_t a, std::uint32_t b) {
  if (state.embedded_cells.empty()) {
    state.embedded_cells.assign(2 * patches.in_cell.size(), kUnknown);
    state.embedded_children.assign(patches.children.size(), kUnknown);
  }
  // Of what is not told of one of them, no more is told of both.
  if (!told_alone(state, patches, a) || (a != b && !told_alone(state, patches, b))) return false;
  return a == b || told(state, patches, patches.children[a].united(patches.children[b]));
}

}  // namespace contactcheck
