"""The frame that a broken rule names, and the command that shows it again."""

import pytest

NONE_MISSED = {"measure": "missed", "at_most": 0}
SOME_MISSED = {"measure": "missed", "at_least": 1}  # what an exact detector breaks
TOUCH_AGAIN = "contactcheck run scenes/touch.json --frames 8 --detector "
PAPER_AGAIN = "--detector paper --no-timing"
EXACT_AGAIN = "contactcheck run scenes/touch.json --frames 8 --detector exact --detector ref"


def test_worst_frame_of_a_family_names_the_value(gate, results):
    row = results.row("exact", "hard-gap")
    row["per_frame"]["missed"] = [0, 1, 0]
    row["levels"]["triangle"]["missed"] = 1
    [check] = gate([{"scenes": ["hard-gap"], "detectors": ["exact"], **NONE_MISSED}], results)
    assert check.sentence.endswith(", frame 1 (1e-9)")


def test_worst_frame_of_equal_ones_is_the_first(touch, results):
    results.row("paper")["per_frame"]["missed"] = [0, 0, 4, 1, 4, 0, 0, 0]
    assert touch("paper", results, **NONE_MISSED).sentence.endswith(", frame 2")


def test_worst_frame_of_changed_contacts_may_be_one_with_spurious_ones(touch, results):
    baseline = results.copy()
    results.row("paper")["per_frame"]["missed"] = [0] * 8
    results.row("paper")["contact_hash"] = "0xdd"
    check = touch("paper", results, baseline, measure="contact_hash", unchanged=True)
    assert ", frame 5; " in check.sentence


def test_worst_frame_is_not_guessed_from_another_level(touch, results):
    check = touch("paper", results, level="body", **SOME_MISSED)
    assert check.red
    assert "frame" not in check.sentence


@pytest.mark.parametrize("command, again", [
    (None, TOUCH_AGAIN + "paper --no-timing"),
    ("contactcheck run default --out touch-out", "contactcheck run touch --frames 8 " + PAPER_AGAIN),
    ("contactcheck run out/recordings/touch.ccr", "contactcheck run out/recordings/touch.ccr " + PAPER_AGAIN),
    ("contactcheck run '/srv/Größe mit/touch.json' --out elsewhere",
     "contactcheck run '/srv/Größe mit/touch.json' --frames 8 " + PAPER_AGAIN)])
def test_rerun_names_the_file_that_the_run_named(touch, results, command, again):
    if command:
        results["command"] = command
    assert touch("paper", results, **NONE_MISSED).rerun == again


@pytest.mark.parametrize("scene, again", [
    ("hard-gap", "contactcheck run hard-gap --detector exact --no-timing"),
    ("random-pairs", "contactcheck run --pairs 64 --seed 7 --detector exact --no-timing")])
def test_rerun_keeps_the_cases_of_a_family_and_makes_random_pairs_again(gate, results, scene, again):
    [check] = gate([{"scenes": [scene], "detectors": ["exact"], **SOME_MISSED}], results)
    assert check.rerun == again


@pytest.mark.parametrize("old, name, word", [
    ("paper", "cmd:'x' y", "'cmd:'\\''x'\\'' y'"),
    ("exact", "ffd-aabb+tri:bounds=safe,isa=SSE4", "ffd-aabb+tri:bounds=safe,isa=SSE4")])
def test_rerun_quotes_what_a_shell_would_take_apart(touch, results, old, name, word):
    results.row(old)["detector"] = name
    assert touch(name, results, measure="memory_bytes", at_most=0).rerun == (
        TOUCH_AGAIN + word + " --no-timing")


def test_rerun_of_a_timing_rule_on_random_pairs_is_timed(gate, results):
    # It was the command of a rule on accuracy, which measures no time.
    timed = results.row("exact")
    for name in ("exact", "ref"):
        row = {**results.row("exact", "random-pairs"), "detector": name}
        if name == "exact":
            row.update(time_ms=timed["time_ms"], speedup=timed["speedup"],
                       per_frame={**row["per_frame"], "frame_ms": [1.0] * row["frames"]})
            results["runs"].remove(results.row("exact", "random-pairs"))
        results["runs"].append(row)
    rule = {"measure": "speedup", "question": "triangles", "reference": "ref", "at_least": 9}
    [check] = gate([{"scenes": ["random-pairs"], "detectors": ["exact"], **rule}], results)
    assert check.rerun.startswith("contactcheck run --pairs 64 --seed 7 --detector exact --detector ref --processes ")


@pytest.mark.parametrize("detector", ["exact", "ref"])
def test_no_rerun_of_a_transient_detector_or_reference(touch, results, detector):
    # A class in an interpreter that has ended: the command was printed and did nothing.
    results["plugins"] = [{"detector": detector, "kind": "command", "source": "it", "content": "c",
                           "version": "", "transient": True}]
    rule = {"measure": "speedup", "question": "triangles", "reference": "ref"}
    assert touch("exact", results, at_least=9, **rule).rerun == ""
    results["plugins"] = []
    assert touch("exact", results, at_least=9, **rule).rerun.startswith(EXACT_AGAIN)


@pytest.mark.parametrize("passes, seed, fails, cannot_judge", [
    (7, 1, " --processes 7", None),
    (3, 1, " --processes 3", " --processes 5"),
    (3, 7, " --processes 3 --seed 7", " --processes 5 --seed 7")])
def test_rerun_of_a_timing_rule_runs_the_reference_beside_it(touch, results, passes, seed, fails,
                                                             cannot_judge):
    row = results.row("exact")
    row["time_ms"]["passes"] = passes
    row["speedup"]["triangles"]["ref"].update(passes=passes, interval="95 %" if passes >= 5 else "range")
    results["timing"].update(processes=passes, seed=seed)
    rule = {"measure": "speedup", "question": "triangles", "reference": "ref"}
    check = touch("exact", results, at_least=9, **rule)
    assert (check.verdict, check.rerun) == ("fail", EXACT_AGAIN + fails)
    if cannot_judge:
        check = touch("exact", results, at_least=3, unjudged="fail", **rule)
        assert (check.verdict, check.rerun) == ("cannot judge", EXACT_AGAIN + cannot_judge)


def test_rerun_of_a_question_without_times_has_as_many_passes(touch, results):
    check = touch("exact", results, measure="speedup", question="body", reference="ref", at_least=1,
                  unjudged="fail")
    assert (check.verdict, check.rerun) == ("cannot judge", EXACT_AGAIN + " --processes 7")


def test_rerun_of_a_timing_rule_without_passes_leaves_them_to_the_run(touch, results):
    del results["timing"]
    check = touch("exact", results, measure="speedup", question="triangles", reference="ref", at_least=9)
    assert check.rerun == EXACT_AGAIN
