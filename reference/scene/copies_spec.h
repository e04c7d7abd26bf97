// A grid of bodies from one description; the copies share the shape.
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "core/deform/motion.h"
#include "reference/text/json_field.h"

namespace contactcheck::scene {

/// The "copies" of a body, all defaults filled in.
struct CopiesSpec {
  static constexpr std::size_t kMost = 100'000;

  std::array<std::size_t, 3> counts = {1, 1, 1};
  Vec3 spacing = Vec3::Zero();  ///< metres, from copy to copy along each axis
  double turn_degrees = 0.0;    ///< copy i is turned by i times this about y, before its spins
  double delay = 0.0;           ///< seconds: copy i moves as the first did i delays earlier

  std::size_t count() const { return counts[0] * counts[1] * counts[2]; }
};

CopiesSpec parse_copies(const text::JsonField& field);

/// The motion of copy `i`, counted along x first, then y, then z.
/// @pre i < copies.count()
Motion motion_of_copy(const CopiesSpec& copies, const Motion& motion, std::size_t i);

/// "name-1", "name-2", ...
std::string name_of_copy(const std::string& name, std::size_t i);

}  // namespace contactcheck::scene
