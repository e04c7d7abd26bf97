"""What a gate must not pass over in silence."""

import json

import pytest

from program import refused

HOLDS = {"scenes": ["touch"], "detectors": ["exact"], "measure": "missed", "at_most": 0}
BASELINE_RULE = "everything that the baseline has"


def red_sentences(checks):
    return [f"{check.rule}: {check.sentence}" for check in checks if check.red]


def test_rule_that_matches_nothing_is_broken(gate, results):
    [sentence] = red_sentences(gate([{**HOLDS, "scenes": ["tuch"]}], results))
    assert sentence.startswith('R0: matches nothing: no row has a scene of "tuch" and a detector of '
                               '"exact"; the results have the scenes ')
    assert '"touch"' in sentence
    [sentence] = red_sentences(gate([{**HOLDS, "detectors": ["exakt"]}], results))
    assert '; the results have the detectors "' in sentence


def test_pattern_that_matches_nothing_is_broken_beside_ones_that_do(gate, results):
    checks = gate([{**HOLDS, "scenes": ["*"], "detectors": ["exact", "ex?ct2"]}], results)
    assert len(checks) == 4, "three scenes and the pattern"
    [sentence] = red_sentences(checks)
    assert sentence.startswith('R0: matches nothing: no row of the rule has a detector "ex?ct2"; '
                               'the results have the detectors "exact"')
    assert "scenes" not in sentence
    assert checks[-1].name == 'matches nothing: no row of the rule has a detector "ex?ct2"', (
        "what the results have instead is another every time")


def test_pattern_with_an_exclamation_mark_takes_rows_out_and_need_not_match(gate, results):
    checks = gate([{"scenes": ["touch"], "detectors": ["*", "!broken", "!l?st", "!nobody"],
                    "measure": "status", "equals": "ok"}], results)
    assert [check.verdict for check in checks] == ["pass"] * 4


def test_oracle_rule_without_random_pairs_matches_nothing(gate, results):
    [sentence] = red_sentences(gate([{"scenes": ["touch"], "measure": "oracle_wrong", "at_most": 0}],
                                    results))
    assert sentence.startswith('R0: matches nothing: no row has a scene of "touch"; the results have the '
                               "scenes ")


# "single" has no stages.
STAGES = {"rule": "stages", "scenes": ["touch"], "detectors": ["single", "exact"],
          "measure": "stage_missed", "at_most": 9}


@pytest.mark.parametrize("allowed, red", [
    ({}, []), ({"cannot_judge_at_most": 1}, []),
    ({"cannot_judge_at_most": 0}, ["rules can judge what they are about: rules that cannot judge 1, allowed "
                                   'at most 0; they are "stages"'])])
def test_rules_that_cannot_judge_break_a_policy_that_allows_fewer(gate, results, allowed, red):
    assert red_sentences(gate([HOLDS, STAGES], results, **allowed)) == red


def test_rules_that_cannot_judge_are_counted(run_gate, results):
    assert run_gate([HOLDS, STAGES], results).out.splitlines()[1].endswith(" 1 cannot judge (of 1 rule)")


@pytest.mark.parametrize("measure", [
    {"measure": "missed", "at_most": 0}, {"measure": "status", "equals": "ok"},
    {"measure": "contact_hash", "unchanged": True}])
def test_unisolated_row_cannot_be_judged(gate, results, measure):
    # A detector that had no process of its own: whatever its row says, it is not gated.
    baseline = results.copy()
    results["runs"][2] = {**results.row("broken"), "detector": "paper"}
    rule = {"scenes": ["touch"], "detectors": ["paper"], **measure}
    assert len(red_sentences(gate([rule], results, baseline))) == 2, "and the row that was lost"
    results["plugins"] = [{"detector": "paper", "kind": "command", "source": "it", "content": "c",
                           "version": "", "unisolated": True}]
    [check] = gate([rule], results, baseline)
    assert check.verdict == "cannot judge"
    assert check.sentence.startswith("touch  paper: unisolated")


@pytest.mark.parametrize("measure", [
    {"measure": "contact_hash", "unchanged": True},
    {"measure": "slowdown", "question": "triangles", "reference": "ref", "at_most": 1.1}])
def test_rule_that_needs_a_baseline_is_refused_without_one(results, tmp_path, measure):
    rule = {"rule": "R", "scenes": ["touch"], "detectors": ["exact"], **measure}
    policy = {"schema": "contactcheck-policy/1", "id": "p", "title": "t", "rules": [rule]}
    (tmp_path / "policy.json").write_text(json.dumps(policy), encoding="utf-8")
    (tmp_path / "results.json").write_text(json.dumps(results), encoding="utf-8")
    refused("gate", tmp_path / "results.json", "--policy", tmp_path / "policy.json",
            named=['policy "p"', 'rule "R"', "--baseline"], folder=tmp_path)


def test_baseline_of_the_same_rows_is_green(gate, results):
    assert red_sentences(gate([HOLDS], results, results)) == []


def test_baseline_scene_that_the_results_lack_is_broken(gate, results):
    baseline = results.copy()
    del results["scenes"][1]
    del results["runs"][6]
    assert red_sentences(gate([HOLDS], results)) == []
    assert red_sentences(gate([HOLDS], results, baseline)) == [
        f"{BASELINE_RULE}: hard-gap: the baseline has this scene, the results do not"]


def test_baseline_detector_that_the_results_lack_in_a_scene_is_broken(gate, results):
    baseline = results.copy()
    del results["runs"][2]
    assert red_sentences(gate([HOLDS], results, baseline)) == [
        f"{BASELINE_RULE}: touch  paper: the baseline has this detector in this scene, the results do not"]


def test_baseline_detector_that_ended_well_and_no_longer_does_is_broken(gate, results):
    baseline = results.copy()
    baseline["runs"][4] = {**baseline.row("paper"), "detector": "broken"}
    check = gate([HOLDS], results, baseline)[-1]
    assert (check.rule, check.name, check.red) == (BASELINE_RULE, "touch broken", True)
    assert check.sentence.startswith("touch  broken: status error, ")
    assert ", frame 4" in check.sentence
    assert check.rerun == "contactcheck run scenes/touch.json --frames 8 --detector broken --no-timing"


def test_baseline_row_that_failed_in_it_may_fail_again_or_be_new(gate, results):
    baseline = results.copy()  # "broken" failed and "lost" was absent
    results["runs"].append({**results.row("exact"), "detector": "new"})
    assert red_sentences(gate([HOLDS], results, baseline)) == []
