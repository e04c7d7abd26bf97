// The data of the 3D view in the HTML report, in one compact container.
//
// Bytes, little-endian: "CCVIEW1\n"; u32 size of the header; the header, JSON padded with spaces so
// that what follows starts at a multiple of 4; the arrays of one scene behind those of the other.
// The header names an array by a reference {"type": "f32" | "u16" | "u32", "at", "count":
// elements}, below as type[shape]; it starts `at` bytes after its scene's `base`, a multiple of 4.
// The header:
//
//   {"schema": "contactcheck-view/1",
//    "left_out": [{"scene", "why"}]       scenes of the results that are not here, in words
//    "scenes": [{
//      "id", "frames": F, "time_step": seconds,
//      "base": where the scene's arrays start, in bytes after the header
//      "placements": [{"origin": [x, y, z], "scale"}]   one, or one per frame; metres. A position
//                                          here is (scene - origin) / scale, within [-1, 1]
//      "shapes": [{"vertices": V, "nodes": N, "triangles": ids[T][3],
//        "kept": {"triangles": ids[T], "vertices": ids[V]}   only if the scene is too large for the
//                                          page: the part near its contacts that is here, by the
//                                          numbers that pairs name, ascending
//        "numbers": ids[V]                by which pairs name the vertices; absent where from 0 on
//        "lattice": {                     absent without one: then nodes are vertices
//          "cell_nodes": ids[C][8]        corner c is at the high end of s, t, u by bits 0, 1, 2
//          "home": ids[V], "local": f32[V][3]       cell of each vertex, and (s, t, u) in it
//          "boxes": f32[C][2][3]          FFD-AABB of each cell in (s, t, u): low, high corner
//          "spheres": {"radius1", "centers2": ids[S], "radii2": [S]}}}]
//                      as ffd-aabb-sphere2 has them (bounds=paper): radii at rest, metres; level 1
//                      is centred in the box of all mapped FFD-AABBs, level 2 on these nodes
//      "bodies": [{"name", "shape"}]      instances share a shape
//      "nodes": f32[F][sum of N over bodies][3]
//      "truth", "detectors"}]}            as in contacts/SCENE.json (fixtures/README.md); empty for
//                                          a scene whose results name no contacts
//
// `ids` is u16 where all fit, u32 elsewhere. Positions in single precision are exact to 2^-24 of
// the scene's size: enough to see, not to judge by.
#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/deform/recording.h"
#include "core/types/vec3.h"
#include "reference/results/results.h"

namespace contactcheck::report {

// Where the view's unit box lies in the scene: single precision then serves scenes of every size
// and at every distance from the origin.

/// A point p of the scene is (p - origin) / scale in the view, within [-1, 1].
struct Placement {
  Vec3 origin = Vec3::Zero();
  double scale = 1.0;  ///< a power of two, metres

  Vec3 in_view(const Vec3& p) const { return (p - origin) / scale; }
};

/// [frame][body][node]
using FrameNodes = std::vector<std::vector<std::vector<Vec3>>>;

/// One placement for all frames, so that motion looks as it is; one per frame if a frame would be
/// too small to see, or its nodes too coarse, in the common box.
std::vector<Placement> view_placements(const FrameNodes& frames);

/// Bytes, compressed as in html.h. base64 adds a third; with page and results a report stays below
/// 15 MB.
inline constexpr std::size_t kViewLimit = 9'500'000;

/// Builds the container from the recordings and contacts that `results` name, in `folder`, the
/// folder of results.json. If not all scenes fit into `limit` compressed bytes, a scene that needs
/// over a third of them keeps only what is near its listed contacts. A scene is left out, and
/// listed, if one of its files is missing or unreadable, or the smaller scenes leave no room for
/// it. Empty if no scene of the results has a recording.
std::string view_bytes(const results::Results& results, const std::filesystem::path& folder,
                       std::size_t limit = kViewLimit);

/// The same of one recording. `contacts`: as in contacts/SCENE.json, of this recording. Empty if
/// not even what is near its contacts fits.
std::string view_bytes(const Recording& recording, const nlohmann::ordered_json& contacts,
                       std::size_t limit);

}  // namespace contactcheck::report
