#include "reference/oracle/oracle.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "core/types/check.h"
#include "core/types/contact_set.h"
#include "core/types/vec3.h"
#include "reference/oracle/cell_hulls.h"
#include "reference/oracle/closed_chain.h"
#include "reference/oracle/exact_tests.h"
#include "reference/oracle/floating_point.h"
#include "reference/oracle/surface_distance.h"
#include "reference/oracle/surface_tree.h"
#include "reference/oracle/vertex_queries.h"

namespace contactcheck::oracle {
namespace {

// The computed distance of two boxes exceeds the true one by less than this share.
constexpr double kGapRounding = 1 - 16 * 0x1p-53;

// Rounded down, also where it is subnormal; no square of it overflows.
double box_gap(const Aabb& a, const Aabb& b) {
  constexpr double kLargestDouble = std::numeric_limits<double>::max();
  const Vec3 gap = (a.lo - b.hi).cwiseMax(b.lo - a.hi).cwiseMax(0.0).cwiseMin(kLargestDouble);
  return std::max(0.0, std::nextafter(gap.stableNorm() * kGapRounding, -1.0));
}

template <typename Pair>
void add_contact(std::vector<Pair>& contacts, const Pair& pair, std::size_t most) {
  if (contacts.size() == most) refuse_many_contacts(most);
  contacts.push_back(pair);
}

// Relative to the scale; below the 1e-9 that DistanceInterval promises, which pays for rounding.
constexpr double kSeparationWidth = 9e-10;

}  // namespace

void refuse_many_contacts(std::size_t most) {
  throw RefusedInput("more than " + std::to_string(most) +
                     " pairs of triangles are in contact; at most that many can be judged");
}

struct Oracle::Impl {
  explicit Impl(const std::vector<Body>& bodies);

  std::uint32_t size() const { return static_cast<std::uint32_t>(shapes.size()); }
  void check(const Frame& frame) const;
  std::vector<Aabb> vertex_boxes(const Frame& frame) const;
  std::vector<OpenBody> update_chains(const Frame& frame);
  bool contains(std::uint32_t outer, std::uint32_t inner, const Frame& frame) const;
  std::vector<BodyPair> contained(const Frame& frame, const std::vector<BodyPair>& touching) const;

  std::vector<std::shared_ptr<const BodyShape>> shapes;
  std::vector<SurfaceTree> trees;
  // Instances of one shape share the chain as written. If that is closed, it is the body's chain in
  // every frame. Empty until first wanted.
  std::vector<std::shared_ptr<const SurfaceChain>> written, chains;
  std::vector<CellHulls> hulls;  // empty until boxes are first wanted
  ScaledSurface scaled_a, scaled_b;
};

Oracle::Impl::Impl(const std::vector<Body>& bodies) {
  for (const Body& body : bodies) {
    shapes.push_back(body.shape);
    // Instances of one shape share its tree's topology.
    const auto first = std::find(shapes.begin(), shapes.end(), body.shape);
    const auto index = static_cast<std::size_t>(first - shapes.begin());
    if (index < trees.size()) {
      trees.push_back(SurfaceTree(trees[index]));
    } else {
      trees.emplace_back(body.shape->mesh);
    }
  }
}

void Oracle::Impl::check(const Frame& frame) const {
  CONTACTCHECK_INVARIANT(frame.bodies.size() == shapes.size(), "one state per body");
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    CONTACTCHECK_INVARIANT(frame.bodies[i].vertices.size() == shapes[i]->mesh.vertices.size(),
                           "the oracle needs every deformed vertex");
  }
}

// Without fitting the trees, which few of the pairs need.
std::vector<Aabb> Oracle::Impl::vertex_boxes(const Frame& frame) const {
  std::vector<Aabb> boxes;
  for (const BodyState& body : frame.bodies) boxes.push_back(box_of(body.vertices));
  return boxes;
}

// The chains of this frame; those that are open.
std::vector<OpenBody> Oracle::Impl::update_chains(const Frame& frame) {
  if (written.empty())
    for (const auto& shape : shapes) {
      const auto first = std::find(shapes.begin(), shapes.end(), shape);
      const auto index = static_cast<std::size_t>(first - shapes.begin());
      const TriangleMesh& mesh = shape->mesh;
      written.push_back(index < written.size()
                            ? written[index]
                            : std::make_shared<const SurfaceChain>(
                                  surface_chain_as_written(mesh.triangles, mesh.vertices.size())));
    }
  chains = written;
  std::vector<OpenBody> open;
  for (std::uint32_t i = 0; i < size(); ++i) {
    if (!written[i]->closed())
      chains[i] = std::make_shared<const SurfaceChain>(
          surface_chain(shapes[i]->mesh.triangles, frame.bodies[i].vertices));
    if (!chains[i]->closed()) open.push_back({i, *chains[i]->open});
  }
  return open;
}

// @pre the surfaces share no point: all of a component lies inside where one of its vertices does
bool Oracle::Impl::contains(std::uint32_t outer, std::uint32_t inner, const Frame& frame) const {
  const std::vector<std::uint32_t>& component_vertex = chains[inner]->component_vertex;
  return chains[outer]->closed() &&
         std::any_of(component_vertex.begin(), component_vertex.end(), [&](std::uint32_t v) {
           return strictly_inside(trees[outer], frame.bodies[inner].vertices[v]);
         });
}

// @pre trees and chains are those of the frame
std::vector<BodyPair> Oracle::Impl::contained(const Frame& frame,
                                              const std::vector<BodyPair>& touching) const {
  std::vector<BodyPair> out;
  for (std::uint32_t a = 0; a < size(); ++a)
    for (std::uint32_t b = a + 1; b < size(); ++b)
      if (trees[a].bounds().overlaps(trees[b].bounds()) &&
          !std::binary_search(touching.begin(), touching.end(), BodyPair{a, b}) &&
          (contains(a, b, frame) || contains(b, a, frame)))
        out.push_back({a, b});
  return out;
}

Oracle::Oracle(const std::vector<Body>& bodies) : impl_(std::make_unique<Impl>(bodies)) {}
Oracle::~Oracle() = default;

Truth Oracle::judge(const Frame& frame, const WantedTruth& wanted) {
  const FloatingPointGuard guard;
  impl_->check(frame);
  const auto& shapes = impl_->shapes;
  std::vector<SurfaceTree>& trees = impl_->trees;
  std::vector<CellHulls>& hulls = impl_->hulls;
  for (std::uint32_t i = 0; i < impl_->size(); ++i) trees[i].refit(frame.bodies[i].vertices);
  if (wanted.boxes) {
    if (hulls.empty())
      for (const auto& shape : shapes) hulls.emplace_back(shape);
    for (std::uint32_t i = 0; i < impl_->size(); ++i) {
      CONTACTCHECK_INVARIANT(frame.bodies[i].nodes.size() == shapes[i]->node_count(),
                             "the oracle needs every deformed node");
      hulls[i].update(frame.bodies[i].nodes);
    }
  }

  Truth truth;
  if (wanted.containment || wanted.vertices) truth.open = impl_->update_chains(frame);
  const auto judge_vertices = [&](std::uint32_t body, std::uint32_t in) {
    if (!impl_->chains[in]->closed()) return;
    const auto vertices = frame.bodies[body].vertices;
    for (std::uint32_t v = 0; v < vertices.size(); ++v)
      if (strictly_inside(trees[in], vertices[v])) truth.surface.vertices.push_back({body, in, v});
  };
  std::vector<BodyPair> touching;
  const auto judge_pair = [&](std::uint32_t a, std::uint32_t b) {
    if (!trees[a].bounds().overlaps(trees[b].bounds())) return;
    if (wanted.triangles || wanted.containment) {
      // All pairs of triangles that share a point, or where only containment counts, the first.
      bool contact = false;
      any_box_pair(trees[a], trees[b], [&](std::uint32_t i, std::uint32_t j) {
        if (!triangles_intersect(trees[a].corners(i), trees[b].corners(j))) return false;
        contact = true;
        if (wanted.triangles)
          add_contact(truth.surface.triangles, {a, b, i, j}, wanted.most_contacts);
        return !wanted.triangles;
      });
      if (contact) touching.push_back({a, b});
    }
    if (wanted.vertices) {
      judge_vertices(a, b);
      judge_vertices(b, a);
    }
  };
  const auto judge_self = [&](std::uint32_t body) {
    const SurfaceTree& tree = trees[body];
    const std::vector<Triangle>& linked = shapes[body]->linked();
    refuse_many_adjacent_pairs(linked);
    any_own_box_pair(tree, [&](std::uint32_t i, std::uint32_t j) {
      if (meet_beyond_shared(linked[i], tree.corners(i), linked[j], tree.corners(j)))
        add_contact(truth.surface.self, {body, i, j}, wanted.most_contacts);
      return false;
    });
  };
  for (std::uint32_t a = 0; wanted.self && a < impl_->size(); ++a) judge_self(a);
  for (std::uint32_t a = 0; a < impl_->size(); ++a)
    for (std::uint32_t b = a + 1; b < impl_->size(); ++b) {
      judge_pair(a, b);
      if (!wanted.boxes) continue;
      std::vector<CellPair> cells;
      overlapping_cells(hulls[a], hulls[b], cells);
      for (const CellPair& c : cells) truth.boxes.push_back({a, b, c.a, c.b});
    }
  if (wanted.containment) truth.containment = impl_->contained(frame, touching);
  truth.surface.canonicalize();
  std::sort(truth.boxes.begin(), truth.boxes.end());
  return truth;
}

Containment Oracle::containment(const Frame& frame, const std::vector<BodyPair>& touching) {
  const FloatingPointGuard guard;
  impl_->check(frame);
  for (std::uint32_t i = 0; i < impl_->size(); ++i) impl_->trees[i].refit(frame.bodies[i].vertices);
  Containment out;
  out.open = impl_->update_chains(frame);
  out.pairs = impl_->contained(frame, touching);
  return out;
}

DistanceInterval Oracle::distance(const Frame& frame, BodyPair pair) {
  const FloatingPointGuard guard;
  impl_->check(frame);
  CONTACTCHECK_INVARIANT(pair.a != pair.b && std::max(pair.a, pair.b) < impl_->size(),
                         "two different bodies of the scene");
  impl_->scaled_a.tree = &impl_->trees[pair.a];
  impl_->scaled_b.tree = &impl_->trees[pair.b];
  impl_->scaled_a.vertices = frame.bodies[pair.a].vertices;
  impl_->scaled_b.vertices = frame.bodies[pair.b].vertices;
  return surface_distance(impl_->scaled_a, impl_->scaled_b);
}

// Pairs of bodies are measured by the distance of their boxes, nearest first: the smallest distance
// of a scene needs few of them. Pairs whose boxes are no nearer than what was found (but for the
// width that the contract allows) need not be measured: grids of equal bodies have thousands of
// equal gaps. Boxes that meet always are measured, because only then it is known that nothing
// touches.
DistanceInterval Oracle::separation(const Frame& frame) {
  const FloatingPointGuard guard;
  impl_->check(frame);
  CONTACTCHECK_INVARIANT(impl_->size() > 1, "a separation is of two bodies at least");
  const std::vector<Aabb> boxes = impl_->vertex_boxes(frame);
  double scale = 0.0;
  for (const Aabb& box : boxes)
    scale = std::max({scale, box.lo.cwiseAbs().maxCoeff(), box.hi.cwiseAbs().maxCoeff()});
  // A heap. Of equal gaps the first bodies come first: the answer does not depend on the heap.
  std::vector<std::tuple<double, std::uint32_t, std::uint32_t>> pairs;
  for (std::uint32_t a = 0; a < impl_->size(); ++a)
    for (std::uint32_t b = a + 1; b < impl_->size(); ++b)
      pairs.emplace_back(box_gap(boxes[a], boxes[b]), a, b);
  std::make_heap(pairs.begin(), pairs.end(), std::greater<>());
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  DistanceInterval best{kInfinity, kInfinity};
  while (best.upper > 0 && !pairs.empty()) {
    std::pop_heap(pairs.begin(), pairs.end(), std::greater<>());
    const auto [gap, a, b] = pairs.back();
    pairs.pop_back();
    if (gap > 0 && gap >= best.upper - kSeparationWidth * scale) {
      best.lower = std::min(best.lower, gap);
      break;
    }
    const DistanceInterval found = distance(frame, {a, b});
    best.lower = std::min(best.lower, found.lower);
    best.upper = std::min(best.upper, found.upper);
  }
  return best;
}

std::vector<NearPair> Oracle::near(const Frame& frame, double margin) {
  const FloatingPointGuard guard;
  impl_->check(frame);
  CONTACTCHECK_INVARIANT(std::isfinite(margin) && margin >= 0, "a margin is finite, at least 0");
  std::vector<NearPair> out;
  if (margin == 0) return out;
  const std::vector<Aabb> boxes = impl_->vertex_boxes(frame);
  for (std::uint32_t other = 0; other < impl_->size(); ++other) {
    bool fitted = false;
    for (std::uint32_t body = 0; body < impl_->size(); ++body) {
      if (body == other || !boxes_within(margin, boxes[body], boxes[other])) continue;
      if (!fitted) impl_->trees[other].refit(frame.bodies[other].vertices);
      fitted = true;
      append_near_pairs({body, other}, frame.bodies[body].vertices, impl_->trees[other], margin,
                        out);
    }
  }
  std::sort(out.begin(), out.end());
  return out;
}

std::vector<NearPair> Oracle::self_near(const Frame& frame, double margin) {
  const FloatingPointGuard guard;
  impl_->check(frame);
  CONTACTCHECK_INVARIANT(std::isfinite(margin) && margin >= 0, "a margin is finite, at least 0");
  std::vector<NearPair> out;
  if (margin == 0) return out;
  for (std::uint32_t body = 0; body < impl_->size(); ++body) {
    impl_->trees[body].refit(frame.bodies[body].vertices);
    append_near_pairs({body, body}, frame.bodies[body].vertices, impl_->trees[body], margin, out);
  }
  std::erase_if(
      out, [&](const NearPair& p) { return impl_->shapes[p.body]->uses(p.triangle, p.vertex); });
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace contactcheck::oracle
