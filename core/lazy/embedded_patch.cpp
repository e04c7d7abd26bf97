#include "core/lazy/embedded_patch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "core/deform/grid.h"
#include "core/deform/mapping.h"
#include "core/lazy/triangle_rest.h"

namespace contactcheck {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Factors for the rounding of what is computed at rest, far more than it can be.
constexpr double kUp = 1 + 1e-6, kDown = 1 - 1e-6;
constexpr std::uint32_t kMostCells = 8;  // a patch with more is not worth a test
// The range of sides of cells, and of the square of DF, for which the bounds are derived.
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
  // For a coordinate on a grid line either cell would do: F is continuous.
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

std::vector<GridSlice> slices_of(const std::vector<double>& lines, double scale) {
  std::vector<GridSlice> out(lines.size() - 1);
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
    const double low = lines[i], high = lines[i + 1], side = (high - low) * scale;
    out[i].low = low;
    out[i].farthest = std::max(std::abs(low), std::abs(high)) * scale;
    if (side >= kLeastSide && side <= kMostSide) out[i].inverse = 2.0 / side;
  }
  return out;
}

class PatchBuilder {
 public:
  PatchBuilder(const BodyShape& shape, const LatticeTree& tree, PatchTree& out)
      : shape_(shape), tree_(tree), rest_(triangles_at_rest(shape)), out_(out) {}

  void run() {
    out_.children.resize(tree_.blocks.size() * kBlockWidth);
    block(0);
    take(ones_, out_.ones);
    take(eights_, out_.eights);
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

  static void take(const Regions& from, PatchRegions& to) {
    std::vector<GridIndex> firsts;
    for (const auto& [first, patch] : from) {
      firsts.push_back(first);
      to.patches.push_back(patch);
    }
    to.places = GridPlaces(firsts);
  }

  const BodyShape& shape_;
  const LatticeTree& tree_;
  std::vector<TriangleRest> rest_;
  Regions ones_{grid_before}, eights_{grid_before};
  PatchTree& out_;
};

// Three numbers and a 0, as the terms of a cell have them.
using Double4 = Eigen::Array4d;

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

/// The part of the cells between two neighbouring grid lines that Q meets, in y = 2 x - 1 of a
/// cell.
struct AxisPart {
  double middle, half, inverse;  ///< inverse: GridSlice::inverse
};

/// The cells that Q meets, axis by axis.
struct PatchCells {
  AxisPart parts[3][kMostCells];
  std::array<bool, 3> flat{};    ///< Q has no extent along this axis
  double largest_inverse = 0.0;  ///< 2 over the shortest side, along axes in which Q extends
  double farthest = 0.0;         ///< |coordinate| of an end of these cells, at rest
  std::size_t count = 1;
  bool long_row = false;  ///< more than two along an axis

  double shortest_side() const { return 2.0 / largest_inverse; }
};

// Nothing where a side is not looked at. @pre at most kMostCells along each axis
std::optional<PatchCells> cells_of(const PatchTree& patches, const PatchRest& patch) {
  PatchCells out;
  for (int k = 0; k < 3; ++k) {
    const std::uint32_t first = patch.first_cell[k], last = patch.last_cell[k];
    out.count *= last - first + std::size_t{1};
    out.long_row = out.long_row || last - first > 1;
    out.flat[k] = patch.lo[k] == patch.hi[k];
    for (std::uint32_t at = first; at <= last; ++at) {
      const GridSlice& slice = patches.slices[k][at];
      if (slice.inverse == 0.0) return {};
      if (!out.flat[k]) out.largest_inverse = std::max(out.largest_inverse, slice.inverse);
      out.farthest = std::max(out.farthest, slice.farthest);
      // Differences round by 2^-53 of them, of which `half` has 1e-12 to spare.
      const double from = std::max(-1.0,
                                   (patch.lo[k] - slice.low) * patches.scale * slice.inverse - 1.0),
                   to = std::min(1.0,
                                 (patch.hi[k] - slice.low) * patches.scale * slice.inverse - 1.0);
      out.parts[k][at - first] = {0.5 * (from + to), std::max(0.0, 0.5 * (to - from)) + 1e-12,
                                  slice.inverse};
    }
  }
  return out;
}

/// DF over the parts of kept cells that Q meets: a column per axis at rest.
struct Derivative {
  Double4 lo[3], hi[3];
  double bend = 0.0;  ///< change per length, where Q is in one cell
  std::size_t kept = 0;

  Derivative() {
    for (int k = 0; k < 3; ++k) lo[k].setConstant(kInfinity), hi[k].setConstant(-kInfinity);
  }
  void add(int axis, const Double4& middle, const Double4& half) {
    lo[axis] = lo[axis].min(middle - half);
    hi[axis] = hi[axis].max(middle + half);
  }
};

Derivative derivative_over(const LazyState& state, const PatchTree& patches, const PatchRest& patch,
                           const PatchCells& cells) {
  Derivative out;
  for (std::uint32_t z = patch.first_cell[2]; z <= patch.last_cell[2]; ++z)
    for (std::uint32_t y = patch.first_cell[1]; y <= patch.last_cell[1]; ++y)
      for (std::uint32_t x = patch.first_cell[0]; x <= patch.last_cell[0]; ++x) {
        const std::uint32_t cell = patches.kept.find({x, y, z});
        if (cell == GridPlaces::kNone) continue;
        const CellTerms& f = state.cells[cell];
        const AxisPart* const part[3] = {&cells.parts[0][x - patch.first_cell[0]],
                                         &cells.parts[1][y - patch.first_cell[1]],
                                         &cells.parts[2][z - patch.first_cell[2]]};
        const Double4 mixed = f.term[7].cast<double>();
        double mixed_norm[3] = {};  // norms of the derivatives along k and the next axis
        for (int k = 0; k < 3; ++k) {
          const int i = (k + 1) % 3, j = (k + 2) % 3;
          const Double4 own = f.term[1 << k].cast<double>(),
                        with_i = f.term[1 << k | 1 << i].cast<double>(),
                        with_j = f.term[1 << k | 1 << j].cast<double>();
          const auto& [ci, ei, inverse_i] = *part[i];
          const auto& [cj, ej, inverse_j] = *part[j];
          const double inverse = part[k]->inverse;
          const Double4 along_i = (with_i + mixed * cj).abs(),
                        along_j = (with_j + mixed * ci).abs();
          const Double4 middle = own + with_i * ci + with_j * cj + mixed * (ci * cj);
          const Double4 half = along_i * ei + along_j * ej + mixed.abs() * (ei * ej);
          out.add(k, middle * inverse, half * inverse);
          if (cells.count > 1 || cells.flat[k] || cells.flat[i]) continue;
          const double second = (along_i + mixed.abs() * ej).matrix().norm();
          mixed_norm[k] = second * inverse * inverse_i;
        }
        // The largest row sum of a symmetric matrix bounds its norm.
        for (int k = 0; k < 3; ++k)
          out.bend = std::max(out.bend, mixed_norm[k] + mixed_norm[(k + 2) % 3]);
        ++out.kept;
      }
  return out;
}

/// A, the middle of DF: its norm, how little it stretches, how far DF is from it.
struct LinearPart {
  double norm;       ///< at least |A|
  double stretch;    ///< s: at most the smallest singular value
  double variation;  ///< d: at least the distance of DF, as an operator
};

// `off`: what entries of DF are off by.
LinearPart linear_part(const Derivative& derivative, const std::array<bool, 3>& flat, double off) {
  Eigen::Matrix3d middle, half;
  for (int k = 0; k < 3; ++k)
    for (int r = 0; r < 3; ++r) {
      middle(r, k) = 0.5 * (derivative.lo[k][r] + derivative.hi[k][r]);
      half(r, k) = 0.5 * (derivative.hi[k][r] - derivative.lo[k][r]) + off;
    }
  // An axis without extent in Q takes no part: in the product below it is as large as all others.
  Eigen::Matrix3d extended = middle;
  for (int k = 0; k < 3; ++k)
    if (flat[k]) extended.col(k).setZero(), half.col(k).setZero();
  Eigen::Matrix3d product = extended.transpose() * extended;
  const double all = product.trace();
  for (int k = 0; k < 3; ++k)
    if (flat[k]) product(k, k) = all;
  // Bounds the norm of every matrix with entries up to those of `half`, by two norms.
  const double variation =
      kUp * std::sqrt(std::min(half.squaredNorm(),
                               half.rowwise().sum().maxCoeff() * half.colwise().sum().maxCoeff()));
  return {middle.norm(), std::sqrt(smallest_eigenvalue(product)) * kDown, variation};
}

// The conditions of the claim for one frame. @pre at most kMostCells cells
bool holds(const LazyState& state, const PatchTree& patches, const PatchRest& patch) {
  if (!(patch.gap > 0.0f)) return false;
  const std::optional<PatchCells> cells = cells_of(patches, patch);
  if (!cells) return false;
  const Derivative derivative = derivative_over(state, patches, patch, *cells);
  const std::size_t kept = derivative.kept;
  if (kept == 0 || (cells->long_row && kept < cells->count)) return false;

  // What the terms are off by: near nodes and sums of eight of them in floats, which may underflow.
  const double side = cells->shortest_side();
  const double off = (64.0 * 0x1p-24 * state.reach + 64.0 * 0x1p-149) * 2.0 / side;
  const LinearPart linear = linear_part(derivative, cells->flat, off);
  const double variation = linear.variation;
  // e: how far a mapped vertex is off, and a vertex at rest (whose local coordinates are off by
  // 2^-50 at most), in the body's frame.
  const double unit = state.precision == Precision::kSingle ? 0x1p-24 : 0x1p-53;
  const double error = 2.0 * mapping_error_bound(state.largest) * state.scale +
                       64.0 * unit * state.reach +
                       32.0 * 0x1p-53 * cells->farthest * (linear.norm + variation) + 1e-37;
  const double edge = patch.edge, error_slope = 2.0 * error / patch.altitude;
  // m: what the terms are off by is in both ends of a cell.
  const double bend = cells->count == 1 ? kUp * (derivative.bend + 16.0 * off / side) : kInfinity;

  // Neighbours, steps 3 and 4.
  const double longest_path = patch.ratio * patch.stretch;  // k c
  const double neighbours = std::min(longest_path * (variation + error_slope),
                                     variation + longest_path * (bend * edge + error_slope));
  if (!(linear.stretch > neighbours * kUp)) return false;
  // Others, steps 2 to 4.
  const double detour = cells->count <= 2 || kept == cells->count ? 1.0 : 1.4142136;  // r
  const double interpolation =
      std::min(variation * edge * 0.57735027, bend * edge * edge / 6.0) + error;
  return (linear.stretch - detour * variation) * patch.gap > 2.0 * interpolation * kUp;
}

// Verdicts on a patch in a frame, as they are cached.
constexpr std::uint8_t kUnasked = 0, kProven = 1, kUnproven = 2;

// The claim for all triangles within some cells, computed once a frame.
bool region_proven(const LazyState& state, const PatchTree& patches, const PatchRest& region,
                   std::uint8_t& cached) {
  if (cached == kUnasked) cached = holds(state, patches, region) ? kProven : kUnproven;
  return cached == kProven;
}

// The claim for one patch or two together: by the cells that it meets where these are few, else by
// the patch itself.
bool proven(LazyState& state, const PatchTree& patches, const PatchRest& patch) {
  std::uint32_t cells = 1, longest = 1;
  for (int k = 0; k < 3; ++k) {
    const std::uint32_t more = patch.last_cell[k] - patch.first_cell[k];
    if (more >= kMostCells) return false;
    cells *= more + 1;  // at most kMostCells^3
    longest = std::max(longest, more + 1);
  }
  if (cells > kMostCells) return false;
  if (longest > 2) return holds(state, patches, patch);
  if (cells == 1) {
    const std::uint32_t one = patches.ones.places.find(patch.first_cell);
    if (region_proven(state, patches, patches.ones.patches[one], state.embedded_ones[one]))
      return true;
  }
  const std::uint32_t eight = patches.eights.places.find(patch.first_cell);
  return region_proven(state, patches, patches.eights.patches[eight],
                       state.embedded_eights[eight]) ||
         holds(state, patches, patch);
}

bool child_proven(LazyState& state, const PatchTree& patches, std::uint32_t child) {
  std::uint8_t& cached = state.embedded_children[child];
  if (cached == kUnasked)
    cached = proven(state, patches, patches.children[child]) ? kProven : kUnproven;
  return cached == kProven;
}

}  // namespace

std::size_t PatchTree::bytes() const {
  std::size_t out =
      children.capacity() * sizeof(PatchRest) + ones.bytes() + eights.bytes() + kept.bytes();
  for (const std::vector<GridSlice>& axis : slices) out += axis.capacity() * sizeof(GridSlice);
  return out;
}

PatchTree make_patch_tree(const BodyShape& shape, const LatticeTree& tree) {
  PatchTree out;
  out.scale = rest_scale(shape);
  out.kept = GridPlaces(shape.lattice->cells);
  for (int k = 0; k < 3; ++k) out.slices[k] = slices_of(shape.lattice->lines[k], out.scale);
  PatchBuilder(shape, tree, out).run();
  return out;
}

bool stays_embedded(LazyState& state, const PatchTree& patches, std::uint32_t a, std::uint32_t b) {
  if (state.embedded_children.empty()) {
    state.embedded_ones.assign(patches.ones.patches.size(), kUnasked);
    state.embedded_eights.assign(patches.eights.patches.size(), kUnasked);
    state.embedded_children.assign(patches.children.size(), kUnasked);
  }
  // Where the claim is not proven for one of them, it is not proven for both.
  if (!child_proven(state, patches, a) || (a != b && !child_proven(state, patches, b)))
    return false;
  return a == b || proven(state, patches, patches.children[a].united(patches.children[b]));
}

}  // namespace contactcheck
