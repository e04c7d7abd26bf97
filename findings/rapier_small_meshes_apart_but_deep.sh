#!/usr/bin/env bash
# Rapier (npm @dimforge/rapier3d-compat 0.21.0): the contact of two triangle meshes that are apart has
# a negative distance, as if they were that deep in each other, where they are some micrometres large
# and the unit is the metre; castShape finds their contact late. intersectsShape is right for the same
# shapes. One would expect answers that scale with the shapes, or a size below which they are refused.
#
# Two cubes of side 2 k as 12 triangles each, 0.5 k apart.
# Seen, as multiples of k: a distance of 0.5 at k = 1 and 1000, 0.505 at 0.001, 0 at 0.0001, -0.5 at
# 0.00001; moved towards each other by k a second, they meet at 0.5 s, from 0.0001 down at 0.76 s.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
npm install --silent --no-audit --no-fund --ignore-scripts @dimforge/rapier3d-compat@0.21.0 >npm.log

cat >apart.mjs <<'JS'
import RAPIER from "@dimforge/rapier3d-compat";

await RAPIER.init();
const faces = [
  [0, 2, 3], [0, 3, 1], [4, 5, 7], [4, 7, 6], [0, 1, 5], [0, 5, 4],
  [2, 6, 7], [2, 7, 3], [0, 4, 6], [0, 6, 2], [1, 3, 7], [1, 7, 5],
];
const cube = (k) => {
  const corners = [];
  for (const z of [-k, k]) for (const y of [-k, k]) for (const x of [-k, k]) corners.push(x, y, z);
  return RAPIER.ColliderDesc.trimesh(new Float32Array(corners), new Uint32Array(faces.flat())).shape;
};
const still = { x: 0, y: 0, z: 0 }, unturned = { x: 0, y: 0, z: 0, w: 1 };
for (const k of [1000, 1, 1e-3, 1e-4, 1e-5]) {
  const a = cube(k), b = cube(k), place = { x: 2.5 * k, y: 0.3 * k, z: 0.2 * k };
  const contact = a.contactShape(still, unturned, b, place, unturned, 10 * k);
  const hit = a.castShape(still, unturned, { x: k, y: 0, z: 0 }, b, place, unturned, still, 0, 9, true);
  console.log(
    k,
    (contact.distance / k).toFixed(3),
    a.intersectsShape(still, unturned, b, place, unturned),
    hit.time_of_impact.toFixed(3),
  );
}
JS
node apart.mjs | tee out
grep -q '^1 0\.500 false 0\.500' out && grep -q '^0\.0001 -\?0\.000 false 0\.7' out &&
  grep -q '^0\.00001 -0\.500 false 0\.7' out || { echo "Rapier behaves otherwise now" >&2; exit 1; }
