// Bodies, states and sums for the tests of the deformable models.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <random>
#include <span>
#include <vector>

#include "core/deform/body.h"
#include "core/dynamics/deformable.h"
#include "core/dynamics/fixed_order.h"
#include "tests/support/shapes.h"

namespace contactcheck::test {

/// A box of 1.2 x 0.9 x 0.6 m in 4 x 3 x 2 cells, off the origin.
inline std::shared_ptr<const BodyShape> block_shape() {
  return make_shape(box_mesh({-0.4, 0.2, 1.0}, {0.8, 1.1, 1.6}, 4), {4, 3, 2});
}

/// Numbers in [-1, 1], the same on every machine.
class Noise {
 public:
  double next() { return static_cast<double>(engine_() >> 11) * 0x1p-52 - 1.0; }
  Vec3 vector() {
    const double x = next(), y = next();
    return {x, y, next()};
  }

 private:
  std::mt19937_64 engine_{20240607};
};

/// Rational rotation from an integer quaternion.
inline Mat3 rotation_of(int w, int x, int y, int z) {
  return Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
}

inline NodeState at_rest(const BodyShape& shape) {
  return {shape.lattice->rest_nodes(),
          std::vector<Vec3>(shape.lattice->nodes.size(), Vec3::Zero())};
}

/// Every node displaced by up to `amount` metres per axis, at rest.
inline NodeState disturbed(const BodyShape& shape, double amount) {
  NodeState state = at_rest(shape);
  Noise noise;
  for (Vec3& p : state.positions) p += noise.vector() * amount;
  return state;
}

inline Vec3 momentum(std::span<const double> masses, const NodeState& state) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t n = 0; n < masses.size(); ++n) sum += masses[n] * state.velocities[n];
  return sum;
}

inline Vec3 angular_momentum(std::span<const double> masses, const NodeState& state) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t n = 0; n < masses.size(); ++n)
    sum += masses[n] * state.positions[n].cross(state.velocities[n]);
  return sum;
}

inline double energy(const Deformable& model, const NodeState& state) {
  double kinetic = 0.0;
  for (std::size_t n = 0; n < model.masses().size(); ++n)
    kinetic += 0.5 * model.masses()[n] * state.velocities[n].squaredNorm();
  return kinetic + model.elastic_energy(state.positions);
}

inline std::vector<Vec3> moved(const std::vector<Vec3>& points, const Mat3& rotation,
                               const Vec3& offset) {
  std::vector<Vec3> out;
  for (const Vec3& p : points) out.push_back(rotation * p + offset);
  return out;
}

/// Largest distance of a force from minus the gradient of the energy, by central differences.
template <typename Model>
double worst_gradient_error(const Model& model, std::vector<Vec3> positions, double step) {
  const std::vector<Vec3> still(positions.size(), Vec3::Zero());
  std::vector<Vec3> forces = still;
  model.add_forces(positions, still, forces);
  double worst = 0.0;
  for (std::size_t n = 0; n < positions.size(); ++n)
    for (int k = 0; k < 3; ++k) {
      const double at = positions[n][k];
      positions[n][k] = at + step;
      const double high = model.elastic_energy(positions);
      positions[n][k] = at - step;
      const double low = model.elastic_energy(positions);
      positions[n][k] = at;
      worst = std::max(worst, std::abs((low - high) / (2.0 * step) - forces[n][k]));
    }
  return worst;
}

}  // namespace contactcheck::test
