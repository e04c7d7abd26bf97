// The input of `contactcheck reduce`: a case file of a run, or a scene with a detector.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "reference/reduce/candidate.h"
#include "reference/reduce/verdict.h"

namespace contactcheck::reduce {

/// One frame in which a detector may err, and what to reduce in it, as far as given.
struct ReductionTask {
  std::string scene;  ///< id
  std::size_t frame = 0;
  std::string place;        ///< "frame 3", "value 1e-9 (frame 3)": as a message names it
  std::string detector;     ///< as it was named; empty: none was
  std::string level, kind;  ///< empty: whatever is found
  Snapshot snapshot;        ///< of all bodies, or of those that a case names
  Snapshot frame_of_case;   ///< all bodies of a case's recording; empty without one
  std::array<std::size_t, 2> named = {0, 1};  ///< the bodies that a case names, in that frame
  bool self = false;                 ///< the scene asks for contacts of bodies with themselves
  std::optional<TrianglePair> pair;  ///< the triangles of a case, of the bodies `sides`
  std::array<std::size_t, 2> sides = {0, 1};  ///< in `snapshot`
  std::optional<CellPair> cells;              ///< the cells of a case
};

/// The triangles of a disagreement, that of the first of its two bodies first: a pair of triangles,
/// or a triangle with the first one that has the vertex beside it. None at other levels.
std::optional<TrianglePair> triangles_of(const judge::Disagreement& disagreement,
                                         const Snapshot& snapshot);

/// The cells of a disagreement between such; none at other levels.
std::optional<CellPair> cells_of(const judge::Disagreement& disagreement);

/// True when `file` is a case file: JSON of one object with a detector and a kind.
bool is_case_file(const std::filesystem::path& file);

/// Reads a case file of `contactcheck run` and the frame out of the recording that it names; where
/// it names none, its two triangles alone.
/// @throws InputError, one sentence: file, place, value
ReductionTask read_case(const std::filesystem::path& file);

/// The frames of a scene, family or recording (`target` as `run` takes it, or with "@FRAME", or
/// "@VALUE" of a family, behind it: that frame alone).
/// @throws InputError; also for a suite, and for simulated scenes, which have no frames before they
/// run: their recordings do
std::vector<ReductionTask> tasks_of_scene(const std::string& target,
                                          const std::filesystem::path& fixtures);

}  // namespace contactcheck::reduce
