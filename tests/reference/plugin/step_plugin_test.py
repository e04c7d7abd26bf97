"""Libraries, commands and classes in Python that answer about steps: a small triangle passes through a
large one at half of the only step. Three of its vertices meet the large one there, and no edges."""

import json
import os
import shlex
import sys

import pytest
from program import contactcheck, valid_results

LIBRARY = os.environ["CONTACTCHECK_STEP_LIBRARY"]
COMMAND = os.path.join(os.path.dirname(__file__), "step_command.py")
OBJ = "v {0} {0} 0\nv {1} {0} 0\nv {0} {1} 0\nf 1 2 3\n"


def scene(folder, end=-1, **more):
    (folder / "large.obj").write_text(OBJ.format(0, 1))
    (folder / "small.obj").write_text(OBJ.format(0.25, 0.5))
    text = {"id": "pass", "frames": 2, "time_step": 1,
            "levels": ["body", "triangle", "impact-vf", "impact-ee", "impact-triangle", "impact"],
            "bodies": [{"name": "large", "mesh": {"file": "large.obj"}},
                       {"name": "small", "mesh": {"file": "small.obj"},
                        "motion": {"position": [[0, [0.375, 0.375, 1]], [1, [0.375, 0.375, end]]]}}], **more}
    (folder / "pass.json").write_text(json.dumps(text))
    return folder / "pass.json"


def row_of(folder, *arguments, timing=False, **more):
    outcome = contactcheck("run", scene(folder, **more), *arguments, "--out", folder / "out",
                           *([] if timing else ["--no-timing"]))
    assert outcome.exit_code != 2, outcome.err
    return valid_results(folder / "out" / "results.json")["runs"][0]


def library(says):
    return "--detector", f"{LIBRARY}:says={says}"


def command(says):
    return "--detector-cmd", f"{shlex.quote(sys.executable)} {shlex.quote(COMMAND)} {says}"


BOTH = pytest.mark.parametrize("kind", (library, command))


def wrong(row):
    return {level: (counts["missed"], counts["spurious"]) for level, counts in row["levels"].items()
            if counts["missed"] or counts["spurious"]}


@BOTH
def test_a_right_answer_is_right_at_every_level(tmp_path, kind):
    row = row_of(tmp_path, *kind("truth"), timing=True)
    assert row["status"] == "ok", row["message"]
    assert row["semantics"]["questions"] == ["impacts"]
    assert wrong(row) == {}
    assert {level: counts["truth"] for level, counts in row["levels"].items()} == {
        "impact-vf": 3, "impact-ee": 0, "impact-triangle": 1, "impact": 1}
    assert row["impacts"] == {"tunnelled": [0], "timed": 1, "early_max": 0, "late_max": 0,
                              "new_triangles": 1, "new_missed": 0}
    assert row["time_ms"]["question"] == "impacts" and row["time_ms"]["timed_frames"] == 1


@BOTH
def test_what_is_not_reported_has_tunnelled(tmp_path, kind):
    row = row_of(tmp_path, *kind("nothing"))
    assert wrong(row) == {"impact-vf": (3, 0), "impact-triangle": (1, 0), "impact": (1, 0)}
    assert row["impacts"]["tunnelled"] == [1]
    assert row["impacts"]["early_max"] is None and row["impacts"]["new_missed"] == 1


@BOTH
def test_early_times_are_told(tmp_path, kind):
    impacts = row_of(tmp_path, *kind("early"))["impacts"]
    assert impacts["early_max"] == pytest.approx(0.25, abs=1e-12) and impacts["late_max"] == 0


def test_late_times_are_told(tmp_path):
    impacts = row_of(tmp_path, *library("late"))["impacts"]
    assert impacts["late_max"] == pytest.approx(0.25, abs=1e-12) and impacts["early_max"] == 0


@BOTH
def test_without_times_there_are_no_errors_of_times(tmp_path, kind):
    row = row_of(tmp_path, *kind("timeless"))
    assert wrong(row) == {}
    assert (row["impacts"]["timed"], row["impacts"]["early_max"]) == (0, None)


@BOTH
def test_wrong_edges_are_spurious(tmp_path, kind):
    assert wrong(row_of(tmp_path, *kind("edges"))) == {"impact-ee": (0, 1)}


@BOTH
@pytest.mark.parametrize("says,sentence", (
    ("no-edge", 'names an edge from vertex 1 to vertex 7, which body "large" does not have'),
    ("nan", "holds a time of contact that is not within [0, 1]")))
def test_what_cannot_be_is_an_error(tmp_path, kind, says, sentence):
    row = row_of(tmp_path, *kind(says))
    assert row["status"] == "error" and sentence in row["message"], row["message"]


def test_time_after_the_step_is_an_error(tmp_path):
    row = row_of(tmp_path, *library("after"))
    assert row["status"] == "error" and "not within [0, 1]" in row["message"]


def test_items_that_say_no_contact_are_passed_over(tmp_path):
    assert wrong(row_of(tmp_path, *library("unsaid"))) == {}


def test_bodies_alone_are_an_answer(tmp_path):
    row = row_of(tmp_path, *library("bodies"))
    assert list(row["levels"]) == ["impact"] and wrong(row) == {}


def test_levels_and_question_go_together(tmp_path):
    outcome = contactcheck("run", scene(tmp_path), *command("no-question"), "--out", tmp_path / "out")
    assert outcome.exit_code == 2
    assert "and the question impacts go together" in outcome.err


@BOTH
def test_scene_of_frames_alone_is_refused(tmp_path, kind):
    row = row_of(tmp_path, *kind("truth"), levels=["body", "triangle"])
    assert row["status"] == "refused"
    assert "the scene has no level of them" in row["message"]


def test_scene_of_one_frame_has_no_step(tmp_path):
    row = row_of(tmp_path, "--detector", "swept-aabb", frames=1)
    assert row["status"] == "refused" and "there is only one" in row["message"]


# The small triangle falls to an eighth above the large one: what is reported does not meet.
NEAR = {"near": 3, "near_max": 0.125, "undecided": 0}


def within(row, level):
    counts = row["levels"][level]["within"]
    assert counts.pop("near_of_start_max") == pytest.approx(0.125 if counts["near"] else 0, rel=1e-9)
    return counts


@pytest.mark.parametrize("answer", (library("tolerant"), command("truth 0.125"), command("truth 0.01 0.125")))
def test_report_within_the_tolerance_is_near(tmp_path, answer):
    row = row_of(tmp_path, *answer, end=0.125)
    assert row["status"] == "ok", row["message"]
    assert wrong(row) == {}
    assert within(row, "impact-vf") == NEAR
    assert within(row, "impact-triangle") == within(row, "impact") == {**NEAR, "near": 1}
    assert within(row, "impact-ee")["near"] == 0


@pytest.mark.parametrize("tolerances", ("0.124", "0 0.124"))
def test_report_beyond_the_tolerance_is_spurious(tmp_path, tolerances):
    row = row_of(tmp_path, *command("truth " + tolerances), end=0.125)
    assert wrong(row) == {"impact-vf": (0, 3), "impact-triangle": (0, 1), "impact": (0, 1)}
    assert within(row, "impact")["near"] == 0


def test_without_a_tolerance_nothing_is_near(tmp_path):
    row = row_of(tmp_path, *command("truth"), end=0.125)
    assert wrong(row)["impact-vf"] == (0, 3)
    assert "within" not in row["levels"]["impact-vf"] and "tolerance" not in row["semantics"]


@pytest.mark.parametrize("tolerance,early,at_start", (("1", None, 1), ("0.999", 0.5, None)))
def test_time_0_is_not_early_within_the_tolerance_at_the_start(tmp_path, tolerance, early, at_start):
    impacts = row_of(tmp_path, *command("start " + tolerance))["impacts"]
    assert impacts["early_max"] == early and impacts.get("near_at_start") == at_start


@pytest.mark.parametrize("tolerances", ("-1", "0 -1e-9"))
def test_tolerance_that_is_none_is_refused(tmp_path, tolerances):
    outcome = contactcheck("run", scene(tmp_path), *command("truth " + tolerances), "--out", tmp_path / "out")
    assert outcome.exit_code == 2 and "a tolerance is no number from 0 on" in outcome.err, outcome.err


def test_policy_caps_what_a_tolerance_excuses(tmp_path):
    row_of(tmp_path, *command("truth 0.125"), end=0.125)
    def gate(measure, at_most):
        (tmp_path / "policy.json").write_text(json.dumps(
            {"schema": "contactcheck-policy/1", "id": "cap", "title": "a cap", "rules": [
                {"rule": "cap", "scenes": ["*"], "detectors": ["*steps*"], "measure": measure, "level": "impact",
                 "at_most": at_most}]}))
        return contactcheck("gate", tmp_path / "out" / "results.json", "--policy", tmp_path / "policy.json").exit_code
    assert [gate("near_max", cap) for cap in (0.125, 0.1249)] == [0, 1]
    assert [gate("near_of_start_max", cap) for cap in (0.1251, 0.1249)] == [0, 1]
    assert [gate("near", most) for most in (1, 0)] == [0, 1]
    assert gate("undecided", 0) == 0


def test_report_tells_what_a_tolerance_excuses(tmp_path):
    outcome = contactcheck("run", scene(tmp_path, end=0.125), *command("truth 0.125"), "--out", tmp_path / "out",
                           "--no-timing")
    assert "within the tolerance" in outcome.out
    report = (tmp_path / "out" / "report.md").read_text()
    assert "Reports within the tolerance" in report and "tolerance within steps 125 mm" in report
    csv = (tmp_path / "out" / "report.csv").read_text().splitlines()
    row = dict(zip(csv[0].split(","), csv[1].split(",")))
    assert (row["impact_near"], row["impact_near_max_m"], row["impact_undecided"]) == ("1", "0.125", "0")
