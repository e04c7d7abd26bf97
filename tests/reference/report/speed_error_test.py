import copy

import pytest


@pytest.fixture
def chart_of(markdown, table_below):
    """A function: the scenes that the chart is of, its rows by detector, and the sentence about detectors
    that are not in it."""

    def chart(results):
        section = markdown(results).split("## Speed against error")[1].split("\n## ")[0]
        scenes = section.split("\nOver ")[1].split(". A time is")[0]
        rows = {row["detector"]: row for row in table_below(section, "", titles=True)}
        return scenes, rows, section.partition("Not in the chart: ")[2].strip()

    return chart


@pytest.fixture
def good_twice(sample):
    """The two good runs of the sample, in a further scene."""
    sample["scenes"].append({**copy.deepcopy(sample["scenes"][0]), "id": "second"})
    sample["runs"] += [{**run, "scene": "second"} for run in copy.deepcopy(sample["runs"][:2])]
    return sample


def test_says_which_detectors_are_left_out_and_why(chart_of, sample):
    assert chart_of(sample)[2] == "fcl-obbrss, embree, ffd-grid (ended well in 0 of 1 scenes)."


def test_takes_one_scene_where_most_detectors_did_not_run_in_all(chart_of, good_twice):
    runs = good_twice["runs"]
    runs += [{**copy.deepcopy(runs[0]), "detector": name} for name in "abc"]
    assert chart_of(good_twice)[0] == "scene hello", "5 detectors there, 2 in both"
    del runs[9]
    assert chart_of(good_twice)[0] == "all 2 scenes", "4 there, 2 in both"


def test_hard_cases_are_their_own_chart(chart_of, hard):
    scenes, rows, _ = chart_of(hard)
    assert scenes == "all 2 families of hard cases"
    assert list(rows) == ["exact", "skin"]


def test_levels_that_are_no_claim_do_not_count(chart_of, sample):
    sample["runs"][0]["levels"]["triangle"]["informative"] = True
    _, rows, left_out = chart_of(sample)
    assert list(rows) == ["ffd-aabb-sphere2+tri"]
    assert "fcl-aabb (nothing to judge)" in left_out


def test_counts_of_different_levels_do_not_add_up(chart_of, good_twice):
    second = good_twice["runs"][6]
    assert second["detector"] == "ffd-aabb-sphere2+tri"
    second["per_frame"]["level"] = "body"
    del second["levels"]["triangle"]
    row = chart_of(good_twice)[1]["ffd-aabb-sphere2+tri"]
    assert row["level"] == "body"
    assert row["truth"] == "26", "13 pairs of bodies in either scene"
    assert row["spurious"] == "4"
    second["per_frame"]["level"] = "near"
    second["levels"] = {"near": {**second["levels"]["body"], "margin": 0.001}}
    _, rows, left_out = chart_of(good_twice)
    assert "ffd-aabb-sphere2+tri" not in rows
    assert "ffd-aabb-sphere2+tri (nothing to judge)" in left_out, "in common"


# The judge's order, which is not that of the results: containment is never the finest.
def test_bodies_that_touch_come_before_bodies_that_contain(chart_of, good_twice):
    for i in (1, 6):
        levels = good_twice["runs"][i]["levels"]
        levels["containment"] = levels["body"]
    good_twice["runs"][6]["per_frame"]["level"] = "body"
    del good_twice["runs"][6]["levels"]["triangle"]
    assert chart_of(good_twice)[1]["ffd-aabb-sphere2+tri"]["level"] == "body"


def test_scenes_with_nothing_to_judge_do_not_coarsen_the_others(chart_of, good_twice):
    del good_twice["runs"][6]["per_frame"]["level"]
    good_twice["runs"][6]["levels"] = {}
    row = chart_of(good_twice)[1]["ffd-aabb-sphere2+tri"]
    assert row["level"] == "triangle"
    assert row["truth"] == "200000"


def test_without_times_there_is_nothing_to_compare(markdown, sample):
    for run in sample["runs"][:2]:
        run["time_ms"] = {"prepare": 1.0}
    assert "Speed against error" not in markdown(sample)
    sample["runs"] = []
    assert "Speed against error" not in markdown(sample)
    sample["scenes"] = []
    assert "Speed against error" not in markdown(sample)


def test_times_that_no_axis_has_are_none(chart_of, sample):
    sample["runs"][0]["time_ms"]["playback"]["frame"] = 0.0
    _, rows, left_out = chart_of(sample)
    assert "fcl-aabb" not in rows
    assert "fcl-aabb (not timed)" in left_out
