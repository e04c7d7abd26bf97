// Holds a detector's answers against the truth, frame by frame, at each level it claims.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/deform/body.h"
#include "core/types/contact_set.h"
#include "core/types/semantics.h"
#include "reference/oracle/oracle.h"
#include "reference/results/results.h"

namespace contactcheck {

/// How many missed and how many spurious pairs of a frame are listed: as many as a picture can
/// show.
inline constexpr std::size_t kListedPairs = 500;

/// How many of a frame's pairs there are, and the first of them in canonical order.
struct ListedPairs {
  std::uint64_t count = 0;
  std::vector<ElementPair> pairs;
};

/// What a frame's answer lacks and what it has too much, at the level of results::PerFrame. The
/// elements of a pair are those that the level counts: missed at level `cell` are triangles; a
/// level of bodies has none, and of `vertex` only the first is one (what is none is 0).
struct FrameDifferences {
  std::size_t frame = 0;
  ListedPairs missed, spurious;
};

/// With the contact that it is about, which its case file shows.
struct Disagreement : results::Disagreement {
  ElementPair pair;
};

/// Why a level cannot be judged on these bodies ("not judged: open"), or "".
std::string obstacle_to_judging(Level level, const std::vector<Body>& bodies);

/// The levels at which an answer is held against the truth: claimed (or informative) and wanted by
/// the scene.
/// Levels that need a solid or a lattice and lack it are left out and named in `not_judged`.
std::vector<Level> judged_levels(const std::vector<Body>& bodies, const Semantics& semantics,
                                 const std::vector<Level>& wanted,
                                 std::map<Level, std::string>* not_judged);

class Judge {
 public:
  /// `listed`: how many pairs of each kind and frame differences() keeps; 0: it stays empty.
  Judge(const std::vector<Body>& bodies, const Semantics& semantics, std::vector<Level> levels,
        std::size_t listed = 0);

  /// `near`: the true pairs nearer than the margin of the semantics, for the level `near`.
  /// @pre all sets are canonical; frames come in order
  void add_frame(std::size_t frame, const Truth& truth, const ContactSet& reported,
                 const std::vector<NearPair>& near = {});

  /// With rates, and the margin of level near.
  results::Levels levels() const;
  const results::PerFrame& per_frame() const { return per_frame_; }
  /// Frames without any are left out.
  const std::vector<FrameDifferences>& differences() const { return differences_; }
  /// The first missed and the first spurious contact of each level claimed; scene and detector left
  /// empty.
  const std::vector<Disagreement>& disagreements() const { return disagreements_; }

 private:
  results::LevelCounts judge_level(Level level, std::size_t frame, const Truth& truth,
                                   const ContactSet& reported, const std::vector<NearPair>& near);
  template <typename T>
  results::LevelCounts compare_sets(Level level, std::size_t frame, const std::vector<T>& truth,
                                    const std::vector<T>& reported);
  results::LevelCounts judge_cells(std::size_t frame, const std::vector<ElementPair>& truth,
                                   const std::vector<ElementPair>& reported);
  template <typename T>
  void note_and_list(Level level, std::size_t frame, const std::vector<T>& missed,
                     const std::vector<T>& spurious);
  void note(Level level, const char* kind, std::size_t frame, const ElementPair& pair);
  template <typename T>
  ListedPairs listed(const std::vector<T>& pairs) const;

  const std::vector<Body>& bodies_;
  Semantics semantics_;
  std::vector<Level> wanted_;
  std::size_t listed_;
  results::Levels levels_;
  results::PerFrame per_frame_;
  std::vector<FrameDifferences> differences_;
  std::vector<Disagreement> disagreements_;
};

}  // namespace contactcheck
