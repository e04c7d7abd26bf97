// What a detector claims. The comparison judges exactly this and nothing else.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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
  // Of a body with itself.
  kSelf,        ///< pairs of triangles that share no vertex, and meet
  kSelfVertex,  ///< pairs that share one vertex, and meet in more
  kSelfEdge,    ///< pairs that share two vertices, and meet in more than the segment between them
  kSelfBody,    ///< bodies with any of the three
  kSelfCell,    ///< as kCell, of cells of one lattice that share no node
  kSelfNear     ///< as kNear, of triangles that use neither the vertex nor one welded to it
};

/// In the order of tables and files.
inline constexpr std::array kLevels = {
    Level::kBody,     Level::kContainment, Level::kCell,    Level::kBox,        Level::kTriangle,
    Level::kVertex,   Level::kNear,        Level::kSelf,    Level::kSelfVertex, Level::kSelfEdge,
    Level::kSelfBody, Level::kSelfCell,    Level::kSelfNear};
/// The first of these that a detector claims is its finest.
inline constexpr std::array kFineToCoarse = {
    Level::kTriangle, Level::kNear,       Level::kVertex,     Level::kCell,     Level::kBox,
    Level::kSelf,     Level::kSelfVertex, Level::kSelfEdge,   Level::kSelfNear, Level::kSelfCell,
    Level::kSelfBody, Level::kBody,       Level::kContainment};
/// The classes of pairs of one body's triangles.
inline constexpr std::array kSelfClasses = {Level::kSelf, Level::kSelfVertex, Level::kSelfEdge};
/// Is it about a body and itself?
constexpr bool is_self(Level level) { return level >= Level::kSelf; }
/// Is one of them?
bool any_self(const std::vector<Level>& levels);

/// What a number of a pair counts; kNone: nothing, the pair is one of bodies.
enum class Element { kTriangle, kCell, kVertex, kNone };
struct NamedElements {
  Element first = Element::kNone, second = Element::kNone;
  bool operator==(const NamedElements&) const = default;
};
/// What a missed contact of the level names, or a spurious one: of cells a missed one is a pair of
/// triangles.
NamedElements named_elements(Level level, bool missed);

/// What is asked of a detector when its time is taken.
enum class Question {
  kTriangles,  ///< all pairs of intersecting triangles
  kBody,       ///< pairs of bodies in contact; early-out allowed
  kCells,      ///< all pairs of colliding FFD cells
  kContacts,   ///< all contacts with depth and normal, of the detector's kind of depth
  kSelf        ///< all contacts of bodies with themselves
};
/// In the order of tables and files.
inline constexpr std::array kQuestions = {Question::kTriangles, Question::kBody, Question::kCells,
                                          Question::kContacts, Question::kSelf};

enum class Precision { kDouble, kSingle };
enum class DepthKind { kNone, kVertexSurface, kConvexPair };

const char* name_of(Level level);
const char* name_of(Question question);
const char* name_of(Precision precision);
const char* name_of(DepthKind kind);
std::optional<Level> level_from_name(std::string_view name);
/// Of kLevels, in order.
std::vector<std::string> level_names();

struct Semantics {
  std::vector<Level> levels;        ///< levels it claims to answer, all of which are judged
  std::vector<Level> informative;   ///< levels that are shown too, but no claim and never gated
  std::vector<Question> questions;  ///< first one: its own question; never empty
  bool solid = false;               ///< true: containment counts as contact; false: surfaces only
  bool closed = true;               ///< true: touching is contact
  bool exact = false;               ///< true: it claims no miss and nothing spurious at its levels
  double margin = 0.0;              ///< metres; near = closer than this, strictly; 0 without one
  Precision precision = Precision::kDouble;
  double scale = 1.0;  ///< with single precision it is fed fed_value(x, scale) and not x
  /// Only with single precision, and then at scale 1: in every frame it subtracts local_origin() in
  /// double before it rounds: it works on local_value(x, origin[axis]) (local_origin.h). One that
  /// needs vertices is fed these values and is judged by their ground truth as well. One that needs
  /// none rounds the nodes and maps its own vertices, which no other program knows. It is judged by
  /// the ground truth of x alone.
  bool local_origin = false;
  DepthKind depth = DepthKind::kNone;
  bool whole_cells = false;  ///< of one that answers with cells: it tests these, not FFD-AABBs
  /// Asked which bodies touch it still finds all contacts: a speed-up over it in that question
  /// would be no fair one, and is not given.
  bool no_early_end = false;
  std::string means;  ///< what it calls contact, where that is not contact of the surfaces

  bool claims(Level level) const;
  bool answers(Question question) const;
};

/// A coordinate as a detector in single precision is fed it: scaled in double, then rounded once.
inline float fed_value(double x, double scale) { return static_cast<float>(scale * x); }

}  // namespace contactcheck
