"""Every measure of accuracy, green and red, on results written by hand."""

import pytest

UNCHANGED_HASH = {"measure": "contact_hash", "unchanged": True}


@pytest.mark.parametrize("rule, bound, green, red, measured, allowed, frame", [
    ({"measure": "recall"}, "at_least", 0.925, 0.93, "recall 0.925 at level cell", "at least 0.93",
     "frame 5"),
    ({"measure": "missed"}, "at_most", 3, 2, "missed 3 at level cell", "at most 2", "frame 5"),
    ({"measure": "missed", "level": "cell"}, "at_least", 3, 4, "missed 3 at level cell", "at least 4",
     "frame 5"),
    ({"measure": "spurious"}, "at_most", 2, 1, "spurious 2 at level cell", "at most 1", "frame 5"),
    # Not the level of the counts per frame: the list of disagreements names the frame.
    ({"measure": "spurious", "level": "body"}, "at_most", 1, 0, "spurious 1 at level body", "at most 0",
     "frame 2"),
    ({"measure": "spurious_rate"}, "at_most", 0.1, 0.09, "spurious_rate 0.1 at level cell",
     "at most 0.09", "frame 5"),
    ({"measure": "missed_length"}, "at_most", 0.5, 0.25, "missed_length 0.5 m", "at most 0.25 m",
     "frame 5"),
    ({"measure": "covered_length_fraction"}, "at_least", 0.9, 0.91, "covered_length_fraction 0.9",
     "at least 0.91", "frame 5"),
    ({"measure": "spurious_distance_max"}, "at_most", 0.25, 0.2, "spurious_distance_max 0.25 m",
     "at most 0.2 m", "frame 5"),
    ({"measure": "depth_error_max"}, "at_most", 0.03, 0.02, "depth_error_max 0.03 m", "at most 0.02 m",
     ""),
    ({"measure": "depth_error_p95"}, "at_most", 0.02, 0.01, "depth_error_p95 0.02 m", "at most 0.01 m",
     ""),
    ({"measure": "depth_error_mean"}, "at_most", 0.01, 0.001, "depth_error_mean 0.01 m",
     "at most 0.001 m", ""),
    ({"measure": "normal_error_deg_max"}, "at_most", 30, 29, "normal_error_deg_max 30 degrees",
     "at most 29 degrees", ""),
    ({"measure": "normal_error_deg_p95"}, "at_most", 20, 19, "normal_error_deg_p95 20 degrees",
     "at most 19 degrees", ""),
    ({"measure": "normal_error_deg_mean"}, "at_most", 10, 9, "normal_error_deg_mean 10 degrees",
     "at most 9 degrees", ""),
    ({"measure": "hover_gap_max"}, "at_most", 0.125, 0.1, "hover_gap_max 0.125 m", "at most 0.1 m", ""),
    ({"measure": "late_frames"}, "at_least", -2, -1, "late_frames -2", "at least -1", ""),
    ({"measure": "stage_missed"}, "at_most", 3, 2, "stage_missed 3", "at most 2", "frame 5"),
    ({"measure": "stage_missed", "stage": "spheres"}, "at_most", 1, 0, "stage_missed 1 in stage spheres",
     "at most 0", "frame 5"),
    ({"measure": "memory_bytes"}, "at_most", 2000, 1999, "memory_bytes 2000 bytes", "at most 1999 bytes",
     "")])
def test_measure_passes_at_its_limit_and_fails_beyond(gate, results, rule, bound, green, red, measured,
                                                      allowed, frame):
    rule = {"scenes": ["touch"], "detectors": ["paper"], **rule}
    passed, failed = gate([{**rule, bound: green}, {**rule, bound: red}], results)
    assert (passed.verdict, passed.red) == ("pass", False)
    assert (failed.verdict, failed.red) == ("fail", True)
    assert failed.sentence == f"touch  paper: {measured}, allowed {allowed}" + (frame and f", {frame}")
    assert failed.rerun == ("contactcheck run scenes/touch.json --frames 8 --detector paper"
                            " --no-timing")


@pytest.mark.parametrize("rule, level, key, value, measured", [
    ({"measure": "missed", "at_most": 0}, ["levels", "triangle"], "missed", 1,
     "missed 1 at level triangle"),
    ({"measure": "spurious", "at_most": 0}, ["levels", "triangle"], "spurious", 1,
     "spurious 1 at level triangle"),
    ({"measure": "contact_hash", "equals": "truth"}, [], "contact_hash", "0xf", "contact_hash 0xf"),
    ({"measure": "stage_missed", "at_most": 0}, ["stages", 1], "missed", 1, "stage_missed 1")])
def test_injected_error_turns_a_green_gate_red(touch, results, rule, level, key, value, measured):
    assert touch("exact", results, **rule).verdict == "pass"
    place = results.row("exact")
    for step in level:
        place = place[step]
    place[key] = value
    check = touch("exact", results, **rule)
    assert check.verdict == "fail"
    assert check.sentence.startswith(f"touch  exact: {measured}, allowed ")


def test_contact_hash_of_the_baseline_passes(touch, results):
    assert touch("paper", results, results, **UNCHANGED_HASH).verdict == "pass"


def test_contact_hash_changed_by_the_detector_fails_and_says_so(touch, results):
    baseline = results.copy()
    results.row("paper")["contact_hash"] = "0xdd"
    check = touch("paper", results, baseline, **UNCHANGED_HASH)
    assert (check.verdict, check.red) == ("fail", True)
    assert check.sentence == ("touch  paper: contact_hash 0xdd, allowed 0xd, that of the baseline, frame 5; "
                              "the truth is as it was: the detector's answer changed")


def test_contact_hash_changed_with_the_truth_says_so(touch, results):
    baseline = results.copy()
    results.row("paper")["contact_hash"] = "0xdd"
    results["scenes"][0]["truth_hash"] = "0xaa"
    assert "; the truth changed as well" in touch("paper", results, baseline, **UNCHANGED_HASH).sentence


def test_contact_hash_of_other_frames_says_so(touch, results):
    baseline = results.copy()
    results.row("paper")["contact_hash"] = "0xdd"
    results.row("paper")["frames"] = 4
    check = touch("paper", results, baseline, **UNCHANGED_HASH)
    assert check.sentence.endswith("; the run has 4 frames, the baseline 8")


def test_unchanged_number_fails_in_both_directions(touch, results):
    rule = {"measure": "missed", "unchanged": True}
    baseline = results.copy()
    assert touch("paper", results, baseline, **rule).verdict == "pass"
    for missed in (2, 4):
        results.row("paper")["levels"]["cell"]["missed"] = missed
        check = touch("paper", results, baseline, **rule)
        assert check.verdict == "fail"
        assert f"missed {missed} at level cell, allowed 3, that of the baseline" in check.sentence


def test_status_is_ok_or_fails(touch, results):
    rule = {"measure": "status", "equals": "ok"}
    assert touch("exact", results, **rule).verdict == "pass"
    broken = touch("broken", results, **rule)
    assert broken.red
    assert broken.sentence == "touch  broken: status error, allowed ok, frame 4; signal 11 in a query"
    assert touch("lost", results, **rule).red, "a policy may demand presence"


def test_row_in_error_fails_every_rule_that_covers_it(touch, results):
    check = touch("broken", results, measure="memory_bytes", at_most=9)
    assert (check.verdict, check.red) == ("fail", True)
    assert check.sentence == ("touch  broken: status error, allowed at most 9 bytes, frame 4; "
                              "signal 11 in a query")


def test_row_in_error_passes_where_the_policy_says_so(touch, results):
    check = touch("broken", results, measure="memory_bytes", at_most=9, error="pass")
    assert (check.verdict, check.red) == ("cannot judge", False)


def refuse(results):
    results.row("broken").update(status="refused", message="a coordinate is too large")


@pytest.mark.parametrize("rule", [
    {"measure": "memory_bytes", "at_most": 9}, {"measure": "contact_hash", "equals": "truth"},
    {"measure": "speedup", "question": "triangles", "reference": "ref", "at_least": 1}])
def test_row_that_is_refused_fails_every_rule_that_covers_it(touch, results, rule):
    refuse(results)
    check = touch("broken", results, **rule)
    assert (check.verdict, check.red) == ("fail", True)
    assert check.sentence.startswith("touch  broken: status refused, allowed ")
    assert check.sentence.endswith(", frame 4; a coordinate is too large")


def test_row_that_is_refused_passes_where_the_policy_says_so(touch, results):
    refuse(results)
    check = touch("broken", results, measure="memory_bytes", at_most=9, refused="pass")
    assert (check.verdict, check.red) == ("cannot judge", False)
    status = touch("broken", results, measure="status", equals="ok", refused="pass")
    assert status.red, "a rule about the status itself"


UNJUDGED = [
    ("lost", {"measure": "missed", "at_most": 0}, "absent: not built"),
    ("single", {"measure": "missed", "level": "vertex", "at_most": 0},
     "level vertex is informative for this detector: shown, never gated"),
    ("single", {"measure": "missed", "at_most": 0}, "no level that the detector claims was judged"),
    ("exact", {"measure": "missed", "level": "vertex", "at_most": 0},
     'level vertex is not judged: open (body "a", frame 0, edge of vertices 4 and 5)'),
    ("exact", {"measure": "missed", "level": "box", "at_most": 0},
     "level box is not judged: the detector does not claim it, or the scene does not ask for it"),
    ("exact", {"measure": "depth_error_max", "at_most": 1},
     "depth_error_max was not measured in this row"),
    ("exact", {"measure": "stage_missed", "stage": "spheres", "at_most": 0},
     'the detector has no stage "spheres"'),
    ("single", {"measure": "stage_missed", "at_most": 0}, "the detector has no stages")]


@pytest.mark.parametrize("detector, rule, reason", UNJUDGED)
def test_what_is_not_there_cannot_be_judged(touch, results, detector, rule, reason):
    check = touch(detector, results, **rule)
    assert (check.verdict, check.red) == ("cannot judge", False)
    assert check.sentence == f"touch  {detector}: {reason}"
    assert touch(detector, results, **rule, unjudged="fail").red


def test_recall_over_nothing_cannot_be_judged(touch, results):
    results.row("paper")["levels"]["cell"].update(recall=None, spurious_rate=None)
    check = touch("paper", results, measure="recall", at_least=1)
    assert check.sentence == "touch  paper: there is no true contact at level cell"
    check = touch("paper", results, measure="spurious_rate", at_most=0)
    assert check.sentence == "touch  paper: nothing was reported at level cell"


def test_number_of_one_side_alone_is_a_change(touch, results):
    without = results.copy()
    results.row("exact")["geometry"]["depth_error_max"] = 0.25
    rule = {"measure": "depth_error_max", "unchanged": True}
    lost = touch("exact", without, results, **rule)
    assert lost.verdict == "fail"
    assert lost.sentence == ("touch  exact: was 0.25, that of the baseline; now depth_error_max was not "
                             "measured in this row")
    found = touch("exact", results, without, **rule)
    assert found.verdict == "fail"
    assert ", allowed none, that of the baseline" in found.sentence
    assert touch("exact", without, without, **rule).verdict == "cannot judge"


def test_row_that_the_baseline_lacks_cannot_be_compared(touch, results):
    baseline = results.copy()
    del baseline["runs"][0]
    check = touch("exact", results, baseline, **UNCHANGED_HASH)
    assert check.sentence == "touch  exact: the baseline has no such row"
    baseline = results.copy()
    baseline.row("exact").update(status="error", message="killed")
    check = touch("exact", results, baseline, **UNCHANGED_HASH)
    assert check.sentence == "touch  exact: in the baseline its status is error"


def test_rounded_input_is_judged_where_the_rule_says_so(touch, results):
    row = results.row("paper")
    row["levels_rounded"] = {**row["levels"], "cell": {**row["levels"]["cell"], "missed": 1}}
    rule = {"measure": "missed", "rounded": True}
    check = touch("paper", results, **rule, at_most=0)
    assert check.verdict == "fail"
    # The counts per frame are of the doubles: no frame is named.
    assert check.sentence == ("touch  paper: missed 1 at level cell of the rounded input, "
                              "allowed at most 0")
    assert touch("paper", results, **rule, at_most=1).verdict == "pass"
    check = touch("exact", results, **rule, at_most=0)
    assert check.sentence == "touch  exact: the detector is given doubles: nothing is rounded"


DEFECTS = [{"scenes": ["hard-gap"], "detectors": ["exact"], "measure": "known_defects", "at_most": 0}]


@pytest.mark.parametrize("kind", ["unlisted", "not_shown", "changed"])
def test_known_defects_fail_when_unlisted_not_shown_or_of_another_count(gate, results, kind):
    assert gate(DEFECTS, results)[0].verdict == "pass"
    defect = {"detector": "exact", "scene": "hard-gap", "kind": "missed", "values": ["0", "1"]}
    results["known_defects"][kind] = [defect]
    check = gate(DEFECTS, results)[0]
    assert check.verdict == "fail"
    assert check.sentence.startswith("hard-gap  exact: known_defects 2, allowed at most 0")
    assert check.rerun == "contactcheck run hard-gap --detector exact --no-timing"
    defect["detector"] = "other"
    assert gate(DEFECTS, results)[0].verdict == "pass", "of its own row"


def test_known_defects_cannot_be_judged_without_hard_cases(gate, results):
    del results["known_defects"]
    assert gate(DEFECTS, results)[0].verdict == "cannot judge"


def test_oracle_wrong_is_of_the_scenes_with_random_pairs(gate, results):
    rule = {"scenes": ["*"], "measure": "oracle_wrong", "at_most": 0}
    assert [check.verdict for check in gate([rule], results)] == ["pass"]
    results["scenes"][2]["pairs"]["rational"]["oracle_wrong"] = 1
    [check] = gate([rule], results)
    assert check.red
    assert check.sentence == "random-pairs  oracle: oracle_wrong 1, allowed at most 0"
    assert check.rerun == "contactcheck run --pairs 64 --seed 7"
