#!/usr/bin/env bash
# Bullet 3.24 (Debian libbullet3.24 3.24+dfsg-2): the soft body that btSoftBodyHelpers::CreateFromTriMesh
# makes has its faces in a random order, for its last argument, randomizeConstraints, is true unless
# said. One would expect face i to be triangle i: contacts and rendered faces are named by that index.
#
# A strip of 200 triangles.
# Seen (amd64): by default 1 of 200 faces is that of its triangle; with false, 200.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
apt-get download -qq -o APT::Sandbox::User=root libbullet3.24=3.24+dfsg-2 libbullet-dev=3.24+dfsg-2
for package in ./*.deb; do dpkg-deb -x "$package" root; done

cat >strip.cpp <<'C'
#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyHelpers.h>

#include <cstdio>
#include <vector>

int main() {
  constexpr int kTriangles = 200;
  std::vector<btScalar> vertices;
  std::vector<int> triangles;
  for (int v = 0; v < kTriangles + 2; ++v) {
    vertices.push_back(0.5f * v);
    vertices.push_back(v % 2);
    vertices.push_back(0);
  }
  for (int t = 0; t < kTriangles; ++t)
    for (int corner = 0; corner < 3; ++corner) triangles.push_back(t + corner);

  for (const bool shuffled : {true, false}) {
    btSoftBodyWorldInfo world;
    btSoftBody* body =
        shuffled ? btSoftBodyHelpers::CreateFromTriMesh(world, vertices.data(), triangles.data(), kTriangles)
                 : btSoftBodyHelpers::CreateFromTriMesh(world, vertices.data(), triangles.data(), kTriangles, false);
    int in_place = 0;
    for (int t = 0; t < kTriangles; ++t) {
      bool same = true;
      for (int corner = 0; corner < 3; ++corner)
        same = same && body->m_faces[t].m_n[corner] == &body->m_nodes[triangles[3 * t + corner]];
      in_place += same;
    }
    std::printf("%s %d\n", shuffled ? "default" : "false", in_place);
    delete body;
  }
}
C
library=root/usr/lib/$(dpkg-architecture -qDEB_HOST_MULTIARCH 2>/dev/null || echo x86_64-linux-gnu)
g++ -std=c++17 -O1 -isystem root/usr/include/bullet strip.cpp -o strip -L "$library" -Wl,-rpath-link,"$library" \
  -lBulletSoftBody -lBulletDynamics -lBulletCollision -lLinearMath
LD_LIBRARY_PATH=$library ./strip | tee out

awk '{faces[$1] = $2} END {exit !(faces["default"] < 20 && faces["false"] == 200)}' out ||
  { echo "Bullet behaves otherwise now" >&2; exit 1; }
