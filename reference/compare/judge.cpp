#include "reference/compare/judge.h"

#include <algorithm>
#include <iterator>

#include "core/types/check.h"
#include "reference/compare/label_cover.h"

namespace contactcheck {
namespace {

bool all_solid(const std::vector<Body>& bodies) {
  return std::all_of(bodies.begin(), bodies.end(),
                     [](const Body& b) { return b.shape->topology.solid; });
}

bool all_in_lattices(const std::vector<Body>& bodies) {
  return std::all_of(bodies.begin(), bodies.end(),
                     [](const Body& b) { return b.shape->lattice.has_value(); });
}

ElementPair as_pair(const ElementPair& p) { return p; }
ElementPair as_pair(const BodyPair& p) { return {p.a, p.b, 0, 0}; }
ElementPair as_pair(const VertexInBody& v) { return {v.body, v.in, v.vertex, 0}; }
ElementPair as_pair(const NearPair& p) { return {p.body, p.other, p.vertex, p.triangle}; }

bool holds(const std::vector<Level>& levels, Level level) {
  return std::find(levels.begin(), levels.end(), level) != levels.end();
}

Level finest(const std::vector<Level>& levels, const Semantics& semantics) {
  for (const Level level : kFineToCoarse)
    if (holds(levels, level) && !holds(semantics.informative, level)) return level;
  return Level::kBody;
}

}  // namespace

std::string obstacle_to_judging(Level level, const std::vector<Body>& bodies) {
  const bool needs_solid = level == Level::kContainment || level == Level::kVertex;
  if (needs_solid && !all_solid(bodies)) return "not judged: open";
  const bool needs_lattice = level == Level::kCell || level == Level::kBox;
  if (needs_lattice && !all_in_lattices(bodies)) return "not judged: a body has no lattice";
  return "";
}

std::vector<Level> judged_levels(const std::vector<Body>& bodies, const Semantics& semantics,
                                 const std::vector<Level>& wanted,
                                 std::map<Level, std::string>* not_judged) {
  std::vector<Level> out;
  std::vector<Level> levels = semantics.levels;
  levels.insert(levels.end(), semantics.informative.begin(), semantics.informative.end());
  for (Level level : levels) {
    if (!holds(wanted, level)) continue;
    const std::string why = obstacle_to_judging(level, bodies);
    if (why.empty()) {
      out.push_back(level);
    } else if (not_judged != nullptr) {
      (*not_judged)[level] = why;
    }
  }
  return out;
}

Judge::Judge(const std::vector<Body>& bodies, const Semantics& semantics, std::vector<Level> levels,
             std::size_t listed)
    : bodies_(bodies), semantics_(semantics), wanted_(std::move(levels)), listed_(listed) {
  for (Level level : wanted_) levels_[level];
  if (!wanted_.empty()) per_frame_.level = finest(wanted_, semantics_);
}

results::Levels Judge::levels() const {
  results::Levels out = levels_;
  for (auto& [level, counts] : out) {
    counts.set_rates();
    if (level == Level::kNear) counts.margin = semantics_.margin;
    counts.informative = !semantics_.claims(level);
  }
  return out;
}

void Judge::note(Level level, const char* kind, std::size_t frame, const ElementPair& pair) {
  if (holds(semantics_.informative, level)) return;
  for (const Disagreement& d : disagreements_)
    if (d.level == name_of(level) && d.kind == kind) return;
  Disagreement d;
  d.level = name_of(level);
  d.kind = kind;
  d.frame = frame;
  d.pair = pair;
  disagreements_.push_back(std::move(d));
}

template <typename T>
ListedPairs Judge::listed(const std::vector<T>& pairs) const {
  ListedPairs out;
  out.count = pairs.size();
  for (std::size_t i = 0; i < std::min(listed_, pairs.size()); ++i)
    out.pairs.push_back(as_pair(pairs[i]));
  return out;
}

template <typename T>
void Judge::note_and_list(Level level, std::size_t frame, const std::vector<T>& missed,
                          const std::vector<T>& spurious) {
  if (!missed.empty()) note(level, "missed", frame, as_pair(missed.front()));
  if (!spurious.empty()) note(level, "spurious", frame, as_pair(spurious.front()));
  if (listed_ == 0 || per_frame_.level != level) return;
  if (missed.empty() && spurious.empty()) return;
  differences_.push_back({frame, listed(missed), listed(spurious)});
}

template <typename T>
results::LevelCounts Judge::compare_sets(Level level, std::size_t frame,
                                         const std::vector<T>& truth,
                                         const std::vector<T>& reported) {
  std::vector<T> missed, spurious;
  std::set_difference(truth.begin(), truth.end(), reported.begin(), reported.end(),
                      std::back_inserter(missed));
  std::set_difference(reported.begin(), reported.end(), truth.begin(), truth.end(),
                      std::back_inserter(spurious));
  note_and_list(level, frame, missed, spurious);
  return {truth.size(), reported.size(), truth.size() - missed.size(), missed.size(),
          spurious.size()};
}

// Truth, hit and missed count triangle pairs; reported and spurious count cell pairs.
results::LevelCounts Judge::judge_cells(std::size_t frame, const std::vector<ElementPair>& truth,
                                        const std::vector<ElementPair>& reported) {
  std::vector<char> covers(reported.size(), 0);
  std::vector<ElementPair> missed, spurious;
  for (const ElementPair& pair : truth)
    if (!covered_by_cells(bodies_, reported, pair, [&](std::size_t i) { covers[i] = 1; }))
      missed.push_back(pair);
  for (std::size_t i = 0; i < reported.size(); ++i)
    if (covers[i] == 0) spurious.push_back(reported[i]);
  note_and_list(Level::kCell, frame, missed, spurious);
  return {truth.size(), reported.size(), truth.size() - missed.size(), missed.size(),
          spurious.size()};
}

results::LevelCounts Judge::judge_level(Level level, std::size_t frame, const Truth& truth,
                                        const ContactSet& reported,
                                        const std::vector<NearPair>& near) {
  switch (level) {
    case Level::kBody: {
      std::vector<BodyPair> bodies = truth.surface.bodies;
      if (semantics_.solid) {
        bodies.insert(bodies.end(), truth.containment.begin(), truth.containment.end());
        std::sort(bodies.begin(), bodies.end());
      }
      return compare_sets(level, frame, bodies, reported.bodies);
    }
    case Level::kContainment: {
      // A solid detector has one list for both kinds of contact: a pair whose surfaces truly touch
      // is the business of the level `body`.
      std::vector<BodyPair> held;
      std::set_difference(reported.bodies.begin(), reported.bodies.end(),
                          truth.surface.bodies.begin(), truth.surface.bodies.end(),
                          std::back_inserter(held));
      return compare_sets(level, frame, truth.containment, held);
    }
    case Level::kCell:
      return judge_cells(frame, truth.surface.triangles, reported.cells);
    case Level::kBox:
      return compare_sets(level, frame, truth.boxes, reported.cells);
    case Level::kTriangle:
      return compare_sets(level, frame, truth.surface.triangles, reported.triangles);
    case Level::kVertex:
      return compare_sets(level, frame, truth.surface.vertices, reported.vertices);
    case Level::kNear:
      return compare_sets(level, frame, near, reported.near);
  }
  CONTACTCHECK_INVARIANT(false, "every level is judged above");
  return {};
}

void Judge::add_frame(std::size_t frame, const Truth& truth, const ContactSet& reported,
                      const std::vector<NearPair>& near) {
  for (Level level : wanted_) {
    const results::LevelCounts counts = judge_level(level, frame, truth, reported, near);
    levels_[level] += counts;
    if (per_frame_.level != level) continue;
    per_frame_.truth.push_back(counts.truth);
    per_frame_.missed.push_back(counts.missed);
    per_frame_.spurious.push_back(counts.spurious);
  }
}

}  // namespace contactcheck
