// A deformed body as the kernels of core/lazy see it, and a walk over its tree.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include "core/lazy/kernels.h"
#include "core/lazy/lattice_tree.h"
#include "core/lazy/lazy_state.h"
#include "core/types/local_origin.h"
#include "tests/support/random_triangles.h"
#include "tests/support/shapes.h"

namespace contactcheck::test {

using ShapePtr = std::shared_ptr<const BodyShape>;

inline void add_triangles(const LatticeTree& tree, TreeChild child,
                          std::vector<std::uint32_t>& out) {
  if (child.leaf()) {
    const TreeLeaf& leaf = tree.leaves[child.index()];
    const auto first = tree.leaf_triangles.begin() + leaf.first_triangle;
    out.insert(out.end(), first, first + leaf.triangles);
    return;
  }
  const TreeBlock& block = tree.blocks[child.index()];
  for (std::uint32_t c = 0; c < block.children; ++c) add_triangles(tree, block.child[c], out);
}

/// Triangles of the mesh below a child, with repeats should there be any.
inline std::vector<std::uint32_t> triangles_under(const LatticeTree& tree, TreeChild child) {
  std::vector<std::uint32_t> out;
  add_triangles(tree, child, out);
  return out;
}

/// Nodes (vertices, without a lattice) at rest, each moved by up to `strength` per axis, then
/// scaled and moved.
struct Deformation {
  double strength = 0.0;
  double scale = 1.0;
  Vec3 offset = Vec3::Zero();
};

inline std::vector<Vec3> deformed_nodes(const BodyShape& shape, const Deformation& how,
                                        TriangleSource& random) {
  std::vector<Vec3> nodes = rest_nodes_at(shape, Vec3::Zero());
  for (Vec3& n : nodes) n = how.offset + how.scale * random.point(n, how.strength);
  return nodes;
}

/// One body in one frame, placed as a scene of one body. Its state points into it.
class OneBody {
 public:
  OneBody(ShapePtr shape, bool from_vertices, Precision precision = Precision::kDouble)
      : shape_(std::move(shape)), tree_(make_lattice_tree(*shape_, TreeUse::kNodes, precision)) {
    states_[1].shape = shape_.get();
    state().shape = shape_.get();
    state().tree = &tree_;
    state().precision = precision;
    state().from_vertices = from_vertices || !shape_->lattice;
  }
  OneBody(const OneBody&) = delete;
  OneBody& operator=(const OneBody&) = delete;

  /// `company`: half-width of another body in the scene, about the origin; 0: the body is alone.
  void begin(std::vector<Vec3> nodes, double company = 0.0) {
    nodes_ = std::move(nodes);
    arena_.clear();
    if (single()) return begin_in_single(company);
    vertices_.resize(shape_->mesh.vertices.size());
    map_body(*shape_, nodes_, vertices_);
    if (state().from_vertices) {
      begin_frame_by_vertices(state(), vertices_);
    } else {
      begin_frame_by_nodes(state(), nodes_);
    }
    states_[1].box = {Vec3::Constant(-company), Vec3::Constant(company)};
    place({states_.data(), company > 0.0 ? 2u : 1u});
    find_cells(state());
  }
  /// Bounds everything; "" or the first broken promise.
  std::string broken(const LazyKernels& kernels) {
    kernels.bound_all(state(), arena_);
    return broken();
  }
  /// The same once it is bounded.
  std::string broken() const {
    return single() ? validate(states_[0], std::span<const Vec3f>(single_vertices_))
                    : validate(states_[0], std::span<const Vec3>(vertices_));
  }

  LazyState& state() { return states_[0]; }
  FrameArena& arena() { return arena_; }
  LazyCounters made() const {
    LazyCounters out;
    count_made(states_[0], out);
    return out;
  }
  const LatticeTree& tree() const { return tree_; }
  const BodyShape& shape() const { return *shape_; }
  const std::vector<Vec3>& vertices() const { return vertices_; }
  /// In single precision instead, in the body's frame.
  const std::vector<Vec3f>& single_vertices() const { return single_vertices_; }

  template <typename Real>
  const std::vector<Vec3Of<Real>>& vertices_in() const {
    if constexpr (std::is_same_v<Real, float>) {
      return single_vertices_;
    } else {
      return vertices_;
    }
  }

  /// In the body's frame.
  Aabb box_of(std::span<const std::uint32_t> triangles) const {
    Aabb box;
    for (std::uint32_t t : triangles)
      for (std::uint32_t v : shape_->mesh.triangles[t]) box.extend(in_frame(v));
    return box;
  }

 private:
  bool single() const { return states_[0].precision == Precision::kSingle; }
  Vec3 in_frame(std::uint32_t v) const {
    if (single()) return single_vertices_[v].cast<double>();
    return (vertices_[v] - states_[0].origin) * states_[0].scale;
  }

  void begin_in_single(double company) {
    const std::vector<Vec3> corners = {Vec3::Constant(-company), Vec3::Constant(company)};
    Frame frame;
    frame.bodies.push_back({nodes_, {}});
    if (company > 0.0) frame.bodies.push_back({corners, {}});
    const Vec3 origin = local_origin(frame);
    begin_frame_in_single(state(), nodes_, origin);
    states_[1].largest = (corners[1] - origin).cwiseAbs().maxCoeff();
    place_in_single({states_.data(), frame.bodies.size()}, origin);
    single_vertices_ = contactcheck::single_vertices(state());
    if (state().from_vertices) state().single.vertices = single_vertices_;
    find_cells(state());
  }

  ShapePtr shape_;
  LatticeTree tree_;
  std::array<LazyState, 2> states_;
  FrameArena arena_;
  std::vector<Vec3> nodes_, vertices_;
  std::vector<Vec3f> single_vertices_;
};

/// Long triangles between random points of [-1, 1]^3.
inline TriangleMesh long_triangles(std::uint64_t seed, int count) {
  TriangleSource random(seed);
  TriangleMesh mesh;
  for (int i = 0; i < count; ++i) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const Vec3& p : random.triangle(Vec3::Zero(), 1.0)) mesh.vertices.push_back(p);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

/// A sheet of 2 n^2 triangles over [0, 1]^2, open.
inline TriangleMesh sheet(int n) {
  TriangleMesh mesh;
  const auto row = static_cast<std::uint32_t>(n + 1);
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x) mesh.vertices.push_back({1.0 * x / n, 1.0 * y / n, 0.1 * (x % 2)});
  for (std::uint32_t y = 0; y + 1 < row; ++y)
    for (std::uint32_t x = 0; x + 1 < row; ++x) {
      const std::uint32_t a = y * row + x;
      mesh.triangles.push_back({a, a + 1, a + row});
      mesh.triangles.push_back({a + 1, a + row + 1, a + row});
    }
  return mesh;
}

/// The box [0, n]^3 whose vertices are lattice nodes, in a lattice without padding.
inline ShapePtr box_on_its_nodes(int n) {
  std::vector<double> line;
  for (int i = 0; i <= n; ++i) line.push_back(i);
  return make_shape_on_lines(box_mesh(Vec3::Zero(), Vec3::Constant(n), n), {line, line, line});
}

/// For a search of large errors (climb): nodes near the corners of a cube of half-width 1 about a
/// place, in any order, that turn a cell inside out; and small changes of one of them.
class TurnedCells {
 public:
  TurnedCells(TriangleSource& random, std::size_t nodes, double place)
      : random_(random), nodes_(nodes), place_(place) {}

  std::vector<Vec3> make() const {
    std::vector<Vec3> out(nodes_);
    for (Vec3& n : out) {
      n = random_.point(Vec3(place_, -place_, 0.7 * place_), std::ldexp(1.0, -random_.below(20)));
      for (int k = 0; k < 3; ++k) n[k] += 2 * random_.below(2) - 1;
    }
    return out;
  }
  void change(std::vector<Vec3>& nodes) const {
    Vec3& n = nodes[static_cast<std::size_t>(random_.below(static_cast<int>(nodes.size())))];
    n[random_.below(3)] += std::ldexp(random_.unit(), -random_.below(24));
  }

 private:
  TriangleSource& random_;
  std::size_t nodes_;
  double place_;
};

}  // namespace contactcheck::test
