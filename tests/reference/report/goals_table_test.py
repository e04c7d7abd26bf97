import pytest


@pytest.fixture
def with_goals(sample):
    return {**sample, "goals": [
        {"goal": "faster", "scene": "s", "detector": "d", "part": "playback", "over": "embree",
         "at_least": 12.0, "measured": 11.95, "low": 11.5, "high": 12.5, "unit": "x", "met": False},
        {"goal": "cheap", "scene": "s", "detector": "d", "part": "cold", "per": "pair",
         "at_most": 0.15, "measured": 0.125, "unit": "us", "met": True},
        {"goal": "wide", "scene": "t", "detector": "e", "part": "playback", "over": "d",
         "at_most": 1.4, "measured": None, "why": "e: not here", "met": None}]}


def test_says_what_was_wanted_measured_and_met(markdown, table_below, with_goals):
    assert table_below(markdown(with_goals), "## Goals of the suite") == [
        ["faster", "s", "d", ">= 12.0x", "11.9x (11.5 to 12.5)", "-", "no"],
        ["cheap", "s", "d", "<= 0.150 us", "0.125 us", "-", "yes"],
        ["wide", "t", "e", "<= 1.40x", "-", "-", "not measured: e: not here"]]


def test_says_what_the_ends_are_from_the_passes_of_the_row(markdown, table_below, with_goals):
    def section():
        return markdown(with_goals).split("## Goals of the suite")[1].split("\n## ")[0]

    with_goals["goals"][0].update(scene="hello", detector="ffd-aabb-sphere2+tri", over="fcl-aabb")
    assert table_below(section(), "")[0][4:6] == ["11.9x [11.5, 12.5]", "5"]
    assert "[low, high] is the 95 % interval over 5 passes." in section()
    with_goals["runs"][1]["speedup"]["triangles"]["fcl-aabb"].update(passes=3, interval="range")
    assert table_below(section(), "")[0][4:6] == ["11.9x (11.5 to 12.5)", "3"]
    assert "95 %" not in section()


def test_is_left_out_of_suites_that_have_none(markdown, sample):
    assert "Goals" not in markdown(sample)
