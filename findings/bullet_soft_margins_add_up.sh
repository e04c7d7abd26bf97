#!/usr/bin/env bash
# Bullet 3.24 (Debian libbullet3.24 3.24+dfsg-2): two soft bodies with vertex-face contacts (VF_SS) are in
# contact where they are nearer than both margins together, and a margin is 0.25 units unless it is set:
# sheets half a metre apart push each other away. One would expect a skin of centimetres at most, as the
# 0.04 of rigid shapes (CONVEX_DISTANCE_MARGIN).
#
# A sheet of four units above another of eight; defaultCollisionHandler, as the world calls it.
# Seen (amd64): contacts up to a distance of 500 mm with the default; up to 19 mm with margins of 0.01.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
apt-get download -qq -o APT::Sandbox::User=root libbullet3.24=3.24+dfsg-2 libbullet-dev=3.24+dfsg-2
for package in ./*.deb; do dpkg-deb -x "$package" root; done

cat >sheets.cpp <<'C'
#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyHelpers.h>

#include <cstdio>

// A grid of 8 by 8 triangles' corners that is never stepped: what is asked is which contacts there are.
btSoftBody* sheet(btSoftBodyWorldInfo& world, float size, float height, float margin) {
  btSoftBody* body = btSoftBodyHelpers::CreatePatch(
      world, btVector3(-size, height, -size), btVector3(size, height, -size), btVector3(-size, height, size),
      btVector3(size, height, size), 8, 8, 0, true);
  body->m_cfg.collisions = btSoftBody::fCollision::VF_SS;
  if (margin > 0) body->getCollisionShape()->setMargin(margin);
  body->predictMotion(0.001f);
  return body;
}

int main() {
  for (const float margin : {0.0f, 0.01f}) {
    int farthest = 0;
    for (int millimetres = 1; millimetres < 700; millimetres += millimetres < 30 ? 1 : 10) {
      btSoftBodyWorldInfo world;
      world.m_gravity.setZero();
      world.m_sparsesdf.Initialize();
      btSoftBody *low = sheet(world, 4, 0, margin), *high = sheet(world, 2, 0.001f * millimetres, margin);
      low->defaultCollisionHandler(high);
      if (low->m_scontacts.size() + high->m_scontacts.size() > 0) farthest = millimetres;
      delete low;
      delete high;
    }
    std::printf("%g %d\n", margin, farthest);
  }
}
C
library=root/usr/lib/$(dpkg-architecture -qDEB_HOST_MULTIARCH 2>/dev/null || echo x86_64-linux-gnu)
g++ -std=c++17 -O1 -isystem root/usr/include/bullet sheets.cpp -o sheets -L "$library" -Wl,-rpath-link,"$library" \
  -lBulletSoftBody -lBulletDynamics -lBulletCollision -lLinearMath
LD_LIBRARY_PATH=$library ./sheets | tee out

awk '{farthest[$1] = $2} END {exit !(farthest["0"] > 400 && farthest["0.01"] == 19)}' out ||
  { echo "Bullet behaves otherwise now" >&2; exit 1; }
