// A deformed body at both ends of a step as the kernels of core/lazy see it, and what its bounds
// promise, by exact arithmetic.
#pragma once

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/core/lazy/exact_cells.h"
#include "tests/core/lazy/one_body.h"
#include "tests/support/observed_error.h"

namespace contactcheck::test {

/// Over the slacks, as far as a search sees them (state_slack_test.cpp).
struct StepErrors {
  double box = -1.0, slab = -1.0;
};

/// One body over one step, placed as a scene of one body. Its states point into it.
class OneStep {
 public:
  OneStep(ShapePtr shape, bool from_vertices)
      : shape_(std::move(shape)), tree_(make_lattice_tree(*shape_)) {
    for (LazyState& state : states_) {
      state.shape = shape_.get();
      state.tree = &tree_;
      state.from_vertices = from_vertices || !shape_->lattice;
    }
    states_[0].end = &states_[1];
  }
  OneStep(const OneStep&) = delete;
  OneStep& operator=(const OneStep&) = delete;

  /// Bounds everything.
  void begin(std::vector<Vec3> start, std::vector<Vec3> end, const LazyKernels& kernels) {
    nodes_ = {std::move(start), std::move(end)};
    arena_.clear();
    for (std::size_t e = 0; e < 2; ++e) {
      vertices_[e].resize(shape_->mesh.vertices.size());
      map_body(*shape_, nodes_[e], vertices_[e]);
      if (states_[e].from_vertices) {
        begin_frame_by_vertices(states_[e], vertices_[e]);
      } else {
        begin_frame_by_nodes(states_[e], nodes_[e]);
      }
    }
    place_step({&states_[0], 1}, {&states_[1], 1});
    for (LazyState& state : states_) find_cells(state);
    kernels.bound_all(states_[0], arena_);
    leaves_.clear();
    for (std::uint32_t l = 0; l < tree_.leaves.size(); ++l)
      leaves_.push_back(&kernels.map_leaf(states_[0], l, arena_));
  }

  /// The first vertex, of either end, that leaves bounds of its triangles, or the reach of the
  /// body, by more than what is rounded in the world; "" if none does. Exact.
  std::string broken() const {
    for (std::size_t e = 0; e < 2; ++e) {
      const std::string of = std::string(" at the ") + (e == 0 ? "start" : "end");
      for (std::uint32_t v = 0; v < vertices_[e].size(); ++v)
        for (int k = 0; k < 3; ++k)
          if (magnitude(in_frame(e, v, k)) > states_[0].reach + Wide(states_[0].slack))
            return "a vertex is beyond the reach" + of;
      for (std::uint32_t b = 0; b < tree_.blocks.size(); ++b)
        for (std::uint32_t c = 0; c < tree_.blocks[b].children; ++c) {
          const BlockBounds& bounds = *states_[0].blocks.find(b);
          for (const std::uint32_t v : vertices_below(b, c)) {
            const std::string lane = std::to_string(c) + " of block " + std::to_string(b) + of;
            if (!holds(bounds.box, c, e, v)) return "a vertex leaves the box of lane " + lane;
            if (!states_[0].from_vertices && beyond_slab(bounds.slab, c, e, v) > 0)
              return "a vertex leaves the slab of lane " + lane;
          }
        }
      for (std::uint32_t l = 0; l < tree_.leaves.size(); ++l)
        for (std::uint32_t t = 0; t < tree_.leaves[l].triangles; ++t)
          for (const std::uint32_t v : shape_->mesh.triangles[triangle(l, t)]) {
            const std::string leaf = " of leaf " + std::to_string(l) + of;
            if (!holds(leaves_[l]->boxes[t / kBlockWidth], t % kBlockWidth, e, v))
              return "a vertex leaves the box of triangle " + std::to_string(t) + leaf;
            if (!holds(*leaves_[l]->whole, 0, e, v)) return "a vertex leaves the whole" + leaf;
          }
    }
    return "";
  }

  /// @pre bounds come from nodes
  StepErrors errors() const {
    StepErrors out;
    for (std::size_t e = 0; e < 2; ++e)
      for (std::uint32_t b = 0; b < tree_.blocks.size(); ++b)
        for (std::uint32_t c = 0; c < tree_.blocks[b].children; ++c) {
          const std::set<std::uint32_t> vertices = vertices_below(b, c);
          for (int k = 0; k < 3; ++k) out.box = std::max(out.box, box_error(b, c, e, k, vertices));
          const double slack = states_[0].slab_slack;
          for (const std::uint32_t v : vertices) {
            const Wide beyond = beyond_slab(states_[0].blocks.find(b)->slab, c, e, v);
            out.slab = std::max(out.slab, static_cast<double>((beyond + slack) / slack));
          }
        }
    return out;
  }

  const LazyState& start() const { return states_[0]; }

 private:
  std::uint32_t triangle(std::uint32_t leaf, std::uint32_t t) const {
    return tree_.leaf_triangles[tree_.leaves[leaf].first_triangle + t];
  }
  std::set<std::uint32_t> vertices_below(std::uint32_t block, std::uint32_t child) const {
    std::set<std::uint32_t> out;
    for (const std::uint32_t t : triangles_under(tree_, tree_.blocks[block].child[child]))
      for (const std::uint32_t v : shape_->mesh.triangles[t]) out.insert(v);
    return out;
  }

  /// In the body's frame at that end.
  Wide in_frame(std::size_t e, std::uint32_t v, int axis) const {
    return (Wide(vertices_[e][v][axis]) - states_[e].origin[axis]) * states_[e].scale;
  }
  bool holds(const LaneBoxes& box, std::size_t lane, std::size_t e, std::uint32_t v) const {
    for (int k = 0; k < 3; ++k) {
      const Wide x = in_frame(e, v, k);
      if (!(box.lo[k][lane] <= x && x <= box.hi[k][lane])) return false;
    }
    return true;
  }
  Wide beyond_slab(const LaneSlabs& slab, std::size_t lane, std::size_t e, std::uint32_t v) const {
    Wide along = -Wide(slab.middle[lane]);
    for (int k = 0; k < 3; ++k) along += Wide(slab.normal[k][lane]) * in_frame(e, v, k);
    return magnitude(along) - slab.half[lane];
  }

  /// By how much the joined box falls short of the exact one at one end and mapped vertices stick
  /// out beyond their exact images, over the slack.
  double box_error(std::uint32_t block, std::uint32_t child, std::size_t e, int axis,
                   const std::set<std::uint32_t>& vertices) const {
    const BlockBounds& bounds = *states_[0].blocks.find(block);
    const WideRange exact = exact_range(states_[e], block, child, axis);
    Wide below = 0, above = 0;
    for (const std::uint32_t v : vertices) {
      const ExactCell cell(states_[e], shape_->embedding.home_cell[v], axis);
      const Wide off = in_frame(e, v, axis) - cell.at(shape_->embedding.local[v]);
      below = std::max(below, -off), above = std::max(above, off);
    }
    const double slack = states_[0].slack;
    const Wide lo = Wide(bounds.box.lo[axis][child]) + slack;
    const Wide hi = Wide(bounds.box.hi[axis][child]) - slack;
    return static_cast<double>(std::max(lo - exact.lo + below, exact.hi - hi + above) / slack);
  }

  ShapePtr shape_;
  LatticeTree tree_;
  std::array<LazyState, 2> states_;
  std::vector<const LeafCache*> leaves_;
  FrameArena arena_;
  std::array<std::vector<Vec3>, 2> nodes_, vertices_;
};

/// The largest error of boxes in a search. A cell is small at the start; at the end, about `place`,
/// its nodes begin near the corners of a cube of half-width 1, in any order, and turn it inside
/// out.
inline double largest_step_box_error(const LazyKernels& kernels, double place) {
  TriangleSource random(543);
  const ShapePtr shape = make_shape(sphere_mesh(Vec3::Zero(), 1.0, 0), {1, 1, 1});
  std::vector<Vec3> start(shape->node_count());
  for (Vec3& n : start) n = random.point(Vec3::Zero(), 0.25);
  const TurnedCells cells(random, shape->node_count(), place);
  OneStep body(shape, false);
  return climb(
      2, 300, [&] { return cells.make(); }, [&](std::vector<Vec3>& end) { cells.change(end); },
      [&](const std::vector<Vec3>& end) {
        body.begin(start, end, kernels);
        return body.errors().box;
      });
}

/// The largest error of slabs in a search: a flat square, which is mapped by affine maps that have
/// a slab without thickness at the start, and are alike at the end.
inline double largest_step_slab_error(const LazyKernels& kernels) {
  TriangleSource random(544);
  TriangleMesh square;
  square.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  square.triangles = {{0, 1, 3}, {0, 3, 2}};
  const std::vector<double> line = {0, 1};
  const ShapePtr shape = make_shape_on_lines(square, {line, line, line});
  struct Affine {
    Vec3 column[4];
    Vec3 to;
  };
  const auto make = [&] {
    Affine out;
    for (int c = 0; c < 3; ++c) out.column[c] = random.point(Vec3::Zero(), 0.5);
    out.column[3] = random.point(Vec3::Zero(), 0.7);
    out.to = random.point(Vec3::Zero(), 1.0);
    return out;
  };
  const auto change = [&](Affine& map) {
    const double by = std::ldexp(random.unit(), -3 - random.below(24));
    if (random.below(5) == 0) {
      map.to[random.below(3)] += by;
    } else {
      map.column[random.below(4)][random.below(3)] += by;
    }
  };
  const std::vector<Vec3> rest = rest_nodes_at(*shape, Vec3::Zero());
  OneStep body(shape, false);
  return climb(3, 300, make, change, [&](const Affine& map) {
    std::vector<Vec3> start, end;
    for (const Vec3& n : rest) {
      start.push_back(map.column[3] + n.x() * map.column[0] + n.y() * map.column[1] +
                      n.z() * map.column[2]);
      end.push_back(start.back() + map.to);
    }
    body.begin(std::move(start), std::move(end), kernels);
    return body.errors().slab;
  });
}

/// Of two bodies with boxes of whole numbers at both ends: how often may_meet() is wrong, and how
/// often they are apart. The boxes are compared at times at which their coordinates are exact.
struct BodyMeetings {
  int wrong = 0, apart = 0;
};
inline BodyMeetings judged_meetings(int count) {
  TriangleSource random(547);
  BodyMeetings out;
  const auto box = [&] {
    const Vec3 at = random.grid_point(2);
    const Aabb drawn = random.grid_box(1);
    return Aabb{drawn.lo + at, drawn.hi + at};
  };
  for (int i = 0; i < count; ++i) {
    LazyState a, b, a_end, b_end;
    a.end = &a_end, b.end = &b_end;
    for (LazyState* state : {&a, &b, &a_end, &b_end}) state->box = box();
    bool apart = false;
    for (int k = 0; k < 3; ++k) {
      int below = 0, above = 0;
      for (double t = 0.0; t <= 1.0; t += 0.125) {
        const auto at = [&](double start, double end) { return (1 - t) * start + t * end; };
        below += at(a.box.hi[k], a_end.box.hi[k]) < at(b.box.lo[k], b_end.box.lo[k]);
        above += at(b.box.hi[k], b_end.box.hi[k]) < at(a.box.lo[k], a_end.box.lo[k]);
      }
      apart |= below == 9 || above == 9;
    }
    out.wrong += may_meet(a, b) == apart;
    out.apart += apart;
  }
  return out;
}

/// Both ends of a step of a body that deforms, moves and turns inside out, here and far out.
inline std::string broken_step(const LazyKernels& kernels, const ShapePtr& shape, int rounds) {
  TriangleSource random(545);
  for (const bool from_vertices : {false, true}) {
    OneStep body(shape, from_vertices);
    for (int round = 0; round < rounds; ++round) {
      const double strength = round % 3 == 0 ? 0.0 : round % 3 == 1 ? 0.3 : 2.0;
      const double far = round % 4 == 3 ? 1e9 : round % 4 == 2 ? 1e3 : 1.0;
      const auto drawn = [&](double place) {
        return deformed_nodes(*shape, {strength, 1.0, random.point(Vec3::Zero(), place)}, random);
      };
      // Far out at one end or the other.
      std::vector<Vec3> start = drawn(round % 8 < 4 ? 1.0 : far);
      body.begin(std::move(start), drawn(round % 8 < 4 ? far : 1.0), kernels);
      const std::string broken = body.broken();
      if (!broken.empty())
        return broken + ", round " + std::to_string(round) + (from_vertices ? ", refitted" : "");
    }
  }
  return "";
}

}  // namespace contactcheck::test
