// Whether a body is a simple solid, so that a depth into it is defined. Exact, in one frame.
//
// A simple solid is a closed chain without self-contact (vertices at equal coordinates are one
// vertex). On every part of it the winding number is 0 on one side and 1 or -1 on the other.
// Several components, cavities and inside-out surfaces are allowed.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "reference/oracle/closed_chain.h"
#include "reference/oracle/surface_tree.h"

namespace contactcheck::oracle {

enum class NotSimple {
  kOpen,         ///< not a closed chain
  kSelfContact,  ///< or more adjacent pairs than are judged (kMostAdjacentPairs)
  kNoInterior,   ///< a part with equal winding numbers on both sides, like double-sided cloth
  kNested        ///< a part between other winding numbers, like a shell in a shell
};

/// Why a body is not a simple solid.
struct SolidFault {
  NotSimple kind = NotSimple::kOpen;
  OpenEdge edge;  ///< where it is open
};

/// "open", "self-contact", "no interior", "nested".
const char* name_of(NotSimple kind);
/// The same with the open edge, if there is one (open_reason).
std::string describe(const SolidFault& fault, const GivenVertices& given);

/// The first fault, in the order of the enumeration; none if the body is a simple solid.
/// @pre the tree contains these triangles and is fitted to these vertices, not to scaled ones
std::optional<SolidFault> solid_fault(const SurfaceTree& tree, std::span<const Triangle> triangles,
                                      std::span<const Vec3> vertices);

}  // namespace contactcheck::oracle
