#!/usr/bin/env bash
# three.js (npm three 0.187.0), OBJLoader: a comment behind a face's indices becomes further corners.
# One would expect it to be left out, as it is on a line of its own; the format lets a comment
# begin anywhere on a line.
#
# A tetrahedron of four faces. Seen: 4 triangles; with "f 1 3 2 # base" 6, of which the added ones
# have coordinates that are not finite; no error.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
npm install --silent --no-audit --no-fund --ignore-scripts three@0.187.0 >npm.log

cat >comment.mjs <<'JS'
import { OBJLoader } from "three/examples/jsm/loaders/OBJLoader.js";

const vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n", rest = "f 1 2 4\nf 2 3 4\nf 1 4 3\n";
for (const [name, first] of [["plain", "f 1 3 2\n"], ["above", "# base\nf 1 3 2\n"],
                             ["behind", "f 1 3 2 # base\n"]]) {
  const position = new OBJLoader().parse(vertices + first + rest).children[0].geometry.attributes.position;
  const finite = Array.from(position.array).every(Number.isFinite);
  console.log(name, position.count / 3, finite ? "finite" : "not finite");
}
JS
node comment.mjs 2>warnings | tee out
diff out - <<'EXPECTED' || { echo "three.js behaves otherwise now" >&2; exit 1; }
plain 4 finite
above 4 finite
behind 6 not finite
EXPECTED
