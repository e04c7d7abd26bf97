// Scenes drawn from a seed: ordinary scenes, as a scene file would describe them, that nobody
// chose. Their frames have the same bits on every machine: seeded_random.h, portable sines and
// square roots, meshes of shapes and packages. (Not those of simplified meshes where meshoptimizer
// is another version.)
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "reference/scene/scene.h"

namespace contactcheck::scene {

inline constexpr std::uint64_t kLargestDrawSeed = (std::uint64_t{1} << 53) - 1;
inline constexpr std::size_t kMostDrawnScenes = 100'000;
inline constexpr std::size_t kMostRedraws = 5;

/// "drawn-7-3": the third scene of seed 7.
std::string drawn_id(const DrawnSpec& spec);

/// What is drawn before anything is built: cheap.
/// @throws InputError for bad rules
Drawn draw_parameters(const DrawnSpec& spec);

struct DrawnScene {
  Scene scene;
  SceneText text;  ///< of the scene file that gives the same frames, bit for bit
};

/// Bodies are placed one after the other. Each is turned at random and comes along one of the axes
/// of a frame that is itself turned at random, aside of a body that stands already, to where it
/// first touches any that stand; it is set back by a gap, or forward by a depth, in each frame
/// anew, since all deform and turn. Outside the frames of the contact it moves away with the drawn
/// speed. Where something meets, it does in every frame of the contact: by an exact test, or the
/// depth is halved. What is nested lies inside a ball or box, which hold it whatever it is.
/// `folder`: where the text is to lie; it names the meshes of `spec` from there. None: as `spec`
/// has them.
/// @throws InputError for bad rules, and for a mesh that cannot be loaded or put into a lattice
DrawnScene draw_scene(const DrawnSpec& spec, const std::filesystem::path& folder = {});

/// Without its bodies: what the results say of a scene that passes a limit when it is made.
/// @throws InputError for bad rules
Scene unmade_scene(const DrawnSpec& spec);

/// The mesh as a drawn scene would take it. @throws InputError, also when no lattice holds it
void check_drawn_mesh(const std::filesystem::path& mesh);

}  // namespace contactcheck::scene
