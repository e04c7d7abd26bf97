"""`contactcheck reduce` with detectors whose minimal case is known, from the command line to the case that
`contactcheck run` shows again."""

import json
import os
import re
import sys

import pytest

from program import run_program, valid_results

WITH_FAULTS = os.environ["CONTACTCHECK_WITH_FAULTS"]

# Two divided boxes that press into one another; where they do, they reach above z = 1.5.
BOXES = {
    "id": "boxes", "frames": 1, "duration": 1, "levels": ["body", "triangle"],
    "bodies": [{"name": "lower", "mesh": {"shape": "box", "sides": [1.1, 1.2, 1.3], "divisions": 2,
                                          "center": [0.12, 0.34, 1.1]}},
               {"name": "upper", "mesh": {"shape": "box", "divisions": 2, "center": [0.31, 0.52, 2.17]}}]}

# The same in lattices, the second bent.
BOX = {"mesh": {"shape": "box", "divisions": 2}, "lattice": {"cells": [3, 3, 3]}}
BEND = {"bend": {"axis": "y", "toward": "x", "degrees": 40}}
BENT_BOXES = {**BOXES, "id": "bent", "bodies": [
    {"name": "lower", **BOX},
    {"name": "upper", **BOX, "motion": {"position": [0.4, 0.3, 0.2], "deformers": [BEND]}}]}

DRAW_RULES = {
    "id": "small", "detectors": ["full-refit"], "meshes": ["box", "letter", "sphere", "torus"],
    "shares": {"deep": 1}, "most_triangles": 4000, "triangles": [80, 600], "cells": [8, 60],
    "bodies": [2, 4], "size_ratio": [1, 4], "frames": [6, 10], "speed": [0, 0.05],
    "contact_share": [0.34, 1], "deformers": [0, 2], "twist": [-60, 60], "bend": [-60, 60],
    "taper": [-0.3, 0.3], "stretch": [-0.25, 0.4], "apart_gap": [0.1, 1], "near_gap": [1e-5, 0.01],
    "graze_depth": [1e-6, 0.0001], "touch_depth": [0.001, 0.02], "deep_depth": [0.03, 0.2]}


def reduce(folder, detector, *flags, scene=BOXES):
    (folder / "scene.json").write_text(json.dumps(scene), encoding="utf-8")
    return run_program(WITH_FAULTS, ["reduce", folder / "scene.json", "--detector", detector,
                                     "--out", folder / "least.json", *flags])


def reduced(folder, *words, **kwargs):
    """The minimal case that `reduce` writes, and what it says."""
    outcome = reduce(folder, *words, **kwargs)
    assert outcome.exit_code == 0, outcome.err
    return json.loads((folder / "least.json").read_text(encoding="utf-8")), outcome


def triangles(case):
    return [len(body["mesh"]["triangles"]) for body in case["bodies"]]


def run_again(folder, detector):
    run_program(WITH_FAULTS, ["run", folder / "least.json", "--detector", detector, "--no-timing",
                              "--quiet", "--out", folder / "out"])
    return valid_results(folder / "out" / "results.json")


def test_miss_becomes_two_triangles_of_small_whole_numbers(tmp_path):
    case, _ = reduced(tmp_path, "fault-misses-high")
    assert case["id"] == "least"
    assert triangles(case) == [1, 1]
    places = [place for body in case["bodies"] for place in body["mesh"]["vertices"]]
    for place in places:
        for number in place:
            assert number == int(number) and abs(number) <= 9
    assert max(z for _, _, z in places) > 1.5


def test_it_says_what_it_found_and_prints_a_test(tmp_path):
    outcome = reduce(tmp_path, "fault-misses-high")
    assert outcome.err.startswith("boxes, frame 0: fault-misses-high missed at level triangle\n")
    assert "triangles                            96          2" in outcome.err
    assert "answered: 0 pairs at level triangle of 1 true: 1 missed" in outcome.err
    assert "least.json\n" in outcome.err
    # Standard output is a source file.
    assert outcome.out.startswith("// fault-misses-high: missed at level triangle. From boxes, frame 0.\n"
                                  "TEST(FaultMissesHigh, MissedTriangleBoxes) {\n")
    assert outcome.out.endswith("\n  EXPECT_TRUE(your_detector(first_vertices, first_triangles, "
                                "second_vertices, second_triangles, 0, 0));\n}\n")


@pytest.mark.parametrize("answer", [True, False])
def test_it_prints_python_that_runs_unchanged(answer, tmp_path):
    _, outcome = reduced(tmp_path, "fault-misses-high", "--print", "python")
    script = f"def your_detector(*given):\n    return {answer}\n{outcome.out}"
    assert (run_program(sys.executable, ["-c", script]).exit_code == 0) is answer


def test_a_log_shows_its_progress(tmp_path):
    outcome = reduce(tmp_path, "fault-hang:frame=0", "--call-limit", "1", "--budget", "4")
    assert " candidates tried, now " in outcome.err


def test_it_writes_a_case_that_run_shows_again(tmp_path):
    reduced(tmp_path, "fault-misses-high")
    results = run_again(tmp_path, "fault-misses-high")
    assert results["runs"][0]["levels"]["triangle"]["missed"] == 1
    assert results["disagreements"][0]["kind"] == "missed"


def test_three_triangles_stay_where_it_takes_three(tmp_path):
    case, _ = reduced(tmp_path, "fault-misses-crowds")
    assert triangles(case) == [3, 1]


def test_it_gives_the_same_bytes_every_time(tmp_path):
    texts = []
    for _ in range(2):
        _, outcome = reduced(tmp_path, "fault-misses-crowds")
        texts.append((outcome.out, (tmp_path / "least.json").read_bytes()))
    assert texts[0] == texts[1]


def test_crash_is_reduced(tmp_path):
    case, outcome = reduced(tmp_path, "fault-crashes-in-crowds")
    assert "error: signal 11" in outcome.err
    assert sum(triangles(case)) == 5
    assert run_again(tmp_path, "fault-crashes-in-crowds")["runs"][0]["status"] == "error"


def test_hang_is_reduced(tmp_path):
    case, outcome = reduced(tmp_path, "fault-hang:frame=0", "--call-limit", "0.2", "--budget", "15")
    assert "error: time limit" in outcome.err
    assert "15 candidates tried, the whole budget" in outcome.err
    assert sum(triangles(case)) == 2


@pytest.mark.parametrize("fault, flags, error", [
    ("fault-throw:frame=0", ["--budget", "50"], "error: threw"),
    ("fault-memory:frame=0", ["--budget", "1", "--memory-limit", "500"], "error: memory limit"),
])
def test_throw_and_memory_are_errors_that_it_reduces(fault, flags, error, tmp_path):
    assert error in reduce(tmp_path, fault, *flags).err


@pytest.mark.parametrize("fault", ["fault-close", "fault-stdout", "fault-locale", "fault-trap"])
def test_it_undoes_what_a_detector_changes_in_its_process(fault, tmp_path):
    outcome = reduce(tmp_path, f"{fault}:frame=0")
    assert outcome.exit_code == 2
    assert "nothing is wrong" in outcome.err


# The first frame is answered rightly, and the second one, in the same process, is not.
def test_error_that_depends_on_earlier_answers_is_refused(tmp_path):
    outcome = reduce(tmp_path, "fault-forgets", scene={**BOXES, "frames": 2})
    assert outcome.exit_code == 2
    assert "depends on what ran before it in its process" in outcome.err
    assert not (tmp_path / "least.json").exists()


def test_error_that_takes_the_lattice_of_the_scene_is_refused(tmp_path):
    outcome = reduce(tmp_path, "fault-misses-in-lattices", scene=BENT_BOXES)
    assert outcome.exit_code == 2
    assert "with the scene's own lattices and rest shapes alone" in outcome.err
    assert not (tmp_path / "least.json").exists()


# ---- run --reduce


def run_and_reduce(folder, target, words):
    (folder / "target.json").write_text(json.dumps(target), encoding="utf-8")
    return run_program(WITH_FAULTS, ["run", folder / "target.json", *words, "--reduce", "--no-timing",
                                     "--quiet", "--out", folder / "out"])


def test_run_reduces_the_first_error_of_each_detector_level_and_kind(tmp_path):
    outcome = run_and_reduce(tmp_path, BOXES, [
        "--detector", "full-refit", "--detector", "fault-misses-high",
        "--detector", "fault-crashes-in-crowds"])
    assert outcome.exit_code == 3, "one has crashed"
    assert "not reduced" not in outcome.out
    cases = tmp_path / "out" / "cases"
    least = cases / "min-fault-misses-high-missed-triangle-boxes.json"
    assert ("\nreduced: boxes, frame 0: fault-misses-high missed at level triangle: 2 triangles: "
            f"{least}\n") in outcome.out
    for file in (least, cases / "min-fault-crashes-in-crowds-error-boxes.json"):
        assert len(json.loads(file.read_text(encoding="utf-8"))["bodies"]) == 2


def test_run_says_what_cannot_be_reduced(tmp_path):
    outcome = run_and_reduce(tmp_path, BENT_BOXES, ["--detector", "fault-misses-in-lattices"])
    assert outcome.exit_code == 0
    assert "\nnot reduced: bent, frame 0, fault-misses-in-lattices: " in outcome.out


def test_case_of_a_drawn_scene_names_its_parameters(tmp_path):
    outcome = run_and_reduce(tmp_path, DRAW_RULES, ["--seed", "7", "--count", "2",
                                                    "--detector", "fault-misses-crowds"])
    assert outcome.exit_code == 0, outcome.err
    file = tmp_path / "out" / "cases" / "min-fault-misses-crowds-missed-triangle-drawn-7-1.json"
    assert re.search("scene drawn-7-1 .bodies [2-4], .*, frame [0-9]+, detector fault-misses-crowds",
                     file.read_text(encoding="utf-8"))
