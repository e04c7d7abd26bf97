// What a detector claims. The comparison judges exactly this and nothing else.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/types/impact.h"

namespace contactcheck {

/// The levels of contact; each has its own ground truth (fixtures/README.md).
enum class Level {
  kBody,
  kContainment,
  kCell,
  kBox,
  kTriangle,
  kVertex,
  kNear,
  // Levels of contact of a body with itself:
  kSelf,        ///< pairs of triangles that share no vertex, and meet
  kSelfVertex,  ///< pairs that share one vertex, and meet in more
  kSelfEdge,    ///< pairs that share two vertices, and meet in more than the segment between them
  kSelfBody,    ///< bodies with any of the three
  kSelfCell,    ///< as kCell, of cells of one lattice that share no node
  kSelfNear,    ///< as kNear, of triangles that use neither the vertex nor one welded to it
  // Levels of contact within a step, from a frame to the next (Step):
  kImpactVf,        ///< a vertex of one body and a triangle of another
  kImpactEe,        ///< an edge of each of two bodies
  kImpactTriangle,  ///< triangles of two bodies, those in contact at the start among them
  kImpact,          ///< pairs of bodies whose surfaces meet
  kImpactSelfVf,    ///< as kImpactVf, of one body, without a common vertex (nor a welded one)
  kImpactSelfEe     ///< as kImpactEe, likewise
};

/// In the order of tables and files.
inline constexpr std::array kLevels = {
    Level::kBody,       Level::kContainment,  Level::kCell,        Level::kBox,
    Level::kTriangle,   Level::kVertex,       Level::kNear,        Level::kSelf,
    Level::kSelfVertex, Level::kSelfEdge,     Level::kSelfBody,    Level::kSelfCell,
    Level::kSelfNear,   Level::kImpactVf,     Level::kImpactEe,    Level::kImpactTriangle,
    Level::kImpact,     Level::kImpactSelfVf, Level::kImpactSelfEe};
/// From fine to coarse: the first of these that a detector claims is its finest level.
inline constexpr std::array kFineToCoarse = {
    Level::kTriangle, Level::kNear,         Level::kVertex,         Level::kCell,
    Level::kBox,      Level::kSelf,         Level::kSelfVertex,     Level::kSelfEdge,
    Level::kSelfNear, Level::kSelfCell,     Level::kImpactTriangle, Level::kImpactVf,
    Level::kImpactEe, Level::kImpactSelfVf, Level::kImpactSelfEe,   Level::kSelfBody,
    Level::kBody,     Level::kImpact,       Level::kContainment};
static_assert(kFineToCoarse.size() == kLevels.size(), "each level has its place");
/// The classes of pairs of one body's triangles.
inline constexpr std::array kSelfClasses = {Level::kSelf, Level::kSelfVertex, Level::kSelfEdge};
/// True for levels of contact of a body with itself, in a frame.
constexpr bool is_self(Level level) { return level >= Level::kSelf && level <= Level::kSelfNear; }
/// True for levels of contact within a step, of bodies with themselves among them.
constexpr bool is_impact(Level level) { return level >= Level::kImpactVf; }
constexpr bool is_self_impact(Level level) { return level >= Level::kImpactSelfVf; }
/// True if one of `levels` is such a level.
bool any_self(const std::vector<Level>& levels);
bool any_impact(const std::vector<Level>& levels);

/// The kind of element that an index of a contact refers to; kNone: the contact has no such index.
enum class Element { kTriangle, kCell, kVertex, kEdge, kNone };
struct NamedElements {
  Element first = Element::kNone, second = Element::kNone;
  bool operator==(const NamedElements&) const = default;
};
/// The elements that a missed or spurious contact of `level` names. At the levels `cell` and
/// `self-cell` a missed contact names two triangles, a spurious one two cells.
NamedElements named_elements(Level level, bool missed);

/// The kinds of query that a detector may answer.
enum class Question {
  kTriangles,   ///< all pairs of intersecting triangles
  kBody,        ///< pairs of bodies in contact; early-out allowed
  kCells,       ///< all pairs of colliding FFD cells
  kContacts,    ///< all contacts with depth and normal, of the detector's kind of depth
  kSelf,        ///< all contacts of bodies with themselves
  kImpacts,     ///< all contacts between bodies within a step
  kSelfImpacts  ///< all contacts of bodies with themselves within a step
};
/// In the order of tables and files.
inline constexpr std::array kQuestions = {
    Question::kTriangles, Question::kBody,    Question::kCells,      Question::kContacts,
    Question::kSelf,      Question::kImpacts, Question::kSelfImpacts};

enum class Precision { kDouble, kSingle };
enum class DepthKind { kNone, kVertexSurface, kConvexPair };

/// True for questions about a step; the others are about a frame.
constexpr bool is_of_steps(Question question) { return question >= Question::kImpacts; }

const char* name_of(Level level);
const char* name_of(Question question);
const char* name_of(Precision precision);
const char* name_of(DepthKind kind);
std::optional<Level> level_from_name(std::string_view name);
/// The names of kLevels, in order.
std::vector<std::string> level_names();

struct Semantics {
  std::vector<Level> levels;        ///< levels it claims to answer, all of which are judged
  std::vector<Level> informative;   ///< levels that are shown too, but no claim and never gated
  std::vector<Question> questions;  ///< first one: its own question; never empty
  bool solid = false;               ///< true: containment counts as contact; false: surfaces only
  bool closed = true;               ///< true: touching is contact
  bool exact = false;               ///< true: it claims no miss and nothing spurious at its levels
  double margin = 0.0;              ///< metres; near = closer than this, strictly; 0 without one
  ImpactTolerance tolerance;        ///< of contact within steps
  Precision precision = Precision::kDouble;
  double scale = 1.0;  ///< in single precision the detector gets fed_value(x, scale), not x
  /// Only in single precision, and then at scale 1: in every frame the detector subtracts
  /// local_origin() in double before it rounds, so it works on local_value(x, origin[axis])
  /// (local_origin.h). A detector that needs vertices gets these values and is judged by their
  /// ground truth as well. One that needs none rounds the nodes and maps its own vertices, which no
  /// other program sees; it is judged by the ground truth of x alone.
  bool local_origin = false;
  DepthKind depth = DepthKind::kNone;
  bool whole_cells = false;  ///< if it answers with cells: it tests cells, not FFD-AABBs
  /// Finds all contacts even for the question `body`. A speed-up over such a detector in that
  /// question would not be fair, so none is reported.
  bool no_early_end = false;
  std::string means;  ///< its definition of contact, if that is not contact of surfaces

  bool claims(Level level) const;
  bool answers(Question question) const;
};

/// The coordinate that a detector in single precision gets: scaled in double, then rounded once.
inline float fed_value(double x, double scale) { return static_cast<float>(scale * x); }

}  // namespace contactcheck
