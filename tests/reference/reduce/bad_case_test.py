"""Cases and scenes that contactcheck reduce cannot take: exit code 2, one sentence that names the place."""

import json
import shutil

import pytest

from program import refused, successful

CASE = "cases/0002.json"


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """A run with one case of triangles: FCL calls triangles that are segments of one plane a contact."""
    out = tmp_path_factory.mktemp("run")
    successful("run", "hard-two-segments-plane", "--detector", "fcl-aabb", "--no-timing", "--quiet", "--out",
               out)
    return out


@pytest.fixture
def case(run, tmp_path):
    for folder in ("cases", "recordings"):
        shutil.copytree(run / folder, tmp_path / folder)
    case = json.loads((tmp_path / CASE).read_text(encoding="utf-8"))
    assert case["level"] == "triangle"
    return case


def expect_refused(case, folder, *named):
    (folder / CASE).write_text(json.dumps(case), encoding="utf-8")
    refused("reduce", CASE, named=[CASE, *named], folder=folder)


@pytest.mark.parametrize("key", ["scene", "frame", "detector", "level", "kind", "first", "second"])
def test_case_without_a_member_is_refused(case, tmp_path, key):
    del case[key]
    expect_refused(case, tmp_path, f"{key} is missing")


@pytest.mark.parametrize("place, value, named", [
    (["level"], "corner", ['level is "corner"']),
    (["kind"], "late", ['kind is "late"']),
    (["frame"], 8, ["frame is 8", "from 0 to 7"]),
    (["frame"], -1, ["frame is -1"]),
    (["color"], "red", ["color"]),
    (["recording"], "gone.ccr", ["gone.ccr", "does not exist"]),
    (["first", "body"], "nobody", ['first.body is "nobody"', "one of first, second"]),
    (["second", "body"], "first", ['second.body is "first"', "another body than first"]),
    (["first", "triangle"], 12, ["first.triangle is 12"]),
    (["first", "vertices"], [["0x0p+0"] * 3] * 2, ["first.vertices", "array of 2"]),
    (["first", "vertices", 1, 2], "0x", ["first.vertices[1][2]"]),
    (["second", "vertices", 1, 2], "0x1p-3", ["second.vertices[1]", "of another run"])])
def test_case_with_a_wrong_value_is_refused(case, tmp_path, place, value, named):
    *steps, last = place
    target = case
    for step in steps:
        target = target[step]
    target[last] = value
    expect_refused(case, tmp_path, *named)


@pytest.mark.usefixtures("case")
def test_case_with_a_broken_recording_is_refused(tmp_path):
    [recording] = (tmp_path / "recordings").iterdir()
    recording.write_text("no recording", encoding="utf-8")
    refused("reduce", CASE, named=[recording.name, "not a recording"], folder=tmp_path)


@pytest.mark.parametrize("target, named", [
    ("hard-shared-edge@7", ['"7"', "0x1p-1074"]), ("hard", ["is a suite"]),
    ("paper-rabbit", ["is simulated"]), ("atlantis@3", ["atlantis"])])
def test_scene_without_such_a_frame_is_refused(tmp_path, target, named):
    refused("reduce", target, "--detector", "fcl-aabb", "--out", "least.json", named=named, folder=tmp_path)
