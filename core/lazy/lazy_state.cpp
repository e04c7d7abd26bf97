#include "core/lazy/lazy_state.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/deform/mapping.h"
#include "core/narrow/moving_triangles.h"
#include "core/types/check.h"
#include "core/types/local_origin.h"

namespace contactcheck {
namespace {

// A slack as a float that is no smaller. Finite whatever happens, so that boxes of lanes without a
// child stay empty; all content of a body lies within 1 of its origin, so this much is everything.
float round_up(double slack) {
  constexpr double kEverything = 1e29;
  return std::nextafter(static_cast<float>(std::min(slack, kEverything)),
                        std::numeric_limits<float>::infinity());
}

double half_width(const Aabb& box) {
  const Vec3 middle = box.center();
  return (box.hi - middle).cwiseMax(middle - box.lo).maxCoeff();
}

Vec3 in_frame(const LazyState& state, const Vec3& x) { return (x - state.origin) * state.scale; }
Vec3 in_frame(const LazyState&, const Vec3f& x) { return x.cast<double>(); }

Aabb box_of(std::span<const Vec3> points) {
  Vec3 lo = points[0], hi = points[0];
  // Four points at a time: one by one, each minimum would wait for the one before it.
  using Four = Eigen::Array<double, 12, 1>;
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  const std::size_t whole = points.size() / 4 * 4;
  if (whole > 0) {
    Four low = Eigen::Map<const Four>(points[0].data()), high = low;
    for (std::size_t i = 4; i < whole; i += 4) {
      const Eigen::Map<const Four> four(points[i].data());
      low = low.min(four);
      high = high.max(four);
    }
    for (int i = 0; i < 12; i += 3) {
      lo = lo.cwiseMin(low.segment<3>(i).matrix());
      hi = hi.cwiseMax(high.segment<3>(i).matrix());
    }
  }
  for (const Vec3& p : points.subspan(whole)) {
    lo = lo.cwiseMin(p);
    hi = hi.cwiseMax(p);
  }
  return {lo, hi};
}

void set_box(std::span<const Vec3> points, LazyState& state) {
  state.box = box_of(points);
  state.largest = std::max(state.box.lo.cwiseAbs().maxCoeff(), state.box.hi.cwiseAbs().maxCoeff());
}

bool box_holds(const LaneBoxes& box, std::uint32_t lane, const Vec3& p) {
  for (int k = 0; k < 3; ++k)
    if (!(box.lo[k][lane] <= p[k] && p[k] <= box.hi[k][lane])) return false;
  return true;
}

bool slab_holds(const LaneSlabs& slab, std::uint32_t lane, const Vec3& p) {
  double along = 0.0;
  for (int k = 0; k < 3; ++k) along += slab.normal[k][lane] * p[k];
  return std::abs(along - slab.middle[lane]) <= slab.half[lane];
}

void place_one(const Aabb& frame, double scale, LazyState& state) {
  constexpr double kFloatUnit = 0x1p-24;
  state.scale = scale;
  state.origin = frame.center();
  state.reach = half_width(frame) * scale;
  const double common = mapping_error_bound(state.largest) * scale * 1.01 + 1e-37;
  state.slack = round_up(64.0 * kFloatUnit * state.reach + common);
  state.slab_slack = round_up(384.0 * kFloatUnit * state.reach + 2.0 * common);
}

// `boxes`: per body, what its frame is to hold.
void place_by(const std::vector<Aabb>& boxes, std::span<LazyState> states) {
  Aabb scene;
  double largest = 0.0, smallest = std::numeric_limits<double>::infinity();
  for (const Aabb& box : boxes) {
    scene.extend(box);
    largest = std::max(largest, half_width(box));
    smallest = std::min(smallest, half_width(box));
  }
  // Slack grows with the frame: at 64 body widths it is still a ten-thousandth of a body.
  constexpr double kLargestShare = 64.0;
  const bool common = half_width(scene) <= kLargestShare * smallest;
  const double scale = scale_to_one(common ? half_width(scene) : largest);
  for (std::size_t b = 0; b < states.size(); ++b)
    place_one(common ? scene : boxes[b], scale, states[b]);
}

void add_and_subtract(Float4& low, Float4& high) {
  const Float4 sum = low + high;
  high -= low;
  low = sum;
}

// Sums and differences of neighbours along one axis after the other. An eighth of each node comes
// in, so that no term is larger than a coordinate.
void set_terms(const CornerIds& ids, const std::vector<Float4>& nodes, CellTerms& out) {
  Float4 f[8];
  for (int c = 0; c < 8; ++c) f[c] = nodes[ids[c]];
  for (int c = 0; c < 8; c += 2) add_and_subtract(f[c], f[c + 1]);
  for (int c : {0, 1, 4, 5}) add_and_subtract(f[c], f[c + 2]);
  for (int c = 0; c < 4; ++c) add_and_subtract(f[c], f[c + 4]);
  for (int c = 0; c < 8; ++c) out.term[c] = f[c];
}

// An eighth of a node in the body's frame.
Float4 near_node(const LazyState& state, std::size_t n) {
  if (state.precision == Precision::kSingle) {
    const Vec3f& node = state.single.nodes[n];
    return {0.125f * node.x(), 0.125f * node.y(), 0.125f * node.z(), 0.0f};
  }
  const double eighth = 0.125 * state.scale;
  Float4 near;
  near << ((state.nodes[n] - state.origin) * eighth).cast<float>(), 0.0f;
  return near;
}

template <class Leaves>
void count_leaves(const LatticeTree& tree, const Leaves& leaves, LazyCounters& counters) {
  for (std::uint32_t l = 0; l < leaves.size(); ++l) {
    if (leaves.find(l) == nullptr) continue;
    ++counters.leaves_mapped;
    counters.vertices_mapped += tree.leaves[l].vertices;
  }
}

template <class Real>
class Validation {
 public:
  Validation(const LazyState& state, std::span<const Vec3Of<Real>> vertices)
      : state_(state), vertices_(vertices) {}

  // Leaves under a block go through every lane above them.
  std::string block(std::uint32_t index) {
    for (std::uint32_t lane = 0; lane < state_.tree->blocks[index].children; ++lane) {
      const TreeChild child = state_.tree->blocks[index].child[lane];
      path_.push_back({index, lane});
      std::string broken = child.leaf() ? leaf(child.index()) : block(child.index());
      path_.pop_back();
      if (!broken.empty()) return broken;
    }
    return "";
  }

 private:
  struct Slot {
    std::uint32_t block, lane;
  };

  bool holds(const Slot& slot, const Vec3& p) const {
    const BlockBounds& bounds = *state_.blocks.find(slot.block);
    return box_holds(bounds.box, slot.lane, p) &&
           (state_.from_vertices || slab_holds(bounds.slab, slot.lane, p));
  }

  std::string leaf(std::uint32_t index) const {
    const TreeLeaf& leaf = state_.tree->leaves[index];
    for (std::uint32_t i = 0; i < leaf.vertices; ++i) {
      const std::uint32_t v = state_.tree->leaf_vertices[leaf.first_vertex + i];
      for (const Slot& slot : path_)
        if (!holds(slot, in_frame(state_, vertices_[v])))
          return "vertex " + std::to_string(v) + " leaves lane " + std::to_string(slot.lane) +
                 " of block " + std::to_string(slot.block);
    }
    return "";
  }

  const LazyState& state_;
  std::span<const Vec3Of<Real>> vertices_;
  std::vector<Slot> path_;
};

}  // namespace

double scale_to_one(double x) {
  constexpr int kLargestExponent = 1000;
  if (!(x > 0.0)) return 1.0;
  int exponent = 0;
  std::frexp(x, &exponent);
  return std::ldexp(1.0, -std::clamp(exponent, -kLargestExponent, kLargestExponent));
}

void forget_frame(LazyState& state) {
  state.blocks.begin_frame(state.tree->blocks.size());
  if (state.precision == Precision::kSingle) {
    state.single.leaves.begin_frame(state.tree->leaves.size());
  } else {
    state.leaves.begin_frame(state.tree->leaves.size());
  }
  state.cells_known = false;
}

void begin_frame_by_nodes(LazyState& state, std::span<const Vec3> nodes) {
  forget_frame(state);
  state.nodes = nodes;
  state.vertices = {};
  set_box(nodes, state);
  // Mapped vertices leave the hull of their nodes by rounding, no more. They are finite, so the box
  // stays so: an infinite one has no middle, and no scale could be made of its width.
  constexpr double kLargest = std::numeric_limits<double>::max();
  const double error = 2.0 * mapping_error_bound(state.largest);
  state.box.lo = (state.box.lo.array() - error).max(-kLargest);
  state.box.hi = (state.box.hi.array() + error).min(kLargest);
}

void begin_frame_by_vertices(LazyState& state, std::span<const Vec3> vertices) {
  forget_frame(state);
  state.vertices = vertices;
  set_box(vertices, state);
}

void begin_same_frame(LazyState& state, const LazyState& before, std::span<const Vec3> nodes,
                      std::span<const Vec3> vertices) {
  forget_frame(state);
  state.nodes = nodes;
  state.vertices = vertices;
  state.box = before.box;
  state.largest = before.largest;
}

void tighten_box(LazyState& state) { state.box = box_of(state.vertices); }

void place(std::span<LazyState> states) {
  std::vector<Aabb> boxes;
  for (const LazyState& state : states) boxes.push_back(state.box);
  place_by(boxes, states);
}

void place_step(std::span<LazyState> states, std::span<LazyState> ends) {
  constexpr double kLargest = 0x1p1020;  // sums of four coordinates do not overflow
  std::vector<Aabb> boxes;
  std::vector<Vec3> velocities;
  for (std::size_t b = 0; b < states.size(); ++b) {
    LazyState &start = states[b], &end = ends[b];
    start.largest = std::max(start.largest, end.largest);
    Vec3& velocity = velocities.emplace_back(Vec3::Zero());
    if (start.largest <= kLargest) velocity = end.box.center() - start.box.center();
    boxes.push_back(start.box);
    boxes.back().extend(Aabb{end.box.lo - velocity, end.box.hi - velocity});
  }
  place_by(boxes, states);
  for (std::size_t b = 0; b < states.size(); ++b) {
    const LazyState& start = states[b];
    LazyState& end = ends[b];
    end.origin = start.origin + velocities[b];
    end.scale = start.scale;
    end.reach = start.reach;
    end.slack = start.slack;
    end.slab_slack = start.slab_slack;
  }
}

bool may_meet(const LazyState& a, const LazyState& b) {
  return !separated(MovingBox{a.box, a.end->box}, MovingBox{b.box, b.end->box});
}

void begin_frame_in_single(LazyState& state, std::span<const Vec3> nodes, const Vec3& origin) {
  forget_frame(state);
  state.nodes = {};
  state.vertices = {};
  state.single.vertices = {};
  state.single.nodes.resize(nodes.size());
  round_to_local(nodes, origin, state.single.nodes);
  float largest = 0.0f;
  for (const Vec3f& node : state.single.nodes)
    largest = std::max(largest, node.cwiseAbs().maxCoeff());
  state.largest = static_cast<double>(largest);
}

void place_in_single(std::span<LazyState> states, const Vec3& origin) {
  constexpr double kFloatUnit = 0x1p-24;
  double largest = 0.0;
  for (const LazyState& state : states) largest = std::max(largest, state.largest);
  const double scale = scale_to_one(largest), reach = largest * scale;
  // By how much vertices mapped in floats are off the exact image of their local coordinates. Those
  // are rounded first, by at most 2^-25 each, and along each axis the image changes by at most 2
  // reach over the cell: 3 * 2^-24 reach for the three.
  const double error = static_cast<double>(mapping_error_bound(static_cast<float>(reach))) +
                       3.0 * kFloatUnit * reach;
  // Slacks: derivation in bounds-inl.h.
  const double common = 1.01 * error + 1e-37;
  for (LazyState& state : states) {
    state.origin = origin;
    state.scale = scale;
    state.reach = reach;
    state.slack = round_up(64.0 * kFloatUnit * reach + common);
    state.slab_slack = round_up(384.0 * kFloatUnit * reach + 2.0 * common);
    AabbOf<float> box;
    for (Vec3f& node : state.single.nodes) {
      // By doubles: the scale of a tiny scene is no float.
      node = (node.cast<double>() * scale).cast<float>();
      box.extend(node);
    }
    // Mapped vertices leave the hull of their nodes by rounding, no more.
    const double outward = state.shape->lattice ? 2.0 * error : 0.0;
    state.box = {box.lo.cast<double>().array() - outward, box.hi.cast<double>().array() + outward};
  }
}

std::vector<Vec3f> single_vertices(const LazyState& state) {
  const BodyShape& shape = *state.shape;
  if (!shape.lattice) return state.single.nodes;
  std::vector<Vec3f> out;
  for (std::size_t v = 0; v < shape.mesh.vertices.size(); ++v) {
    const CornerIds& ids = shape.lattice->cell_nodes[shape.embedding.home_cell[v]];
    CornersOf<float> corners;
    for (std::size_t c = 0; c < corners.size(); ++c) corners[c] = state.single.nodes[ids[c]];
    out.push_back(map_point(corners, Vec3f(shape.embedding.local[v].cast<float>())));
  }
  return out;
}

void find_cells(LazyState& state) {
  if (state.cells_known || state.from_vertices) return;
  state.near_nodes.resize(state.shape->node_count());
  for (std::size_t n = 0; n < state.near_nodes.size(); ++n)
    state.near_nodes[n] = near_node(state, n);
  const std::vector<CornerIds>& cells = state.shape->lattice->cell_nodes;
  state.cells.resize(cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c)
    set_terms(cells[c], state.near_nodes, state.cells[c]);
  state.cells_known = true;
  state.embedded_children.clear();
}

void count_made(const LazyState& state, LazyCounters& counters) {
  for (std::uint32_t b = 0; b < state.blocks.size(); ++b)
    if (state.blocks.find(b) != nullptr) ++counters.blocks_bounded;
  count_leaves(*state.tree, state.leaves, counters);
  count_leaves(*state.tree, state.single.leaves, counters);
}

std::string validate(const LazyState& state, std::span<const Vec3> vertices) {
  return Validation<double>(state, vertices).block(0);
}

std::string validate(const LazyState& state, std::span<const Vec3f> vertices) {
  return Validation<float>(state, vertices).block(0);
}

}  // namespace contactcheck
