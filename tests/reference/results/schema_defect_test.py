"""Results files that do not satisfy fixtures/results.schema.json: the sentence names place and value."""

import json

import pytest

from program import EXAMPLE_RESULTS, place_at, refused, successful


@pytest.fixture
def results():
    return json.loads(EXAMPLE_RESULTS.read_text(encoding="utf-8"))


def put(results, path, value):
    place, last = place_at(results, f"/{path}")
    place[last] = value


def expect_refused(results, folder, sentence):
    (folder / "r.json").write_text(json.dumps(results), encoding="utf-8")
    assert refused("diff", "r.json", "r.json", named=[], folder=folder) == (
        f"contactcheck: r.json: not complete: {sentence}\n")


@pytest.mark.parametrize("path, value, sentence", [
    ("runs/0/levels/body/truth", -1, "runs[0].levels.body.truth is -1; it must be at least 0"),
    ("runs/0/levels/body/truth", 1.5, "runs[0].levels.body.truth is 1.5; it must be of type integer"),
    ("runs/0/levels/body/recall", 1.5, "runs[0].levels.body.recall is 1.5; it must be at most 1"),
    ("runs/0/time_ms/pass_ms", [1, 0], "runs[0].time_ms.pass_ms[1] is 0; it must be above 0"),
    ("runs/0/scene", "", 'runs[0].scene is ""; it must be a text that is not empty'),
    ("runs/0/status", "fine", 'runs[0].status is "fine"; it must be one of ok, error, absent, refused'),
    ("libraries/fcl", 7, "libraries.fcl is 7; it must be of type string"),
    ("runs/0/speedup/body/fcl-aabb/interval", "range",
     'runs[0].speedup.body.fcl-aabb.interval is "range"; it must be "95 %"'),
    # Names of members are checked, too.
    ("runs/0/speedup/spheres", {}, 'a key of runs[0].speedup is "spheres"; it must be one of triangles, '
                                   "body, cells, contacts, self, impacts, self-impacts"),
    # Of alternatives the sentence is that of the first.
    ("runs/0/geometry/missed_length", "long",
     'runs[0].geometry.missed_length is "long"; it must be of type number'),
    ("merged", [], "merged is an array of 0; it must be at least 1 long"),
    ("resumed", ["a", "b", "a"], 'resumed[2] is "a", as an earlier one is'),
    ("known_defects/more", 1, "known_defects.more is not allowed")])
def test_wrong_value_is_named_with_its_place(results, tmp_path, path, value, sentence):
    put(results, path, value)
    expect_refused(results, tmp_path, sentence)


def test_member_that_a_condition_asks_for_is_missing(results, tmp_path):
    del results["runs"][0]["contact_hash"]
    expect_refused(results, tmp_path, "runs[0].contact_hash is missing")


def test_member_that_another_one_asks_for_is_missing(results, tmp_path):
    del results["goals"][0]["high"]
    expect_refused(results, tmp_path, "goals[0].high is missing beside low")


def test_example_and_an_array_that_does_not_repeat_itself_have_no_defect(results, tmp_path):
    successful("diff", EXAMPLE_RESULTS, EXAMPLE_RESULTS)
    results["resumed"] = ["a", "b"]
    (tmp_path / "r.json").write_text(json.dumps(results), encoding="utf-8")
    successful("diff", tmp_path / "r.json", tmp_path / "r.json")
