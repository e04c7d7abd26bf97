#include "core/lazy/embedded_patch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/deform/grid.h"
#include "core/deform/mapping.h"
#include "core/lazy/triangle_rest.h"

namespace contactcheck {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Rounding of what is computed at rest: far more than it can be.
constexpr double kUp = 1 + 1e-6, kDown = 1 - 1e-6;
constexpr std::uint64_t kMostCells = 8;  // of a patch; more are not worth a look
// Sides of cells, and square of DF, that are looked at.
constexpr double kLeastSide = 0x1p-100, kMostSide = 0x1p100;
constexpr double kLeastSquare = 0x1p-200, kMostSquare = 0x1p200;

// A float rounds by 2^-24 of what is within its range, less than kUp and kDown leave; what is
// beyond it goes to the safe end.
float at_least(double x) {
  constexpr double kLeast = std::numeric_limits<float>::min(), kMost = 0x1p126;
  return x * kUp < kMost ? static_cast<float>(std::max(x * kUp, kLeast))
                         : std::numeric_limits<float>::infinity();
}
float at_most(double x) {
  constexpr double kLeast = std::numeric_limits<float>::min(), kMost = 0x1p126;
  return x * kDown >= kLeast ? static_cast<float>(std::min(x * kDown, kMost)) : 0.0f;
}

PatchRest patch_of(const BodyShape& shape, std::uint32_t triangle, const TriangleRest& rest) {
  PatchRest out;
  Aabb box;
  for (const std::uint32_t v : shape.mesh.triangles[triangle]) box.extend(shape.mesh.vertices[v]);
  for (int k = 0; k < 3; ++k) {
    out.lo[k] = box.lo[k];
    out.hi[k] = box.hi[k];
  }
  // Of a coordinate on a line, either cell would do: F is continuous.
  const Grid grid(shape.lattice->lines);
  out.first_cell = grid.cell_of(box.lo);
  out.last_cell = grid.cell_of(box.hi);
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

  void run() {
    out_.children.resize(tree_.blocks.size() * kBlockWidth);
    block(0);
    for (const auto& [first, patch] : ones_) out_.ones.push_back({first, patch});
    for (const auto& [first, patch] : eights_) out_.eights.push_back({first, patch});
  }

 private:
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

  PatchRest leaf(std::uint32_t index) {
    const TreeLeaf& leaf = tree_.leaves[index];
    PatchRest all;
    for (std::uint32_t i = 0; i < leaf.triangles; ++i) {
      const std::uint32_t t = tree_.leaf_triangles[leaf.first_triangle + i];
      const PatchRest patch = patch_of(shape_, t, rest_[t]);
      add_to_regions(patch);
      all = i == 0 ? patch : all.united(patch);
    }
    return all;
  }

  // A triangle is in the cells that its box meets, where these are two by two by two at most.
  void add_to_regions(const PatchRest& patch) {
    const auto& first = patch.first_cell;
    const auto& last = patch.last_cell;
    if (first == last) add(ones_, first, patch);
    GridIndex low;
    for (int k = 0; k < 3; ++k) {
      if (last[k] - first[k] > 1) return;
      low[k] = std::max<std::uint32_t>(last[k], 1) - 1;
    }
    for (std::uint32_t z = low[2]; z <= first[2]; ++z)
      for (std::uint32_t y = low[1]; y <= first[1]; ++y)
        for (std::uint32_t x = low[0]; x <= first[0]; ++x) add(eights_, {x, y, z}, patch);
  }

  using Regions = std::map<GridIndex, PatchRest, bool (*)(const GridIndex&, const GridIndex&)>;
  static void add(Regions& to, const GridIndex& first, const PatchRest& patch) {
    const auto [at, fresh] = to.try_emplace(first, patch);
    if (!fresh) at->second = at->second.united(patch);
  }

  const BodyShape& shape_;
  const LatticeTree& tree_;
  std::vector<TriangleRest> rest_;
  Regions ones_{grid_before}, eights_{grid_before};
  PatchTree& out_;
};

/// Entries of DF over parts of cells: a column per axis at rest.
struct Range {
  Eigen::Array3d lo[3], hi[3];
  void add(int axis, const Eigen::Array3d& middle, const Eigen::Array3d& half, bool first) {
    lo[axis] = first ? Eigen::Array3d(middle - half) : lo[axis].min(middle - half).eval();
    hi[axis] = first ? Eigen::Array3d(middle + half) : hi[axis].max(middle + half).eval();
  }
};

Eigen::Array3d in_doubles(const Float4& x) { return x.head<3>().cast<double>(); }

// The smallest eigenvalue of a symmetric positive semidefinite matrix, from below: Newton's method
// from 0 on the characteristic polynomial, which is concave and increasing up to its first root.
//   * Determinant, minors and the values of the polynomial round by less than 2^-46 of trace^3,
//     trace^2 and trace^3. A polynomial with a larger linear and a smaller constant term is above
//     this one, so that its first root is smaller, and it is as concave up to there. Each step goes
//     no farther than its tangent, which is above it. The matrix itself rounds by less than 2^-46
//     of its trace.
//   * Within [kLeastSquare, kMostSquare] no power of the trace leaves the range of doubles.
double smallest_eigenvalue(const Eigen::Matrix3d& m) {
  constexpr double kRounding = 0x1p-44;
  const double trace = m.trace();
  if (!(trace >= kLeastSquare && trace <= kMostSquare)) return 0.0;
  const double minors = m(0, 0) * m(1, 1) - m(0, 1) * m(0, 1) + m(0, 0) * m(2, 2) -
                        m(0, 2) * m(0, 2) + m(1, 1) * m(2, 2) - m(1, 2) * m(1, 2) +
                        kRounding * trace * trace;
  const double determinant = m.determinant() - kRounding * trace * trace * trace;
  if (!(determinant > 0.0)) return 0.0;
  double x = 0.0;
  for (int i = 0; i < 4; ++i) {
    const double value = ((x - trace) * x + minors) * x - determinant;
    const double slope = (3.0 * x - 2.0 * trace) * x + minors + kRounding * trace * trace;
    if (!(value < 0.0) || !(slope > 0.0)) break;
    x -= value / slope;
  }
  return std::max(0.0, x * kDown - kRounding * trace);
}

constexpr std::uint8_t kUnknown = 0, kEmbedded = 1, kNotTold = 2;

// The conditions of the claim for one frame.
bool holds(const LazyState& state, const PatchTree& patches, const PatchRest& patch) {
  const Lattice& lattice = *state.shape->lattice;
  if (!(patch.gap > 0.0f)) return false;

  // DF over the part of each cell that Q holds. Terms are those of y = 2 x - 1 in the cell.
  Range range;
  double finest = kInfinity;  // the shortest side of these cells, along axes in which Q extends
  double farthest = 0.0;      // |coordinate| of a corner of these cells, at rest
  double bend = 0.0;          // m
  std::size_t cells = 1, kept = 0;
  bool long_row = false;  // more than two cells along an axis
  std::array<bool, 3> flat{};
  for (int k = 0; k < 3; ++k) {
    cells *= patch.last_cell[k] - patch.first_cell[k] + std::size_t{1};
    long_row = long_row || patch.last_cell[k] - patch.first_cell[k] > 1;
    flat[k] = patch.lo[k] == patch.hi[k];
  }
  for (std::uint32_t z = patch.first_cell[2]; z <= patch.last_cell[2]; ++z)
    for (std::uint32_t y = patch.first_cell[1]; y <= patch.last_cell[1]; ++y)
      for (std::size_t cell = lattice.first_cell_from({patch.first_cell[0], y, z});
           cell < lattice.cells.size() &&
           !grid_before({patch.last_cell[0], y, z}, lattice.cells[cell]);
           ++cell) {
        const CellTerms& f = state.cells[cell];
        double c[3], e[3], inverse[3];
        for (int k = 0; k < 3; ++k) {
          const std::uint32_t at = lattice.cells[cell][k];
          const double low = lattice.lines[k][at], high = lattice.lines[k][at + 1];
          const double side = high - low;
          const double scaled = side * patches.scale;
          if (!(scaled >= kLeastSide && scaled <= kMostSide)) return false;
          if (!flat[k]) finest = std::min(finest, scaled);
          farthest = std::max(farthest, std::max(std::abs(low), std::abs(high)) * patches.scale);
          const double from = std::max(-1.0, 2.0 * (patch.lo[k] - low) / side - 1.0),
                       to = std::min(1.0, 2.0 * (patch.hi[k] - low) / side - 1.0);
          c[k] = 0.5 * (from + to);
          e[k] = std::max(0.0, 0.5 * (to - from)) + 1e-12;
          inverse[k] = 2.0 / scaled;
        }
        double mixed_norm[3];  // of the derivatives along k and the next axis
        for (int k = 0; k < 3; ++k) {
          const int i = (k + 1) % 3, j = (k + 2) % 3, all = 7;
          const Eigen::Array3d own = in_doubles(f.term[1 << k]),
                               with_i = in_doubles(f.term[1 << k | 1 << i]),
                               with_j = in_doubles(f.term[1 << k | 1 << j]),
                               mixed = in_doubles(f.term[all]);
          const Eigen::Array3d middle = own + with_i * c[i] + with_j * c[j] + mixed * (c[i] * c[j]);
          const Eigen::Array3d half = (with_i + mixed * c[j]).abs() * e[i] +
                                      (with_j + mixed * c[i]).abs() * e[j] +
                                      mixed.abs() * (e[i] * e[j]);
          range.add(k, middle * inverse[k], half * inverse[k], kept == 0);
          const Eigen::Array3d second = (with_i + mixed * c[j]).abs() + mixed.abs() * e[j];
          mixed_norm[k] =
              flat[k] || flat[i] ? 0.0 : second.matrix().norm() * inverse[k] * inverse[i];
        }
        // The largest row sum of a symmetric matrix bounds its norm.
        for (int k = 0; k < 3; ++k) bend = std::max(bend, mixed_norm[k] + mixed_norm[(k + 2) % 3]);
        ++kept;
      }
  if (kept == 0 || (long_row && kept < cells)) return false;

  // What the terms are off by: near nodes and sums of eight of them in floats, which may underflow.
  const double off = (64.0 * 0x1p-24 * state.reach + 64.0 * 0x1p-149) * 2.0 / finest;
  Eigen::Matrix3d a, half;
  for (int k = 0; k < 3; ++k)
    for (int r = 0; r < 3; ++r) {
      a(r, k) = 0.5 * (range.lo[k][r] + range.hi[k][r]);
      half(r, k) = 0.5 * (range.hi[k][r] - range.lo[k][r]) + off;
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
  // A mapped vertex, and a vertex at rest (whose local coordinates are off by 2^-50 at most), in
  // the body's frame.
  const double unit = state.precision == Precision::kSingle ? 0x1p-24 : 0x1p-53;
  const double error = 2.0 * mapping_error_bound(state.largest) * state.scale +
                       64.0 * unit * state.reach + 32.0 * 0x1p-53 * farthest * (a.norm() + d) +
                       1e-37;
  const double h = patch.edge, off_slope = 2.0 * error / patch.altitude;
  // What the terms are off by is in both ends of a cell.
  const double m = cells == 1 ? kUp * (bend + 16.0 * off / finest) : kInfinity;
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

std::size_t PatchTree::bytes() const {
  return children.capacity() * sizeof(PatchRest) +
         (ones.capacity() + eights.capacity()) * sizeof(PatchRegion);
}

PatchTree make_patch_tree(const BodyShape& shape, const LatticeTree& tree) {
  PatchTree out;
  out.scale = rest_scale(shape);
  PatchBuilder(shape, tree, out).run();
  return out;
}

namespace {

// One patch, or two together: by the cells it meets where these are few, else by itself.
bool told(LazyState& state, const PatchTree& patches, const PatchRest& patch) {
  std::uint64_t cells = 1, longest = 1;
  for (int k = 0; k < 3; ++k) {
    const std::uint64_t count = patch.last_cell[k] - patch.first_cell[k] + std::uint64_t{1};
    if (count > kMostCells) return false;
    cells *= count;
    longest = std::max(longest, count);
  }
  if (cells > kMostCells) return false;
  if (longest > 2) return holds(state, patches, patch);
  for (const std::vector<PatchRegion>* regions : {&patches.ones, &patches.eights}) {
    const bool eight = regions == &patches.eights;
    if (!eight && cells > 1) continue;
    const auto at = std::lower_bound(regions->begin(), regions->end(), patch.first_cell,
                                     [](const PatchRegion& region, const GridIndex& cell) {
                                       return grid_before(region.first, cell);
                                     });
    const auto index = static_cast<std::size_t>(at - regions->begin());
    std::uint8_t& known = state.embedded_regions[index + (eight ? patches.ones.size() : 0)];
    if (known == kUnknown) known = holds(state, patches, at->patch) ? kEmbedded : kNotTold;
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
  if (state.embedded_children.empty()) {
    state.embedded_regions.assign(patches.ones.size() + patches.eights.size(), kUnknown);
    state.embedded_children.assign(patches.children.size(), kUnknown);
  }
  // Of what is not told of one of them, no more is told of both.
  if (!told_alone(state, patches, a) || (a != b && !told_alone(state, patches, b))) return false;
  return a == b || told(state, patches, patches.children[a].united(patches.children[b]));
}

}  // namespace contactcheck
