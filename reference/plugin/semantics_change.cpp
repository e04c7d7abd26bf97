#include "core/types/check.h"
#include "reference/plugin/declaration.h"

namespace contactcheck::plugin {
namespace {

// The first that differs, by its key in a declaration.
const char* changed_key(const Semantics& before, const Semantics& now) {
  if (before.levels != now.levels) return "levels";
  if (before.informative != now.informative) return "informative";
  if (before.questions != now.questions) return "questions";
  if (before.solid != now.solid) return "body";
  if (before.closed != now.closed) return "touching";
  if (before.exact != now.exact) return "exact";
  if (before.precision != now.precision) return "precision";
  if (before.depth != now.depth) return "depth_kind";
  if (before.whole_cells != now.whole_cells) return "whole_cells";
  if (before.means != now.means) return "means";
  return nullptr;
}

}  // namespace

void require_same_claims(const std::string& from, const Semantics& before, const Semantics& now) {
  if (const char* const key = changed_key(before, now)) refuse_change(from, key);
}

void refuse_change(const std::string& from, const std::string& key) {
  throw InputError(from + " declares another \"" + key +
                   "\" after prepare than before: only scale and margin may change then");
}

}  // namespace contactcheck::plugin
