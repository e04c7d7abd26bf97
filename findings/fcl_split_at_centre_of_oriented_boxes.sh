#!/usr/bin/env bash
# FCL 0.7.0 (Debian libfcl0.7 0.7.0-3+b1): a BVHModel of oriented boxes that is built with the split
# method SPLIT_METHOD_BV_CENTER gets a tree that depends on where the mesh stands and on the order of
# its triangles. Triangles are projected on the box's longest axis (include/fcl/geometry/bvh/detail/
# BV_splitter-inl.h, apply), but are held against the x coordinate of the box's centre
# (computeSplitValue_bvcenter), not against the centre's projection. Where all fall on one side, the
# list is halved as it stands. One would expect about the boxes of the method "mean", anywhere.
#
# Two linked rings of 6,144 triangles each that do not touch, in a random order of triangles.
# Seen (amd64), pairs of boxes that a query tests: with mean 47, at the origin and ten units along y;
# with centre 91,603 at the origin and 1,243,893 there. With AABBs 249 and 195, then 323 and 203.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
apt-get download -qq -o APT::Sandbox::User=root libfcl0.7=0.7.0-3+b1 libfcl-dev=0.7.0-3+b1 \
  libccd2=2.1-2+b1 libccd-dev=2.1-2+b1 liboctomap1.9=1.9.7+dfsg-3+b1 liboctomap-dev=1.9.7+dfsg-3+b1 \
  libeigen3-dev=3.4.0-4
for package in ./*.deb; do dpkg-deb -x "$package" root; done

cat >rings.cpp <<'C'
#include <fcl/fcl.h>
#include <fcl/geometry/bvh/detail/BV_splitter.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

template <typename Bv>
void build(bool second, double y, fcl::detail::SplitMethodType method, fcl::BVHModel<Bv>& model) {
  constexpr std::size_t kAround = 96, kAcross = 32;
  std::vector<fcl::Vector3d> vertices;
  std::vector<fcl::Triangle> triangles;
  for (std::size_t i = 0; i < kAround; ++i)
    for (std::size_t j = 0; j < kAcross; ++j) {
      const double a = 2 * M_PI * i / kAround, b = 2 * M_PI * j / kAcross;
      const double radius = 1 + 0.3 * std::cos(b);
      const double p = radius * std::cos(a), q = radius * std::sin(a), r = 0.3 * std::sin(b);
      vertices.push_back(second ? fcl::Vector3d(p + 1, y + r, q) : fcl::Vector3d(p, y + q, r));
      const std::size_t i1 = (i + 1) % kAround, j1 = (j + 1) % kAcross;
      triangles.emplace_back(i * kAcross + j, i1 * kAcross + j, i1 * kAcross + j1);
      triangles.emplace_back(i * kAcross + j, i1 * kAcross + j1, i * kAcross + j1);
    }
  std::shuffle(triangles.begin(), triangles.end(), std::mt19937(1));
  model.bv_splitter.reset(new fcl::detail::BVSplitter<Bv>(method));
  model.beginModel();
  model.addSubModel(vertices, triangles);
  model.endModel();
}

template <typename Bv, typename Node>
void measure(const char* boxes) {
  const fcl::Transform3d none = fcl::Transform3d::Identity();
  for (const double y : {0.0, 10.0})
    for (const auto method : {fcl::detail::SPLIT_METHOD_MEAN, fcl::detail::SPLIT_METHOD_BV_CENTER}) {
      fcl::BVHModel<Bv> a, b;
      build(false, y, method, a);
      build(true, y, method, b);
      const fcl::CollisionRequestd request(1000000, false);
      fcl::CollisionResultd result;
      Node node;
      fcl::Transform3d of_a = none, of_b = none;
      if constexpr (std::is_same_v<Bv, fcl::AABBd>)
        fcl::detail::initialize(node, a, of_a, b, of_b, request, result);
      else
        fcl::detail::initialize(node, const_cast<const fcl::BVHModel<Bv>&>(a), of_a,
                                const_cast<const fcl::BVHModel<Bv>&>(b), of_b, request, result);
      node.enable_statistics = true;
      fcl::detail::collide(&node);
      std::printf("%s y=%g %s %d %zu\n", boxes, y,
                  method == fcl::detail::SPLIT_METHOD_MEAN ? "mean" : "centre", node.num_bv_tests,
                  result.numContacts());
    }
}

int main() {
  measure<fcl::AABBd, fcl::detail::MeshCollisionTraversalNode<fcl::AABBd>>("AABB");
  measure<fcl::OBBRSSd, fcl::detail::MeshCollisionTraversalNodeOBBRSS<double>>("OBBRSS");
}
C
library=root/usr/lib/$(dpkg-architecture -qDEB_HOST_MULTIARCH 2>/dev/null || echo x86_64-linux-gnu)
g++ -std=c++17 -O1 -isystem root/usr/include -isystem root/usr/include/eigen3 rings.cpp -o rings \
  -L "$library" -Wl,-rpath-link,"$library" -lfcl -lccd
LD_LIBRARY_PATH=$library ./rings | tee out

awk '{tests[$1 $2 $3] = $4}
  END {
    for (place in tests) {
      if (place !~ /centre$/) continue
      mean = place; sub(/centre$/, "mean", mean)
      times = tests[place] / tests[mean]
      if (place ~ /^AABB/ && times > 3) exit 1
      if (place ~ /^OBBRSS/ && times < 20) exit 1
    }
  }' out || { echo "FCL behaves otherwise now" >&2; exit 1; }
