"""The scripts of tests/examples/python say what they are there to say."""

import pathlib
import re
import subprocess
import sys

import pytest

EXAMPLES = pathlib.Path(__file__).parents[2] / "examples" / "python"
SAID = {
    "judge_detector": ["ffd-lazy       contact in 8 frames, missed in 0, spurious in 0",
                       "vertex-inside  contact in 8 frames, missed in 8, spurious in 0",
                       "first missed at height 0.2"],
    "first_bad_frame": ["first frame in contact: 24 of 33", r"the frame before: 0\.02\d\d m apart",
                        "pairs of triangles, 0 vertices of the sheet inside the ball"],
    "self_intersections": ["frame 24: 15 pairs", "frames without self-contact: 24",
                           r"pairs in the last five frames: \[15, 27, 39, 51, 57\]"],
    "compare_versions": [r"before  spurious by frame: \[0, 0, 0, 0\]",
                         r"after   spurious by frame: \[0, 4, 0, 4\]", "failed: plates  mine: contact_hash"],
    "cost_against_separation": [r"ffd-lazy ( *\d+\.\d\d){12} ms", r"fcl-aabb ( *\d+\.\d\d){12} ms", r"cost\.svg"],
}


def test_every_example_is_run():
    assert {file.stem for file in EXAMPLES.glob("*.py")} == set(SAID)


@pytest.mark.parametrize("name", SAID)
def test_an_example_says_what_it_says(name, tmp_path):
    script = EXAMPLES / f"{name}.py"
    said = subprocess.run([sys.executable, "-B", script], cwd=tmp_path, check=True, capture_output=True, text=True)
    for line in SAID[name]:
        assert re.search(line, said.stdout), said.stdout
