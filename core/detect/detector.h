// The interface of every detector, ours and adapted ones.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
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
    // Of body pairs; any active cell of one body with any of the other.
    kActiveLabelCells,  ///< triangle pairs that both have an active label
    kActiveOwnerCells   ///< triangle pairs whose owner cells are both active
  };
  std::string name;
  std::string unit;  ///< what `in` and `out` count: "body pairs", "sphere pairs", ...
  std::uint64_t in = 0;
  std::uint64_t out = 0;
  /// What the stage looked at ("node pairs", "bucket entries"); empty unit: not counted.
  std::uint64_t visited = 0;
  std::string visited_unit;
  Kind kind = Kind::kBodies;
  std::vector<BodyPair> bodies;
  std::vector<ElementPair> elements;
  std::vector<std::vector<char>> active;  ///< [body][cell]
};

/// The stages of one frame, in order. `owner[body][triangle]` is set when a stage is of owner
/// cells.
struct StageTrace {
  std::vector<StageRecord> stages;
  std::vector<std::vector<std::uint32_t>> owner;
};

/// One detector on one scene. Calls come in the order prepare, then (update, query...) per frame;
/// frames may come in any order and repeat. A detector holds no state that changes the answer to a
/// later frame. Two detectors (also of one kind) may be used by two threads at once. An exception
/// is recorded as status `error` (RefusedInput: `refused`); after it the detector is only
/// destroyed.
class Detector {
 public:
  Detector() = default;
  Detector(const Detector&) = delete;
  Detector& operator=(const Detector&) = delete;
  virtual ~Detector() = default;

  /// Final once prepare() has run: a scale may be taken from the bodies.
  virtual const Semantics& semantics() const = 0;
  /// True when update() reads BodyState::vertices; the mapping is then timed as phase `map`.
  virtual bool needs_vertices() const = 0;
  /// Before prepare(), if at all: the questions that will be asked. What only others need can be
  /// left out, and what these need be done before it is asked for.
  virtual void expect(const std::vector<Question>&) {}
  /// Once per scene. The bodies outlive the detector.
  virtual void prepare(const std::vector<Body>& bodies) = 0;
  virtual void update(const Frame& frame) = 0;
  /// Appends to `out` (the caller clears it); canonicalize() is the caller's, untimed.
  /// @pre semantics().answers(question)
  virtual void query(Question question, ContactSet& out) = 0;
  /// The stages of the last updated frame; empty for detectors without stages. Untimed.
  virtual StageTrace trace() { return {}; }
  /// What the last updated frame took, counted in the detector's own units, always the same names
  /// in the same order; since its update, so asking once more adds to it. Untimed.
  virtual std::vector<Count> counts() { return {}; }
  /// What the detector itself says its last update() or query() took, nanoseconds; none: it says
  /// nothing. For a detector behind a pipe this excludes the time of the pipe. Untimed.
  virtual std::optional<double> reported_ns() const { return std::nullopt; }
  /// What a reader must know about the answer to the last updated frame: limits that were reached,
  /// triangles that the library cannot see. One sentence each, the same words for the same fact in
  /// every frame, without numbers that change from frame to frame. Untimed.
  virtual std::vector<std::string> notes() { return {}; }
};

}  // namespace contactcheck
