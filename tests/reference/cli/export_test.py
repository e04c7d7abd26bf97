"""`contactcheck export`: what it writes, what it replaces, and what it leaves behind when it cannot
finish. That the certificates are right is tested in tests/reference/oracle.
"""

import json
import os
import re
import signal
import sys
import time

import pytest

from program import PROGRAM, RunningProgram, names_in, refused, run_program, successful, tiny_scene


@pytest.fixture
def scene(tmp_path):
    file = tmp_path / "tiny.json"
    file.write_text(tiny_scene(), encoding="utf-8")
    return file


def exported(out, *words, **settings):
    return successful("export", *words, "--out", out, **settings)


def index(out):
    return json.loads((out / "tiny" / "scene.json").read_text(encoding="utf-8"))


def frames_in(folder):
    return sorted(int(name.removeprefix("frame_").removesuffix(".json"))
                  for name in names_in(folder / "truth"))


def expect_proven(folder, frames):
    """The checker that lies in the folder is content with it; what it says."""
    check = run_program(sys.executable, ["-B", folder / "check.py"])
    assert check.exit_code == 0, check.err
    assert check.out.startswith(f"{folder.name}: {frames} frames proven: ")
    return check.out


def test_writes_a_folder_that_proves_itself(tmp_path, scene):
    out = tmp_path / "out"
    outcome = exported(out, scene)
    assert f"{out / 'tiny'}: 5 frames; " in outcome.out
    assert index(out)["contact_hash"] in outcome.out
    assert names_in(out) == {"tiny"}
    assert names_in(out / "tiny") == {"bodies", "check.py", "scene.json", "truth"}
    assert names_in(out / "tiny" / "bodies") == {"0-left", "1-right"}
    assert names_in(out / "tiny" / "truth") == {f"frame_000{number}.json" for number in range(5)}
    [pairs] = re.findall(r"(\d+) pairs of triangles touch, (\d+) more", outcome.out)
    assert re.findall(r"(\d+) pairs of triangles .*; (\d+) are", expect_proven(out / "tiny", 5)) == [pairs]
    assert "0" not in pairs


def test_every_takes_some_of_the_frames(tmp_path, scene):
    out = tmp_path / "out"
    exported(out, scene, "--frames", "10", "--every", "4")
    assert frames_in(out / "tiny") == [0, 4, 8]
    assert index(out)["scene_frames"] == 10
    expect_proven(out / "tiny", 3)


def test_of_a_recording_has_the_same_hash(tmp_path, scene):
    out = tmp_path / "out"
    exported(out, scene)
    contact_hash = index(out)["contact_hash"]
    successful("run", scene, "--quiet", "--no-timing", "--detector", "fcl-aabb", "--out", tmp_path / "run")
    exported(out, tmp_path / "run" / "recordings" / "tiny.ccr")
    assert index(out)["contact_hash"] == contact_hash
    expect_proven(out / "tiny", 5)


def test_of_a_suite_is_a_folder_per_scene(tmp_path):
    fixtures, out = tmp_path / "fixtures", tmp_path / "out"
    for name in ("scenes", "suites"):
        (fixtures / name).mkdir(parents=True)
    frames = {"one": 3, "two": 2}
    for name, count in frames.items():
        (fixtures / "scenes" / f"{name}.json").write_text(tiny_scene(name, count), encoding="utf-8")
    (fixtures / "suites" / "both.json").write_text(
        json.dumps({"id": "both", "scenes": list(frames), "detectors": ["fcl-aabb"]}), encoding="utf-8")
    exported(out, "both", env={"CONTACTCHECK_FIXTURES": str(fixtures)})
    assert names_in(out) == set(frames)
    for name, count in frames.items():
        expect_proven(out / name, count)


def test_of_one_drawn_scene_has_its_frames(tmp_path):
    exported(tmp_path / "out", "drawn-3-6")
    assert len(frames_in(tmp_path / "out" / "drawn-3-6")) > 2
    successful("run", "drawn-3-6", "--no-timing", "--detector", "fcl-aabb", "--quiet", "--out", tmp_path / "run")
    again = successful("export", "drawn-3-6.ccr", "--out", tmp_path / "again", cwd=tmp_path / "run" / "recordings")
    assert "drawn-3-6" in again.out
    refused("export", "drawn-3-6", "--frames", "2", "--out", tmp_path / "out",
            named=["--frames", "drawn with their frames"], folder=tmp_path)


def test_replaces_an_earlier_one_whole(tmp_path, scene):
    out = tmp_path / "out"
    exported(out, scene)
    exported(out, scene, "--frames", "2")
    assert names_in(out) == {"tiny"}
    assert frames_in(out / "tiny") == [0, 1]
    expect_proven(out / "tiny", 2)


def test_leaves_alone_what_is_no_export(tmp_path, scene):
    (tmp_path / "out" / "tiny").mkdir(parents=True)
    (tmp_path / "out" / "tiny" / "scene.json").write_text('{"id": "tiny"}', encoding="utf-8")
    refused("export", scene, "--out", tmp_path / "out",
            named=[str(tmp_path / "out" / "tiny"), "is there already and is no export"], folder=tmp_path)


def test_interrupted_leaves_nothing(tmp_path):
    long, out = tmp_path / "long.json", tmp_path / "out"
    long.write_text(tiny_scene("long", 100_000), encoding="utf-8")
    with RunningProgram(PROGRAM, ["export", long, "--out", out]) as running:
        while not any("frame_0002.json" in names for _, _, names in os.walk(out)):
            assert not running.has_ended(), running.outcome().err
            time.sleep(0.01)
        running.send(signal.SIGINT)
        assert running.outcome().exit_code == 128 + signal.SIGINT
    assert names_in(out) == set()


def test_full_disk_leaves_all_or_nothing(tmp_path, scene):
    """Files may not grow beyond some size: whatever cannot be written, no unfinished folder looks like an
    export, and the earlier one stays as it was."""
    out = tmp_path / "out"
    exported(out, scene, "--frames", "2")
    before = (out / "tiny" / "scene.json").read_bytes()
    failures = successes = 0
    for blocks in (1, 2, 4, 8, 16, 32, 64, 128, 256):
        outcome = run_program("/bin/sh", ["-c", f'ulimit -f {blocks}; exec "$0" "$@"', PROGRAM, "export",
                                          scene, "--out", out])
        assert names_in(out) == {"tiny"}
        if outcome.exit_code == 0:
            successes += 1
            expect_proven(out / "tiny", 5)
            continue
        failures += 1
        assert outcome.exit_code == 2
        assert "File too large" in outcome.err
        assert (out / "tiny" / "scene.json").read_bytes() == before
    assert failures > 1
    assert successes > 0
