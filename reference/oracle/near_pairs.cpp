// All vertices go down the tree together; each node passes on those near its box.
//
// Rounding to nearest is monotone: a gap of at most `margin` rounds to at most `margin`, which is a
// double itself. So boxes need no growing: a rounded gap above the margin is a true one.
#include "reference/oracle/near_pairs.h"

#include "reference/oracle/vertex_distance.h"

namespace contactcheck::oracle {
namespace {

bool within(double margin, const Vec3& p, const Aabb& box) {
  return box.lo.x() - p.x() <= margin && p.x() - box.hi.x() <= margin &&
         box.lo.y() - p.y() <= margin && p.y() - box.hi.y() <= margin &&
         box.lo.z() - p.z() <= margin && p.z() - box.hi.z() <= margin;
}

class MarginSearch {
 public:
  MarginSearch(BodyPair pair, std::span<const Vec3> vertices, const SurfaceTree& surface,
               double margin, std::vector<NearPair>& out)
      : pair_(pair), vertices_(vertices), surface_(surface), margin_(margin), out_(out) {}

  void run() {
    for (std::uint32_t v = 0; v < vertices_.size(); ++v) passed_.push_back(v);
    descend(0, 0, passed_.size());
  }

 private:
  void descend(std::uint32_t index, std::size_t first, std::size_t last);
  void measure(std::uint32_t place, std::size_t first, std::size_t last);

  BodyPair pair_;
  std::span<const Vec3> vertices_;
  const SurfaceTree& surface_;
  double margin_;
  std::vector<NearPair>& out_;
  std::vector<std::uint32_t> passed_;  // the vertices passed on, by every node above the present
};

// Searches below a node for the vertices passed_[first .. last).
void MarginSearch::descend(std::uint32_t index, std::size_t first, std::size_t last) {
  const SurfaceTree::Node& node = surface_.node(index);
  const std::size_t begin = passed_.size();
  for (std::size_t i = first; i < last; ++i) {
    const std::uint32_t v = passed_[i];
    if (within(margin_, vertices_[v], node.box)) passed_.push_back(v);
  }
  const std::size_t end = passed_.size();
  if (begin < end && node.is_leaf()) {
    for (std::uint32_t place = node.first; place < node.first + node.count; ++place)
      measure(place, begin, end);
  } else if (begin < end) {
    descend(index + 1, begin, end);
    descend(node.second, begin, end);
  }
  passed_.resize(begin);
}

void MarginSearch::measure(std::uint32_t place, std::size_t first, std::size_t last) {
  const std::uint32_t triangle = surface_.triangle_at(place);
  const TriangleCorners corners = surface_.corners(triangle);
  for (std::size_t i = first; i < last; ++i) {
    const Vec3& vertex = vertices_[passed_[i]];
    if (within(margin_, vertex, surface_.box_at(place)) && nearer_than(margin_, vertex, corners))
      out_.push_back({pair_.a, pair_.b, passed_[i], triangle});
  }
}

}  // namespace

bool boxes_within(double margin, const Aabb& a, const Aabb& b) {
  return ((b.lo - a.hi).array() <= margin).all() && ((a.lo - b.hi).array() <= margin).all();
}

void append_near_pairs(BodyPair pair, std::span<const Vec3> vertices, const SurfaceTree& surface,
                       double margin, std::vector<NearPair>& out) {
  MarginSearch(pair, vertices, surface, margin, out).run();
}

}  // namespace contactcheck::oracle
