import pytest


@pytest.fixture
def summary_of(markdown, table_below):
    return lambda results: table_below(markdown(results), "## Summary")


def test_has_one_cell_per_column(markdown, sample):
    section = markdown(sample).split("## Summary")[1].split("\n## ")[0]
    lines = [line for line in section.split("\n") if line.startswith("|")]
    assert len(lines) == 7
    assert {line.count("|") for line in lines} == {15}


def test_adds_counts_over_scenes_and_keeps_the_range_of_speeds(summary_of, two_scenes):
    second = two_scenes["runs"][6]
    assert second["detector"] == "ffd-aabb-sphere2+tri"
    second["speedup"]["triangles"]["fcl-aabb"]["playback"]["ratio"] = 2.5
    second["speedup"]["triangles"]["fcl-aabb"].update(passes=1, interval="range")
    second["geometry"]["hover_gap_max"] = 0.004
    rows = summary_of(two_scenes)
    assert len(rows) == 5
    assert rows[0] == ["fcl-aabb", "2", "triangle", "400000", "1", "0", "0", "0/0", "0", "triangles", "5",
                       "1.00x", "-", "-"]
    assert rows[1] == ["ffd-aabb-sphere2+tri", "2", "triangle", "400000", "0.99999", "2", "4", "0/4", "4.00",
                       "triangles", "1 to 5", "2.50 to 4.00x", "-", "-"]


def test_runs_that_are_not_ok_are_counted_and_never_a_hit_or_a_miss(summary_of, two_scenes):
    assert summary_of(two_scenes)[2] == [
        "fcl-obbrss", "0 (2 error)", "", "-", "-", "-", "-", "-", "-", "", "-", "-", "-", "-"]


def test_refusals_and_errors_are_counted_apart(summary_of, two_scenes):
    assert two_scenes["runs"][2]["detector"] == "fcl-obbrss"
    two_scenes["runs"][2]["status"] = "refused"
    assert summary_of(two_scenes)[2][1] == "0 (1 error, 1 refused)"


@pytest.mark.parametrize("broken", [0, 5])
def test_run_that_is_not_ok_is_in_the_row_of_its_detector(summary_of, two_scenes, broken):
    two_scenes["runs"][broken] = {"scene": two_scenes["runs"][broken]["scene"], "detector": "fcl-aabb",
                                  "status": "error", "message": "why"}
    rows = summary_of(two_scenes)
    assert len(rows) == 5
    assert rows[0][1:4] == ["1 (1 error)", "triangle", "200000"]


def test_levels_of_different_scenes_are_not_added_up(summary_of, two_scenes):
    second = two_scenes["runs"][5]
    assert second["detector"] == "fcl-aabb"
    second["per_frame"]["level"] = "body"
    del second["levels"]["triangle"]
    rows = summary_of(two_scenes)
    assert len(rows) == 6
    assert rows[0] == ["fcl-aabb", "1", "triangle", "200000", "1", "0", "0", "0/0", "0", "triangles", "5",
                       "1.00x", "-", "-"]
    assert rows[5] == ["fcl-aabb", "1", "body", "13", "1", "0", "0", "0/0", "0", "triangles", "5",
                       "1.00x", "-", "-"]
