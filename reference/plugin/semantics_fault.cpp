#include <algorithm>
#include <cmath>
#include <set>

#include "reference/plugin/declaration.h"

namespace contactcheck::plugin {
namespace {

std::string levels_fault(const Semantics& s) {
  std::set<Level> levels(s.levels.begin(), s.levels.end());
  levels.insert(s.informative.begin(), s.informative.end());
  if (levels.empty()) return "it claims no level";
  if (levels.size() != s.levels.size() + s.informative.size())
    return "it names a level twice (one that is claimed is not informative beside)";
  if (s.exact && s.levels.empty()) return "it is exact at no level";
  return "";
}

// What is judged must have been asked for.
std::string questions_fault(const Semantics& s) {
  if (s.questions.empty()) return "it answers no question";
  if (std::set<Question>(s.questions.begin(), s.questions.end()).size() != s.questions.size())
    return "it names a question twice";
  if (s.claims(Level::kTriangle) && !s.answers(Question::kTriangles))
    return "it claims the level triangle and does not answer the question triangles";
  if (s.claims(Level::kCell) && !s.answers(Question::kCells))
    return "it claims the level cell and does not answer the question cells";
  if (s.answers(Question::kContacts) != (s.depth != DepthKind::kNone))
    return "the question contacts and a kind of depth go together, and it declares one of them";
  return "";
}

std::string numbers_fault(const Semantics& s) {
  if (!std::isfinite(s.margin) || s.margin < 0.0) return "its margin is no number from 0 on";
  if (s.claims(Level::kNear) && s.margin == 0.0)
    return "it claims the level near with a margin of 0: nothing is nearer than that";
  if (!std::isfinite(s.scale) || s.scale <= 0.0) return "its scale is no number above 0";
  if (s.precision == Precision::kDouble && s.scale != 1.0)
    return "it has a scale and no single precision";
  if (s.local_origin && (s.precision == Precision::kDouble || s.scale != 1.0))
    return "it has a local origin and no single precision at scale 1";
  return "";
}

}  // namespace

std::string semantics_fault(const Semantics& semantics) {
  for (const auto fault : {levels_fault, questions_fault, numbers_fault}) {
    std::string found = fault(semantics);
    if (!found.empty()) return found;
  }
  return "";
}

}  // namespace contactcheck::plugin
