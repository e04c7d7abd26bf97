"""The worked examples of detectors from outside, through the whole program."""

import json
import os
import pathlib
import shlex
import sys

import pytest

from program import PROGRAM, ROOT, contactcheck, refused, run_program, successful, valid_results
from tiny_run import UNTIMED, TinyRun

LIBRARY = os.environ["CONTACTCHECK_C_EXAMPLE"]
IMPACTS_LIBRARY = os.environ["CONTACTCHECK_C_IMPACTS_EXAMPLE"]
CPP_PROGRAM = os.environ["CONTACTCHECK_CPP_EXAMPLE"]
PYTHON_FOLDER = pathlib.Path(__file__).with_name("python-pipe")
COMMAND = shlex.join([sys.executable, "-B", str(PYTHON_FOLDER / "detector.py")])
IMPACTS_COMMAND = shlex.join([sys.executable, "-B", str(PYTHON_FOLDER / "impacts.py")])

# Simulated bodies that fall on one another, driven by detectors from outside.
FALL = """{
  "id": "fall", "title": "A box falls onto another", "frames": 4,
  "simulation": {"every": 6, "ground": {}, "driver": "ffd-aabb+tri"},
  "levels": ["body", "triangle"],
  "bodies": [
    {"name": "below", "mesh": {"shape": "box", "divisions": 2}, "lattice": {"cells": [2, 2, 2]},
     "motion": {"position": [0, 0.6, 0]}, "material": {"model": "mass-spring", "mass": 1}},
    {"name": "above", "mesh": {"shape": "box", "divisions": 2}, "lattice": {"cells": [2, 2, 2]},
     "motion": {"position": [0.1, 1.7, 0.2]}, "material": {"model": "mass-spring", "mass": 1}}]
}"""


def assert_exact(row):
    assert row["status"] == "ok", row["message"]
    level = row["levels"]["triangle"]
    assert level["truth"] > 0
    assert (level["missed"], level["spurious"]) == (0, 0)


def test_from_outside_they_answer_as_fcl_does(tmp_path):
    run = TinyRun(tmp_path, ["--detector", LIBRARY, "--detector-cmd", COMMAND, "--detector", "fcl-aabb"])
    assert run.outcome.exit_code == 0, run.outcome.err
    for detector in ("c-sweep", "python-sweep"):
        row = run.row(detector)
        assert_exact(row)
        assert row["contact_hash"] == run.row("fcl-aabb")["contact_hash"]
        assert row["notes"] == []
    assert run.row("c-sweep")["semantics"]["exact"] is False
    assert run.row("python-sweep")["semantics"]["exact"] is True


def test_from_outside_they_are_named_in_the_results(tmp_path):
    run = TinyRun(tmp_path, ["--detector", f"{LIBRARY}:axis=z", "--detector-cmd", COMMAND])
    assert run.row("c-sweep:axis=z")["options"] == {"axis": "z"}
    # A shell reads the command of the results as the words of this run.
    words = shlex.split(run.results["command"])
    assert words[words.index("--detector-cmd") + 1] == COMMAND
    command, library = run.results["plugins"]
    assert (command["detector"], command["kind"], command["source"]) == ("python-sweep", "command", COMMAND)
    assert (library["detector"], library["source"]) == ("c-sweep", pathlib.Path(LIBRARY).name)
    assert library["version"] == "1.0"


def test_in_c_it_tells_of_its_stages_and_counts(tmp_path):
    row = TinyRun(tmp_path, ["--detector", LIBRARY]).row("c-sweep")
    boxes, = row["stages"]
    assert boxes["name"] == "boxes"
    assert boxes["missed"] == 0
    assert row["levels"]["triangle"]["truth"] <= boxes["out"] < boxes["in"]
    assert row["counters"]["pairs_swept"] == boxes["in"]
    assert row["counters"]["triangle_pairs_tested"] == boxes["out"]


def test_library_twice_is_two_rows(tmp_path):
    run = TinyRun(tmp_path, ["--detector", f"{LIBRARY}:axis=y", "--detector", LIBRARY])
    assert_exact(run.row("c-sweep:axis=y"))
    assert_exact(run.row("c-sweep"))
    assert len(run.results["plugins"]) == 1


def test_they_are_timed_in_every_process_beside_their_own_clock(tmp_path):
    run = TinyRun(tmp_path, ["--detector", LIBRARY, "--detector-cmd", COMMAND, "--detector", "fcl-aabb"],
                  ["--processes", "2", "--threads", "2"])
    assert run.outcome.exit_code == 0, run.outcome.err
    for detector in ("c-sweep", "python-sweep"):
        row = run.row(detector)
        assert row["time_ms"]["passes"] == 2
        assert "fcl-aabb" in row["speedup"]["triangles"]
        for regime in ("playback", "cold"):
            assert row["time_ms"][regime]["self_reported"] > 0
    for regime in ("playback", "cold"):
        times = run.row("python-sweep")["time_ms"][regime]
        assert times["self_reported"] < times["update"] + times["query"], "only ours includes the pipe"
        assert "self_reported" not in run.row("fcl-aabb")["time_ms"][regime]


def test_in_python_it_answers_for_bodies_that_touch_themselves(tmp_path):
    scenes = ["hard-self-layers", "hard-self-crossing-scale", "hard-self-t-junction",
              "hard-self-sectors-turned", "hard-self-corner-segment", "hard-self-repeated-index",
              "hard-self-point", "hard-self-hinge-turned", "hard-self-edge-segments",
              "hard-self-edge-needle", "hard-self-duplicates"]
    successful("run", *scenes, "--detector-cmd", COMMAND, "--no-timing", "--out", tmp_path / "out")
    rows = valid_results(tmp_path / "out" / "results.json")["runs"]
    assert len(rows) == 11
    for row in rows:
        assert row["status"] == "ok", row["message"]
        level, = row["levels"].values()
        assert (level["missed"], level["spurious"]) == (0, 0), row["scene"]


# Touching, degenerate and coplanar triangles, and pairs that rounding gets wrong: the example in
# Python claims them all.
def test_in_python_it_is_exact_on_hard_cases(tmp_path):
    scenes = ["hard-point", "hard-segment", "hard-segment-in-plane", "hard-two-segments",
              "hard-two-segments-plane", "hard-vertex-vertex", "hard-coplanar-slide", "hard-identical"]
    successful("run", *scenes, "--pairs", "300", "--detector-cmd", COMMAND, "--no-timing",
               "--out", tmp_path / "out")
    rows = valid_results(tmp_path / "out" / "results.json")["runs"]
    assert len(rows) == 9
    for row in rows:
        assert row["status"] == "ok", row["message"]
        level = row["levels"]["triangle"]
        assert (level["missed"], level["spurious"]) == (0, 0), row["scene"]


def test_in_cpp_it_is_in_the_list_of_its_program():
    assert "\ncpp-sweep\n" in run_program(CPP_PROGRAM, ["list", "--detectors"]).out


def test_in_cpp_it_is_judged_by_its_program(tmp_path):
    run = TinyRun(tmp_path, ["--detector", "cpp-sweep:axis=y"], UNTIMED, of=CPP_PROGRAM)
    assert run.outcome.exit_code == 0, run.outcome.err
    assert_exact(run.row("cpp-sweep:axis=y"))


def test_they_drive_simulations(tmp_path):
    scene = tmp_path / "fall.json"
    scene.write_text(FALL, encoding="utf-8")
    successful("run", scene, "--closed-loop", "--processes", "1", "--detector", LIBRARY,
               "--detector-cmd", COMMAND, "--out", tmp_path / "out")
    rows = valid_results(tmp_path / "out" / "results.json")["runs"]
    assert len(rows) > 1
    for row in rows:
        assert "closed_loop" in row, row["message"]
        assert row["closed_loop"]["error"] == ""
        assert "step_ms" in row


def ab(base, head, folder):
    return ("ab", base, head, "hard-vertex-face", "--rounds", "5", "--floor-us", "1e9", "--quiet",
            "--out", folder / "ab")


@pytest.mark.parametrize("base, head, row", [
    (LIBRARY, LIBRARY, ""), (COMMAND, f"env {COMMAND}", ""),
    (LIBRARY, f"{LIBRARY}:axis=y", "c-sweep -> c-sweep:axis=y "), (COMMAND, LIBRARY, "python-sweep -> c-sweep "),
    ("fcl-aabb", "embree", "fcl-aabb -> embree ")],
    ids=["libraries", "commands", "options", "command and library", "built in"])
def test_two_detectors_are_compared_in_turns(base, head, row, tmp_path):
    outcome = contactcheck(*ab(base, head, tmp_path))
    assert outcome.exit_code == 0, outcome.out
    assert "PASS: answers are equal, 1 time is within the limit." in outcome.out
    # Of two builds of one detector a ratio within the limit is not told.
    assert f"hard-vertex-face  {row}" in outcome.out if row else "hard-vertex-face" not in outcome.out


@pytest.mark.parametrize("base, head, named", [
    (PROGRAM, LIBRARY, ["is a program and head", "is a detector; ab compares two programs or two detectors"]),
    ("embree", PROGRAM, ["is a detector and head", "is a program; ab compares two programs or two detectors"]),
], ids=["program and library", "name and program"])
def test_program_and_detector_are_not_compared(base, head, named, tmp_path):
    refused(*ab(base, head, tmp_path), named=named, folder=tmp_path)


# ---- queries of moving elements


def judged_queries(program, folder, *words):
    """The rows of two files with proved truth, by file and detector."""
    files = sorted((ROOT / "fixtures" / "queries").glob("*/by_hand.csv"))
    outcome = run_program(program, ["queries", *files, *words, "--out", folder])
    assert outcome.exit_code == 0, outcome.err
    document = json.loads((folder / "queries.json").read_text(encoding="utf-8"))
    return [{row["detector"]: row for row in file["detectors"]} for file in document["files"]]


def test_in_c_boxes_of_time_and_place_miss_nothing(tmp_path):
    for rows in judged_queries(PROGRAM, tmp_path, "--detector", IMPACTS_LIBRARY, "--detector",
                               f"{IMPACTS_LIBRARY}:tolerance=0.001"):
        for name in ("c-inclusion", "c-inclusion:tolerance=0.001"):
            score = rows[name]["score"]
            assert score["truth"] > 50 and score["missed"] == score["spurious"] == 0
            assert score["near"] > 0
            assert rows[name]["time_of_contact"]["late_max"] == 0
        coarse, fine = (rows[name]["score"]["near"]
                        for name in ("c-inclusion:tolerance=0.001", "c-inclusion"))
        assert coarse >= fine


def test_in_python_changes_of_a_sign_find_crossings_and_no_touching(tmp_path):
    for rows in judged_queries(PROGRAM, tmp_path, "--detector-cmd", IMPACTS_COMMAND):
        score = rows["python-samples"]["score"]
        assert 20 < score["hit"] < score["truth"]


def test_in_cpp_boxes_before_the_exact_test_lose_nothing(tmp_path):
    for rows in judged_queries(CPP_PROGRAM, tmp_path, "--detector", "cpp-boxes", "--detector", "exact"):
        for row in rows.values():
            assert row["score"]["missed"] == row["score"]["spurious"] == 0
        assert rows["cpp-boxes"]["score"] == rows["exact"]["score"]
