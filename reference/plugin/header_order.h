// What contactcheck_plugin.h numbers from 0 on, in the order of its numbers; all values there are.
#pragma once

#include "core/types/semantics.h"

namespace contactcheck::plugin {

inline constexpr Level kHeaderLevels[] = {Level::kBody, Level::kContainment, Level::kCell,
                                          Level::kBox,  Level::kTriangle,    Level::kVertex,
                                          Level::kNear};
inline constexpr Question kHeaderQuestions[] = {Question::kTriangles, Question::kBody,
                                                Question::kCells, Question::kContacts};
inline constexpr Precision kHeaderPrecisions[] = {Precision::kDouble, Precision::kSingle};
inline constexpr DepthKind kHeaderDepthKinds[] = {DepthKind::kNone, DepthKind::kVertexSurface,
                                                  DepthKind::kConvexPair};

}  // namespace contactcheck::plugin
