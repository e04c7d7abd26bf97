// The base of adapters for libraries that test two bodies at a time. Sweep and prune over the
// bodies' boxes finds the candidate pairs; a body without a candidate pair is not given to the
// library in that frame.
//
// With prefilter=nodes the boxes are first those of the lattice nodes, and only bodies of a
// candidate pair are mapped, by the detector itself, which gives a reference the same prefilter as
// ffd-lazy. A box of nodes contains the body up to rounding, since a mapped vertex is a mean of its
// cell's nodes.
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

/// The common part of DetectorInfo::given.
inline constexpr const char* kSweepAndPrune =
    "sweep and prune over the bodies' boxes; bodies that meet no other are not refitted; ";

/// The largest |coordinate| of a box that is not empty.
inline double largest_coordinate(const Aabb& box) {
  return std::max(box.lo.cwiseAbs().maxCoeff(), box.hi.cwiseAbs().maxCoeff());
}

/// A body in at least one candidate pair of the frame.
struct CandidateBody {
  std::uint32_t body = 0;
  std::span<const Vec3> vertices;  ///< valid until the next update
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

  /// To be called by prepare(). `margin`: metres by which the library's boxes exceed the vertices;
  /// `rounding`: the same as a share of the coordinates.
  /// @throws RefusedInput as refuse_many_adjacent_pairs() does, if self-contact is expected;
  /// otherwise query() does
  void set_bodies(const std::vector<Body>& bodies, double margin = 0.0, double rounding = 0.0);
  /// Refuses coordinates that the library cannot take. Called for every body in every frame.
  /// @throws RefusedInput
  virtual void check(const Aabb&) const {}
  /// Updates the bodies that may meet another in this frame; the others keep their state.
  virtual void move(std::span<const CandidateBody> bodies) = 0;
  /// Called for the candidate pairs of the frame, one after another, ascending.
  virtual void collide(BodyPair pair, Question question, ContactSet& out) = 0;
  /// Called after move() of the body, for detectors that answer the question `self`.
  virtual void collide_self(std::uint32_t, ContactSet&) {}

  const std::vector<BodyPair>& candidate_pairs() const { return pairs_; }
  /// The bodies that the last update gave to move().
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
