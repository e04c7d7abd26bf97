#include "reference/judge/judge.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include "core/types/check.h"
#include "core/types/shared_corners.h"
#include "reference/oracle/closed_chain.h"
#include "reference/text/file_text.h"

namespace contactcheck::judge {
namespace {

bool all_in_lattices(const std::vector<Body>& bodies) {
  return std::all_of(bodies.begin(), bodies.end(),
                     [](const Body& b) { return b.shape->lattice.has_value(); });
}

std::vector<ElementPair> as_pairs(const std::vector<SelfPair>& pairs) {
  std::vector<ElementPair> out;
  for (const SelfPair& p : pairs) out.push_back(as_pair(p));
  return out;
}

bool contains(const std::vector<Level>& levels, Level level) {
  return std::find(levels.begin(), levels.end(), level) != levels.end();
}

// Do the true triangles of a pair get past this stage?
bool covers(const std::vector<Body>& bodies, const StageTrace& trace, const StageRecord& stage,
            const ElementPair& pair) {
  const auto has_bodies = [&] {
    return std::binary_search(stage.bodies.begin(), stage.bodies.end(),
                              BodyPair{pair.body_a, pair.body_b});
  };
  const auto has_active_label = [&](std::uint32_t body, std::uint32_t triangle) {
    const auto cells = bodies[body].shape->embedding.cells_of_triangle(triangle);
    return std::any_of(cells.begin(), cells.end(),
                       [&](std::uint32_t cell) { return stage.active[body][cell] != 0; });
  };
  switch (stage.kind) {
    case StageRecord::Kind::kBodies:
      return has_bodies();
    case StageRecord::Kind::kActiveLabelCells:
      return has_bodies() && has_active_label(pair.body_a, pair.a) &&
             has_active_label(pair.body_b, pair.b);
    case StageRecord::Kind::kActiveOwnerCells:
      return has_bodies() && stage.active[pair.body_a][trace.owner[pair.body_a][pair.a]] &&
             stage.active[pair.body_b][trace.owner[pair.body_b][pair.b]];
    case StageRecord::Kind::kLabelCells:
      return covered_by_cells(bodies, stage.elements, pair);
    case StageRecord::Kind::kOwnerCells: {
      const ElementPair owners{pair.body_a, pair.body_b, trace.owner[pair.body_a][pair.a],
                               trace.owner[pair.body_b][pair.b]};
      return std::binary_search(stage.elements.begin(), stage.elements.end(), owners);
    }
    case StageRecord::Kind::kTriangles:
      return std::binary_search(stage.elements.begin(), stage.elements.end(), pair);
  }
  return false;
}

// Do two triangles of a body lie in cells of which all of the one are apart from all of the other?
// Then their contact is one of cells apart, wherever it is.
bool in_cells_apart(const BodyShape& shape, const SelfPair& triangles) {
  for (const std::uint32_t a : shape.embedding.cells_of_triangle(triangles.a))
    for (const std::uint32_t b : shape.embedding.cells_of_triangle(triangles.b))
      if (share_node(*shape.lattice, a, b)) return false;
  return true;
}

// Contact between bodies and within them, in frames and within steps, are computed only where a
// scene names them.
enum class Subject { kFrames, kSelf, kSteps, kSelfSteps };

Subject subject_of(Level level) {
  return is_self(level)          ? Subject::kSelf
         : is_self_impact(level) ? Subject::kSelfSteps
         : is_impact(level)      ? Subject::kSteps
                                 : Subject::kFrames;
}

Subject subject_of(Question question) {
  return question == Question::kSelf          ? Subject::kSelf
         : question == Question::kSelfImpacts ? Subject::kSelfSteps
         : question == Question::kImpacts     ? Subject::kSteps
                                              : Subject::kFrames;
}

}  // namespace

NamedElements elements_of(const std::string& level, const std::string& kind) {
  const std::optional<Level> known = level_from_name(level);
  return known ? named_elements(*known, kind == "missed") : NamedElements{};
}

void note_open_bodies(const std::vector<Body>& bodies, std::size_t frame,
                      const std::vector<oracle::OpenBody>& found, std::vector<std::string>& open) {
  open.resize(bodies.size());
  for (const oracle::OpenBody& o : found)
    if (open[o.body].empty())
      open[o.body] = oracle::open_reason(
          o.edge, bodies[o.body].shape->given,
          "body " + text::in_quotes(bodies[o.body].name) + ", frame " + std::to_string(frame));
}

std::string obstacle_to_judging(Level level, const std::vector<Body>& bodies,
                                const std::vector<std::string>& open) {
  const bool needs_solid = level == Level::kContainment || level == Level::kVertex;
  const auto first =
      std::find_if(open.begin(), open.end(), [](const auto& o) { return !o.empty(); });
  if (needs_solid && first != open.end()) return "not judged: " + *first;
  const bool needs_lattice =
      level == Level::kCell || level == Level::kBox || level == Level::kSelfCell;
  if (needs_lattice && !all_in_lattices(bodies)) return "not judged: a body has no lattice";
  return "";
}

std::vector<Level> judged_levels(const std::vector<Body>& bodies,
                                 const std::vector<std::string>& open, const Semantics& semantics,
                                 const std::vector<Level>& wanted,
                                 std::map<Level, std::string>* not_judged) {
  std::vector<Level> out;
  std::vector<Level> levels = semantics.levels;
  levels.insert(levels.end(), semantics.informative.begin(), semantics.informative.end());
  for (Level level : levels) {
    if (!contains(wanted, level)) continue;
    const std::string why = obstacle_to_judging(level, bodies, open);
    if (why.empty()) {
      out.push_back(level);
    } else if (not_judged != nullptr) {
      (*not_judged)[level] = why;
    }
  }
  return out;
}

Semantics semantics_in(const std::vector<Level>& wanted, Semantics semantics) {
  const auto is_wanted = [&](auto subject) {
    return std::any_of(wanted.begin(), wanted.end(),
                       [&](Level level) { return subject_of(level) == subject_of(subject); });
  };
  std::erase_if(semantics.levels, [&](Level level) { return !is_wanted(level); });
  const auto unwanted = [&](Question question) { return !is_wanted(question); };
  // One of frames that answers nothing of it is asked and timed all the same.
  if (!is_of_steps(semantics.questions.front()) &&
      std::all_of(semantics.questions.begin(), semantics.questions.end(), unwanted))
    return semantics;
  std::erase_if(semantics.questions, unwanted);
  return semantics;
}

std::optional<Level> self_level(const BodyShape& shape, std::uint32_t a, std::uint32_t b) {
  const SharedCorners shared = shared_corners(shape.linked()[a], shape.linked()[b]);
  if (shared.duplicates) return std::nullopt;
  return shared.count == 0   ? Level::kSelf
         : shared.count == 1 ? Level::kSelfVertex
                             : Level::kSelfEdge;
}

std::vector<SelfPair> self_pairs(Level level, const std::vector<Body>& bodies,
                                 const std::vector<SelfPair>& pairs) {
  std::vector<SelfPair> out;
  for (const SelfPair& p : pairs)
    if (self_level(*bodies[p.body].shape, p.a, p.b) == level) out.push_back(p);
  return out;
}

std::vector<SelfPair> pairs_of_cells_apart(const std::vector<Body>& bodies,
                                           const std::vector<SelfPair>& pairs) {
  std::vector<SelfPair> out;
  for (const SelfPair& p : pairs)
    if (in_cells_apart(*bodies[p.body].shape, p)) out.push_back(p);
  return out;
}

Question question_of(Level level, const Semantics& semantics) {
  std::optional<Question> about;  // of vertices and near pairs there is none
  if (level == Level::kBody || level == Level::kContainment) about = Question::kBody;
  if (level == Level::kCell || level == Level::kBox) about = Question::kCells;
  if (level == Level::kTriangle) about = Question::kTriangles;
  if (is_self(level)) return Question::kSelf;
  if (is_impact(level)) return is_self_impact(level) ? Question::kSelfImpacts : Question::kImpacts;
  if (about && semantics.answers(*about)) return *about;
  for (const Question question : semantics.questions)
    if (question != Question::kBody && subject_of(question) == Subject::kFrames) return question;
  return Question::kBody;
}

Question question_about(ContactList list, const Semantics& semantics) {
  switch (list) {
    case ContactList::kBodies:
      return question_of(Level::kBody, semantics);
    case ContactList::kCells:
      return question_of(Level::kCell, semantics);
    case ContactList::kTriangles:
      return question_of(Level::kTriangle, semantics);
    case ContactList::kVertices:
      return question_of(Level::kVertex, semantics);
    case ContactList::kNear:
      return question_of(Level::kNear, semantics);
    case ContactList::kSelfBodies:
    case ContactList::kSelf:
    case ContactList::kSelfCells:
    case ContactList::kSelfNear:
      return question_of(Level::kSelf, semantics);
    case ContactList::kImpacts:
    case ContactList::kImpactTriangles:
    case ContactList::kImpactVertices:
    case ContactList::kImpactEdges:
      return Question::kImpacts;
    case ContactList::kSelfImpactVertices:
    case ContactList::kSelfImpactEdges:
      return Question::kSelfImpacts;
    case ContactList::kPieceContacts:
    case ContactList::kVertexContacts:
      return Question::kContacts;
  }
  return semantics.questions.front();
}

TrueNear true_near(oracle::Oracle& oracle, const Frame& frame, const std::vector<Level>& levels,
                   double margin) {
  TrueNear out;
  for (const Level level : levels) {
    if (level == Level::kNear) out[level] = oracle.near(frame, margin);
    if (level == Level::kSelfNear) out[level] = oracle.self_near(frame, margin);
  }
  return out;
}

std::vector<BodyPair> true_body_pairs(bool solid, const oracle::Truth& truth) {
  std::vector<BodyPair> out = truth.surface.bodies;
  if (!solid) return out;
  out.insert(out.end(), truth.containment.begin(), truth.containment.end());
  std::sort(out.begin(), out.end());
  return out;
}

LevelComparison compare_at(Level level, const std::vector<Body>& bodies, const Semantics& semantics,
                           const oracle::Truth& truth, const ContactSet& reported,
                           const TrueNear& near) {
  LevelComparison out;
  switch (level) {
    case Level::kBody:
      return compare_lists(true_body_pairs(semantics.solid, truth), reported.bodies);
    case Level::kContainment: {
      // A solid detector has one list for both kinds of contact. Level `body` judges the pairs
      // whose surfaces truly touch.
      std::vector<BodyPair> contained;
      std::set_difference(reported.bodies.begin(), reported.bodies.end(),
                          truth.surface.bodies.begin(), truth.surface.bodies.end(),
                          std::back_inserter(contained));
      return compare_lists(truth.containment, contained);
    }
    case Level::kCell: {
      // Truth, hit and missed count triangle pairs; reported and spurious count cell pairs.
      std::vector<char> covering(reported.cells.size(), 0);
      for (const ElementPair& pair : truth.surface.triangles)
        if (!covered_by_cells(bodies, reported.cells, pair, &covering)) out.missed.push_back(pair);
      for (std::size_t i = 0; i < covering.size(); ++i)
        if (covering[i] == 0) out.spurious.push_back(reported.cells[i]);
      out.counts.truth = truth.surface.triangles.size();
      out.counts.reported = reported.cells.size();
      break;
    }
    case Level::kBox:
      return compare_lists(truth.boxes, reported.cells);
    case Level::kTriangle:
      return compare_lists(truth.surface.triangles, reported.triangles);
    case Level::kVertex:
      return compare_lists(truth.surface.vertices, reported.vertices);
    case Level::kNear:
      return compare_lists(near.at(level), reported.near);
    case Level::kSelfNear:
      return compare_lists(near.at(level), reported.self_near);
    case Level::kSelf:
    case Level::kSelfVertex:
    case Level::kSelfEdge:
      return compare_lists(self_pairs(level, bodies, truth.surface.self),
                           self_pairs(level, bodies, reported.self));
    case Level::kSelfBody:
      return compare_lists(truth.surface.self_bodies, reported.self_bodies);
    case Level::kSelfCell: {
      // As kCell: pairs of triangles, and pairs of cells. What can be found in neighbouring cells
      // is not claimed, and no error where it is found.
      const std::vector<ElementPair> cells = as_pairs(reported.self_cells);
      std::vector<char> covering(cells.size(), 0);
      for (const SelfPair& p : truth.surface.self) {
        const ElementPair pair{p.body, p.body, p.a, p.b};
        const bool covered = covered_by_cells(bodies, cells, pair, &covering);
        if (!in_cells_apart(*bodies[p.body].shape, p)) continue;
        ++out.counts.truth;
        if (!covered) out.missed.push_back(pair);
      }
      for (std::size_t i = 0; i < covering.size(); ++i)
        if (covering[i] == 0) out.spurious.push_back(cells[i]);
      out.counts.reported = reported.self_cells.size();
      break;
    }
    case Level::kImpactVf:
    case Level::kImpactEe:
    case Level::kImpactTriangle:
    case Level::kImpact:
    case Level::kImpactSelfVf:
    case Level::kImpactSelfEe:
      CONTACTCHECK_INVARIANT(false, "levels of steps are compared by compare_step_at()");
  }
  out.counts.missed = out.missed.size();
  out.counts.spurious = out.spurious.size();
  out.counts.hit = out.counts.truth - out.counts.missed;
  return out;
}

LevelTotals::LevelTotals(const Semantics& semantics, const std::vector<Level>& compared,
                         std::size_t listed)
    : informative_(semantics.informative), listed_(listed) {
  for (const Level level : compared) {
    levels[level].informative = !semantics.claims(level);
    if (level == Level::kNear || level == Level::kSelfNear) levels[level].margin = semantics.margin;
  }
  if (compared.empty()) return;
  const auto finest = std::find_if(kFineToCoarse.begin(), kFineToCoarse.end(), [&](Level level) {
    return contains(compared, level) && !contains(informative_, level);
  });
  per_frame.level = finest == kFineToCoarse.end() ? Level::kBody : *finest;
}

void LevelTotals::add(std::size_t frame, Level level, const LevelComparison& comparison) {
  results::LevelCounts& sums = levels.at(level);
  sums += comparison.counts;
  sums.set_rates();
  const auto note_first = [&](const char* kind, const std::vector<ElementPair>& pairs) {
    if (pairs.empty() || contains(informative_, level)) return;
    for (const Disagreement& d : disagreements)
      if (d.level == name_of(level) && d.kind == kind) return;
    Disagreement& d = disagreements.emplace_back();
    d.level = name_of(level);
    d.kind = kind;
    d.frame = frame;
    d.pair = pairs.front();
  };
  note_first("missed", comparison.missed);
  note_first("spurious", comparison.spurious);
  if (per_frame.level != level) return;
  per_frame.truth.push_back(comparison.counts.truth);
  per_frame.missed.push_back(comparison.counts.missed);
  per_frame.spurious.push_back(comparison.counts.spurious);
  if (listed_ == 0 || (comparison.missed.empty() && comparison.spurious.empty())) return;
  const auto first_of = [this](const std::vector<ElementPair>& pairs) {
    const std::size_t count = std::min(listed_, pairs.size());
    return ListedPairs{pairs.size(), {pairs.data(), pairs.data() + count}};
  };
  differences.push_back({frame, first_of(comparison.missed), first_of(comparison.spurious)});
}

void add_stages(const std::vector<Body>& bodies, const StageTrace& trace,
                const std::vector<ElementPair>& true_triangles,
                std::vector<results::Stage>& stages) {
  if (stages.empty()) {
    for (const StageRecord& record : trace.stages) {
      results::Stage& stage = stages.emplace_back();
      stage.name = record.name;
      stage.unit = record.unit;
      stage.visited_unit = record.visited_unit;
      if (!record.visited_unit.empty()) stage.visited = 0;
    }
  }
  CONTACTCHECK_INVARIANT(stages.size() == trace.stages.size(), "stages do not change over frames");
  std::vector<ElementPair> covered = true_triangles;
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const StageRecord& record = trace.stages[i];
    stages[i].in += record.in;
    stages[i].out += record.out;
    if (stages[i].visited) *stages[i].visited += record.visited;
    stages[i].missed += std::erase_if(
        covered, [&](const ElementPair& pair) { return !covers(bodies, trace, record, pair); });
  }
}

bool covered_by_cells(const std::vector<Body>& bodies, const std::vector<ElementPair>& cells,
                      const ElementPair& triangles, std::vector<char>* covering) {
  bool covered = false;
  const Embedding& first = bodies[triangles.body_a].shape->embedding;
  const Embedding& second = bodies[triangles.body_b].shape->embedding;
  for (std::uint32_t a : first.cells_of_triangle(triangles.a)) {
    for (std::uint32_t b : second.cells_of_triangle(triangles.b)) {
      ElementPair pair{triangles.body_a, triangles.body_b, a, b};
      if (pair.body_a == pair.body_b && a > b) std::swap(pair.a, pair.b);  // as canonical
      const auto it = std::lower_bound(cells.begin(), cells.end(), pair);
      if (it == cells.end() || *it != pair) continue;
      covered = true;
      if (covering != nullptr) (*covering)[static_cast<std::size_t>(it - cells.begin())] = 1;
    }
  }
  return covered;
}

}  // namespace contactcheck::judge
