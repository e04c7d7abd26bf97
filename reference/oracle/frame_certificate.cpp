#include "reference/oracle/frame_certificate.h"

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/types/shared_corners.h"
#include "reference/oracle/floating_point.h"
#include "reference/oracle/surface_tree.h"

namespace contactcheck::oracle::certify {
namespace {

// An axis along which two closed boxes are disjoint; -1 when they overlap.
int separating_axis(const Aabb& a, const Aabb& b) {
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
    if (pair.a == pair.b) {
      cover_own(tree_a().all());
    } else {
      cover(tree_a().all(), tree_b().all());
    }
  }

 private:
  const RangeTree& tree_a() const { return trees_[pair_.a]; }
  const RangeTree& tree_b() const { return trees_[pair_.b]; }

  void cover_own(const Range& range) {
    if (range.size() == 1) return;
    cover_own(range.lower_half());
    cover_own(range.upper_half());
    cover(range.lower_half(), range.upper_half());
  }

  void cover(const Range& a, const Range& b) {
    const Aabb &box_a = tree_a().box(a), &box_b = tree_b().box(b);
    const int axis = separating_axis(box_a, box_b);
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

  void decide(ElementPair triangles) {
    SharedCorners shared;
    if (pair_.a == pair_.b) {
      if (triangles.a > triangles.b) std::swap(triangles.a, triangles.b);
      const std::vector<Triangle>& linked = bodies_[pair_.a].shape->linked();
      shared = shared_corners(linked[triangles.a], linked[triangles.b]);
    }
    if (shared.duplicates) {
      out_.decisions += 'd';
    } else if (shared.count > 0) {
      decide_neighbours(triangles, shared);
    } else {
      decide_strangers(triangles);
    }
  }

  void decide_neighbours(const ElementPair& triangles, const SharedCorners& shared) {
    const auto arranged = [](const TriangleCorners& t, const std::array<std::uint8_t, 3>& order) {
      return TriangleCorners{t[order[0]], t[order[1]], t[order[2]]};
    };
    const TriangleCorners p = arranged(corners(pair_.a, triangles.a), shared.p),
                          q = arranged(corners(pair_.b, triangles.b), shared.q);
    if (std::binary_search(touching_.begin(), touching_.end(), triangles)) {
      const auto found = further_point(p, q, shared.count);
      if (!found) refuse(triangles, "meet in more than they share");
      Witness witness;
      for (std::size_t k = 0; k < 3; ++k) {
        witness.p[shared.p[k]] = found->p[k];
        witness.q[shared.q[k]] = found->q[k];
      }
      out_.decisions += 't';
      out_.contacts.push_back({triangles, std::move(witness)});
    } else if (shared.count == 2 || (!is_proper(p) && !is_proper(q))) {
      if (!share_hull_alone(p, q, shared.count)) refuse(triangles, "share their vertices alone");
      out_.decisions += 'e';
    } else {
      auto plane = plane_through_corner(p, q);
      if (!plane) refuse(triangles, "share their corner alone");
      out_.decisions += 's';
      out_.gaps.push_back({triangles, std::move(*plane)});
    }
  }

  void decide_strangers(const ElementPair& triangles) {
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

RangeTree::RangeTree(const TriangleMesh& rest)
    : triangles_(rest.triangles), boxes_(2 * rest.triangles.size() - 1) {
  const SurfaceTree tree(rest);
  for (std::uint32_t place = 0; place < triangles_.size(); ++place)
    order_.push_back(tree.triangle_at(place));
}

void RangeTree::refit(std::span<const Vec3> vertices) { refit(all(), vertices); }

const Aabb& RangeTree::refit(const Range& range, std::span<const Vec3> vertices) {
  Aabb box;
  if (range.size() == 1) {
    for (std::uint32_t v : triangles_[order_[range.first]]) box.extend(vertices[v]);
  } else {
    box = refit(range.lower_half(), vertices);
    box.extend(refit(range.upper_half(), vertices));
  }
  return boxes_[range.node] = box;
}

Certifier::Certifier(const std::vector<Body>& bodies) : bodies_(bodies) {
  for (const Body& body : bodies) trees_.emplace_back(body.shape->mesh);
}

FrameCertificate Certifier::certify(const Frame& frame, const std::vector<ElementPair>& between,
                                    const std::vector<SelfPair>* own) {
  std::vector<ElementPair> touching = between;
  if (own != nullptr)
    for (const SelfPair& pair : *own) touching.push_back({pair.body, pair.body, pair.a, pair.b});
  std::sort(touching.begin(), touching.end());
  for (std::size_t b = 0; b < trees_.size(); ++b) trees_[b].refit(frame.bodies[b].vertices);
  FrameCertificate out;
  PairCertifier certifier(frame, bodies_, trees_, touching, out);
  const auto count = static_cast<std::uint32_t>(bodies_.size());
  for (std::uint32_t a = 0; a < count; ++a)
    for (std::uint32_t b = a + 1; b < count; ++b) certifier.certify({a, b});
  for (std::uint32_t a = 0; own != nullptr && a < count; ++a) certifier.certify({a, a});
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

}  // namespace contactcheck::oracle::certify
