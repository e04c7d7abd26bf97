"""The examples in reference/plugin/README.md do what it says: compiled and run as they stand there.

    own_detector_readme_test.py README PROGRAM C_COMPILER HEADER_FOLDER CPP_MAIN FOLDER
"""

import json
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

SCENE = {
    "id": "boxes", "frames": 2, "duration": 1, "levels": ["body", "triangle"],
    "bodies": [
        {"name": "left", "mesh": {"shape": "box", "divisions": 2}, "lattice": {"cells": [2, 2, 2]}},
        {"name": "right", "mesh": {"shape": "box", "divisions": 2}, "lattice": {"cells": [2, 2, 2]},
         "motion": {"position": [0.9, 0.1, 0.2]}},
    ],
}


def block(text, language):
    blocks = re.findall(r"```" + language + r"\n(.*?)```", text, re.DOTALL)
    assert len(blocks) == 1, f"{len(blocks)} blocks of {language}"
    return blocks[0]


def row_of(program, folder, words):
    """What the run says about the detector `mine`."""
    scene = folder / "boxes.json"
    scene.write_text(json.dumps(SCENE))
    out = folder / "out"
    subprocess.run([program, "run", scene, *words, "--no-timing", "--quiet", "--out", out], check=True)
    rows = json.loads((out / "results.json").read_bytes())["runs"]
    assert [row["detector"] for row in rows] == ["mine"], rows
    return rows[0]


def expect_silence(row):
    """It finds nothing, and nothing else is wrong with it."""
    level = row["levels"]["triangle"]
    assert row["status"] == "ok" and row["notes"] == [], row
    assert level["truth"] > 0 and level["missed"] == level["truth"], level
    assert level["spurious"] == 0, level


def expect_boxes(row):
    """Here the bodies touch where their boxes do, in both frames."""
    level = row["levels"]["body"]
    assert row["status"] == "ok" and row["notes"] == [], row
    assert level["truth"] == 2 and level["hit"] == 2 and level["spurious"] == 0, level


def main():
    readme, program, compiler, headers, cpp_main, folder = sys.argv[1:]
    text, folder = pathlib.Path(readme).read_text(encoding="utf-8"), pathlib.Path(folder)
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    (folder / "mine.c").write_text(block(text, "c"), encoding="utf-8")
    library = folder / "libmine.so"
    subprocess.run([compiler, "-shared", "-fPIC", "-I", headers, folder / "mine.c", "-o", library], check=True)
    expect_silence(row_of(program, folder, ["--detector", library]))
    (folder / "mine.py").write_text(block(text, "python"), encoding="utf-8")
    command = shlex.join([sys.executable, str(folder / "mine.py")])
    expect_boxes(row_of(program, folder, ["--detector-cmd", command]))
    stub = pathlib.Path(headers).parent / "cli/init/detector.py"
    assert block(text, "python") == stub.read_text(encoding="utf-8"), "init writes another detector"
    assert block(text, "cpp") in pathlib.Path(cpp_main).read_text(encoding="utf-8")


main()
