#!/usr/bin/env bash
# FCL 0.7.0 (Debian libfcl0.7 0.7.0-3+b1): refitting a BVHModel<OBBRSS> the default way, bottom-up,
# inflates its boxes although no vertex has moved. One would expect about the boxes of the build, as
# endReplaceModel's parameters "refit = true, bottomup = true" are the defaults.
#
# Two linked rings of 6,144 triangles each that do not touch; endReplaceModel with the same vertices.
# Seen (amd64): bottom-up the boxes' volumes add up to 253 times those of the build, and a query tests
# 165 times as many pairs of boxes (12,371 for 75). Top-down: 1.00 times and 75.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
apt-get download -qq -o APT::Sandbox::User=root libfcl0.7=0.7.0-3+b1 libfcl-dev=0.7.0-3+b1 libccd2=2.1-2+b1 libccd-dev=2.1-2+b1 \
  liboctomap1.9=1.9.7+dfsg-3+b1 liboctomap-dev=1.9.7+dfsg-3+b1 libeigen3-dev=3.4.0-4
for package in ./*.deb; do dpkg-deb -x "$package" root; done

cat >rings.cpp <<'C'
#include <fcl/fcl.h>

#include <cmath>
#include <cstdio>
#include <vector>

using Model = fcl::BVHModel<fcl::OBBRSSd>;

struct Ring {
  std::vector<fcl::Vector3d> vertices;
  std::vector<fcl::Triangle> triangles;
  Model model;

  explicit Ring(bool second) {
    constexpr std::size_t kAround = 96, kAcross = 32;
    for (std::size_t i = 0; i < kAround; ++i)
      for (std::size_t j = 0; j < kAcross; ++j) {
        const double a = 2 * M_PI * i / kAround, b = 2 * M_PI * j / kAcross;
        const double radius = 1 + 0.3 * std::cos(b);
        const double x = radius * std::cos(a), y = radius * std::sin(a), z = 0.3 * std::sin(b);
        if (second) vertices.emplace_back(x + 1, z, y);
        else vertices.emplace_back(x, y, z);
        const std::size_t i1 = (i + 1) % kAround, j1 = (j + 1) % kAcross;
        triangles.emplace_back(i * kAcross + j, i1 * kAcross + j, i1 * kAcross + j1);
        triangles.emplace_back(i * kAcross + j, i1 * kAcross + j1, i * kAcross + j1);
      }
    model.beginModel();
    model.addSubModel(vertices, triangles);
    model.endModel();
  }

  void refit(bool bottom_up) {
    model.beginReplaceModel();
    model.replaceSubModel(vertices);
    model.endReplaceModel(true, bottom_up);
  }

  double volume() const {
    double sum = 0;
    for (int i = 0; i < model.getNumBVs(); ++i) sum += model.getBV(i).bv.volume();
    return sum;
  }
};

int box_tests(const Ring& a, const Ring& b) {
  const fcl::CollisionRequestd request(1000000, false);
  fcl::CollisionResultd result;
  fcl::detail::MeshCollisionTraversalNodeOBBRSS<double> node;
  const Model &of_a = a.model, &of_b = b.model;
  const fcl::Transform3d none = fcl::Transform3d::Identity();
  fcl::detail::initialize(node, of_a, none, of_b, none, request, result);
  node.enable_statistics = true;
  fcl::detail::collide(&node);
  return node.num_bv_tests;
}

int main() {
  Ring a(false), b(true);
  std::printf("built %.4g %d\n", a.volume(), box_tests(a, b));
  for (const bool bottom_up : {true, false}) {
    a.refit(bottom_up);
    b.refit(bottom_up);
    std::printf("%s %.4g %d\n", bottom_up ? "bottom-up" : "top-down", a.volume(), box_tests(a, b));
  }
}
C
library=root/usr/lib/$(dpkg-architecture -qDEB_HOST_MULTIARCH 2>/dev/null || echo x86_64-linux-gnu)
g++ -std=c++17 -O1 -isystem root/usr/include -isystem root/usr/include/eigen3 rings.cpp -o rings -L "$library" \
  -Wl,-rpath-link,"$library" -lfcl -lccd
LD_LIBRARY_PATH=$library ./rings | tee out

awk '{volume[$1] = $2; tests[$1] = $3}
  END {
    same = volume["top-down"] < 1.1 * volume["built"] && tests["top-down"] <= 2 * tests["built"]
    inflated = volume["bottom-up"] > 100 * volume["built"] && tests["bottom-up"] > 50 * tests["built"]
    exit !(same && inflated)
  }' out || { echo "FCL behaves otherwise now" >&2; exit 1; }
