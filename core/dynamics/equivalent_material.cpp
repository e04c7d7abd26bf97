#include "core/dynamics/equivalent_material.h"

#include <cmath>

#include "core/dynamics/deformable.h"
#include "core/dynamics/fixed_order.h"

namespace contactcheck {
namespace {

// Small against 1, so that springs are linear; far above rounding.
constexpr double kStrain = 1e-3;

// Joule, over the basis of strains.
double stored_energy(const Material& material, const BodyShape& shape) {
  const std::unique_ptr<const Deformable> body = make_deformable(shape, material);
  double sum = 0.0;
  for (int row = 0; row < 3; ++row)
    for (int column = row; column < 3; ++column) {
      Mat3 stretch = Mat3::Identity();
      stretch(row, column) += row == column ? kStrain : kStrain * std::sqrt(0.5);
      stretch(column, row) = stretch(row, column);
      std::vector<Vec3> positions = shape.lattice->rest_nodes();
      for (Vec3& p : positions) p = (stretch * p).eval();
      sum += body->elastic_energy(positions);
    }
  return sum;
}

double poisson_ratio_of(const Material& material) {
  if (material.model == DeformableModel::kMassSpring) return 0.25;
  return material.model == DeformableModel::kShapeMatching ? 0.0 : material.poisson_ratio;
}

double damping_time_of(const Material& material) {
  if (material.model == DeformableModel::kMassSpring) return material.damping / material.stiffness;
  return material.model == DeformableModel::kShapeMatching ? 2.0 * material.relaxation_time
                                                           : material.damping_time;
}

}  // namespace

Material equivalent_material(const Material& material, DeformableModel model,
                             const BodyShape& shape) {
  if (model == material.model) return material;
  Material out;
  out.model = model;
  out.mass = material.mass;
  out.restitution = material.restitution;
  out.friction = material.friction;
  out.poisson_ratio = poisson_ratio_of(material);
  // Energies grow with the stiffness, and fall with the square of the relaxation time.
  const double factor = stored_energy(material, shape) / stored_energy(out, shape);
  out.stiffness *= factor;
  out.youngs_modulus *= factor;
  out.relaxation_time /= std::sqrt(factor);
  out.damping_time = damping_time_of(material);
  out.damping = out.damping_time * out.stiffness;
  return out;
}

}  // namespace contactcheck
