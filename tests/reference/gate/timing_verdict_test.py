"""Timing rules on results written by hand: "exact" is 4.00 times as fast as "ref", [3.80, 4.20], of 7
passes, at 1000 us a frame.
"""

import pytest

from program import place_at

RATIO = "speedup 4.00x [3.80, 4.20] over ref, triangles, playback"
SAME_CONTACTS = {"measure": "contact_hash", "unchanged": True}


@pytest.fixture
def speedup(touch):
    """The check of a rule about the speed-up of "exact" over "ref"; `rule` has its limits."""
    def check(results, **rule):
        rule = {"question": "triangles", "reference": "ref", **rule}
        return touch("exact", results, measure="speedup", **rule)
    return check


@pytest.fixture
def slowdown(touch):
    """The check of a rule about the slow-down of "exact" against a baseline."""
    def check(results, baseline, at_most=1.1, **rule):
        return touch("exact", results, baseline, measure="slowdown", question="triangles",
                     reference="ref", at_most=at_most, **rule)
    return check


def over_ref(results):
    return results.row("exact")["speedup"]["triangles"]["ref"]


def slower(results, factor):
    """As if "exact" took `factor` times as long."""
    slow = results.copy()
    playback = over_ref(slow)["playback"]
    for key in playback:
        playback[key] /= factor
    slow.row("exact")["time_ms"]["playback"]["frame"] *= factor
    return slow


def with_passes(results, passes):
    few = results.copy()
    few.row("exact")["time_ms"]["passes"] = passes
    over_ref(few).update(passes=passes, interval="95 %" if passes >= 5 else "range")
    few["timing"]["processes"] = passes
    return few


def put(document, path, value):
    """The document with a value at a place such as "runs/0/frames"."""
    changed = document.copy()
    place, last = place_at(changed, f"/{path}")
    place[last] = value
    return changed


def test_speedup_reached_passes(speedup, results):
    assert speedup(results, at_least=3.8).verdict == "pass"


def test_speedup_missed_by_the_whole_interval_fails_with_its_command(speedup, results):
    check = speedup(results, at_least=5)
    assert (check.verdict, check.red) == ("fail", True)
    assert check.sentence == (f"touch  exact: {RATIO}, allowed at least 5x; 200 us too long per frame of "
                              "1000 us")
    assert check.rerun == ("contactcheck run scenes/touch.json --frames 8 --detector exact --detector ref "
                           "--processes 7")


def test_speedup_missed_by_less_than_the_floor_passes(speedup, results):
    assert speedup(results, at_least=5, floor_us=201).verdict == "pass"
    assert speedup(results, at_least=5, floor_us=199).verdict == "fail"


def test_speedup_with_the_limit_in_its_interval_is_too_noisy_as_the_rule_has_it(speedup, results):
    check = speedup(results, at_least=4, noise_width=0.05)
    assert (check.verdict, check.red) == ("too noisy to judge", False)
    assert check.sentence.startswith(f"touch  exact: {RATIO}, allowed at least 4x; ")
    assert speedup(results, at_least=4, noise_width=0.05, noisy="fail").red
    assert speedup(results, at_least=4, noise_width=0.2).verdict == "pass"


@pytest.mark.parametrize("part, good, bad, us", [
    ("cold", 1.8, 2.3, 4000), ("contact_frames", 2.9, 3.2, 2000), ("without_map", 4.9, 5.2, 900)])
def test_speedup_is_of_the_part_that_the_rule_names(speedup, results, part, good, bad, us):
    assert speedup(results, part=part, at_least=good).verdict == "pass"
    check = speedup(results, part=part, at_least=bad)
    assert check.verdict == "fail"
    assert f"per frame of {us} us" in check.sentence


def test_speedup_of_another_question_takes_its_own_times(speedup, results):
    row = results.row("exact")
    row["speedup"]["body"] = row["speedup"]["triangles"]
    check = speedup(results, question="body", at_least=5)
    assert check.sentence.endswith("no times per frame of the question body")
    times = {**row["time_ms"], "question": "body"}
    row["time_ms_other_questions"] = [{**times, "playback": {**times["playback"], "frame": 0.01}}]
    # The excess of 2 us per frame is less than the default floor: the rule passes.
    assert speedup(results, question="body", at_least=5).verdict == "pass"
    check = speedup(results, question="body", at_least=5, floor_us=1.9)
    assert check.sentence.endswith("; 2 us too long per frame of 10 us")


def test_speedup_that_is_not_there_cannot_be_judged(touch, speedup, results):
    def reason(**rule):
        check = speedup(results, at_least=1, **rule)
        assert check.verdict == "cannot judge"
        return check.sentence.removeprefix("touch  exact: ")
    untimed = touch("paper", results, measure="speedup", question="triangles", reference="ref", at_least=1)
    assert untimed.sentence == "touch  paper: the run was not timed"
    assert reason(reference="embree") == "no speed-up over embree in the question triangles"
    over_ref(results).update(without_map=None, contact_frames=None, cold=None)
    assert reason(part="cold") == "no cold times: triangles is not the own question of both detectors"
    assert "maps lazily" in reason(part="without_map")
    assert reason(part="contact_frames") == "no frame with contact was timed"


def test_speedup_window_below_its_upper_end_passes(speedup, results):
    assert speedup(results, at_most=4.2).verdict == "pass"


def test_speedup_window_above_its_upper_end_blames_the_reference(speedup, results):
    check = speedup(results, at_most=2)
    assert (check.verdict, check.red) == ("fail", True)
    assert check.sentence == (f"touch  exact: {RATIO}, allowed at most 2x; ref: 2000 us too long per frame "
                              "of 4000 us")
    assert speedup(results, at_most=2, floor_us=2001).verdict == "pass", "the excess is the reference's"


def test_speedup_window_of_both_ends_fails_on_either(speedup, results):
    assert speedup(results, at_least=2, at_most=8).verdict == "pass"
    below = speedup(results, at_least=5, at_most=8)
    assert below.verdict == "fail"
    assert below.sentence.endswith(", allowed at least 5x and at most 8x; 200 us too long per frame of "
                                   "1000 us")
    above = speedup(results, at_least=1, at_most=2)
    assert above.verdict == "fail"
    assert above.sentence.endswith(", allowed at least 1x and at most 2x; ref: 2000 us too long per frame "
                                   "of 4000 us")


@pytest.mark.parametrize("ends", [
    {"at_most": 4}, {"at_least": 1, "at_most": 4}, {"at_least": 4, "at_most": 9}])
def test_speedup_window_with_an_end_in_a_wide_interval_is_too_noisy(speedup, results, ends):
    check = speedup(results, **ends, noise_width=0.05)
    assert (check.verdict, check.red) == ("too noisy to judge", False)
    assert speedup(results, **ends, noise_width=0.05, noisy="fail").red
    assert speedup(results, **ends, noise_width=0.2).verdict == "pass"


def test_speedup_window_fails_where_one_end_is_open_and_the_other_broken(speedup, results):
    # A window narrower than the noise: what one end leaves open, the other still finds.
    over_ref(results)["playback"] = {"ratio": 4.0, "low": 2.0, "high": 8.0}
    assert speedup(results, at_least=3, at_most=5).verdict == "too noisy to judge"
    assert speedup(results, at_least=1, at_most=1.9).verdict == "fail"
    assert speedup(results, at_least=8.1, at_most=9).verdict == "fail"


def test_speedup_window_of_few_passes_is_judged_by_the_factor_on_either_side(speedup, results):
    few = with_passes(results, 3)
    assert speedup(few, at_least=2.5, at_most=6.5).verdict == "pass"
    for ends in ({"at_least": 2.6, "at_most": 99}, {"at_least": 1, "at_most": 6.2}, {"at_most": 6.2},
                 {"at_most": 2.6}):
        check = speedup(few, **ends)
        assert check.verdict == "cannot judge"
        assert ("3 passes: the limit lies within a factor 1.5 of the range 3.8x to 4.2x; --processes 5 "
                "gives an interval") in check.sentence
    for ends in ({"at_most": 2.5}, {"at_least": 1, "at_most": 2.5}, {"at_least": 6.4, "at_most": 9}):
        assert speedup(few, **ends).verdict == "fail"


def test_speedup_window_of_a_reference_thirty_times_slower_is_red(speedup, results):
    over_ref(results)["playback"] = {"ratio": 120.0, "low": 60.0, "high": 240.0}
    assert speedup(results, at_least=1, at_most=9).red


def test_slowdown_of_thirty_percent_fails(slowdown, results):
    check = slowdown(slower(results, 1.3), results)
    assert (check.verdict, check.red) == ("fail", True)
    assert check.sentence == ("touch  exact: slowdown 1.30x [1.21, 1.40] (speed-up 3.077x, in the baseline "
                              "4x, over ref, triangles, playback), allowed at most 1.1x; 200 us too long "
                              "per frame of 1300 us")


@pytest.mark.parametrize("factor, verdict", [
    (1.0, "pass"), (0.5, "pass"), (1.1, "too noisy to judge"), (1.3, "fail")])
def test_slowdown_passes_without_one_and_is_too_noisy_close_to_the_limit(slowdown, results, factor, verdict):
    assert slowdown(slower(results, factor), results).verdict == verdict


@pytest.mark.parametrize("path, value, reason", [
    ("machine/cpu", "B CPU", 'cpu is "A CPU" here and "B CPU" in the baseline'),
    ("machine/cores", 64, "cores is 2 here and 64 in the baseline"),
    ("machine/isa", "SSE4", 'isa is "AVX2" here and "SSE4"'),
    ("machine/compiler", "clang 16", 'compiler is "g++ 12" here and "clang 16"'),
    ("machine/build", "Debug", 'build is "Release" here and "Debug"'),
    ("libraries/fcl", "0.8.0", 'library fcl is "0.7.0" here and "0.8.0"'),
    ("libraries/embree", "3.13.5", 'library embree is null here and "3.13.5"')])
def test_slowdown_against_another_machine_cannot_be_judged(touch, slowdown, results, path, value, reason):
    baseline = put(results, path, value)
    check = slowdown(slower(results, 1.3), baseline)
    assert (check.verdict, check.red) == ("cannot judge", False)
    assert f"another machine or build: {reason}" in check.sentence
    same = touch("exact", results, baseline, **SAME_CONTACTS)
    assert same.verdict == "pass", "contacts do not depend on the machine"


def test_slowdown_on_another_operating_system_of_the_same_machine_is_judged(slowdown, results):
    assert slowdown(slower(results, 1.3), put(results, "machine/os", "Debian 13")).verdict == "fail"


@pytest.mark.parametrize("path, value, reason", [
    ("runs/0/frames", 9, "frames is 8 here and 9 in the baseline"),
    ("runs/0/contact_frames", 2, "contact_frames is 3 here and 2 in the baseline"),
    ("runs/0/time_ms/timed_frames", 6, "8 frames are timed here and 6 in the baseline"),
    ("runs/0/speedup/triangles/ref/reference_options", {"bounds": "safe"},
     "the reference has other options in the baseline"),
    ("runs/0/speedup/triangles/ref/playback/low", 0, "a speed-up of 0 has no logarithm"),
    ("runs/0/speedup/triangles", {}, "in the baseline: no speed-up over ref in the question triangles")])
def test_slowdown_of_another_measurement_cannot_be_judged(slowdown, results, path, value, reason):
    baseline = put(results, path, value)
    baseline.row("exact")["per_frame"]["frame_ms"] = []  # which has as many entries as there are frames
    check = slowdown(slower(results, 1.3), baseline)
    assert check.verdict == "cannot judge"
    assert check.sentence == f"touch  exact: {reason}"


def test_slowdown_of_other_cold_frames_cannot_be_judged(slowdown, results):
    assert slowdown(results, results, at_most=1.5, part="cold").verdict == "pass"
    baseline = results.copy()
    baseline["scenes"][0]["cold_frames"] = [1, 3, 4, 7]
    check = slowdown(results, baseline, at_most=1.5, part="cold")
    assert check.verdict == "cannot judge"
    assert check.sentence == "touch  exact: other frames are timed cold in the baseline"
    assert slowdown(results, baseline, at_most=1.5).verdict == "pass", "a playback has all frames"


@pytest.mark.parametrize("limit, verdict", [
    (2.5, "pass"), (2.6, "cannot judge"), (6.2, "cannot judge"), (6.4, "fail")])
def test_few_passes_decide_a_speedup_beyond_a_factor_alone(speedup, results, limit, verdict):
    assert speedup(with_passes(results, 3), at_least=limit).verdict == verdict  # 3.8 to 4.2


def test_few_passes_that_decide_nothing_say_what_would(speedup, results):
    few = with_passes(results, 3)
    check = speedup(few, at_least=3)
    assert (check.verdict, check.red) == ("cannot judge", False)
    sentence = ("touch  exact: {}speedup 4.00x (range 3.80 to 4.20) over ref, triangles, playback, allowed "
                "at least 3x; 8 frames, 3 passes: the limit lies within a factor 1.5 of the range 3.8x to "
                "4.2x; --processes 5 gives an interval")
    assert check.sentence == sentence.format("")
    red = speedup(few, at_least=3, unjudged="fail")
    assert red.red
    assert red.sentence == sentence.format("cannot judge: ")
    assert red.rerun.endswith(" --detector exact --detector ref --processes 5")


@pytest.mark.parametrize("part, limit, frames", [("cold", 2, 4), ("contact_frames", 3, 3)])
def test_few_passes_are_of_the_frames_of_the_rules_part(speedup, results, part, limit, frames):
    check = speedup(with_passes(results, 3), part=part, at_least=limit)
    assert f"; {frames} frames, 3 passes: " in check.sentence


def test_one_pass_has_no_range(speedup, results):
    one = with_passes(results, 1)
    over_ref(one)["playback"] = {"ratio": 4, "low": 4, "high": 4}
    assert speedup(one, at_least=3).sentence == (
        "touch  exact: speedup 4.00x (1 pass) over ref, triangles, playback, allowed at least 3x; 8 frames, "
        "1 pass: the limit lies within a factor 1.5 of 4x; --processes 5 gives an interval")


def test_few_passes_of_either_side_make_a_slowdown_a_range(slowdown, results):
    few, slow = with_passes(results, 3), slower(results, 1.3)
    then = slowdown(slow, few)
    assert then.verdict == "cannot judge"
    assert then.sentence.endswith(
        "; 8 frames, 7 passes, 3 in the baseline: the limit lies within a factor 1.5 of the range 1.18x to "
        "1.44x; --processes 5 in the baseline gives an interval")
    now = slowdown(with_passes(slow, 3), results)
    assert now.sentence.endswith("; --processes 5 gives an interval")
    both = slowdown(with_passes(slow, 3), few)
    assert both.sentence.endswith("; --processes 5 here and in the baseline gives an interval")
    assert slowdown(with_passes(slower(results, 2.0), 3), few).verdict == "fail"
