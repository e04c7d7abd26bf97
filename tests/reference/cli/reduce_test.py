"""`contactcheck reduce`: from a run's case files and from families to minimal cases. What it does with
detectors of known defects is tests/faults/reduce_test.cpp.
"""

import json

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
