"""`contactcheck reduce`: from a run's case files and from families to minimal cases. What it does with
detectors of known defects is tests/faults/reduce_test.cpp.
"""

import json
import shlex

import pytest

from program import contactcheck, refused, successful

# FCL calls two triangles that are segments of one plane a contact wherever they are.
FAMILY = "hard-two-segments-plane"


def results_of_run(target, out):
    successful("run", target, "--detector", "fcl-aabb", "--no-timing", "--quiet", "--out", out)
    return json.loads((out / "results.json").read_text(encoding="utf-8"))


@pytest.fixture
def out(tmp_path):
    return tmp_path / "out"


@pytest.fixture
def disagreements(out):
    """Of a run of fcl-aabb on the family, which leaves its case files in `out`."""
    return results_of_run(FAMILY, out)["disagreements"]


def test_every_case_of_a_run_becomes_one_that_run_shows_again(tmp_path, out, disagreements):
    assert [(one["level"], one["kind"]) for one in disagreements] == [("body", "spurious"),
                                                                      ("triangle", "spurious")]
    for one in disagreements:
        file = out / one["case"]
        outcome = successful("reduce", file)
        least = file.with_suffix(".min.json")
        assert f"{least}\n" in outcome.err
        found = results_of_run(least, tmp_path / "again")["disagreements"]
        assert [(other["level"], other["kind"]) for other in found].count((one["level"], one["kind"])) == 1


def test_stays_behind_for_the_next_run(out, disagreements):
    successful("reduce", out / "cases" / "0001.json")
    results_of_run(FAMILY, out)
    assert (out / "cases" / "0001.min.json").exists()


def test_takes_another_detector_that_errs_in_the_same_way(out, disagreements):
    outcome = successful("reduce", out / "cases" / "0002.json", "--detector", "fcl-collide")
    assert "fcl-collide spurious at level triangle" in outcome.err


def test_that_does_not_show_any_more_is_refused(out, disagreements):
    outcome = contactcheck("reduce", out / "cases" / "0002.json", "--detector", "embree")
    assert outcome.exit_code == 2
    assert outcome.err == ("contactcheck: hard-two-segments-plane, frame 0: nothing is spurious at level "
                           "triangle any more in the answer of embree\n")
    assert not (out / "cases" / "0002.min.json").exists()


def test_of_a_family_is_the_first_frame_that_is_wrong(tmp_path):
    least = tmp_path / "least.json"
    detector = "fcl-obbrss:refit=bottom-up"
    outcome = successful("reduce", "hard-balls-scale", "--detector", detector, "--out", least)
    assert f"(frame 0): {detector} missed at level triangle" in outcome.err
    assert results_of_run(least, tmp_path / "out")["scenes"][0]["id"] == "least"


def test_of_a_family_may_be_the_named_value(tmp_path):
    outcome = contactcheck("reduce", f"{FAMILY}@0", "--detector", "fcl-obbrss", "--kind", "missed", "--out",
                           tmp_path / "least.json")
    assert outcome.exit_code == 2
    assert "nothing is missed in the answer of fcl-obbrss" in outcome.err


# The detector of `init`, whose answer is made wrong where more than one pair of boxes meets.
WRONG = """
source = open({detector!r}, encoding="utf-8").read()
old = '        write({{"message": "contacts"'
assert old in source
exec(source.replace(old, "        if len(found) > 1: {wrong}\\n" + old))
"""


@pytest.fixture
def row_of_boxes(tmp_path):
    """Frames of five boxes, in whose last three meet; a function that runs a detector on them, which does
    `wrong` there, and gives what is printed as `next:`."""
    successful("init", tmp_path / "mine")
    scene = {"id": "row", "title": "Two boxes come to a third", "frames": 3, "duration": 1,
             "levels": ["body", "triangle"], "bodies": []}
    for name, at in (("far", 9), ("middle", 0), ("left", [[0, [2.9, 0.1, 0.2]], [0.6, [0.5, 0.1, 0.2]]]),
                     ("farther", -9), ("right", [[0, [-2.9, 0.1, 0.2]], [0.6, [-0.6, 0.1, 0.2]]])):
        scene["bodies"].append({"name": name, "mesh": {"shape": "box"},
                                "motion": {"position": at if isinstance(at, list) else [at, 0, 0]}})
    (tmp_path / "row.json").write_text(json.dumps(scene), encoding="utf-8")

    def next_of(wrong, *words):
        (tmp_path / "wrong.py").write_text(
            WRONG.format(detector=str(tmp_path / "mine" / "detector.py"), wrong=wrong), encoding="utf-8")
        run = contactcheck("run", "row.json", "--detector-cmd", "python3 wrong.py", "--no-timing", *words,
                           cwd=tmp_path)
        [line] = [line for line in run.out.splitlines() if line.startswith("next: ")]
        return shlex.split(line)[2:]

    return next_of


def test_error_that_needs_three_bodies_has_three(tmp_path, row_of_boxes):
    words = row_of_boxes("del found[1:]")
    outcome = successful(*words, cwd=tmp_path)
    assert "row, frame 2: mine missed at level body" in outcome.err
    assert "body0 is middle, body1 is left, body2 is right." in outcome.out
    assert ("your_detector(body0_vertices, body0_triangles, body1_vertices, body1_triangles, body2_vertices, "
            "body2_triangles, 0, 2)") in outcome.out
    least = json.loads((tmp_path / "out/cases/0001.min.json").read_text(encoding="utf-8"))
    assert [len(body["mesh"]["triangles"]) for body in least["bodies"]] == [1, 1, 1]
    again = successful("run", "out/cases/0001.min.json", *words[2:], "--no-timing", "--out", "again", cwd=tmp_path)
    assert "mine missed a contact" in again.out


# The error of other bodies in the same frame is another one.
def test_case_whose_bodies_are_right_again_is_refused(tmp_path, row_of_boxes):
    words = row_of_boxes("del found[1:]")
    wrong = tmp_path / "wrong.py"
    text = wrong.read_text(encoding="utf-8")
    assert "del found[1:]" in text
    wrong.write_text(text.replace("del found[1:]", "del found[:1]"), encoding="utf-8")
    outcome = contactcheck(*words, cwd=tmp_path)
    assert outcome.exit_code == 2
    assert "row, frame 2: nothing is missed at level body any more in the answer of mine" in outcome.err


def test_crash_of_ones_own_detector_is_what_is_next(tmp_path, row_of_boxes):
    words = row_of_boxes("__import__('os').kill(__import__('os').getpid(), 11)")
    assert words[:2] == ["reduce", "out/recordings/row.ccr@2"]
    outcome = successful(*words, cwd=tmp_path)
    assert "mine answered: error: threw: the command ended with signal 11 (Segmentation fault)." in outcome.out
    least = json.loads((tmp_path / "out/cases/row-2-mine.min.json").read_text(encoding="utf-8"))
    assert [body["name"] for body in least["bodies"]] == ["middle", "left", "right"]


def test_hang_of_ones_own_detector_is_what_is_next_with_its_limit(row_of_boxes):
    words = row_of_boxes("__import__('time').sleep(1000)", "--call-limit", "4")
    assert words == ["reduce", "out/recordings/row.ccr@2", "--detector-cmd", "python3 wrong.py", "--call-limit",
                     "4"]


@pytest.mark.parametrize(("text", "named"), [
    ("", ["bad.json", "is empty"]),
    ("[]", ["bad.json"]),
    ('{"detector": "fcl-aabb", ', ["bad.json", "line 1"]),
    ('{"detector": "fcl-aabb", "kind": "missed"}', ["bad.json", "scene"])],
    ids=["empty", "neither_case_nor_scene", "cut_short", "case_without_scene"])
def test_refuses_a_bad_file(tmp_path, text, named):
    file = tmp_path / "bad.json"
    file.write_text(text, encoding="utf-8")
    refused("reduce", file, named=named, folder=tmp_path)
