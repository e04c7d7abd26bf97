#include "reference/oracle/surface_geometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/types/check.h"
#include "reference/oracle/cell_hulls.h"
#include "reference/oracle/convex_penetration.h"
#include "reference/oracle/exact_tests.h"
#include "reference/oracle/floating_point.h"
#include "reference/oracle/intersection_length.h"
#include "reference/oracle/surface_depth.h"
#include "reference/oracle/surface_tree.h"
#include "reference/oracle/triangle_distance.h"
#include "reference/oracle/vertex_distance.h"

namespace contactcheck::oracle {
namespace {

// In fractions of the size: what counts as equally near, and how wide bounds may be.
constexpr double kAsNear = 1e-9, kBoundsWidth = 5e-13;

struct Candidate {
  std::uint32_t triangle;
  NearestPoint point;
};

// Depth: the distance from the vertex to the surface, off by less than 1e-12 of `size` or of the
// depth. Directions: to the nearest point of every triangle that is as near within 1e-9 of `size`,
// one for those that agree; none when the vertex lies on the surface (exactly).
// @pre the tree is fitted; all |coordinates| <= 1
Penetration nearest_points(const Vec3& vertex, const SurfaceTree& surface, double size) {
  double upper = std::numeric_limits<double>::infinity();
  std::vector<Candidate> near;
  const auto worth = [&](double distance) { return distance <= upper + kAsNear * size; };

  const auto descend = [&](const auto& self, std::uint32_t index) -> void {
    const SurfaceTree::Node& node = surface.node(index);
    if (!worth(distance_to(node.box, vertex))) return;
    if (node.is_leaf()) {
      for (std::uint32_t place = node.first; place < node.first + node.count; ++place) {
        if (!worth(distance_to(surface.box_at(place), vertex))) continue;
        const std::uint32_t triangle = surface.triangle_at(place);
        const NearestPoint point = nearest_point(vertex, surface.corners(triangle));
        if (!worth(point.lower)) continue;
        upper = std::min(upper, point.upper);
        near.push_back({triangle, point});
      }
      return;
    }
    std::uint32_t first = index + 1, second = node.second;
    if (distance_to(surface.node(second).box, vertex) <
        distance_to(surface.node(first).box, vertex))
      std::swap(first, second);
    self(self, first);
    self(self, second);
  };
  descend(descend, 0);

  const auto drop_farther = [&] {
    std::erase_if(near, [&](const Candidate& c) { return !worth(c.point.lower); });
  };
  drop_farther();
  for (Candidate& c : near) {
    if (c.point.upper - c.point.lower <= kBoundsWidth * size) continue;
    c.point = exact_nearest_point(vertex, surface.corners(c.triangle));
    upper = std::min(upper, c.point.upper);
  }
  drop_farther();

  Penetration out;
  for (const Candidate& c : near)
    if (c.point.lower == 0 && point_on_triangle(vertex, surface.corners(c.triangle))) return out;
  std::stable_sort(near.begin(), near.end(), [](const Candidate& x, const Candidate& y) {
    return x.point.offset.squaredNorm() < y.point.offset.squaredNorm();
  });
  out.depth = near.front().point.offset.norm();
  for (const Candidate& c : near) {
    const double length = c.point.offset.norm();
    if (length > 0) add_direction(c.point.offset / length, out.directions);
  }
  return out;
}

// In fractions of the body size: depths that differ by less are equal.
constexpr double kAsShort = 1e-9;

// Relative width of a distance interval above which it is computed in rationals.
constexpr double kDistanceWidth = 1e-9;

TriangleCorners scaled_corners(const TriangleCorners& t, int exponent) {
  return {scaled_by_two_to(exponent, t[0]), scaled_by_two_to(exponent, t[1]),
          scaled_by_two_to(exponent, t[2])};
}

Penetration scaled_back(Penetration penetration, int exponent) {
  penetration.depth = std::ldexp(penetration.depth, exponent);
  return penetration;
}

}  // namespace

// One body in the frame; what costs time is made when it is first asked for.
struct BodyGeometry {
  explicit BodyGeometry(std::shared_ptr<const BodyShape> s) : shape(std::move(s)) {}

  std::shared_ptr<const BodyShape> shape;
  BodyState state;
  double largest = 0.0, side = 0.0;  // coordinate; side of the box of all vertices
  std::optional<SurfaceTree> tree;
  std::vector<Vec3> scaled;  // what the tree is fitted to
  int tree_exponent = 0;
  bool tree_fitted = false;
  std::optional<CellHulls> hulls;
  bool hulls_fitted = false;
  std::optional<SolidFault> fault;
  bool fault_known = false;

  void set(const BodyState& now);
  TriangleCorners corners(std::uint32_t triangle) const;
  const SurfaceTree& fitted_tree(int exponent);
  const ConvexHull& hull(std::uint32_t cell);
  const std::optional<SolidFault>& not_simple();
};

void BodyGeometry::set(const BodyState& now) {
  CONTACTCHECK_INVARIANT(now.vertices.size() == shape->mesh.vertices.size(),
                         "the oracle needs every deformed vertex");
  state = now;
  largest = largest_coordinate(now.vertices);
  side = std::min(largest_side(now.vertices), std::numeric_limits<double>::max());
  tree_fitted = hulls_fitted = fault_known = false;
}

TriangleCorners BodyGeometry::corners(std::uint32_t triangle) const {
  CONTACTCHECK_INVARIANT(triangle < shape->mesh.triangles.size(), "a triangle of the body");
  const Triangle& t = shape->mesh.triangles[triangle];
  return {state.vertices[t[0]], state.vertices[t[1]], state.vertices[t[2]]};
}

const SurfaceTree& BodyGeometry::fitted_tree(int exponent) {
  if (!tree) tree.emplace(shape->mesh);
  if (tree_fitted && tree_exponent == exponent) return *tree;
  scaled.clear();
  for (const Vec3& p : state.vertices) scaled.push_back(scaled_by_two_to(-exponent, p));
  tree->refit(scaled);
  tree_exponent = exponent;
  tree_fitted = true;
  return *tree;
}

const ConvexHull& BodyGeometry::hull(std::uint32_t cell) {
  if (!hulls) hulls.emplace(shape);
  CONTACTCHECK_INVARIANT(cell < hulls->size(), "a kept cell of the body");
  CONTACTCHECK_INVARIANT(state.nodes.size() == shape->node_count(),
                         "the oracle needs every deformed node");
  if (!hulls_fitted) hulls->update(state.nodes);
  hulls_fitted = true;
  return hulls->hull(cell);
}

const std::optional<SolidFault>& BodyGeometry::not_simple() {
  if (!fault_known) fault = solid_fault(fitted_tree(0), shape->mesh.triangles, state.vertices);
  fault_known = true;
  return fault;
}

struct SurfaceGeometry::Impl {
  std::vector<BodyGeometry> bodies;

  BodyGeometry& body(std::uint32_t index);
  TriangleCorners first(const ElementPair& pair) { return body(pair.body_a).corners(pair.a); }
  TriangleCorners second(const ElementPair& pair) { return body(pair.body_b).corners(pair.b); }
  Penetration penetration(PieceSurface a, PieceSurface b, double body_side) const;
  double side(std::uint32_t a, std::uint32_t b) { return std::max(body(a).side, body(b).side); }
};

BodyGeometry& SurfaceGeometry::Impl::body(std::uint32_t index) {
  CONTACTCHECK_INVARIANT(index < bodies.size(), "a body of the scene");
  return bodies[index];
}

// Scaled to at most 1, so that no difference overflows.
Penetration SurfaceGeometry::Impl::penetration(PieceSurface a, PieceSurface b,
                                               double body_side) const {
  double largest = 0.0;
  for (PieceSurface surface : {a, b})
    for (const TriangleCorners& t : surface) largest = std::max(largest, largest_coordinate(t));
  const int exponent = exponent_above(largest);
  std::vector<TriangleCorners> p, q;
  for (const TriangleCorners& t : a) p.push_back(scaled_corners(t, -exponent));
  for (const TriangleCorners& t : b) q.push_back(scaled_corners(t, -exponent));
  return scaled_back(convex_penetration(p, q, std::ldexp(kAsShort * body_side, -exponent)),
                     exponent);
}

SurfaceGeometry::SurfaceGeometry(const std::vector<Body>& bodies)
    : impl_(std::make_unique<Impl>()) {
  for (const Body& body : bodies) impl_->bodies.emplace_back(body.shape);
}

SurfaceGeometry::~SurfaceGeometry() = default;

void SurfaceGeometry::set_frame(const Frame& frame) {
  const FloatingPointGuard guard;
  CONTACTCHECK_INVARIANT(frame.bodies.size() == impl_->bodies.size(), "one state per body");
  for (std::size_t i = 0; i < frame.bodies.size(); ++i) impl_->bodies[i].set(frame.bodies[i]);
}

double SurfaceGeometry::intersection_length(const ElementPair& triangles) const {
  const FloatingPointGuard guard;
  return oracle::intersection_length(impl_->first(triangles), impl_->second(triangles));
}

double SurfaceGeometry::triangle_distance(const ElementPair& triangles) const {
  const FloatingPointGuard guard;
  const TriangleCorners a = impl_->first(triangles), b = impl_->second(triangles);
  if (triangles_intersect(a, b)) return 0.0;
  const int exponent = exponent_above(std::max(largest_coordinate(a), largest_coordinate(b)));
  const TriangleCorners p = scaled_corners(a, -exponent), q = scaled_corners(b, -exponent);
  DistanceBounds bounds = distance_bounds(p, q);
  if (bounds.upper - bounds.lower > kDistanceWidth * bounds.upper)
    bounds = exact_distance_bounds(p, q);
  // Scaling may have brought the two together, and scaling back may round down.
  const double upper = std::ldexp(bounds.upper, exponent);
  return upper < std::numeric_limits<double>::min()
             ? std::nextafter(upper, std::numeric_limits<double>::max())
             : upper;
}

Penetration SurfaceGeometry::vertex_to_surface(const VertexInBody& where) const {
  const FloatingPointGuard guard;
  const BodyGeometry& from = impl_->body(where.body);
  BodyGeometry& to = impl_->body(where.in);
  CONTACTCHECK_INVARIANT(where.vertex < from.state.vertices.size(), "a vertex of the body");
  const int exponent = exponent_above(std::max(from.largest, to.largest));
  const double size = std::ldexp(impl_->side(where.body, where.in), -exponent);
  const Vec3 vertex = scaled_by_two_to(-exponent, from.state.vertices[where.vertex]);
  return scaled_back(nearest_points(vertex, to.fitted_tree(exponent), size), exponent);
}

SurfaceDepth SurfaceGeometry::surface_depth(BodyPair pair, double limit) {
  const FloatingPointGuard guard;
  CONTACTCHECK_INVARIANT(pair.a != pair.b, "two bodies have a depth");
  for (const std::uint32_t body : {pair.a, pair.b})
    if (const auto& fault = impl_->body(body).not_simple())
      return {0.0, 0.0, SurfaceDepth::Unknown{body, *fault}};
  BodyGeometry &a = impl_->body(pair.a), &b = impl_->body(pair.b);
  const int exponent = exponent_above(std::max(a.largest, b.largest));
  const DistanceBounds bounds =
      unscaled(oracle::surface_depth(a.fitted_tree(exponent), b.fitted_tree(exponent),
                                     {std::ldexp(limit, -exponent)}),
               exponent);
  return {bounds.lower, bounds.upper, std::nullopt};
}

std::optional<Penetration> SurfaceGeometry::triangle_penetration(
    const ElementPair& triangles) const {
  const FloatingPointGuard guard;
  const TriangleCorners a = impl_->first(triangles), b = impl_->second(triangles);
  if (!triangles_intersect(a, b)) return std::nullopt;
  return impl_->penetration({&a, 1}, {&b, 1}, impl_->side(triangles.body_a, triangles.body_b));
}

std::optional<Penetration> SurfaceGeometry::box_penetration(const ElementPair& cells) {
  const FloatingPointGuard guard;
  const ConvexHull& a = impl_->body(cells.body_a).hull(cells.a);
  const ConvexHull& b = impl_->body(cells.body_b).hull(cells.b);
  if (!hulls_overlap(a, b)) return std::nullopt;
  return impl_->penetration(a.surface, b.surface, impl_->side(cells.body_a, cells.body_b));
}

}  // namespace contactcheck::oracle
