// How a scene file describes a body's lattice, and building the shape in it.
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
  std::size_t kept = 0;                   ///< kKept: wanted number of kept cells
  double padding = 0.0;                   ///< fraction of the largest side, on each side
  bool fit = false;                       ///< to a recording
  double smoothing = 0.0;                 ///< of the fit (lattice_fit.h)

  bool operator==(const LatticeSpec&) const = default;
};

/// `recorded`: beside a recording, to which every lattice is fitted and has to say so.
LatticeSpec parse_lattice_spec(const text::JsonField& field, bool recorded = false);

/// @throws InputError when the mesh has a fatal defect
std::shared_ptr<const BodyShape> build_shape(TriangleMesh mesh, const LatticeSpec& spec);

}  // namespace contactcheck::scene
