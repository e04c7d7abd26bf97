// Is a body a simple solid, so that a depth into it is known? Exact, in one frame.
//
// A simple solid is a closed chain without self-contact (vertices at equal coordinates are one),
// beside every part of which the winding number is 0 on one side and 1 or -1 on the other. Several
// components, cavities and surfaces that are inside out are simple.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "reference/oracle/closed_chain.h"
#include "reference/oracle/surface_tree.h"

namespace contactcheck::oracle {

enum class NotSimple {
  kOpen,         ///< not a closed chain
  kSelfContact,  ///< or more neighbours than are judged (kMostAdjacentPairs)
  kNoInterior,   ///< a part with equal winding numbers on both sides, as double-sided cloth
  kNested        ///< a part between other winding numbers, as a shell in a shell
};

/// Why a body is not a simple solid.
struct SolidFault {
  NotSimple kind = NotSimple::kOpen;
  OpenEdge edge;  ///< where it is open
};

/// "open", "self-contact", "no interior", "nested".
const char* name_of(NotSimple kind);
/// The same in a sentence, with the edge where it is open (open_reason).
std::string describe(const SolidFault& fault, const GivenVertices& given);

/// The first fault, in the order of the enumeration; none: the body is a simple solid.
/// @pre the tree is of these triangles, fitted to these vertices, not scaled
std::optional<SolidFault> solid_fault(const SurfaceTree& tree, std::span<const Triangle> triangles,
                                      std::span<const Vec3> vertices);

}  // namespace contactcheck::oracle
