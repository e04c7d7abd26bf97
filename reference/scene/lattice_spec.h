// A body's lattice in a scene file, and building its shape.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>

#include "core/deform/body.h"
#include "reference/text/json_field.h"

namespace contactcheck::scene {

/// The "lattice" of a body. Equal specs over equal meshes give equal shapes.
struct LatticeSpec {
  enum class Kind { kNone, kCells, kKept };

  Kind kind = Kind::kNone;
  std::array<std::size_t, 3> cells = {};  ///< kCells: per axis
  std::size_t kept = 0;                   ///< kKept: requested number of kept cells
  double padding = 0.0;                   ///< fraction of the largest side, on each side
  bool fit = false;                       ///< fitted to a recording
  double smoothing = 0.0;                 ///< of the fit (lattice_fit.h)

  bool operator==(const LatticeSpec&) const = default;
};

/// `recorded`: the body has a recording; then every lattice must have "fit".
LatticeSpec parse_lattice_spec(const text::JsonField& field, bool recorded = false);

/// @throws InputError when the mesh has a fatal defect
std::shared_ptr<const BodyShape> build_shape(TriangleMesh mesh, const LatticeSpec& spec);

}  // namespace contactcheck::scene
