#include "reference/adapters/body_pair_detector.h"

#include <algorithm>

#include "core/broad/body_pairs.h"
#include "core/deform/mapping.h"
#include "core/types/check.h"

namespace contactcheck::adapters {
namespace {

/// @throws RefusedInput for a coordinate that is not finite, which a box would hide
Aabb box_of(std::span<const Vec3> points) {
  Aabb box;
  Vec3 finite = Vec3::Zero();
  for (const Vec3& p : points) {
    box.extend(p);
    finite += p - p;  // NaN and infinity become NaN and stay it
  }
  if (!(finite.array() == 0.0).all())
    throw RefusedInput("the detector refuses a vertex that is not finite");
  return box;
}

Aabb grown(const Aabb& box, double by) {
  if (box.empty()) return box;
  return {(box.lo.array() - by).matrix(), (box.hi.array() + by).matrix()};
}

}  // namespace

OptionInfo prefilter_option() {
  return choice_option("prefilter", "none", {"none", "nodes"},
                       "nodes: only bodies whose boxes of lattice nodes meet are mapped");
}

Prefilter prefilter_of(const Options& options) {
  return options.at("prefilter") == "nodes" ? Prefilter::kNodes : Prefilter::kNone;
}

void BodyPairDetector::set_bodies(const std::vector<Body>& bodies, double margin, double rounding) {
  margin_ = margin;
  rounding_ = rounding;
  shapes_.clear();
  for (const Body& body : bodies) {
    if (expects_self_) refuse_many_adjacent_pairs(body.shape->linked());
    shapes_.push_back(body.shape.get());
  }
  boxes_.assign(bodies.size(), {});
  vertices_.assign(bodies.size(), {});
  mapped_.assign(bodies.size(), {});
}

void BodyPairDetector::expect(const std::vector<Question>& questions) {
  expects_self_ = std::ranges::find(questions, Question::kSelf) != questions.end();
}

void BodyPairDetector::update(const Frame& frame) {
  CONTACTCHECK_INVARIANT(frame.bodies.size() == shapes_.size(), "one state per prepared body");
  const bool by_nodes = prefilter_ == Prefilter::kNodes;
  const auto reach = [this](const Aabb& box) {
    return margin_ + rounding_ * largest_coordinate(box);
  };
  grown_.clear();
  for (std::size_t b = 0; b < shapes_.size(); ++b) {
    const BodyState& state = frame.bodies[b];
    CONTACTCHECK_INVARIANT(by_nodes || state.vertices.size() == shapes_[b]->mesh.vertices.size(),
                           "one position per vertex");
    boxes_[b] = box_of(by_nodes ? state.nodes : state.vertices);
    check(boxes_[b]);
    const double mapping =
        by_nodes ? 2.0 * mapping_error_bound(largest_coordinate(boxes_[b])) : 0.0;
    grown_.push_back(grown(boxes_[b], mapping + reach(boxes_[b])));
    if (!by_nodes) vertices_[b] = state.vertices;
  }
  nodes_.clear();
  for (const BodyState& state : frame.bodies) nodes_.push_back(state.nodes);
  moved_all_ = false;
  find_candidate_bodies(grown_, pairs_);
  std::vector<char> wanted(shapes_.size(), 0);
  for (const BodyPair& pair : pairs_) wanted[pair.a] = wanted[pair.b] = 1;

  if (by_nodes) {
    for (std::size_t b = 0; b < shapes_.size(); ++b) {
      if (!wanted[b]) continue;
      mapped_[b].resize(shapes_[b]->mesh.vertices.size());
      map_body(*shapes_[b], frame.bodies[b].nodes, mapped_[b]);
      vertices_[b] = mapped_[b];
      boxes_[b] = box_of(mapped_[b]);
      grown_[b] = grown(boxes_[b], reach(boxes_[b]));
    }
    std::erase_if(
        pairs_, [this](const BodyPair& pair) { return !grown_[pair.a].overlaps(grown_[pair.b]); });
    std::ranges::fill(wanted, 0);
    for (const BodyPair& pair : pairs_) wanted[pair.a] = wanted[pair.b] = 1;
  }

  candidates_.clear();
  for (std::uint32_t b = 0; b < shapes_.size(); ++b)
    if (wanted[b]) candidates_.push_back({b, vertices_[b], boxes_[b]});
  move(candidates_);
  if (expects_self_) move_others();
}

void BodyPairDetector::query(Question question, ContactSet& out) {
  CONTACTCHECK_INVARIANT(semantics().answers(question), "only claimed questions are asked");
  if (question == Question::kSelf) {
    for (std::size_t b = 0; !expects_self_ && b < shapes_.size(); ++b)
      refuse_many_adjacent_pairs(shapes_[b]->linked());
    if (!moved_all_) move_others();
    for (std::uint32_t b = 0; b < shapes_.size(); ++b) collide_self(b, out);
    return;
  }
  for (const BodyPair& pair : pairs_) collide(pair, question, out);
}

// A body that meets no other may meet itself.
void BodyPairDetector::move_others() {
  moved_all_ = true;
  std::vector<char> moved(shapes_.size(), 0);
  for (const CandidateBody& candidate : candidates_) moved[candidate.body] = 1;
  std::vector<CandidateBody> others;
  for (std::uint32_t b = 0; b < shapes_.size(); ++b) {
    if (moved[b] != 0) continue;
    if (prefilter_ == Prefilter::kNodes) {
      mapped_[b].resize(shapes_[b]->mesh.vertices.size());
      map_body(*shapes_[b], nodes_[b], mapped_[b]);
      vertices_[b] = mapped_[b];
      boxes_[b] = box_of(mapped_[b]);
    }
    others.push_back({b, vertices_[b], boxes_[b]});
  }
  move(others);
}

}  // namespace contactcheck::adapters
