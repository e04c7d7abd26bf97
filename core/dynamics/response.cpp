#include "core/dynamics/response.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "core/deform/mapping.h"
#include "core/dynamics/blend_math.h"
#include "core/dynamics/unit_vector.h"

namespace contactcheck {
namespace {

// The data of one body that the sweeps read and write. A body with empty `velocities` is at rest.
struct Mover {
  std::span<const double> masses;  // empty: cannot be moved
  std::span<Vec3> velocities;
  std::vector<Vec3> moved;  // metres per node, in this response; empty: cannot be moved
};

// A point, and what was done at it so far.
struct Constraint {
  const ContactPoint* point = nullptr;
  double inverse_mass = 0.0;            // 1/kg, of both sides against each other
  double target = 0.0;                  // m/s along the normal, wanted afterwards
  double friction = 0.0;                // Coulomb's coefficient
  Vec3 before = Vec3::Zero();           // m/s, of b's side against a's, at the start
  double normal_impulse = 0.0;          // N s, not negative
  Vec3 tangent_impulse = Vec3::Zero();  // N s, within friction times normal_impulse
  double push = 0.0;                    // kg m, not negative

  Vec3 impulse() const { return normal_impulse * point->normal + tangent_impulse; }
};

// Points that act on one another: two movable bodies in contact belong to one group.
class Groups {
 public:
  explicit Groups(std::size_t bodies) : parent_(bodies) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t find(std::size_t body) {
    while (parent_[body] != body) body = parent_[body] = parent_[parent_[body]];
    return body;
  }
  void join(std::size_t a, std::size_t b) { parent_[find(a)] = find(b); }

 private:
  std::vector<std::size_t> parent_;
};

class Response {
 public:
  /// All three outlive this object.
  Response(const std::vector<ContactPoint>& points, const ResponseSettings& settings,
           std::vector<ResponseBody>& bodies);
  void change_velocities();
  void change_positions();

 private:
  void add_constraint(const ContactPoint& point, const ResponseSettings& settings);
  Vec3 approach(const ContactPoint& point) const;
  void apply_impulse(const ContactPoint& point, const Vec3& impulse);
  void answer_normal(Constraint& c);
  void answer_friction(Constraint& c);
  void answer_depth(Constraint& c);
  std::size_t group_of(const ContactPoint& point);
  void limit_energy();

  const ResponseSettings& settings_;
  std::vector<ResponseBody>& bodies_;
  std::vector<Mover> movers_;
  std::vector<Constraint> constraints_;
  Groups groups_;
};

Response::Response(const std::vector<ContactPoint>& points, const ResponseSettings& settings,
                   std::vector<ResponseBody>& bodies)
    : settings_(settings), bodies_(bodies), movers_(bodies.size()), groups_(bodies.size()) {
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    movers_[b].masses = bodies_[b].masses;
    if (bodies_[b].state) movers_[b].velocities = bodies_[b].state->velocities;
  }
  constraints_.reserve(points.size());
  for (const ContactPoint& point : points) add_constraint(point, settings);
}

void Response::add_constraint(const ContactPoint& point, const ResponseSettings& settings) {
  Mover &a = movers_[point.body_a], &b = movers_[point.body_b];
  Constraint c;
  c.inverse_mass = inverse_mass(point.a, a.masses) + inverse_mass(point.b, b.masses);
  if (!(c.inverse_mass > 0.0)) return;  // neither side can be moved
  const ResponseBody &body_a = bodies_[point.body_a], &body_b = bodies_[point.body_b];
  c.point = &point;
  c.before = approach(point);
  c.friction = std::sqrt(body_a.friction * body_b.friction);
  const double speed = -ordered_dot(c.before, point.normal);
  if (speed > settings.least_bounce_speed)
    c.target = std::max(body_a.restitution, body_b.restitution) * speed;
  for (Mover* mover : {&a, &b}) mover->moved.resize(mover->masses.size(), Vec3::Zero());
  if (!a.masses.empty() && !b.masses.empty()) groups_.join(point.body_a, point.body_b);
  constraints_.push_back(c);
}

// Velocity of b's side against a's.
Vec3 Response::approach(const ContactPoint& point) const {
  return blended(point.b, movers_[point.body_b].velocities) -
         blended(point.a, movers_[point.body_a].velocities);
}

void Response::apply_impulse(const ContactPoint& point, const Vec3& impulse) {
  if (impulse.isZero(0.0)) return;  // adding zero would turn the sign of a zero
  Mover &a = movers_[point.body_a], &b = movers_[point.body_b];
  spread(point.a, -impulse, a.masses, a.velocities);
  spread(point.b, impulse, b.masses, b.velocities);
}

// Takes back excess impulses of earlier sweeps: only the sum must not pull.
void Response::answer_normal(Constraint& c) {
  const double speed = ordered_dot(approach(*c.point), c.point->normal);
  const double wanted = c.normal_impulse + (c.target - speed) / c.inverse_mass;
  const double change = std::max(0.0, wanted) - c.normal_impulse;
  c.normal_impulse += change;
  apply_impulse(*c.point, change * c.point->normal);
}

// Against the sliding, up to stopping it, within Coulomb's cone. Nodes are points of mass, so the
// effective mass is the same in every direction.
void Response::answer_friction(Constraint& c) {
  const Vec3 velocity = approach(*c.point);
  const Vec3 sliding = velocity - ordered_dot(velocity, c.point->normal) * c.point->normal;
  Vec3 wanted = c.tangent_impulse - sliding / c.inverse_mass;
  const double most = c.friction * c.normal_impulse, length = ordered_norm(wanted);
  if (length > most) wanted *= most / length;
  const Vec3 change = wanted - c.tangent_impulse;
  c.tangent_impulse = wanted;
  apply_impulse(*c.point, change);
}

std::size_t Response::group_of(const ContactPoint& point) {
  const bool a_moves = !movers_[point.body_a].masses.empty();
  return groups_.find(a_moves ? point.body_a : point.body_b);
}

// Bounces at several points of one body may add up to more than the energy that was there: the
// sweeps end before they agree, and Newton's restitution with friction may gain by itself. With
// impulses P and velocities u of b against a, a group gains sum P.(u_before + u_after) / 2 (in the
// frame of what cannot be moved). Where that is positive, all its impulses shrink by the factor
// with which it is zero.
void Response::limit_energy() {
  std::vector<double> work(movers_.size(), 0.0), change(movers_.size(), 0.0);
  for (const Constraint& c : constraints_) {
    const std::size_t group = group_of(*c.point);
    const Vec3 impulse = c.impulse();
    work[group] += ordered_dot(impulse, c.before);
    change[group] += ordered_dot(impulse, approach(*c.point) - c.before);
  }
  for (const Constraint& c : constraints_) {
    const std::size_t group = group_of(*c.point);
    if (!(2.0 * work[group] + change[group] > 0.0)) continue;
    const double kept = std::max(0.0, -2.0 * work[group] / change[group]);
    apply_impulse(*c.point, (kept - 1.0) * c.impulse());
  }
}

void Response::change_velocities() {
  for (std::uint32_t sweep = 0; sweep < settings_.iterations; ++sweep)
    for (Constraint& c : constraints_) {
      answer_normal(c);
      answer_friction(c);
    }
  limit_energy();
}

// Recomputes how far the sides have moved apart, so that a thousand points at one place push as one
// does.
void Response::answer_depth(Constraint& c) {
  Mover &a = movers_[c.point->body_a], &b = movers_[c.point->body_b];
  const Vec3& normal = c.point->normal;
  const Vec3 moved = blended(c.point->b, b.moved) - blended(c.point->a, a.moved);
  const double remaining = settings_.corrected_share * c.point->depth - ordered_dot(moved, normal);
  const double change = std::max(0.0, c.push + remaining / c.inverse_mass) - c.push;
  if (change == 0.0) return;
  c.push += change;
  spread(c.point->a, -change * normal, a.masses, a.moved);
  spread(c.point->b, change * normal, b.masses, b.moved);
}

void Response::change_positions() {
  for (std::uint32_t sweep = 0; sweep < settings_.iterations; ++sweep)
    for (Constraint& c : constraints_) answer_depth(c);
  for (std::size_t b = 0; b < movers_.size(); ++b)
    for (std::size_t n = 0; n < movers_[b].moved.size(); ++n)
      if (!movers_[b].moved[n].isZero(0.0)) bodies_[b].state->positions[n] += movers_[b].moved[n];
}

Vec3 mapped_vertex(const BodyShape& shape, std::uint32_t vertex, std::span<const Vec3> nodes) {
  if (!shape.lattice) return nodes[vertex];
  return map_point(corners_of(*shape.lattice, shape.embedding.home_cell[vertex], nodes),
                   shape.embedding.local[vertex]);
}

}  // namespace

void respond_to_contacts(const std::vector<ContactPoint>& points, const ResponseSettings& settings,
                         std::vector<ResponseBody>& bodies) {
  Response response(points, settings, bodies);
  response.change_velocities();
  response.change_positions();
}

void respond_to_ground(const BodyShape& shape, const std::vector<std::uint32_t>& vertices,
                       const Ground& ground, const ResponseSettings& settings, ResponseBody& body) {
  // The ground is a body a without nodes: at rest, and not to be moved.
  std::vector<ResponseBody> bodies(2);
  bodies[0].restitution = ground.restitution;
  bodies[0].friction = ground.friction;
  bodies[1] = body;
  std::vector<ContactPoint> points;
  points.reserve(vertices.size());
  for (std::uint32_t vertex : vertices) {
    const Vec3 at = mapped_vertex(shape, vertex, body.state->positions);
    const double depth = std::max(0.0, ground.height - at[ground.axis]);
    points.push_back({0, 1, {}, blend_of_vertex(shape, vertex), Vec3::Unit(ground.axis), depth});
  }
  respond_to_contacts(points, settings, bodies);
}

}  // namespace contactcheck
