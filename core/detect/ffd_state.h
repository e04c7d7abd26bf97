// What the FFD-AABB family computes per frame and body before any test ("Updating CELL"): mapped
// boxes, their bounds, sphere centres and radii.
#pragma once

#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "core/broad/sphere.h"
#include "core/deform/lattice.h"
#include "core/detect/ffd_config.h"
#include "core/detect/ffd_model.h"
#include "core/types/frame.h"

namespace contactcheck {

template <typename T>
struct FfdStateOf {
  std::span<const Vec3Of<T>> nodes;   ///< the frame's; valid until the next update
  std::vector<CornersOf<T>> corners;  ///< per piece
  std::vector<AabbOf<T>> hull;        ///< per kept cell: exactly round the corners of its pieces
  std::vector<AabbOf<T>> cell_box;    ///< per kept cell; safe only; empty boxes without pieces
  std::vector<std::vector<SphereOf<T>>> spheres;  ///< per level
};
using FfdState = FfdStateOf<double>;

/// One per body.
template <typename T>
using FfdModels = std::vector<FfdModelOf<T>>;
template <typename T>
using FfdStates = std::vector<FfdStateOf<T>>;

/// Computes the state of a frame. The caller keeps `nodes` alive while `state` is used.
template <typename T>
void update_state(const FfdModelOf<T>& model, const FfdConfig& config,
                  std::span<const Vec3Of<T>> nodes, FfdStateOf<T>& state);

/// Checks what the safe reading promises for mapped `vertices`: every triangle's owner box and all
/// its spheres contain the three vertices. Returns a sentence for the first broken promise, or "".
template <typename T>
std::string validate(const FfdModelOf<T>& model, const FfdStateOf<T>& state,
                     std::type_identity_t<std::span<const Vec3Of<T>>> vertices);

}  // namespace contactcheck
