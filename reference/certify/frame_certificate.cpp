#include "reference/certify/frame_certificate.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace contactcheck::certify {
namespace {

using oracle::TriangleCorners;

// An axis along which two closed boxes are apart; -1 when they overlap.
int parting_axis(const Aabb& a, const Aabb& b) {
  for (int axis = 0; axis < 3; ++axis)
    if (a.hi[axis] < b.lo[axis] || b.hi[axis] < a.lo[axis]) return axis;
  return -1;
}

/// One pair of bodies in one frame.
class PairCertifier {
 public:
  PairCertifier(const Frame& frame, const std::vector<Body>& bodies,
                const std::vector<RangeTree>& trees, const std::vector<ElementPair>& touching,
                FrameCertificate& out)
      : frame_(frame), bodies_(bodies), trees_(trees), touching_(touching), out_(out) {}

  void certify(BodyPair pair) {
    pair_ = pair;
    cover(tree_a().all(), tree_b().all());
  }

 private:
  const RangeTree& tree_a() const { return trees_[pair_.a]; }
  const RangeTree& tree_b() const { return trees_[pair_.b]; }

  void cover(const Range& a, const Range& b) {
    const Aabb &box_a = tree_a().box(a), &box_b = tree_b().box(b);
    const int axis = parting_axis(box_a, box_b);
    if (axis >= 0) {
      out_.decisions += "xyz"[axis];
    } else if (a.size() == 1 && b.size() == 1) {
      decide({pair_.a, pair_.b, tree_a().order()[a.first], tree_b().order()[b.first]});
    } else if (b.size() == 1 ||
               (a.size() > 1 && box_a.extent().maxCoeff() >= box_b.extent().maxCoeff())) {
      out_.decisions += 'a';
      cover(a.lower_half(), b);
      cover(a.upper_half(), b);
    } else {
      out_.decisions += 'b';
      cover(a, b.lower_half());
      cover(a, b.upper_half());
    }
  }

  void decide(const ElementPair& triangles) {
    const TriangleCorners p = corners(pair_.a, triangles.a), q = corners(pair_.b, triangles.b);
    if (std::binary_search(touching_.begin(), touching_.end(), triangles)) {
      auto witness = common_point(p, q);
      if (!witness) refuse(triangles, "share a point");
      out_.decisions += 't';
      out_.contacts.push_back({triangles, std::move(*witness)});
    } else {
      auto plane = separating_plane(p, q);
      if (!plane) refuse(triangles, "are apart");
      out_.decisions += 's';
      out_.gaps.push_back({triangles, std::move(*plane)});
    }
  }

  TriangleCorners corners(std::uint32_t body, std::uint32_t triangle) const {
    const Triangle& t = bodies_[body].shape->mesh.triangles[triangle];
    const auto vertices = frame_.bodies[body].vertices;
    return {vertices[t[0]], vertices[t[1]], vertices[t[2]]};
  }

  [[noreturn]] void refuse(const ElementPair& t, const std::string& verdict) const {
    throw std::runtime_error("the oracle says that triangle " + std::to_string(t.a) + " of \"" +
                             bodies_[t.body_a].name + "\" and triangle " + std::to_string(t.b) +
                             " of \"" + bodies_[t.body_b].name + "\" " + verdict + " in frame " +
                             std::to_string(frame_.index) + ", which is not so");
  }

  const Frame& frame_;
  const std::vector<Body>& bodies_;
  const std::vector<RangeTree>& trees_;
  const std::vector<ElementPair>& touching_;
  FrameCertificate& out_;
  BodyPair pair_;
};

template <typename Certified>
void sort_by_triangles(std::vector<Certified>& certified) {
  std::sort(certified.begin(), certified.end(),
            [](const Certified& x, const Certified& y) { return x.triangles < y.triangles; });
}

}  // namespace

Certifier::Certifier(const std::vector<Body>& bodies) : bodies_(bodies) {
  for (const Body& body : bodies) trees_.emplace_back(body.shape->mesh);
}

FrameCertificate Certifier::certify(const Frame& frame, const std::vector<ElementPair>& touching) {
  for (std::size_t b = 0; b < trees_.size(); ++b) trees_[b].refit(frame.bodies[b].vertices);
  FrameCertificate out;
  PairCertifier certifier(frame, bodies_, trees_, touching, out);
  const auto count = static_cast<std::uint32_t>(bodies_.size());
  for (std::uint32_t a = 0; a < count; ++a)
    for (std::uint32_t b = a + 1; b < count; ++b) certifier.certify({a, b});
  // Every contact was told as one, so that equal numbers mean equal sets.
  if (out.contacts.size() != touching.size())
    throw std::runtime_error("the oracle reports " + std::to_string(touching.size()) +
                             " pairs of triangles in frame " + std::to_string(frame.index) +
                             ", and only " + std::to_string(out.contacts.size()) +
                             " have boxes that meet");
  sort_by_triangles(out.contacts);
  sort_by_triangles(out.gaps);
  return out;
}

}  // namespace contactcheck::certify
