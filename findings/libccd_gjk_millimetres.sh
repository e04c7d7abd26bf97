#!/usr/bin/env bash
# libccd 2.1 (Debian libccd2 2.1-2+b1): ccdGJKIntersect says "apart" of nearly all triangles that cross
# where they are a millimetre large and the unit is the metre. At 1 cm and at 10 micrometres the same
# triangles are right; one would expect the same answer at every scale, or a bound from which it is wrong.
#
# 2,000 random triangles of coordinates within +-scale, each crossed through its inside by another.
# Seen (amd64): of 2,000 crossing pairs GJK misses 0 at scale 1, 0 at 0.01, 1995 at 0.001, 418 at
# 0.0001, 0 at 0.00001; ccdMPRIntersect 0, 11, 106, 0, 0.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
apt-get download -qq -o APT::Sandbox::User=root libccd2=2.1-2+b1 libccd-dev=2.1-2+b1
for package in ./*.deb; do dpkg-deb -x "$package" root; done

cat >crossing.c <<'C'
#include <ccd/ccd.h>
#include <stdint.h>
#include <stdio.h>

typedef struct {
  ccd_vec3_t corner[3];
} Triangle;

static void support(const void *object, const ccd_vec3_t *direction, ccd_vec3_t *out) {
  const Triangle *t = object;
  int best = 0;
  for (int i = 1; i < 3; ++i)
    if (ccdVec3Dot(&t->corner[i], direction) > ccdVec3Dot(&t->corner[best], direction)) best = i;
  *out = t->corner[best];
}

static void centre(const void *object, ccd_vec3_t *out) {
  const Triangle *t = object;
  ccdVec3Set(out, 0, 0, 0);
  for (int i = 0; i < 3; ++i) ccdVec3Add(out, &t->corner[i]);
  ccdVec3Scale(out, 1 / 3.0);
}

static uint64_t state;

/* From -1 to 1. */
static double drawn(void) {
  state = state * 6364136223846793005u + 1442695040888963407u;
  return (double)(state >> 11) * 0x1p-52 - 1;
}

int main(void) {
  const double scales[] = {1, 1e-2, 1e-3, 1e-4, 1e-5};
  for (int s = 0; s < 5; ++s) {
    int gjk = 0, mpr = 0;
    state = 1;
    for (int pair = 0; pair < 2000; ++pair) {
      double p[3][3], through[3], q[3][3];
      for (int i = 0; i < 3; ++i)
        for (int axis = 0; axis < 3; ++axis) p[i][axis] = drawn();
      const double u = 0.2 + 0.1 * drawn(), v = 0.4 + 0.1 * drawn();
      for (int axis = 0; axis < 3; ++axis)
        through[axis] = u * p[0][axis] + v * p[1][axis] + (1 - u - v) * p[2][axis];
      for (int axis = 0; axis < 3; ++axis) {
        const double away = drawn();
        q[0][axis] = through[axis] + away;
        q[1][axis] = through[axis] - away;
      }
      for (int axis = 0; axis < 3; ++axis) q[2][axis] = through[axis] + drawn();
      Triangle a, b;
      for (int i = 0; i < 3; ++i) {
        ccdVec3Set(&a.corner[i], scales[s] * p[i][0], scales[s] * p[i][1], scales[s] * p[i][2]);
        ccdVec3Set(&b.corner[i], scales[s] * q[i][0], scales[s] * q[i][1], scales[s] * q[i][2]);
      }
      ccd_t settings;
      CCD_INIT(&settings);
      settings.support1 = settings.support2 = support;
      settings.center1 = settings.center2 = centre;
      settings.max_iterations = 1000;
      gjk += !ccdGJKIntersect(&a, &b, &settings);
      mpr += !ccdMPRIntersect(&a, &b, &settings);
    }
    printf("%g: GJK misses %d, MPR %d\n", scales[s], gjk, mpr);
  }
}
C
library=root/usr/lib/$(dpkg-architecture -qDEB_HOST_MULTIARCH 2>/dev/null || echo x86_64-linux-gnu)
gcc -O1 -ffp-contract=off -I root/usr/include crossing.c -o crossing -L "$library" -lccd -lm
LD_LIBRARY_PATH=$library ./crossing | tee out

misses() { sed -n "s/^$1: GJK misses \([0-9]*\),.*/\1/p" out; }
[ "$(misses 1)" = 0 ] && [ "$(misses 0.01)" = 0 ] && [ "$(misses 1e-05)" = 0 ] &&
  [ "$(misses 0.001)" -gt 1900 ] && [ "$(misses 0.0001)" -gt 100 ] ||
  { echo "libccd behaves otherwise now" >&2; exit 1; }
