#include "core/dynamics/deformable.h"

#include "core/dynamics/finite_elements.h"
#include "core/dynamics/mass_spring.h"
#include "core/dynamics/shape_matching.h"
#include "core/types/check.h"

namespace contactcheck {
namespace {

double cell_volume(const Lattice& lattice, std::uint32_t cell) {
  const Vec3 sides = lattice.cell_box(cell).extent();
  return sides.x() * sides.y() * sides.z();
}

}  // namespace

std::vector<double> node_masses(const Lattice& lattice, double mass) {
  CONTACTCHECK_INVARIANT(mass > 0.0, "a body that moves has a mass");
  const auto cells = static_cast<std::uint32_t>(lattice.cells.size());
  double volume = 0.0;
  for (std::uint32_t c = 0; c < cells; ++c) volume += cell_volume(lattice, c);
  std::vector<double> masses(lattice.nodes.size(), 0.0);
  for (std::uint32_t c = 0; c < cells; ++c) {
    const double share = mass * (cell_volume(lattice, c) / volume) / 8.0;
    for (std::uint32_t node : lattice.cell_nodes[c]) masses[node] += share;
  }
  return masses;
}

std::unique_ptr<const Deformable> make_deformable(const BodyShape& shape,
                                                  const Material& material) {
  CONTACTCHECK_INVARIANT(shape.lattice.has_value(), "only lattice nodes are simulated");
  switch (material.model) {
    case DeformableModel::kMassSpring:
      return std::make_unique<MassSpring>(*shape.lattice, material);
    case DeformableModel::kFiniteElements:
      return std::make_unique<FiniteElements>(*shape.lattice, material);
    case DeformableModel::kShapeMatching:
      return std::make_unique<ShapeMatching>(*shape.lattice, material);
  }
  CONTACTCHECK_INVARIANT(false, "a material has one of the three models");
}

}  // namespace contactcheck
