#!/usr/bin/env bash
# three.js (npm three 0.187.0), PLYLoader: faces of five corners and more are dropped, without an
# error or a warning. One would expect them to be split, as those of four are, or refused. A file
# of nothing else has no index afterwards, so that its vertices are drawn three by three.
#
# A house: a square and a pentagon. Seen: the square's 2 triangles; of the pentagon none; of the
# pentagon alone no index and 5 vertices.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
npm install --silent --no-audit --no-fund --ignore-scripts three@0.187.0 >npm.log

cat >house.mjs <<'JS'
import { PLYLoader } from "three/examples/jsm/loaders/PLYLoader.js";

const vertices = "0 0 0\n2 0 0\n2 2 0\n1 3 0\n0 2 0\n";
for (const [name, ...faces] of [["square", "4 0 1 2 4"], ["pentagon", "5 0 1 2 3 4"],
                                ["both", "4 0 1 2 4", "5 0 1 2 3 4"]]) {
  const geometry = new PLYLoader().parse(
    "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n" +
      `property float z\nelement face ${faces.length}\n` +
      `property list uchar int vertex_indices\nend_header\n${vertices}${faces.join("\n")}\n`,
  );
  const triangles = geometry.index ? `${geometry.index.count / 3} triangles` : "no index";
  console.log(name, triangles, geometry.attributes.position.count, "vertices");
}
JS
node house.mjs 2>warnings | tee out
[ ! -s warnings ] && diff out - <<'EXPECTED' || { echo "three.js behaves otherwise now" >&2; exit 1; }
square 2 triangles 5 vertices
pentagon no index 5 vertices
both 2 triangles 5 vertices
EXPECTED
