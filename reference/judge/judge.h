// Compares a detector's answers with the ground truth, at each level and stage by stage.
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/deform/body.h"
#include "core/detect/detector.h"
#include "core/types/contact_set.h"
#include "core/types/semantics.h"
#include "reference/oracle/oracle.h"
#include "reference/results/results.h"

namespace contactcheck::judge {

/// The limits, per frame, of listed missed and of listed spurious pairs: a picture shows no more.
inline constexpr std::size_t kListedPairs = 500;

/// The number of a frame's pairs, and the first of them in canonical order.
struct ListedPairs {
  std::uint64_t count = 0;
  std::vector<ElementPair> pairs;
};

/// The missed and spurious contacts of a frame, at the level of results::PerFrame. A pair names the
/// elements that the level counts: triangles where level `cell` misses them, only the first element
/// at level `vertex`, and no elements at levels of bodies. An element that is not named is 0.
struct FrameDifferences {
  std::size_t frame = 0;
  ListedPairs missed, spurious;
};

/// A disagreement with its contact, which the case file shows.
struct Disagreement : results::Disagreement {
  ElementPair pair;
};
/// The kinds of elements that the pair of a disagreement names; no kinds if `level` is not a level.
NamedElements elements_of(const std::string& level, const std::string& kind);

/// Adds to `open`, indexed by body, a text for every body in `found` that has none yet: "open (body
/// "cube", frame 3, edge of vertices 4 and 5)".
void note_open_bodies(const std::vector<Body>& bodies, std::size_t frame,
                      const std::vector<oracle::OpenBody>& found, std::vector<std::string>& open);

/// Why a level cannot be judged on these bodies ("not judged: a body has no lattice"), or "".
/// `open`: by body, as note_open_bodies() fills it; an empty text means closed.
std::string obstacle_to_judging(Level level, const std::vector<Body>& bodies,
                                const std::vector<std::string>& open);

/// The levels at which an answer is compared: claimed (or informative) and wanted by the scene. A
/// level that lacks its solids or lattices is left out, and `not_judged` says why.
std::vector<Level> judged_levels(const std::vector<Body>& bodies,
                                 const std::vector<std::string>& open, const Semantics& semantics,
                                 const std::vector<Level>& wanted,
                                 std::map<Level, std::string>* not_judged);

/// The part of `semantics` that a scene wants: contact of bodies with themselves, and within steps,
/// only if the scene has a level of it, and only these if it has no other. A question that is left
/// out is not asked and costs nothing. No question is left of a detector that answers about steps
/// alone, in a scene without a level of them.
Semantics semantics_in(const std::vector<Level>& wanted, Semantics semantics);

/// The level (self, self-vertex or self-edge) of two different triangles of a shape; none for
/// duplicates, which name the same vertices.
std::optional<Level> self_level(const BodyShape& shape, std::uint32_t a, std::uint32_t b);

/// The pairs of `pairs` that belong to `level`, one of these three.
std::vector<SelfPair> self_pairs(Level level, const std::vector<Body>& bodies,
                                 const std::vector<SelfPair>& pairs);

/// The pairs of `pairs` for which no cell of one triangle shares a node with a cell of the other:
/// the ground truth of level self-cell.
/// @pre their bodies have lattices
std::vector<SelfPair> pairs_of_cells_apart(const std::vector<Body>& bodies,
                                           const std::vector<SelfPair>& pairs);

/// The question whose answer is judged at `level`: `self` for levels of self-contact, `impacts` and
/// `self-impacts` for those of steps; else the question about the level (`body`, `triangles`,
/// `cells`) if the detector answers it; else its first question of frames other than `body` and
/// `self`; else `body`, whose answer may end early.
Question question_of(Level level, const Semantics& semantics);
/// The question whose answer a list is judged by. Depths and normals are those of `contacts`.
Question question_about(ContactList list, const Semantics& semantics);

/// An answer to one frame, compared with the ground truth at one level.
struct LevelComparison {
  results::LevelCounts counts;  ///< without rates
  /// In canonical order; they name the same elements as FrameDifferences.
  std::vector<ElementPair> missed, spurious;
};

template <typename Record>
bool holds(const std::vector<Record>& sorted, const Record& record) {
  return std::binary_search(sorted.begin(), sorted.end(), record);
}

// Records of any list as pairs of elements, in the same order.
inline ElementPair as_pair(const ElementPair& p) { return p; }
inline ElementPair as_pair(const BodyPair& p) { return {p.a, p.b, 0, 0}; }
inline ElementPair as_pair(const VertexInBody& v) { return {v.body, v.in, v.vertex, 0}; }
inline ElementPair as_pair(const NearPair& p) { return {p.body, p.other, p.vertex, p.triangle}; }
inline ElementPair as_pair(const SelfPair& p) { return {p.body, p.body, p.a, p.b}; }
inline ElementPair as_pair(const BodyImpact& p) { return as_pair(p.bodies); }
inline ElementPair as_pair(std::uint32_t body) { return {body, body, 0, 0}; }

/// What two canonical lists of one kind do not share, and all counts.
template <typename Record>
LevelComparison compare_lists(const std::vector<Record>& truth,
                              const std::vector<Record>& reported) {
  const auto pairs_of = [](const std::vector<Record>& list) {
    std::vector<ElementPair> out;
    out.reserve(list.size());
    for (const Record& record : list) out.push_back(as_pair(record));
    return out;
  };
  const std::vector<ElementPair> true_pairs = pairs_of(truth), answered = pairs_of(reported);
  LevelComparison out;
  std::set_difference(true_pairs.begin(), true_pairs.end(), answered.begin(), answered.end(),
                      std::back_inserter(out.missed));
  std::set_difference(answered.begin(), answered.end(), true_pairs.begin(), true_pairs.end(),
                      std::back_inserter(out.spurious));
  out.counts.truth = truth.size();
  out.counts.reported = reported.size();
  out.counts.missed = out.missed.size();
  out.counts.spurious = out.spurious.size();
  out.counts.hit = out.counts.truth - out.counts.missed;
  return out;
}

/// Pairs nearer than a margin, for each level that has one.
using TrueNear = std::map<Level, std::vector<NearPair>>;
/// The pairs of those of `levels` that have a margin. `margin`: in the coordinates of the frame.
TrueNear true_near(oracle::Oracle& oracle, const Frame& frame, const std::vector<Level>& levels,
                   double margin);

/// The pairs of bodies in contact, canonical; `solid` adds containment, for detectors that treat
/// bodies as solids.
std::vector<BodyPair> true_body_pairs(bool solid, const oracle::Truth& truth);

/// `near`: the true pairs within the detector's margin, for the levels `near` and `self-near`.
/// @pre all sets are canonical; the level is one of frames (compare_step_at: of steps)
LevelComparison compare_at(Level level, const std::vector<Body>& bodies, const Semantics& semantics,
                           const oracle::Truth& truth, const ContactSet& reported,
                           const TrueNear& near = {});

/// The comparisons of one detector's answers, summed over the frames of a scene.
class LevelTotals {
 public:
  /// `listed`: the most pairs of each kind and frame that `differences` keeps; 0 keeps none.
  LevelTotals(const Semantics& semantics, const std::vector<Level>& compared,
              std::size_t listed = 0);
  /// @pre frames come in order
  void add(std::size_t frame, Level level, const LevelComparison& comparison);

  results::Levels levels;                     ///< with rates, near levels with their margin
  results::PerFrame per_frame;                ///< at the finest level claimed and compared
  std::vector<FrameDifferences> differences;  ///< the frames that have any
  /// The first missed and the first spurious contact of each claimed level; the caller sets scene
  /// and detector.
  std::vector<Disagreement> disagreements;

 private:
  std::vector<Level> informative_;
  std::size_t listed_;
};

/// Adds a frame to the sums of a detector's stages. A stage's `missed` counts the true pairs that
/// all stages before it covered and that its own output does not cover.
void add_stages(const std::vector<Body>& bodies, const StageTrace& trace,
                const std::vector<ElementPair>& true_triangles,
                std::vector<results::Stage>& stages);

/// True if some pair of cells in `cells` (canonical) belongs to the labels of the two triangles.
/// Marks each such pair in `covering`, by its index in `cells`.
bool covered_by_cells(const std::vector<Body>& bodies, const std::vector<ElementPair>& cells,
                      const ElementPair& triangles, std::vector<char>* covering = nullptr);

}  // namespace contactcheck::judge
