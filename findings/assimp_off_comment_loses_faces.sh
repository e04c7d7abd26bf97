#!/usr/bin/env bash
# assimp (npm assimpjs 0.0.10; Debian's assimp 5.2.5 does the same): a comment line between the
# vertices and the faces of an OFF file is counted as a face, so that as many faces at the end are
# lost, without an error. One would expect the same mesh with the comment and without it, as
# Geomview's format allows comments on any line; CGAL writes "# 12 facets" there.
#
# A tetrahedron of four faces. Seen: without a comment 4 faces; with a comment line before the
# vertices 4; with one before the faces 3; with three 1.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
npm install --silent --no-audit --no-fund --ignore-scripts assimpjs@0.0.10 >npm.log

cat >faces.mjs <<'JS'
import createAssimp from "assimpjs";

const assimp = await createAssimp();
function facesOf(text) {
  const files = new assimp.FileList();
  files.AddFile("tetrahedron.off", new TextEncoder().encode(text));
  const result = assimp.ConvertFileList(files, "assjson");
  const scene = JSON.parse(new TextDecoder().decode(result.GetFile(0).GetContent()));
  return scene.meshes.reduce((sum, mesh) => sum + mesh.faces.length, 0);
}
const vertices = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n", faces = "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
const head = "OFF\n4 4 0\n";
console.log("plain", facesOf(head + vertices + faces));
console.log("before vertices", facesOf(head + "# vertices\n" + vertices + faces));
console.log("before faces", facesOf(head + vertices + "# faces\n" + faces));
console.log("three before faces", facesOf(head + vertices + "#\n# faces\n#\n" + faces));
JS
node faces.mjs | tee out
diff out - <<'EXPECTED' || { echo "assimp behaves otherwise now" >&2; exit 1; }
plain 4
before vertices 4
before faces 3
three before faces 1
EXPECTED
