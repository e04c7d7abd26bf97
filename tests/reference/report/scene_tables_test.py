import re

import pytest

PHASES = {"map": 0.5, "update": 1.0, "query": 2.0, "frame": 3.5, "contact_frame": 4.0, "first_frame": 5.0,
          "cpu": 6.0}


def with_runs(results, *runs):
    return {**results, "runs": list(runs)}


def test_times_have_the_detectors_own_clock_where_it_has_one(markdown, bullet):
    run = bullet["runs"][0]
    run.update(frames=7, memory_bytes=1048576)
    run["per_frame"]["frame_ms"] = []
    times = {"prepare": 1.0, "question": "body", "timed_frames": 7, "timed_contact_frames": 7, "passes": 5,
             "playback": PHASES, "cold": PHASES}
    with_clock = {**run, "time_ms": {**times, "playback": {**PHASES, "self_reported": 2.25}}}
    without = {**run, "detector": "other", "time_ms": times}
    text = markdown(with_runs(bullet, with_clock, without))
    assert "| contact frame | first frame | own clock | CPU time |" in text
    assert "| bullet-vf | body | 1.00 | 0.500 | 1.00 | 2.00 | 3.50 | 4.00 | 5.00 | 2.25 | 6.00 |" in text
    assert "| other | body | 1.00 | 0.500 | 1.00 | 2.00 | 3.50 | 4.00 | 5.00 | - |" in text


def test_tables_say_where_frames_were_not_timed(markdown, table_below, bullet):
    run = bullet["runs"][0]
    run["frames"] = 60
    run["per_frame"]["frame_ms"] = []
    run["time_ms"].update(question="body", timed_frames=4, timed_contact_frames=0, passes=3,
                          playback=dict.fromkeys(PHASES, 0.0))
    text = markdown(bullet)
    assert "| 4 of 60 frames | 3 |" in text
    assert table_below(text, "Speed-ups: ")[0][-1] == "3 (4 of 60 frames)"
    assert table_below(text, "True contacts", titles=True)[0]["ms/frame"] == "0 (4 of 60 frames)"


def timed_run(sample, detector, **times):
    """A run with these times of a frame by question, the detector's own one first."""
    phases = dict.fromkeys(PHASES, 0.0)
    run = {**sample["runs"][0], "detector": detector, "levels": {}, "speedup": {},
           "semantics": {"questions": list(times)}}
    run["time_ms"], *run["time_ms_other_questions"] = [
        {"prepare": 0.0, "question": question, "timed_frames": 60, "timed_contact_frames": 0, "passes": 5,
         "playback": {**phases, "query": frame, "frame": frame, "first_frame": 2.0 * frame}}
        for question, frame in times.items()]
    return run


def speedup(reference, detector):
    ratio = reference / detector
    return {"playback": {"ratio": ratio, "low": 0.9 * ratio, "high": 1.1 * ratio}, "cold": None,
            "contact_frames": None, "without_map": None, "passes": 5, "interval": "95 %",
            "reference_options": {}}


@pytest.fixture
def timed(sample):
    """Three detectors. Another question is the own one of "cells" than that of its speed-ups."""
    reference = timed_run(sample, "fcl-aabb", triangles=7.654, body=1.2345)
    exact = timed_run(sample, "exact", triangles=0.6789, body=0.5)
    cells = timed_run(sample, "cells", cells=0.0777, body=0.3217)
    exact["speedup"] = {"triangles": {"fcl-aabb": speedup(7.654, 0.6789)},
                        "body": {"fcl-aabb": speedup(1.2345, 0.5)}}
    cells["speedup"] = {"body": {"fcl-aabb": speedup(1.2345, 0.3217)}}
    return with_runs(sample, reference, exact, cells)


def printed(cell):
    """The ends between which a printed number lies: half a unit of its last digit to either side."""
    digits = re.match(r"[0-9.]+", cell)[0]
    half_unit = 0.5 * 10.0 ** -len(digits.partition(".")[2])
    return float(digits) - half_unit, float(digits) + half_unit


def expect_quotient(reference, detector, ratio):
    over, under, quotient = printed(reference), printed(detector), printed(ratio)
    assert over[0] / under[1] <= quotient[1], f"{reference} / {detector} is not {ratio}"
    assert over[1] / under[0] >= quotient[0], f"{reference} / {detector} is not {ratio}"


def cell_of(rows, detector, question, title):
    cells = [row[title] for row in rows if row["detector"] == detector and row["question"] == question]
    assert len(cells) == 1, f"{detector}, {question}"
    return cells[0]


def test_quotients_of_printed_times_are_the_printed_speedups(markdown, table_below, timed):
    text = markdown(timed)
    result = table_below(text, "True contacts", titles=True)
    times = table_below(text, "Times in milliseconds", titles=True)
    speedups = table_below(text, "Speed-ups: ", titles=True)
    assert len(speedups) == 3
    for row in speedups:
        expect_quotient(cell_of(times, row["reference"], row["question"], "frame"),
                        cell_of(times, row["detector"], row["question"], "frame"), row["playback"])
    assert len(result) == 3
    expect_quotient(cell_of(result, "fcl-aabb", "triangles", "ms/frame"),
                    cell_of(result, "exact", "triangles", "ms/frame"),
                    cell_of(result, "exact", "triangles", "vs fcl-aabb"))
    expect_quotient(cell_of(times, "fcl-aabb", "body", "frame"), cell_of(result, "cells", "body", "ms/frame"),
                    cell_of(result, "cells", "body", "vs fcl-aabb"))


def test_result_has_its_own_question_where_it_was_not_timed_in_the_one_compared(markdown, table_below, timed):
    run = timed["runs"][2]
    del run["time_ms_other_questions"]
    result = table_below(markdown(with_runs(timed, run)), "True contacts", titles=True)
    assert cell_of(result, "cells", "cells", "ms/frame") == "0.0777"
    assert cell_of(result, "cells", "cells", "vs fcl-aabb") == "-"


def test_result_says_where_a_reference_has_fewer_passes(markdown, table_below, timed):
    timed["runs"][1]["speedup"]["triangles"]["fcl-aabb"].update(passes=1, interval="range")
    result = table_below(markdown(timed), "True contacts", titles=True)
    assert cell_of(result, "exact", "triangles", "passes") == "5"
    assert cell_of(result, "exact", "triangles", "vs fcl-aabb") == "11.3x (1 pass)"


def test_graded_errors_are_left_out_for_detectors_without_contour_and_depth(markdown, bullet):
    assert "Graded errors" in markdown(bullet)
    geometry = bullet["runs"][0]["geometry"]
    for field in geometry:
        geometry[field] = 0 if field.endswith("_judged") else None
    geometry["depth_kind"] = "none"
    assert "Graded errors" not in markdown(bullet)


def test_counters_are_means_per_frame_of_detectors_that_count(markdown, bullet):
    assert "Work per frame" not in markdown(bullet)
    bullet["runs"][0].update(frames=50, counters={"leaves_mapped": 600, "exact_tests": 0})
    assert "| bullet-vf | 12.0 leaves mapped, 0 exact tests |" in markdown(bullet)


@pytest.mark.parametrize("passes, sentence, row, absent", [
    (3, "(low to high) is the range of 3 passes.", "| 2.00x (1.50 to 2.50) | - | - | - | 3 |", "95 %"),
    (5, "[low, high] is the 95 % interval over 5 passes.", "| 2.00x [1.50, 2.50] | - | - | - | 5 |", "range"),
    (1, "", "| 2.00x (1 pass) | - | - | - | 1 |", "range"),
])
def test_ends_of_the_speedups_of_few_passes_are_a_range(markdown, bullet, passes, sentence, row, absent):
    bullet["runs"][0]["speedup"]["body"]["fcl-aabb"].update(
        passes=passes, interval="95 %" if passes >= 5 else "range")
    text = markdown(bullet).split("## hello")[1].split("\n## ")[0]
    assert sentence in text
    assert row in text
    assert absent not in text


def test_speedups_leave_out_the_reference_against_itself(markdown, bullet):
    assert "Speed-ups: " in markdown(bullet)
    bullet["runs"][0]["detector"] = "fcl-aabb"
    assert "Speed-ups: " not in markdown(bullet)


def test_scene_has_no_details_of_runs_that_are_not_ok(markdown, bullet):
    text = markdown(with_runs(bullet, {"scene": "hello", "detector": "x", "status": "error", "message": "y"}))
    section = text.split("\n## hello\n")[1].split("\n## ")[0].split("\n")
    assert [line for line in section if line][1:] == [
        "True contacts, summed over frames: .",
        "| detector | level | truth | recall | missed | spurious | body m/s | hover mm | late |",
        "|---|---|--:|--:|--:|--:|--:|--:|--:|",
        "| x | error | y |" + "  |" * 6]


@pytest.fixture
def fcl_run(bullet):
    """A function: a run of fcl-aabb whose spurious pairs of triangles lie at most so far apart, in metres."""

    def run_of(farthest):
        run = bullet["runs"][0]
        counts = {"truth": 1792, "reported": 1843, "hit": 1792, "missed": 0, "spurious": 51, "recall": 1.0,
                  "spurious_rate": 51 / 1843}
        return {**run, "detector": "fcl-aabb", "levels": {"triangle": counts},
                "geometry": {**run["geometry"], "spurious_distance_max": farthest}}

    return run_of


def test_findings_of_fcl_name_scenes_where_only_rounding_separates(markdown, bullet, fcl_run):
    text = markdown(with_runs(bullet, fcl_run(4e-18)))
    assert "gaps below rounding" in text
    assert "| hello | fcl-aabb | 1843 | 51 | 4.00e-15 |" in text


def test_there_are_no_findings_of_fcl_where_another_cause_may_be(markdown, bullet, fcl_run):
    text = markdown(with_runs(bullet, fcl_run(1e-6)))
    assert "| fcl-aabb | triangle |" in text
    assert "What the results say" not in text


def test_there_are_no_findings_of_fcl_without_spurious_contacts(markdown, bullet, fcl_run):
    right = fcl_run(4e-18)
    right["levels"]["triangle"].update(reported=1792, spurious=0, spurious_rate=0.0)
    text = markdown(with_runs(bullet, right, {**fcl_run(4e-18), "detector": "embree"}))
    assert "| embree | triangle |" in text
    assert "What the results say" not in text


def test_there_are_no_findings_of_fcl_in_families(markdown, bullet, fcl_run):
    bullet["scenes"][0]["family"] = {
        "parameter": "gap", "values": [], "origin": "here", "stresses": "gaps", "true_pairs": []}
    assert "What the results say" not in markdown(with_runs(bullet, fcl_run(4e-18)))


def test_there_are_no_findings_of_runs_that_are_not_ok(markdown, bullet):
    failed = {"scene": "hello", "detector": "x", "status": "error", "message": "y"}
    assert "What the results say" not in markdown(with_runs(bullet, failed))


def test_findings_of_bullet_compare_the_scales(markdown, bullet):
    run = bullet["runs"][0]
    plain = {**run, "detector": "bullet-vf:scale=1",
             "levels": {level: {**counts, "recall": {"body": 0.0, "near": 0.01}.get(level, counts["recall"])}
                        for level, counts in run["levels"].items()}}
    text = markdown(with_runs(bullet, run, plain))
    assert "small triangles do not exist" in text
    assert "| hello | 64.0 | 1 | 0.98000 | 0 | 0.01000 |" in text


def test_findings_of_bullet_say_why_normals_are_turned(markdown, bullet):
    assert "| hello | 3 | - | 90.0 | 180 |" in markdown(bullet)
    geometry = bullet["runs"][0]["geometry"]
    geometry["normal_error_deg_histogram"] = [{"from": 0.0, "below": 5.0, "count": 1},
                                              {"from": 175.0, "below": 180.0, "count": 2}]
    text = markdown(bullet)
    assert "| hello | 3 | 2 | 90.0 | 180 |" in text
    assert "normals turn" in text
    geometry["normal_error_deg_max"] = 12.0
    assert "normals turn" not in markdown(bullet)


def test_there_are_no_findings_of_bullet_without_bullet(markdown, bullet):
    bullet["runs"][0]["detector"] = "fcl-aabb"
    assert "What the results say" not in markdown(bullet)
