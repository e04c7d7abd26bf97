"""What the times of a run are worth: how much of them was taken off, and passes compared with one another."""

import copy
import math
import re

import pytest

SLOWER_FIRST = [1.5, 1.0, 3.0, 2.0, 0.3, 0.2, 6.0, 4.0, 1.5, 1.0]


@pytest.fixture
def timed_rows(sample):
    """A function: results with a row per detector, of passes that took so long."""

    def results_of(*detectors):
        run = {**sample["runs"][0], "speedup": {}}
        runs = []
        for i, pass_ms in enumerate(detectors):
            times = {**run["time_ms"], "passes": len(pass_ms) or 1}
            runs.append({**run, "detector": f"d{i}",
                         "time_ms": {**times, "pass_ms": pass_ms} if pass_ms else times})
        return {**sample, "runs": runs}

    return results_of


@pytest.fixture
def steadiness_of(markdown):
    """A function: the line about each detector compared with itself; "" where there is none."""

    def line_in(results):
        lines = re.findall("^- (each detector beside itself.*)$", markdown(results), re.MULTILINE)
        assert len(lines) <= 1
        return lines[0] if lines else ""

    return line_in


@pytest.fixture
def timing_of(markdown):
    return lambda results: re.search("^- (timing: .*)$", markdown(results), re.MULTILINE)[1]


def passes_round_one(half_width):
    """Ten passes whose ratios, pair by pair, have an interval of this half-width round 1."""
    t4 = 2.776  # Student's t of 5 ratios
    ratio = math.exp(math.log(1.0 + half_width) * math.sqrt(5.0) / t4)
    return [ratio, 1.0, 1.0, ratio, 2.0 * ratio, 2.0, 3.0, 3.0 * ratio, 5.0, 5.0]


def test_steadiness_is_said_of_five_pairs_of_passes(steadiness_of, timed_rows):
    assert steadiness_of(timed_rows()) == ""
    assert steadiness_of(timed_rows([], [1.0] * 9)) == "", "four pairs and one pass"
    assert steadiness_of(timed_rows([1.0] * 10)) == (
        "each detector beside itself, over 5 pairs of passes: 1.00 lies inside 1 of 1 intervals of 95 %; "
        "their median half-width is 0.0 %")


def test_steadiness_counts_intervals_that_miss_one_and_gives_the_median_half_width(steadiness_of, timed_rows):
    results = timed_rows(passes_round_one(0.05), SLOWER_FIRST, [1.0] * 9, passes_round_one(0.25))
    assert steadiness_of(results) == (
        "each detector beside itself, over 5 pairs of passes: 1.00 lies inside 2 of 3 intervals of 95 %; "
        "their median half-width is 5.0 %")


def test_steadiness_counts_every_question_and_names_the_fewest_pairs(steadiness_of, timed_rows):
    results = timed_rows([1.0] * 13)
    assert "over 6 pairs of passes: 1.00 lies inside 1 of 1" in steadiness_of(results)
    other = timed_rows(SLOWER_FIRST)["runs"][0]["time_ms"]
    results["runs"][0]["time_ms_other_questions"] = [{**other, "question": "body"}]
    assert "over 5 pairs of passes: 1.00 lies inside 1 of 2" in steadiness_of(results)


def test_steadiness_is_the_last_line_about_the_run(markdown, steadiness_of, sample):
    assert steadiness_of(sample) == ""
    assert "beside itself" not in markdown(sample)
    sample["runs"][0]["time_ms"].update(passes=10, pass_ms=SLOWER_FIRST)
    *_, timing, line = markdown(sample).split("\n\n## Summary")[0].split("\n")
    assert timing.startswith("- timing: ")
    assert line == "- " + steadiness_of(sample)
    assert "inside 0 of 1 intervals" in line


def test_timing_says_what_share_of_the_time_was_taken_off(timing_of, sample):
    runs = copy.deepcopy(sample["runs"])
    assert "given to others" not in timing_of(sample)
    runs[1]["time_ms"]["playback"]["taken"] = 0.0
    assert "given to others" not in timing_of({**sample, "runs": runs})
    # The times of the two rows, 2 and 0.5 ms, do not contain it.
    runs[0]["time_ms"]["playback"]["taken"] = 0.5
    assert ". 16.7 % of the time was given to others by the machine" in timing_of({**sample, "runs": runs})
