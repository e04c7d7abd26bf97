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
    case Level::kSelfNear:
      return "self-near";
    case Level::kImpactVf:
      return "impact-vf";
    case Level::kImpactEe:
      return "impact-ee";
    case Level::kImpactTriangle:
      return "impact-triangle";
    case Level::kImpact:
      return "impact";
    case Level::kImpactSelfVf:
      return "impact-self-vf";
    case Level::kImpactSelfEe:
      return "impact-self-ee";
  }
  return "unknown";
}

bool any_self(const std::vector<Level>& levels) {
  return std::any_of(levels.begin(), levels.end(), is_self);
}
bool any_impact(const std::vector<Level>& levels) {
  return std::any_of(levels.begin(), levels.end(), is_impact);
}

NamedElements named_elements(Level level, bool missed) {
  constexpr NamedElements kTriangles{Element::kTriangle, Element::kTriangle};
  constexpr NamedElements kCells{Element::kCell, Element::kCell};
  switch (level) {
    case Level::kTriangle:
    case Level::kSelf:
    case Level::kSelfVertex:
    case Level::kSelfEdge:
    case Level::kImpactTriangle:
      return kTriangles;
    case Level::kCell:
    case Level::kSelfCell:
      return missed ? kTriangles : kCells;
    case Level::kBox:
      return kCells;
    case Level::kVertex:
      return {Element::kVertex, Element::kNone};
    case Level::kNear:
    case Level::kSelfNear:
    case Level::kImpactVf:
    case Level::kImpactSelfVf:
      return {Element::kVertex, Element::kTriangle};
    case Level::kImpactEe:
    case Level::kImpactSelfEe:
      return {Element::kEdge, Element::kEdge};
    case Level::kBody:
    case Level::kContainment:
    case Level::kSelfBody:
    case Level::kImpact:
      break;
  }
  return {};
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
    case Question::kImpacts:
      return "impacts";
    case Question::kSelfImpacts:
      return "self-impacts";
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
