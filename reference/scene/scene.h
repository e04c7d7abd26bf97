// A scene: named bodies, how they move, and what is to be judged.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
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

/// Where and how a body's mesh came to be; goes into the results.
struct MeshOrigin {
  std::string body;
  std::string
      source;  ///< "libcgal-demo:bunny00.off simplified to 5914 triangles", "box", a path, ...
  std::string notes;  ///< defects found, "read as float", ...; empty when there is nothing to say
};

/// What moves the bodies of a simulated scene.
struct SimulationSpec {
  SimulationSettings settings;
  std::vector<std::optional<Material>> materials;  ///< per body; without one it cannot be moved
  std::vector<Vec3> velocities;  ///< per body, m/s at time 0; zero for what cannot be moved
  std::string driver;            ///< the detector whose contacts are resolved, by its name
  std::size_t every = 1;         ///< steps from one judged frame to the next
};

/// A family of hard cases: one frame per value of a parameter.
struct CaseFamily {
  std::string parameter;            ///< "gap, m"
  std::vector<std::string> values;  ///< per frame, as the file writes them
  std::string origin;               ///< where the case is from: an issue, a derivation
  std::string stresses;             ///< what it is hard for
  /// What the parameter measures where the family asks in which range answers are right: "size"
  /// (edge of a triangle, metres) or "distance" (from the origin, in edges); else empty.
  std::string range;
};

/// Poses of two bodies at given separations, over many orientations. Frames are ordered by
/// separation, then orientation; sweep_poses.h (place_sweep) says what a separation is.
struct SweepSpec {
  std::vector<double> separations;  ///< of the scene's size, ascending; below 0: depths
  std::size_t orientations = 64;
  std::uint64_t seed = 1;
};
/// Of the scene's size: how far a separation may be from what it says.
inline constexpr double kSweepTolerance = 1e-6;

inline constexpr std::size_t kMostFrames = 100'000;  // of a scene file, a sequence or an option

/// How far a lattice that was fitted to a recording is from it.
struct FitError {
  std::size_t body = 0;
  std::vector<double> rms, max;  ///< per frame: of the distances of all vertices, metres
};

/// Random hard pairs of triangles (random_pairs.h).
struct PairSpec {
  std::uint64_t count = 0, seed = 1;
};
class RandomPairs;

/// Where a scene that was drawn from a seed comes from (drawn_scene.h).
struct Drawn {
  std::uint64_t seed = 0, number = 0;
  std::size_t redrawn = 0;  ///< times that it was drawn again because a limit ended its judging
  std::string happens;      ///< one of kHappenings (draw_rules.h)
  std::map<std::string, double> parameters;  ///< by the names of kDrawnParameters
};
/// Per body the triangles and cells wanted; the gap or, below 0, depth in the first body's size;
/// the share of frames that are to have contact; speed in that size, a frame.
inline constexpr std::array<const char*, 9> kDrawnParameters = {
    "bodies", "cells",      "contact_share", "deformers", "distance",
    "frames", "size_ratio", "speed",         "triangles"};

/// What a scene is drawn from.
struct DrawnSpec {
  std::string rules, rules_name;  ///< their text, and how messages name it
  std::uint64_t seed = 1, number = 1;
  std::size_t redrawn = 0;
  std::vector<std::filesystem::path> meshes;  ///< in place of those of the rules; empty: those
};

/// Positions are given: by the motions of bodies, or as recorded.
struct GivenFrames {};
/// How the frames of a scene come about. Random pairs make theirs one by one.
using SceneKind = std::variant<GivenFrames, SimulationSpec, SweepSpec, CaseFamily,
                               std::shared_ptr<const RandomPairs>>;

struct Scene {
  std::string id;
  std::string title;  ///< one line
  std::vector<Body> bodies;
  std::vector<MeshOrigin> origins;  ///< per body
  std::size_t frames = 0;
  double time_step = 0.0;       ///< seconds
  std::vector<Level> levels;    ///< to be judged; nothing else is computed
  std::vector<Motion> motions;  ///< per body; empty for a recording; simulated: the pose at time 0
  /// Recorded nodes [frame][body]; empty for a scripted scene. A scene with recorded bodies has
  /// them of all its bodies, and a family those of its cases. Of a simulated scene,
  /// simulate_scene.h (simulate) fills it before any frame is asked for; of a sweep sweep_poses.h
  /// does.
  std::vector<std::vector<std::vector<Vec3>>> recorded;
  SceneKind kind;
  std::vector<FitError> fits;  ///< bodies with a lattice fitted to a recording
  std::optional<Drawn> drawn;  ///< drawn from a seed, whatever its kind

  /// Null for scenes of other kinds, as are the next.
  const SimulationSpec* simulation() const { return std::get_if<SimulationSpec>(&kind); }
  SimulationSpec* simulation() { return std::get_if<SimulationSpec>(&kind); }
  const SweepSpec* sweep() const { return std::get_if<SweepSpec>(&kind); }
  const CaseFamily* family() const { return std::get_if<CaseFamily>(&kind); }
  const RandomPairs* pairs() const {
    const auto* pairs = std::get_if<std::shared_ptr<const RandomPairs>>(&kind);
    return pairs == nullptr ? nullptr : pairs->get();
  }

  /// Positions follow from the time alone.
  bool scripted() const { return recorded.empty() && std::holds_alternative<GivenFrames>(kind); }
  /// First contacts are searched between frames. (Of a drawn scene they are not: many searches cost
  /// more than all else, and its frames are what is drawn.)
  bool bisects_time() const { return scripted() && !drawn; }
  /// Random pairs differ in scale from frame to frame: their lengths and distances do not add up.
  bool grades_lengths() const { return pairs() == nullptr; }
  /// Frames of families, sweeps and random pairs are cases, not moments: there is no first contact.
  bool follows_time() const { return !family() && !sweep() && !pairs(); }
  bool judges(Level level) const;
  double time_of(std::size_t frame) const { return static_cast<double>(frame) * time_step; }
  /// Lattice nodes of every body. @pre scripted(), or simulated or a sweep and time 0: the start
  std::vector<std::vector<Vec3>> nodes_at(double time) const;
  /// Lattice nodes of every body at a frame, scripted, recorded or made. @pre a simulation has been
  /// run
  std::vector<std::vector<Vec3>> nodes_of_frame(std::size_t frame) const;
  /// The largest side of any body's rest box, metres: tolerances are relative to it.
  double size() const;
};

/// Reads a scene file (JSON). `wanted_frames` above 0 replaces the file's frame count, keeping the
/// duration; of a simulated scene the steps keep their length, so that the duration follows; of
/// recorded frames it takes the first. A family of hard cases has its own frames.
/// @throws InputError, one sentence: file, path of the field, value, what is allowed
Scene load_scene(const std::filesystem::path& file, std::size_t wanted_frames = 0);

/// The text of a scene that lies in no file. Paths in it are relative to `folder`.
struct SceneText {
  std::string text;
  std::string name;  ///< of the text, in messages: "scene file \"touch.json\""
  std::filesystem::path folder;
};
Scene load_scene_text(const SceneText& document, std::size_t wanted_frames = 0);

/// The scene `random-pairs` (random_pairs.h), judged at the levels body, cell and triangle.
Scene make_pairs_scene(const PairSpec& spec);

/// A scene out of a recording (.ccr), judged at the levels body, cell, box, triangle and near.
Scene load_recording(const std::filesystem::path& file);

/// Welds every body (core/deform/body.h); their defects are noted as those of the welded meshes.
void weld(Scene& scene);

/// Self-contact that would take too long to judge (refuse_many_adjacent_pairs).
/// @throws InputError naming the first such body of a scene with levels of self-contact
void refuse_crowded_vertices(const Scene& scene);

/// The file of a scene, a family or a recording (.ccr), the text of a scene, random pairs, or a
/// scene that is to be drawn.
using SceneSource = std::variant<std::filesystem::path, SceneText, PairSpec, DrawnSpec>;

/// `frames` above 0 replaces the number of frames, except that of random pairs; of a recording it
/// takes the first.
/// @throws InputError, also where a recording has fewer, and as refuse_crowded_vertices() does
Scene load_any_scene(const SceneSource& source, std::size_t frames = 0);

/// The same source, whatever the working directory is.
SceneSource absolute(SceneSource source);

}  // namespace contactcheck::scene
