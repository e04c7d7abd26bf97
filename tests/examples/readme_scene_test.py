"""Runs mine.json of fixtures/README.md, on an OBJ file of our own, as a reader would.

Usage: readme_scene_test.py PAGE CONTACTCHECK FOLDER
"""

import json
import pathlib
import re
import subprocess
import sys


def torus_obj(rings=24, sides=12):
    """A closed OBJ mesh that is in no package: a torus with squared cross-sections."""
    import math

    lines = []
    for i in range(rings):
        for j in range(sides):
            a, b = 2 * math.pi * i / rings, 2 * math.pi * j / sides
            radius = 1.0 + 0.4 * math.cos(b)
            lines.append(f"v {radius * math.cos(a)} {radius * math.sin(a)} {0.4 * math.sin(b)}")
    for i in range(rings):
        for j in range(sides):
            corner = lambda k, l: (k % rings) * sides + l % sides + 1
            p, q = corner(i, j), corner(i + 1, j)
            r, s = corner(i + 1, j + 1), corner(i, j + 1)
            lines += [f"f {p} {q} {r}", f"f {p} {r} {s}"]
    return "\n".join(lines) + "\n"


def main():
    page, program, folder = (pathlib.Path(a).resolve() for a in sys.argv[1:4])
    blocks = [block for block in
              re.findall(r"```json\n(.*?)```", page.read_text(encoding="utf-8"), re.S)
              if '"id": "mine"' in block]
    assert len(blocks) == 1, f"the page shows {len(blocks)} scenes \"mine\", not 1"
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "mine.json").write_text(blocks[0], encoding="utf-8")
    (folder / "mine.obj").write_text(torus_obj())
    command = [program, "run", "mine.json", "--no-timing", "--quiet", "--out", "out"]
    subprocess.run(command, cwd=folder, check=True)
    runs = json.loads((folder / "out/results.json").read_bytes())["runs"]
    assert runs and all(run["status"] == "ok" for run in runs), "a detector did not finish"
    for run in runs:
        if "+tri" in run["detector"]:
            counts = run["levels"]["triangle"]
            assert counts["truth"] > 0, "the page's scene never touches"
            assert counts["missed"] == counts["spurious"] == 0, run["detector"]
    print(f"{len(runs)} detectors judged on the page's scene")


if __name__ == "__main__":
    main()
