#include "core/dynamics/hexahedron.h"

#include <cmath>
#include <memory>

#include "core/dynamics/fixed_order.h"
#include "core/types/check.h"

namespace contactcheck {
namespace {

constexpr int kShapes = 8 + 3;       // corners, then one parabola per axis
constexpr int kInner = 3 * kShapes;  // displacements with the inner ones
constexpr int kOuter = 3 * 8;        // displacements of the corners

using Gradients = std::array<Vec3, kShapes>;
using InnerStiffness = std::array<std::array<double, kInner>, kInner>;

double side_of(int corner, int axis) { return (corner >> axis & 1) ? 1.0 : -1.0; }

// At a point of the element in [-1, 1]^3. Parabola m is 1 - p_m^2.
Gradients gradients_at(const Vec3& p, const Vec3& sides) {
  Gradients out;
  for (int c = 0; c < 8; ++c) {
    Vec3 factor;
    for (int k = 0; k < 3; ++k) factor[k] = 0.5 * (1.0 + side_of(c, k) * p[k]);
    for (int k = 0; k < 3; ++k)
      out[c][k] = side_of(c, k) / sides[k] * factor[(k + 1) % 3] * factor[(k + 2) % 3];
  }
  for (int m = 0; m < 3; ++m) out[8 + m] = Vec3::Unit(m) * (-4.0 * p[m] / sides[m]);
  return out;
}

// Adds weight times the energy density of Hooke's law with Lame's constants, as a bilinear form.
void add_point(const Gradients& g, double weight, double lambda, double mu, InnerStiffness& k) {
  for (int a = 0; a < kShapes; ++a)
    for (int b = 0; b < kShapes; ++b) {
      const double dot = ordered_dot(g[a], g[b]);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          k[3 * a + i][3 * b + j] += weight * (lambda * g[a][i] * g[b][j] + mu * g[a][j] * g[b][i] +
                                               (i == j ? mu * dot : 0.0));
    }
}

// Static condensation: the inner displacements take the values of least energy.
void eliminate_inner(InnerStiffness& k) {
  for (int p = kInner - 1; p >= kOuter; --p)
    for (int i = 0; i < p; ++i) {
      const double factor = k[i][p] / k[p][p];
      for (int j = 0; j < p; ++j) k[i][j] -= factor * k[p][j];
    }
}

double frobenius(const HexahedronStiffness& m) {
  double sum = 0.0;
  for (double x : m) sum += x * x;
  return std::sqrt(sum);
}

HexahedronStiffness squared(const HexahedronStiffness& m, double scale) {
  HexahedronStiffness out{};
  for (int i = 0; i < 24; ++i)
    for (int p = 0; p < 24; ++p) {
      const double factor = m[24 * i + p] * scale * scale;
      for (int k = 0; k < 24; ++k) out[24 * i + k] += factor * m[24 * p + k];
    }
  return out;
}

}  // namespace

HexahedronStiffness hexahedron_stiffness(const Vec3& sides, double youngs_modulus,
                                         double poisson_ratio) {
  CONTACTCHECK_INVARIANT(youngs_modulus > 0.0 && poisson_ratio >= 0.0 && poisson_ratio < 0.5,
                         "the material is solid and can be compressed");
  const double mu = youngs_modulus / (2.0 * (1.0 + poisson_ratio));
  const double lambda = 2.0 * mu * poisson_ratio / (1.0 - 2.0 * poisson_ratio);
  const double weight = sides.x() * sides.y() * sides.z() / 8.0;
  const double at = 1.0 / std::sqrt(3.0);
  InnerStiffness inner{};
  for (int point = 0; point < 8; ++point) {
    const Vec3 p(at * side_of(point, 0), at * side_of(point, 1), at * side_of(point, 2));
    add_point(gradients_at(p, sides), weight, lambda, mu, inner);
  }
  eliminate_inner(inner);
  HexahedronStiffness out;
  for (int i = 0; i < kOuter; ++i)
    for (int k = 0; k < kOuter; ++k) out[24 * i + k] = 0.5 * (inner[i][k] + inner[k][i]);
  return out;
}

// Of K^64, squared six times: its Frobenius norm is that of its eigenvalues, at most sqrt(24) times
// the largest, and 24^(1/128) = 1.026. Normed on the way, so that no power overflows.
double largest_eigenvalue_bound(const HexahedronStiffness& stiffness) {
  constexpr int kSquarings = 6;
  HexahedronStiffness power = stiffness;
  std::array<double, kSquarings> norms;
  for (double& norm : norms) {
    norm = frobenius(power);
    if (norm == 0.0) return 0.0;
    power = squared(power, 1.0 / norm);
  }
  double bound = frobenius(power);
  for (int i = kSquarings - 1; i >= 0; --i) bound = norms[i] * std::sqrt(bound);
  return bound;
}

Vec3 corner_gradient(int corner, const Vec3& sides) {
  Vec3 out;
  for (int k = 0; k < 3; ++k) out[k] = side_of(corner, k) / (4.0 * sides[k]);
  return out;
}

}  // namespace contactcheck
