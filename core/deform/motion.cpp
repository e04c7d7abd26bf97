#include "core/deform/motion.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "core/deform/body.h"
#include "core/deform/portable_sine.h"
#include "core/types/check.h"

namespace contactcheck {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;

// Where the point is relative to the body: rest centre and largest half side.
struct RestFrame {
  Vec3 center;
  Vec3 half;
  bool portable_sines = false;
  double relative_height(const Vec3& p, int axis) const {
    return half[axis] > 0 ? (p[axis] - center[axis]) / half[axis] : 0.0;
  }
};

// Takes the angle in both units: each kind of sine takes its own without rounding.
SineCosine sine_cosine(double radians, double degrees, bool portable) {
  if (portable) return portable_sine_cosine(degrees);
  return {std::sin(radians), std::cos(radians)};
}

Vec3 rotated(const Vec3& p, const Vec3& axis, double degrees, bool portable) {
  // Rodrigues' formula.
  const Vec3 k = axis.normalized();
  const auto [s, c] = sine_cosine(degrees * kRadiansPerDegree, degrees, portable);
  return p * c + k.cross(p) * s + k * (k.dot(p) * (1.0 - c));
}

Vec3 moved(const Twist& twist, const Vec3& p, const RestFrame& rest, double time) {
  const double angle = 0.5 * twist.angle.at(time) * rest.relative_height(p, twist.axis);
  return rest.center + rotated(p - rest.center, Vec3::Unit(twist.axis), angle, rest.portable_sines);
}

// Barr's bend: the centre line becomes an arc of constant curvature; cross-sections stay plane and
// turn with it.
Vec3 moved(const Bend& bend, const Vec3& p, const RestFrame& rest, double time) {
  const double height = 2.0 * rest.half[bend.axis];
  const double curvature = height > 0 ? bend.angle.at(time) * kRadiansPerDegree / height : 0.0;
  const Vec3 d = p - rest.center;
  Vec3 out = d;
  if (std::abs(curvature) * height > 1e-9) {
    const double radius = 1.0 / curvature;
    const double degrees = bend.angle.at(time) * (d[bend.axis] / height);
    const auto [s, c] = sine_cosine(d[bend.axis] * curvature, degrees, rest.portable_sines);
    out[bend.axis] = (radius - d[bend.toward]) * s;
    out[bend.toward] = radius - (radius - d[bend.toward]) * c;
  }
  return rest.center + out;
}

Vec3 moved(const Taper& taper, const Vec3& p, const RestFrame& rest, double time) {
  const double scale = 1.0 + taper.amount.at(time) * rest.relative_height(p, taper.axis);
  Vec3 d = p - rest.center;
  for (int k = 0; k < 3; ++k)
    if (k != taper.axis) d[k] *= scale;
  return rest.center + d;
}

Vec3 moved(const Stretch& stretch, const Vec3& p, const RestFrame& rest, double time) {
  const double along = 1.0 + stretch.amount.at(time);
  Vec3 d = p - rest.center;
  for (int k = 0; k < 3; ++k) d[k] *= k == stretch.axis ? along : 1.0 / std::sqrt(along);
  return rest.center + d;
}

void add_offsets(const NodeKeys::Key& key, double weight, const Lattice& lattice,
                 std::vector<Vec3>& displacement) {
  const std::map<GridIndex, Vec3> offsets(key.offsets.begin(), key.offsets.end());
  for (std::size_t n = 0; n < lattice.nodes.size(); ++n) {
    const auto it = offsets.find(lattice.nodes[n]);
    if (it != offsets.end()) displacement[n] += weight * it->second;
  }
}

void add_displacements(const NodeKeys& keys, const BodyShape& shape, const RestFrame&,
                       const std::vector<Vec3>&, double time, std::vector<Vec3>& displacement) {
  CONTACTCHECK_INVARIANT(shape.lattice.has_value(), "node keyframes move lattice nodes");
  if (keys.keys.empty()) return;
  const auto after = std::find_if(keys.keys.begin(), keys.keys.end(),
                                  [&](const NodeKeys::Key& k) { return k.time > time; });
  if (after == keys.keys.begin() || after == keys.keys.end()) {
    add_offsets(after == keys.keys.end() ? keys.keys.back() : keys.keys.front(), 1.0,
                *shape.lattice, displacement);
    return;
  }
  const auto before = after - 1;
  const double w = (time - before->time) / (after->time - before->time);
  add_offsets(*before, 1.0 - w, *shape.lattice, displacement);
  add_offsets(*after, w, *shape.lattice, displacement);
}

template <typename Global>
void add_displacements(const Global& deformer, const BodyShape&, const RestFrame& frame,
                       const std::vector<Vec3>& rest, double time,
                       std::vector<Vec3>& displacement) {
  for (std::size_t n = 0; n < rest.size(); ++n) {
    displacement[n] += moved(deformer, rest[n], frame, time) - rest[n];
  }
}

Vec3 placed(const RigidPath& path, const Vec3& p, const RestFrame& rest, double time) {
  Vec3 d = p - rest.center;
  for (const RigidPath::Spin& spin : path.spins)
    d = rotated(d, spin.axis, spin.angle.at(time), rest.portable_sines);
  const Vec3 position(path.position[0].at(time), path.position[1].at(time),
                      path.position[2].at(time));
  return d + position;
}

}  // namespace

double Curve::at(double time) const {
  if (keys.empty()) return 0.0;
  if (time <= keys.front().time) return keys.front().value;
  if (time >= keys.back().time) return keys.back().value;
  const auto after =
      std::find_if(keys.begin(), keys.end(), [&](const Key& k) { return k.time > time; });
  const auto before = after - 1;
  double w = (time - before->time) / (after->time - before->time);
  if (smooth) w = w * w * (3.0 - 2.0 * w);
  return before->value * (1.0 - w) + after->value * w;
}

std::vector<Vec3> nodes_at(const BodyShape& shape, const Motion& motion, double time) {
  const std::vector<Vec3> rest = shape.lattice ? shape.lattice->rest_nodes() : shape.mesh.vertices;
  const Aabb box = bounding_box(shape.mesh.vertices);
  const RestFrame frame{box.center(), 0.5 * box.extent(), motion.portable_sines};
  std::vector<Vec3> displacement(rest.size(), Vec3::Zero());
  for (const Deformer& deformer : motion.deformers) {
    std::visit([&](const auto& d) { add_displacements(d, shape, frame, rest, time, displacement); },
               deformer);
  }
  std::vector<Vec3> out(rest.size());
  for (std::size_t n = 0; n < rest.size(); ++n) {
    out[n] = placed(motion.path, rest[n] + displacement[n], frame, time);
  }
  return out;
}

}  // namespace contactcheck
