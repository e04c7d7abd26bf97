#!/usr/bin/env bash
# Rapier (npm @dimforge/rapier3d-compat 0.21.0): a closed mesh with TriMeshFlags.ORIENTED is a solid to
# points and a hollow shell to shapes. A point inside is "contained" and "inside", but a small box
# around the same point does not "intersect" the mesh, and their contact has a positive distance. One
# would expect one reading of inside for both, as a Cuboid of the same size has.
#
# A cube of side 2 as 12 triangles, oriented outward; a box of side 0.2 in its middle.
# Seen: containsPoint true, projectPoint isInside true, intersectsShape false, contactShape 0.8 to
# 0.9 apart; of the Cuboid: true, true, true, and a contact of -1.1 (that deep).
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
npm install --silent --no-audit --no-fund --ignore-scripts @dimforge/rapier3d-compat@0.21.0 >npm.log

cat >inside.mjs <<'JS'
import RAPIER from "@dimforge/rapier3d-compat";

await RAPIER.init();
const corners = [];
for (const z of [-1, 1]) for (const y of [-1, 1]) for (const x of [-1, 1]) corners.push(x, y, z);
const faces = [
  [0, 2, 3], [0, 3, 1], [4, 5, 7], [4, 7, 6], [0, 1, 5], [0, 5, 4],
  [2, 6, 7], [2, 7, 3], [0, 4, 6], [0, 6, 2], [1, 3, 7], [1, 7, 5],
];
const mesh = RAPIER.ColliderDesc.trimesh(
  new Float32Array(corners),
  new Uint32Array(faces.flat()),
  RAPIER.TriMeshFlags.ORIENTED,
).shape;
const origin = { x: 0, y: 0, z: 0 }, unturned = { x: 0, y: 0, z: 0, w: 1 };
const small = new RAPIER.Cuboid(0.1, 0.1, 0.1);
for (const [name, shape] of [["mesh", mesh], ["cuboid", new RAPIER.Cuboid(1, 1, 1)]]) {
  const contact = shape.contactShape(origin, unturned, small, origin, unturned, 10);
  console.log(
    name,
    shape.containsPoint(origin, unturned, origin),
    shape.projectPoint(origin, unturned, origin, false).isInside,
    shape.intersectsShape(origin, unturned, small, origin, unturned),
    contact.distance > 0 ? "apart" : "deep",
    contact.distance.toFixed(3),
  );
}
JS
node inside.mjs | tee out
grep -q '^mesh true true false apart 0\.[89]' out && grep -q '^cuboid true true true deep -1\.1' out ||
  { echo "Rapier behaves otherwise now" >&2; exit 1; }
