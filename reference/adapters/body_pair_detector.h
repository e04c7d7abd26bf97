// What the adapters of libraries share that test two bodies at a time: which pairs of bodies are
// worth a test. Sweep and prune over the bodies' boxes names them; a body in none of these pairs is
// not given to the library in that frame.
//
// With prefilter=nodes the boxes are first those of the lattice nodes, and only bodies in a pair of
// these are mapped, by the detector itself: a reference then has what ffd-lazy has. A box of nodes
// holds the body, since a mapped vertex is a mean of its cell's nodes but for rounding.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "core/detect/detector.h"
#include "core/detect/option_info.h"

namespace contactcheck::adapters {

enum class Prefilter { kNone, kNodes };

/// prefilter=none|nodes
OptionInfo prefilter_option();
/// @pre the detector has prefilter_option()
Prefilter prefilter_of(const Options& options);

/// What all of these are given, for DetectorInfo::given.
inline constexpr const char* kSweepAndPrune =
    "sweep and prune over the bodies' boxes; bodies that meet no other are not refitted; ";

/// The largest |coordinate| of a box that is not empty.
inline double largest_coordinate(const Aabb& box) {
  return std::max(box.lo.cwiseAbs().maxCoeff(), box.hi.cwiseAbs().maxCoeff());
}

/// A body in at least one candidate pair of the frame.
struct CandidateBody {
  std::uint32_t body = 0;
  std::span<const Vec3> vertices;  ///< until the next update
  Aabb box;                        ///< of the vertices, exact
};

class BodyPairDetector : public Detector {
 public:
  bool needs_vertices() const final { return prefilter_ == Prefilter::kNone; }
  void expect(const std::vector<Question>& questions) final;
  /// @throws RefusedInput for a coordinate that is not finite
  void update(const Frame& frame) final;
  void query(Question question, ContactSet& out) final;

 protected:
  explicit BodyPairDetector(Prefilter prefilter) : prefilter_(prefilter) {}

  /// For prepare(). `margin`: metres by which the library's own boxes are wider than the vertices;
  /// `rounding`: by how much of a coordinate they may be, too.
  /// @throws RefusedInput as refuse_many_adjacent_pairs() does, where self-contact is expected;
  /// elsewhere query() does
  void set_bodies(const std::vector<Body>& bodies, double margin = 0.0, double rounding = 0.0);
  /// Of every body in every frame: what the library cannot take.
  /// @throws RefusedInput
  virtual void check(const Aabb&) const {}
  /// The bodies that may meet another in this frame; the others keep what they had.
  virtual void move(std::span<const CandidateBody> bodies) = 0;
  /// The candidate pairs of the frame, ascending, one after the other.
  virtual void collide(BodyPair pair, Question question, ContactSet& out) = 0;
  /// A body with itself, after move() of it. Of those that answer the question `self`.
  virtual void collide_self(std::uint32_t, ContactSet&) {}

  const std::vector<BodyPair>& candidate_pairs() const { return pairs_; }
  /// What the last update has given to move().
  const std::vector<CandidateBody>& candidates() const { return candidates_; }
  std::span<const Vec3> vertices(std::uint32_t body) const { return vertices_[body]; }
  const BodyShape& shape(std::uint32_t body) const { return *shapes_[body]; }
  std::size_t body_count() const { return shapes_.size(); }
  bool expects_self() const { return expects_self_; }

 private:
  void move_others();

  const Prefilter prefilter_;
  double margin_ = 0.0, rounding_ = 0.0;
  std::vector<const BodyShape*> shapes_;
  std::vector<Aabb> boxes_, grown_;
  std::vector<BodyPair> pairs_;
  std::vector<CandidateBody> candidates_;
  std::vector<std::span<const Vec3>> vertices_;  // of bodies in a pair
  std::vector<std::vector<Vec3>> mapped_;        // with prefilter=nodes
  std::vector<std::span<const Vec3>> nodes_;     // of the frame
  bool expects_self_ = false;
  bool moved_all_ = false;  // in this frame
};

}  // namespace contactcheck::adapters
