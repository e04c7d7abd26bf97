// What contactcheck_plugin.h numbers from 0 on, in the order of its numbers; all values there are.
#pragma once

#include "core/types/semantics.h"

namespace contactcheck {

inline constexpr Level kLevels[] = {Level::kBody, Level::kContainment, Level::kCell,
                                    Level::kBox,  Level::kTriangle,    Level::kVertex,
                                    Level::kNear};
inline constexpr Question kQuestions[] = {Question::kTriangles, Question::kBody, Question::kCells,
                                          Question::kContacts};
inline constexpr Precision kPrecisions[] = {Precision::kDouble, Precision::kSingle};
inline constexpr DepthKind kDepthKinds[] = {DepthKind::kNone, DepthKind::kVertexSurface,
                                            DepthKind::kConvexPair};

}  // namespace contactcheck
