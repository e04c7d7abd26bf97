// The interface of every detector, ours and adapted ones.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/deform/body.h"
#include "core/types/contact_set.h"
#include "core/types/frame.h"
#include "core/types/semantics.h"

namespace contactcheck {

/// Work that a detector has done, by name: "leaves_mapped".
struct Count {
  std::string name;
  std::uint64_t value = 0;
};

/// What one pipeline stage still covers for the frame of the last update. Exactly one of the
/// coverage lists is meaningful, by `kind` (of active cells: `bodies` and `active`); pairs are
/// canonical sets.
struct StageRecord {
  enum class Kind {
    kBodies,      ///< every triangle pair of these body pairs
    kLabelCells,  ///< triangle pairs whose labels (Embedding) include these cell pairs
    kOwnerCells,  ///< triangle pairs whose owner cells are these cell pairs; see `owner`
    kTriangles,   ///< these triangle pairs
    // All pairs of active cells, one of each body, of these body pairs:
    kActiveLabelCells,  ///< triangle pairs that both have an active label
    kActiveOwnerCells   ///< triangle pairs whose owner cells are both active
  };
  std::string name;
  std::string unit;  ///< what `in` and `out` count: "body pairs", "sphere pairs", ...
  std::uint64_t in = 0;
  std::uint64_t out = 0;
  /// What the stage looked at ("node pairs", "box comparisons"); empty unit: not counted.
  std::uint64_t visited = 0;
  std::string visited_unit;
  Kind kind = Kind::kBodies;
  std::vector<BodyPair> bodies;
  std::vector<ElementPair> elements;
  std::vector<std::vector<char>> active;  ///< [body][cell]
};

/// The stages of one frame, in order. `owner[body][triangle]` is set if a stage has owner cells.
struct StageTrace {
  std::vector<StageRecord> stages;
  std::vector<std::vector<std::uint32_t>> owner;
};

/// One detector on one scene. Calls come in the order prepare, then (update, query...) per frame,
/// and (update_step, query...) per step where it answers questions of steps; frames and steps may
/// come in any order and repeat. A detector has no state that changes the answer to a later frame
/// or step. Two detectors (also of one kind) may be used by two threads at once. An exception
/// is recorded as status `error` (RefusedInput: `refused`); after it the detector is only
/// destroyed.
class Detector {
 public:
  Detector() = default;
  Detector(const Detector&) = delete;
  Detector& operator=(const Detector&) = delete;
  virtual ~Detector() = default;

  /// Constant after prepare(), which may take a scale from the bodies.
  virtual const Semantics& semantics() const = 0;
  /// True when update() or update_step() reads BodyState::vertices; the mapping is then timed as
  /// phase `map`.
  virtual bool needs_vertices() const = 0;
  /// Optional, before prepare(): the questions that will be asked. The detector may skip work that
  /// only other questions need, and do work for these in advance.
  virtual void expect(const std::vector<Question>&) {}
  /// Called once per scene. The caller keeps `bodies` alive longer than the detector.
  virtual void prepare(const std::vector<Body>& bodies) = 0;
  virtual void update(const Frame& frame) = 0;
  /// In place of update(), before questions of steps. The nodes and vertices that the step
  /// refers to outlive these, the step itself may not.
  /// @pre semantics() answers one (is_of_steps)
  virtual void update_step(const Step& step);
  /// Appends to `out`. The caller clears it before and canonicalizes it afterwards, untimed.
  /// @pre semantics().answers(question)
  virtual void query(Question question, ContactSet& out) = 0;
  /// The stages of the last updated frame; empty for detectors without stages. Untimed.
  virtual StageTrace trace() { return {}; }
  /// Work of the last update() or update_step() and of all queries since, in the detector's own
  /// units: always the same names in the same order. Untimed.
  virtual std::vector<Count> counts() { return {}; }
  /// Nanoseconds of the last update() or query() as measured by the detector itself; none if it
  /// measures none. For a detector behind a pipe this excludes the time of the pipe. Untimed.
  virtual std::optional<double> reported_ns() const { return std::nullopt; }
  /// What a reader must know about the answer to the last updated frame: limits that were reached,
  /// triangles that the library cannot see. One sentence each, the same words for the same fact in
  /// every frame, without numbers that change from frame to frame. Untimed.
  virtual std::vector<std::string> notes() { return {}; }

  // For a detector whose work other processes do.

  /// Halts them, and lets them go on, so that they compute nothing while nobody waits for them.
  /// Every other call lets them go on, too. Untimed, round the calls of a frame.
  virtual void pause() {}
  virtual void resume() {}
  /// Bytes of memory that they hold; none where there are no such processes, or where they are out
  /// of sight. Untimed.
  virtual std::optional<std::uint64_t> bytes_elsewhere() const { return std::nullopt; }
  /// True when prepare() may be called again, with other bodies, after which earlier ones are not
  /// looked at any more: to start such a process may take longer than its answers do.
  virtual bool prepares_again() const { return false; }
};

inline void Detector::update_step(const Step&) {
  throw std::logic_error("a detector without an answer to `impacts` was given a step");
}

}  // namespace contactcheck
