#!/usr/bin/env bash
# Rapier (npm @dimforge/rapier3d-compat 0.21.0): intersectsShape says that triangles of some
# centimetres intersect which a plane separates by a tenth of their size, and so it does of meshes of
# such triangles; some of these pairs it calls apart when the two are exchanged. contactShape gives
# their distance. One would expect the same answer at every scale, and in both orders.
#
# 2,000 pairs of triangles with corners in a cube of side k, those of the first on one side of a plane
# through its centre, those of the second on the other, 0.1 k apart or more.
# Seen: 0 intersect at k = 1 and 0.1 (units are metres), 53 at 0.02 (48 exchanged, 33 as meshes), 177
# at 0.001.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
npm install --silent --no-audit --no-fund --ignore-scripts @dimforge/rapier3d-compat@0.21.0 >npm.log

cat >apart.mjs <<'JS'
import RAPIER from "@dimforge/rapier3d-compat";

await RAPIER.init();
const still = { x: 0, y: 0, z: 0 }, unturned = { x: 0, y: 0, z: 0, w: 1 };
let state = 1;
const random = () => (state = (state * 48271) % 2147483647) / 2147483647 - 0.5;
const dot = (p, q) => p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
const triangle = (t) => new RAPIER.Triangle(...t.map(([x, y, z]) => ({ x, y, z })));
const mesh = (t) => new RAPIER.TriMesh(new Float32Array(t.flat()), new Uint32Array([0, 1, 2]));
const intersect = (p, q) => p.intersectsShape(still, unturned, q, still, unturned);
for (const k of [1, 0.1, 0.02, 0.001]) {
  state = 1;
  let pairs = 0, exchanged = 0, meshes = 0;
  for (let i = 0; i < 2000; i++) {
    const normal = [random(), random(), random()], length = Math.hypot(...normal);
    const corner = (side) => {
      for (;;) {
        const p = [random(), random(), random()];
        if ((side * dot(p, normal)) / length > 0.05) return p.map((x) => k * x);
      }
    };
    const [a, b] = [1, -1].map((side) => [corner(side), corner(side), corner(side)]);
    pairs += intersect(triangle(a), triangle(b));
    exchanged += intersect(triangle(b), triangle(a));
    meshes += intersect(mesh(a), mesh(b));
  }
  console.log(k, pairs, exchanged, meshes);
}
JS
node apart.mjs | tee out
grep -q '^1 0 0 0$' out && grep -q '^0.1 0 0 0$' out && grep -q '^0.02 53 48 33$' out &&
  grep -q '^0.001 177 ' out || { echo "Rapier behaves otherwise now" >&2; exit 1; }
