// A blend of nodes as one point: its velocity, its inverse mass, and how an impulse acts at it.
#pragma once

#include <span>

#include "core/dynamics/contact_point.h"
#include "core/types/vec3.h"

namespace contactcheck {

/// The blend of values per node (positions, velocities); zero where there are none.
inline Vec3 blended(const NodeBlend& blend, std::span<const Vec3> values) {
  Vec3 out = Vec3::Zero();
  if (values.empty()) return out;
  for (std::size_t i = 0; i < blend.nodes.size(); ++i)
    out += blend.weights[i] * values[blend.nodes[i]];
  return out;
}

/// Inverse mass, 1/kg, in every direction; 0 for a body that cannot be moved (no masses).
inline double inverse_mass(const NodeBlend& blend, std::span<const double> masses) {
  double out = 0.0;
  if (masses.empty()) return out;
  for (std::size_t i = 0; i < blend.nodes.size(); ++i)
    out += blend.weights[i] * blend.weights[i] / masses[blend.nodes[i]];
  return out;
}

/// Spreads an impulse (or a push) at a point over its nodes, by weight over mass.
inline void spread(const NodeBlend& blend, const Vec3& impulse, std::span<const double> masses,
                   std::span<Vec3> values) {
  if (masses.empty()) return;
  for (std::size_t i = 0; i < blend.nodes.size(); ++i) {
    const std::uint32_t node = blend.nodes[i];
    values[node] += blend.weights[i] / masses[node] * impulse;
  }
}

}  // namespace contactcheck
