#include "reference/oracle/step_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "core/types/check.h"
#include "core/types/mesh_edges.h"
#include "reference/oracle/elementary_impact.h"
#include "reference/oracle/floating_point.h"
#include "reference/oracle/surface_tree.h"

namespace contactcheck::oracle {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The next double: sums and products of a few numbers are right to that many units.
double above(double x) { return std::nextafter(x, kInfinity); }

// Not above the distance of any two points of the boxes.
double least_distance(const Aabb& a, const Aabb& b) {
  double gap = 0.0;
  for (int k = 0; k < 3; ++k) gap = std::max({gap, a.lo[k] - b.hi[k], b.lo[k] - a.hi[k]});
  return gap > 0.0 ? std::nextafter(gap, 0.0) : 0.0;
}

// Not below it.
double largest_distance(const Aabb& a, const Aabb& b) {
  double sum = 0.0;
  for (int k = 0; k < 3; ++k)
    sum = above(sum + above(std::max(a.hi[k] - b.lo[k], b.hi[k] - a.lo[k])));
  return sum;
}

// Whether points of the boxes can come within the tolerance. The boxes hold all of the step, so
// that no distance at its start is larger than that of their farthest corners.
bool may_be_near(const Aabb& a, const Aabb& b, const ImpactTolerance& tolerance) {
  const double least = least_distance(a, b);
  if (least <= tolerance.absolute) return true;
  return tolerance.of_start > 0.0 && least <= above(tolerance.of_start * largest_distance(a, b));
}

void keep_nearer(StepNearness& kept, const StepNearness& other) {
  if (other.verdict == NearVerdict::kNear) {
    if (kept.verdict != NearVerdict::kNear || other.distance < kept.distance) kept = other;
  } else if (kept.verdict == NearVerdict::kSpurious) {
    kept.verdict = other.verdict;
  }
}

}  // namespace

struct StepDistances::Impl {
  explicit Impl(const std::vector<Body>& bodies) {
    for (const Body& body : bodies) {
      shapes.push_back(body.shape);
      edges.push_back(mesh_edges(body.shape->mesh.triangles).edges);
      trees.emplace_back(body.shape->mesh);
    }
  }

  const Triangle& triangle(std::uint32_t body, std::uint32_t t) const {
    return shapes[body]->mesh.triangles[t];
  }

  // Vertices of body a and b in the order of ImpactQuery, the first `of_a` of them of a.
  StepNearness elements(ImpactKind kind, std::uint32_t a, std::uint32_t b,
                        const std::array<std::uint32_t, 4>& vertices,
                        const ImpactTolerance& tolerance) const {
    ImpactQuery query{kind, {}, {}};
    const std::size_t of_a = kind == ImpactKind::vertex_triangle ? 1 : 2;
    for (std::size_t i = 0; i < 4; ++i) {
      const std::uint32_t body = i < of_a ? a : b;
      query.start[i] = start[body][vertices[i]];
      query.end[i] = end[body][vertices[i]];
    }
    StepNearness out;
    // Elements of one body with a common vertex do meet, and are no contact.
    if (elementary_impact(query).contact) return out;
    out.verdict = near_miss(query, tolerance).verdict;
    if (out.verdict != NearVerdict::kNear) return out;
    // Within a tolerance the distance itself is not looked for; without one it is.
    out.distance = near_miss(query, {}).at_most;
    const double at_start = near_miss({kind, query.start, query.start}, {}).at_least;
    out.of_start = std::min(1.0, above(out.distance / at_start));
    return out;
  }

  StepNearness vertex(std::uint32_t a, std::uint32_t v, std::uint32_t b, std::uint32_t t,
                      const ImpactTolerance& tolerance) const {
    const Triangle& c = triangle(b, t);
    return elements(ImpactKind::vertex_triangle, a, b, {v, c[0], c[1], c[2]}, tolerance);
  }

  StepNearness triangles(std::uint32_t a, std::uint32_t s, std::uint32_t b, std::uint32_t t,
                         const ImpactTolerance& tolerance) const {
    StepNearness out;
    const Triangle &p = triangle(a, s), &q = triangle(b, t);
    for (std::size_t i = 0; i < 3; ++i) {
      keep_nearer(out, vertex(a, p[i], b, t, tolerance));
      keep_nearer(out, vertex(b, q[i], a, s, tolerance));
      for (std::size_t j = 0; j < 3; ++j)
        keep_nearer(out, elements(ImpactKind::edge_edge, a, b,
                                  {p[i], p[(i + 1) % 3], q[j], q[(j + 1) % 3]}, tolerance));
    }
    return out;
  }

  StepNearness of_bodies(const BodyPair& pair, const ImpactTolerance& tolerance) const {
    StepNearness out;
    std::uint64_t left = kMostPairs;
    any_pair(
        trees[pair.a], trees[pair.b],
        [&](const Aabb& x, const Aabb& y) { return may_be_near(x, y, tolerance); },
        [&](std::uint32_t s, std::uint32_t t) {
          if (left == 0) {
            out.verdict = NearVerdict::kUndecided;
            return true;
          }
          --left;
          keep_nearer(out, triangles(pair.a, s, pair.b, t, tolerance));
          return out.verdict == NearVerdict::kNear;
        });
    return out;
  }

  std::vector<std::shared_ptr<const BodyShape>> shapes;
  std::vector<std::vector<Edge>> edges;  // per body
  std::vector<SurfaceTree> trees;
  std::vector<std::span<const Vec3>> start, end;  // per body
};

StepDistances::StepDistances(const std::vector<Body>& bodies)
    : impl_(std::make_unique<Impl>(bodies)) {}
StepDistances::~StepDistances() = default;

void StepDistances::set_step(const Step& step) {
  impl_->start.clear();
  impl_->end.clear();
  for (std::size_t b = 0; b < impl_->shapes.size(); ++b) {
    impl_->start.push_back(step.start.bodies[b].vertices);
    impl_->end.push_back(step.end.bodies[b].vertices);
    impl_->trees[b].refit(impl_->start[b], impl_->end[b]);
  }
}

StepNearness StepDistances::nearness(Level level, const ElementPair& pair,
                                     const ImpactTolerance& tolerance) {
  const FloatingPointGuard guard;
  switch (level) {
    case Level::kImpactVf:
    case Level::kImpactSelfVf:
      return impl_->vertex(pair.body_a, pair.a, pair.body_b, pair.b, tolerance);
    case Level::kImpactEe:
    case Level::kImpactSelfEe: {
      const Edge &p = impl_->edges[pair.body_a][pair.a], &q = impl_->edges[pair.body_b][pair.b];
      return impl_->elements(ImpactKind::edge_edge, pair.body_a, pair.body_b,
                             {p[0], p[1], q[0], q[1]}, tolerance);
    }
    case Level::kImpactTriangle:
      return impl_->triangles(pair.body_a, pair.a, pair.body_b, pair.b, tolerance);
    default:
      CONTACTCHECK_INVARIANT(level == Level::kImpact, "a level of contact within steps");
      return impl_->of_bodies({pair.body_a, pair.body_b}, tolerance);
  }
}

NearVerdict StepDistances::near_at_start(const BodyPair& bodies, double distance) {
  const FloatingPointGuard guard;
  const std::vector<std::span<const Vec3>> end = std::exchange(impl_->end, impl_->start);
  const NearVerdict verdict = impl_->of_bodies(bodies, {distance, 0.0}).verdict;
  impl_->end = end;
  return verdict;
}

}  // namespace contactcheck::oracle
