#!/usr/bin/env bash
# FCL 0.7.0 (Debian libfcl0.7 0.7.0-3+b1): the distance of two meshes that cross is 0, but the nearest
# points that come with it are not one point: they lie centimetres to decimetres apart. With
# enable_signed_distance the distance of the same meshes is 0 as well, without an error or a warning.
# One would expect two equal points, and a negative distance or a refusal.
#
# Two closed cubes of side 2, the second moved by 1.3 along x: the deepest point is 0.7 inside.
# Seen (amd64), distance and nearest points' distance: RSS 0 and 0.3, OBBRSS 0 and 0.078, AABB 0 and
# 0.038; the same with enable_signed_distance.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
apt-get download -qq -o APT::Sandbox::User=root libfcl0.7=0.7.0-3+b1 libfcl-dev=0.7.0-3+b1 \
  libccd2=2.1-2+b1 libccd-dev=2.1-2+b1 liboctomap1.9=1.9.7+dfsg-3+b1 liboctomap-dev=1.9.7+dfsg-3+b1 \
  libeigen3-dev=3.4.0-4
for package in ./*.deb; do dpkg-deb -x "$package" root; done

cat >cubes.cpp <<'C'
#include <fcl/fcl.h>

#include <cstdio>
#include <vector>

// Of side 2, its faces divided into cells of two triangles.
template <typename Bv>
void make_cube(const fcl::Vector3d& centre, std::size_t cells, fcl::BVHModel<Bv>& out) {
  std::vector<fcl::Vector3d> vertices;
  std::vector<fcl::Triangle> triangles;
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {-1, 1}) {
      const std::size_t first = vertices.size(), row = cells + 1;
      for (std::size_t i = 0; i < row; ++i)
        for (std::size_t j = 0; j < row; ++j) {
          fcl::Vector3d p;
          p[axis] = side;
          p[(axis + 1) % 3] = 2.0 * i / cells - 1;
          p[(axis + 2) % 3] = 2.0 * j / cells - 1;
          vertices.push_back(centre + p);
        }
      for (std::size_t i = 0; i < cells; ++i)
        for (std::size_t j = 0; j < cells; ++j) {
          const std::size_t a = first + i * row + j;
          triangles.emplace_back(a, a + 1, a + row + 1);
          triangles.emplace_back(a, a + row + 1, a + row);
        }
    }
  out.beginModel();
  out.addSubModel(vertices, triangles);
  out.endModel();
}

template <typename Bv>
void measure(const char* name) {
  fcl::BVHModel<Bv> a, b;
  make_cube(fcl::Vector3d::Zero(), 4, a);
  make_cube(fcl::Vector3d(1.3, 0.1, 0.2), 3, b);
  const fcl::Transform3d none = fcl::Transform3d::Identity();
  for (const bool is_signed : {false, true}) {
    const fcl::DistanceRequestd request(true, is_signed);
    fcl::DistanceResultd result;
    const double distance = fcl::distance(&a, none, &b, none, request, result);
    std::printf("%s %s %g %.3f\n", name, is_signed ? "signed" : "plain", distance,
                (result.nearest_points[0] - result.nearest_points[1]).norm());
  }
}

int main() {
  measure<fcl::RSSd>("RSS");
  measure<fcl::OBBRSSd>("OBBRSS");
  measure<fcl::AABBd>("AABB");
}
C
library=root/usr/lib/$(dpkg-architecture -qDEB_HOST_MULTIARCH 2>/dev/null || echo x86_64-linux-gnu)
g++ -std=c++17 -O1 -isystem root/usr/include -isystem root/usr/include/eigen3 cubes.cpp -o cubes \
  -L "$library" -Wl,-rpath-link,"$library" -lfcl -lccd
LD_LIBRARY_PATH=$library ./cubes | tee out

awk '$3 != 0 || $4 < 0.03 {other = 1} END {exit other || NR != 6}' out ||
  { echo "FCL behaves otherwise now" >&2; exit 1; }
