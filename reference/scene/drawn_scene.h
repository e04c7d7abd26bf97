// Random scenes drawn from a seed; each equals what a scene file could describe. Their frames have
// the same bits on every machine, thanks to seeded_random.h, portable sines and square roots, and
// meshes of shapes and packages. (Simplified meshes depend on the version of meshoptimizer.)
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "reference/scene/scene.h"

namespace contactcheck::scene {

inline constexpr std::uint64_t kLargestDrawSeed = (std::uint64_t{1} << 53) - 1;
inline constexpr std::size_t kMostDrawnScenes = 100'000;
inline constexpr std::size_t kMostRedraws = 5;

/// "drawn-7-3": the third scene of seed 7; "drawn-steps-7-3" by rules of steps.
/// @throws InputError for bad rules
std::string drawn_id(const DrawnSpec& spec);

/// Draws the parameters without building anything, which is fast.
/// @throws InputError for bad rules
Drawn draw_parameters(const DrawnSpec& spec);

struct DrawnScene {
  Scene scene;
  SceneText text;  ///< the scene file that gives the same frames, bit for bit
};

/// Bodies are placed one after another. Each is rotated at random and comes along an axis of a
/// randomly rotated frame, beside a body that is already placed, to where it first touches a placed
/// one. Then it is moved back by a gap or forward by a depth, in each frame anew, since all bodies
/// deform and rotate. Outside the contact frames it moves away at the drawn speed. Contact is
/// enforced in every contact frame: by an exact test, or the depth is halved. A nested body lies
/// inside a ball or box that is large enough for it. By rules of steps bodies also slide sideways,
/// half of the scenes drift as a whole, and bodies that pass are on the other side of what they
/// meet in every second frame. `folder`: the folder of the text, from which
/// it names the meshes of `spec`; empty: unchanged names.
/// @throws InputError for bad rules, and for a mesh that cannot be loaded or embedded in a lattice
DrawnScene draw_scene(const DrawnSpec& spec, const std::filesystem::path& folder = {});

/// The scene without bodies, for the results of a scene that exceeds a limit while it is made.
/// @throws InputError for bad rules
Scene unmade_scene(const DrawnSpec& spec);

/// Loads the mesh as a drawn scene would. @throws InputError, also if it fits into no lattice
void check_drawn_mesh(const std::filesystem::path& mesh);

}  // namespace contactcheck::scene
