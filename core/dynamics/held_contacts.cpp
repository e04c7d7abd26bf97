#include "core/dynamics/held_contacts.h"

#include <cmath>
#include <span>
#include <utility>

#include "core/dynamics/blend_math.h"
#include "core/dynamics/unit_vector.h"

namespace contactcheck {
namespace {

std::span<const Vec3> positions(const ResponseBody& body) {
  return body.state ? std::span<const Vec3>(body.state->positions) : std::span<const Vec3>();
}

std::span<Vec3> velocities(const ResponseBody& body) {
  return body.state ? std::span<Vec3>(body.state->velocities) : std::span<Vec3>();
}

}  // namespace

void HeldContacts::hold(std::vector<ContactPoint> points, const std::vector<ResponseBody>& bodies) {
  points_.clear();
  for (ContactPoint& point : points) {
    const ResponseBody &a = bodies[point.body_a], &b = bodies[point.body_b];
    Held held;
    held.inverse_mass = inverse_mass(point.a, a.masses) + inverse_mass(point.b, b.masses);
    if (!(held.inverse_mass > 0.0)) continue;
    held.separation =
        ordered_dot(blended(point.b, positions(b)) - blended(point.a, positions(a)), point.normal);
    held.friction = std::sqrt(a.friction * b.friction);
    held.point = std::move(point);
    points_.push_back(std::move(held));
  }
}

void HeldContacts::stop_approach(std::vector<ResponseBody>& bodies) const {
  for (const Held& held : points_) {
    const ContactPoint& p = held.point;
    ResponseBody &a = bodies[p.body_a], &b = bodies[p.body_b];
    const Vec3 velocity = blended(p.b, velocities(b)) - blended(p.a, velocities(a));
    const double approach = -ordered_dot(velocity, p.normal);
    if (!(approach > 0.0)) continue;
    const Vec3 apart = blended(p.b, positions(b)) - blended(p.a, positions(a));
    if (ordered_dot(apart, p.normal) > held.separation) continue;
    const Vec3 sliding = velocity + approach * p.normal;
    const double speed = ordered_norm(sliding), most = held.friction * approach;
    const Vec3 stopped = speed > most ? Vec3(sliding * (most / speed)) : sliding;
    const Vec3 impulse = (approach * p.normal - stopped) / held.inverse_mass;
    spread(p.a, -impulse, a.masses, velocities(a));
    spread(p.b, impulse, b.masses, velocities(b));
  }
}

}  // namespace contactcheck
