// What a plug-in declares about its detector, be it a library or a command.
#pragma once

#include <algorithm>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/detect/registry.h"
#include "core/types/contact_set.h"
#include "core/types/impact.h"
#include "core/types/semantics.h"
#include "reference/text/json_field.h"

namespace contactcheck::plugin {

// What contactcheck_plugin.h numbers from 0 on, in the order of its numbers: all values about
// frames. Those about steps have bits of their own (CONTACTCHECK_IMPACT_...).
inline constexpr Level kHeaderLevels[] = {
    Level::kBody,     Level::kContainment, Level::kCell,    Level::kBox,        Level::kTriangle,
    Level::kVertex,   Level::kNear,        Level::kSelf,    Level::kSelfVertex, Level::kSelfEdge,
    Level::kSelfBody, Level::kSelfCell,    Level::kSelfNear};
inline constexpr Question kHeaderQuestions[] = {
    Question::kTriangles, Question::kBody, Question::kCells, Question::kContacts, Question::kSelf};
// One that is left out would be asked for as the first one.
static_assert(std::all_of(kLevels.begin(), kLevels.end(), [](Level level) {
  return is_impact(level) != (std::ranges::count(kHeaderLevels, level) == 1);
}));
static_assert(std::all_of(kQuestions.begin(), kQuestions.end(), [](Question question) {
  return is_of_steps(question) != (std::ranges::count(kHeaderQuestions, question) == 1);
}));
/// Levels within a step, in the order of the header's bits.
inline constexpr Level kHeaderImpacts[] = {Level::kImpactVf,       Level::kImpactEe,
                                           Level::kImpactTriangle, Level::kImpact,
                                           Level::kImpactSelfVf,   Level::kImpactSelfEe};
inline constexpr Precision kHeaderPrecisions[] = {Precision::kDouble, Precision::kSingle};
inline constexpr DepthKind kHeaderDepthKinds[] = {DepthKind::kNone, DepthKind::kVertexSurface,
                                                  DepthKind::kConvexPair};

/// The kinds of elements, in the order of the header's bits.
inline constexpr ImpactKind kHeaderKinds[] = {ImpactKind::vertex_triangle, ImpactKind::edge_edge};

/// What is claimed about queries of moving elements.
struct ImpactClaims {
  std::vector<ImpactKind> kinds;  ///< at least one
  Precision precision = Precision::kDouble;
  ImpactTolerance tolerance;
};

/// Each is a call of a detector or two; all together are held to the limit of one call.
inline constexpr std::uint32_t kMostWarmUpFrames = 10000;

struct Declaration {
  std::string id, summary, version;
  std::vector<OptionInfo> options;
  /// With the default options, before prepare. Without questions: it answers `impacts` alone.
  Semantics semantics;
  std::optional<ImpactClaims> impacts;  ///< with the default options; none: no such queries
  bool needs_vertices = true, needs_nodes = true;
  bool unisolated = false;      ///< it is asked in a process that cannot be ended with it
  bool transient = false;       ///< no later run can reach it: it lives in the caller of this one
  bool prepares_again = false;  ///< of a command: it may get other bodies while it runs
  /// Of a command: frames of warm_up.h that it is asked about before the bodies of a scene.
  std::uint32_t warm_up = 0;

  /// Frames, or steps from one to the next.
  bool answers_frames() const { return !semantics.questions.empty(); }
};

/// Reads one strictly; README.md beside this header gives its keys. Keys that it does not know are
/// passed over, so that later versions may add some, unless they resemble one of these.
/// @throws InputError: one sentence with the document, the place, the value and what is allowed
Declaration read_declaration(const text::JsonField& field);
Semantics read_semantics(const text::JsonField& field);
ImpactClaims read_impact_claims(const text::JsonField& field);
nlohmann::ordered_json to_json(const Declaration& declaration);

/// What is wrong with it in itself: levels and questions that do not fit together, margins and
/// scales that cannot be used; "" when nothing is.
std::string semantics_fault(const Semantics& semantics);
std::string claims_fault(const ImpactClaims& claims);

/// A plug-in answers the question `self` by pairs of triangles, cells and bodies, and by near
/// pairs, that name one body twice; here they become what a Detector answers. @throws InputError
/// for others
void read_self_answer(const std::string& from, ContactSet& answer);

/// What is claimed may not depend on the bodies: a margin and a scale alone may be other after
/// prepare. @throws InputError: `from` and the key that has changed
void require_same_claims(const std::string& from, const Semantics& before, const Semantics& now);
/// Only the tolerance of queries may depend on options.
void require_same_claims(const std::string& from, const ImpactClaims& before,
                         const ImpactClaims& now);
[[noreturn]] void refuse_change(const std::string& from, const std::string& key);

}  // namespace contactcheck::plugin
