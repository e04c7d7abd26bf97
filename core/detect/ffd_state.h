// What the FFD-AABB family computes per frame and body before any test ("Updating CELL"): mapped
// boxes, their bounds, sphere centres and radii.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/broad/sphere.h"
#include "core/deform/lattice.h"
#include "core/detect/ffd_config.h"
#include "core/detect/ffd_model.h"
#include "core/types/frame.h"

namespace contactcheck {

struct FfdState {
  std::span<const Vec3> nodes;   ///< the frame's; valid until the next update
  std::vector<Corners> corners;  ///< per piece
  std::vector<Aabb> hull;        ///< per kept cell: exactly round the corners of its pieces
  std::vector<Aabb> cell_box;    ///< per kept cell; safe only; empty boxes without pieces
  std::vector<std::vector<Sphere>> spheres;  ///< per level
};

void update_state(const FfdModel& model, const FfdConfig& config, const BodyState& body,
                  FfdState& state);

/// Checks what the safe reading promises for mapped `vertices`: every triangle's owner box and all
/// its spheres contain the three vertices. Returns a sentence for the first broken promise, or "".
std::string validate(const FfdModel& model, const FfdState& state, std::span<const Vec3> vertices);

}  // namespace contactcheck
