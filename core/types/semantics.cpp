#include "core/types/semantics.h"

#include <algorithm>

namespace contactcheck {

const char* name_of(Level level) {
  switch (level) {
    case Level::kBody:
      return "body";
    case Level::kContainment:
      return "containment";
    case Level::kCell:
      return "cell";
    case Level::kBox:
      return "box";
    case Level::kTriangle:
      return "triangle";
    case Level::kVertex:
      return "vertex";
    case Level::kNear:
      return "near";
    case Level::kSelf:
      return "self";
    case Level::kSelfVertex:
      return "self-vertex";
    case Level::kSelfEdge:
      return "self-edge";
    case Level::kSelfBody:
      return "self-body";
    case Level::kSelfCell:
      return "self-cell";
  }
  return "unknown";
}

const char* name_of(Question question) {
  switch (question) {
    case Question::kTriangles:
      return "triangles";
    case Question::kBody:
      return "body";
    case Question::kCells:
      return "cells";
    case Question::kContacts:
      return "contacts";
    case Question::kSelf:
      return "self";
  }
  return "unknown";
}

const char* name_of(Precision precision) {
  return precision == Precision::kDouble ? "double" : "single";
}

const char* name_of(DepthKind kind) {
  switch (kind) {
    case DepthKind::kNone:
      return "none";
    case DepthKind::kVertexSurface:
      return "vertex-surface";
    case DepthKind::kConvexPair:
      return "convex-pair";
  }
  return "unknown";
}

std::optional<Level> level_from_name(std::string_view name) {
  for (Level level : kLevels)
    if (name == name_of(level)) return level;
  return std::nullopt;
}

std::vector<std::string> level_names() {
  std::vector<std::string> names;
  for (const Level level : kLevels) names.emplace_back(name_of(level));
  return names;
}

bool Semantics::claims(Level level) const {
  return std::find(levels.begin(), levels.end(), level) != levels.end();
}

bool Semantics::answers(Question question) const {
  return std::find(questions.begin(), questions.end(), question) != questions.end();
}

}  // namespace contactcheck
