#!/usr/bin/env bash
# Embree 3.13.5 (Debian libembree3-3 3.13.5+dfsg-2): for geometries that are refitted, rtcCollide names
# pairs of primitives whose bounds do not overlap; for those built anew it names none. One would expect
# the pairs with overlapping bounds from both.
#
# Two balls of 1,280 triangles that press into one another, as user geometries of dynamic scenes.
# Seen (amd64): 384 pairs of bounds overlap; RTC_BUILD_QUALITY_LOW names these, RTC_BUILD_QUALITY_REFIT
# these and 452 more.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
apt-get download -qq -o APT::Sandbox::User=root libembree3-3=3.13.5+dfsg-2 libembree-dev=3.13.5+dfsg-2
for package in ./*.deb; do dpkg-deb -x "$package" root; done

cat >balls.cpp <<'C'
#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

using Box = std::array<float, 6>;  // lower, upper

struct Ball {
  std::vector<Box> boxes;
  RTCScene scene;

  Ball(RTCDevice device, float x, RTCBuildQuality quality) {
    constexpr int kAround = 40, kDown = 16;
    const auto point = [&](int i, int j) {
      const double a = 2 * M_PI * i / kAround, b = M_PI * j / kDown;
      return std::array<float, 3>{float(x + std::sin(b) * std::cos(a)), float(std::sin(b) * std::sin(a)),
                                  float(std::cos(b))};
    };
    for (int i = 0; i < kAround; ++i)
      for (int j = 0; j < kDown; ++j)
        for (const int half : {0, 1}) {
          const std::array<float, 3> t[] = {point(i, j), point(i + 1, j + 1), half ? point(i + 1, j) : point(i, j + 1)};
          Box box;
          for (int k = 0; k < 3; ++k) {
            box[k] = std::min({t[0][k], t[1][k], t[2][k]});
            box[k + 3] = std::max({t[0][k], t[1][k], t[2][k]});
          }
          boxes.push_back(box);
        }
    scene = rtcNewScene(device);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, boxes.size());
    rtcSetGeometryUserData(geometry, this);
    rtcSetGeometryBoundsFunction(
        geometry,
        [](const RTCBoundsFunctionArguments* arguments) {
          const Box& box = static_cast<const Ball*>(arguments->geometryUserPtr)->boxes[arguments->primID];
          RTCBounds& out = *arguments->bounds_o;
          out.lower_x = box[0], out.lower_y = box[1], out.lower_z = box[2];
          out.upper_x = box[3], out.upper_y = box[4], out.upper_z = box[5];
        },
        nullptr);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_DYNAMIC);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_LOW);
    rtcSetGeometryBuildQuality(geometry, quality);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcCommitScene(scene);
  }
};

using Pairs = std::vector<std::array<unsigned, 2>>;

bool overlap(const Box& p, const Box& q) {
  return p[0] <= q[3] && q[0] <= p[3] && p[1] <= q[4] && q[1] <= p[4] && p[2] <= q[5] && q[2] <= p[5];
}

int main() {
  RTCDevice device = rtcNewDevice("threads=1");
  for (const RTCBuildQuality quality : {RTC_BUILD_QUALITY_LOW, RTC_BUILD_QUALITY_REFIT}) {
    const Ball a(device, 0, quality), b(device, 1.9f, quality);
    Pairs named;
    rtcCollide(
        a.scene, b.scene,
        [](void* user, RTCCollision* collisions, unsigned count) {
          for (unsigned i = 0; i < count; ++i)
            static_cast<Pairs*>(user)->push_back({collisions[i].primID0, collisions[i].primID1});
        },
        &named);
    int apart = 0, overlapping = 0;
    for (const auto& [i, j] : named) apart += !overlap(a.boxes[i], b.boxes[j]);
    for (const Box& p : a.boxes)
      for (const Box& q : b.boxes) overlapping += overlap(p, q);
    std::printf("%s %zu %d %d\n", quality == RTC_BUILD_QUALITY_LOW ? "low" : "refit", named.size(), apart,
                overlapping);
  }
}
C
library=root/usr/lib/$(dpkg-architecture -qDEB_HOST_MULTIARCH 2>/dev/null || echo x86_64-linux-gnu)
g++ -std=c++17 -O1 -I root/usr/include balls.cpp -o balls -L "$library" -Wl,--unresolved-symbols=ignore-in-shared-libs -lembree3
LD_LIBRARY_PATH=$library ./balls | tee out

awk '{named[$1] = $2; apart[$1] = $3; overlapping = $4}
  END {exit !(apart["low"] == 0 && named["low"] == overlapping && apart["refit"] > 100)}' out ||
  { echo "Embree behaves otherwise now" >&2; exit 1; }
