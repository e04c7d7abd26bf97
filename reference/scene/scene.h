// A scene: named bodies, their motion, and the levels to judge.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/deform/body.h"
#include "core/deform/motion.h"
#include "core/dynamics/material.h"
#include "core/dynamics/simulation.h"
#include "core/types/semantics.h"

namespace contactcheck::scene {

/// The source of a body's mesh, for the results.
struct MeshOrigin {
  std::string body;
  std::string
      source;  ///< "libcgal-demo:bunny00.off simplified to 5914 triangles", "box", a path, ...
  std::string notes;  ///< defects found, "read as float", ...; may be empty
};

/// What moves the bodies of a simulated scene.
struct SimulationSpec {
  SimulationSettings settings;
  std::vector<std::optional<Material>> materials;  ///< per body; a body without one does not move
  std::vector<Vec3> velocities;  ///< per body, m/s at time 0; zero without a material
  std::string driver;            ///< name of the detector whose contacts are resolved
  std::size_t every = 1;         ///< steps per judged frame
};

/// A family of hard cases: one frame per value of a parameter.
struct CaseFamily {
  std::string parameter;            ///< "gap, m"
  std::vector<std::string> values;  ///< per frame, as the file writes them
  std::string origin;               ///< source of the case: an issue, a derivation
  std::string stresses;             ///< what makes it hard
  /// What the parameter measures if the family tests a range: "size" (edge of a triangle, metres)
  /// or "distance" (from the origin, in edges); else empty.
  std::string range;
};

/// Poses of two bodies at given separations, over many orientations. Frames are ordered by
/// separation, then orientation; sweep_poses.h (place_sweep) says what a separation is.
struct SweepSpec {
  std::vector<double> separations;  ///< relative to the scene's size, ascending; negative: depths
  std::size_t orientations = 64;
  std::uint64_t seed = 1;
};
/// The error allowed in a separation, relative to the scene's size.
inline constexpr double kSweepTolerance = 1e-6;

inline constexpr std::size_t kMostFrames = 100'000;  // of a scene file, a sequence or an option

/// The error of a lattice that was fitted to a recording.
struct FitError {
  std::size_t body = 0;
  std::vector<double> rms, max;  ///< per frame: of the distances of all vertices, metres
};

/// Random hard pairs of triangles (random_pairs.h).
struct PairSpec {
  std::uint64_t count = 0, seed = 1;
};
class RandomPairs;

/// The origin of a scene that was drawn from a seed (drawn_scene.h).
struct Drawn {
  std::uint64_t seed = 0, number = 0;
  std::size_t redrawn = 0;                   ///< number of redraws because judging exceeded a limit
  std::string happens;                       ///< one of kHappenings (draw_rules.h)
  std::map<std::string, double> parameters;  ///< by the names of kDrawnParameters
};
/// triangles and cells: wanted per body. distance: gap (below 0: depth) in the smaller body's size.
/// contact_share: share of the frames. speed: per frame, in the first body's size.
inline constexpr std::array<const char*, 9> kDrawnParameters = {
    "bodies", "cells",      "contact_share", "deformers", "distance",
    "frames", "size_ratio", "speed",         "triangles"};

/// The input of a drawn scene.
struct DrawnSpec {
  std::string rules, rules_name;  ///< text of the rules, and its name in messages
  std::uint64_t seed = 1, number = 1;
  std::size_t redrawn = 0;
  std::vector<std::filesystem::path> meshes;  ///< replace those of the rules; empty: no change
};

/// Frames are given: by the motions of bodies, or by recordings.
struct GivenFrames {};
/// How the frames of a scene are made. Random pairs make theirs one by one.
using SceneKind = std::variant<GivenFrames, SimulationSpec, SweepSpec, CaseFamily,
                               std::shared_ptr<const RandomPairs>>;

using FrameReader = std::function<std::vector<std::vector<Vec3>>(std::size_t frame)>;

struct Scene {
  std::string id;
  std::string title;  ///< one line
  std::vector<Body> bodies;
  std::vector<MeshOrigin> origins;  ///< per body
  std::size_t frames = 0;
  double time_step = 0.0;       ///< seconds
  std::vector<Level> levels;    ///< levels to judge; nothing else is computed
  std::vector<Motion> motions;  ///< per body; empty for a recording; simulated: the pose at time 0
  /// Recorded nodes [frame][body][node]; empty for a scripted scene. Set for all bodies if one has
  /// a recording, and for the cases of a family. For a simulated scene simulate_scene.h fills it
  /// before any frame is requested, for a sweep sweep_poses.h.
  std::vector<std::vector<std::vector<Vec3>>> recorded;
  /// In place of `recorded`: reads the nodes of a frame, [body][node], each time it is called
  /// (load_scene_unread). Any thread may call it, one at a time. It throws InputError.
  FrameReader read_frame;
  SceneKind kind;
  std::vector<FitError> fits;  ///< bodies with a lattice fitted to a recording
  std::optional<Drawn> drawn;  ///< set if the scene was drawn from a seed, whatever its kind

  /// These return null for scenes of other kinds.
  const SimulationSpec* simulation() const { return std::get_if<SimulationSpec>(&kind); }
  SimulationSpec* simulation() { return std::get_if<SimulationSpec>(&kind); }
  const SweepSpec* sweep() const { return std::get_if<SweepSpec>(&kind); }
  const CaseFamily* family() const { return std::get_if<CaseFamily>(&kind); }
  const RandomPairs* pairs() const {
    const auto* pairs = std::get_if<std::shared_ptr<const RandomPairs>>(&kind);
    return pairs == nullptr ? nullptr : pairs->get();
  }

  /// True if positions depend only on the time.
  bool scripted() const {
    return recorded.empty() && !read_frame && std::holds_alternative<GivenFrames>(kind);
  }
  /// True if first contacts are searched between frames. (Not for drawn scenes: the searches would
  /// take longest of all, and these scenes are defined by their frames.)
  bool bisects_time() const { return scripted() && !drawn; }
  /// Random pairs differ in scale between frames, so their lengths and distances cannot be summed.
  bool grades_lengths() const { return pairs() == nullptr; }
  /// Frames of families, sweeps and random pairs are separate cases, without a first contact.
  bool follows_time() const { return !family() && !sweep() && !pairs(); }
  bool judges(Level level) const;
  double time_of(std::size_t frame) const { return static_cast<double>(frame) * time_step; }
  /// Lattice nodes of every body. @pre scripted(), or simulated or a sweep and time 0: the start
  std::vector<std::vector<Vec3>> nodes_at(double time) const;
  /// Lattice nodes of every body at a frame, scripted, recorded or made. @pre a simulated scene has
  /// been simulated
  std::vector<std::vector<Vec3>> nodes_of_frame(std::size_t frame) const;
  /// The largest side of any body's rest box, metres: tolerances are relative to it.
  double size() const;
};

/// Reads a scene file (JSON). `wanted_frames` above 0 replaces the number of frames: scripted
/// scenes keep the duration, simulated scenes the step length, and recordings use their first
/// frames. It does not apply to a family of hard cases.
/// @throws InputError, one sentence: file, path of the field, value, what is allowed
Scene load_scene(const std::filesystem::path& file, std::size_t wanted_frames = 0);

/// The text of a scene without a file. Its paths are relative to `folder`.
struct SceneText {
  std::string text;
  std::string name;  ///< for messages: "scene file \"touch.json\""
  std::filesystem::path folder;
};
Scene load_scene_text(const SceneText& document, std::size_t wanted_frames = 0);

/// The same, but recorded mesh files are read when nodes_of_frame() asks for them, each time: the
/// memory does not grow with their number. Point caches are read now, and frames to which a lattice
/// is fitted.
Scene load_scene_unread(const SceneText& document);

/// The scene `random-pairs` (random_pairs.h), judged at the levels body, cell and triangle.
Scene make_pairs_scene(const PairSpec& spec);

/// A scene from a recording (.ccr), judged at the levels body, cell, box, triangle and near.
Scene load_recording(const std::filesystem::path& file);

/// Welds every body (core/deform/body.h); defects are then those of the welded meshes.
void weld(Scene& scene);

/// Refuses self-contact that would take too long to judge (refuse_many_adjacent_pairs).
/// @throws InputError naming the first such body of a scene with levels of self-contact
void refuse_crowded_vertices(const Scene& scene);

/// A file (scene, family or .ccr recording), the text of a scene, random pairs, or a scene to draw.
using SceneSource = std::variant<std::filesystem::path, SceneText, PairSpec, DrawnSpec>;

/// `frames` above 0 replaces the number of frames, except for random pairs; a recording uses its
/// first frames.
/// @throws InputError, also where a recording has fewer, and as refuse_crowded_vertices() does
Scene load_any_scene(const SceneSource& source, std::size_t frames = 0);

/// The same source with absolute paths.
SceneSource absolute(SceneSource source);

}  // namespace contactcheck::scene
