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


def paper_rule(measure, *names, **more):
    return {"scenes": ["touch"], "detectors": ["paper"], "measure": measure, "includes": list(names), **more}


def test_claims_that_a_policy_pins_hold_or_fail(gate, results):
    results.row("paper")["semantics"]["questions"] = ["cells", "body"]
    checks = gate([paper_rule("levels", "cell"), paper_rule("levels", "body", "cell"),
                   paper_rule("levels", "cell", "triangle"), paper_rule("questions", "body"),
                   paper_rule("questions", "triangles", "body")], results)
    assert [(check.verdict, check.red) for check in checks] == [
        ("pass", False), ("pass", False), ("fail", True), ("pass", False), ("fail", True)]
    assert checks[2].sentence == "touch  paper: levels body, cell, allowed cell, triangle among them"
    assert checks[4].sentence == "touch  paper: questions cells, body, allowed triangles, body among them"
    assert checks[2].rerun == "contactcheck run scenes/touch.json --frames 8 --detector paper --no-timing"


def test_pinned_level_that_was_not_judged_cannot_be_judged(gate, results):
    row = results.row("paper")
    row["semantics"]["levels"].append("vertex")
    [check] = gate([paper_rule("levels", "vertex")], results)
    assert check.verdict == "cannot judge"
    assert check.sentence == "touch  paper: level vertex is not judged: the scene does not ask for it"
    row["not_judged"] = {"vertex": "not judged: open"}
    [check] = gate([paper_rule("levels", "vertex", unjudged="fail")], results)
    assert check.red
    assert check.sentence == "touch  paper: cannot judge: level vertex is not judged: open"


def lost(gate, results, baseline):
    """What the baseline's row "paper" has and the results' has not."""
    out = []
    for check in gate([HOLDS], results, baseline):
        if check.red:
            assert (check.rule, check.name) == (BASELINE_RULE, "touch paper")
            assert check.rerun.startswith("contactcheck run scenes/touch.json --frames ")
            out.append(check.sentence.removeprefix("touch  paper: "))
    return out


def test_weaker_claim_than_in_the_baseline_is_broken(gate, results):
    baseline = results.copy()
    baseline.row("paper")["semantics"]["questions"] = ["cells", "body"]
    row = results.row("paper")
    row["semantics"].update(levels=["body"], questions=["body"])
    del row["levels"]["cell"]
    assert lost(gate, results, baseline) == [
        "level cell was judged in the baseline; now the detector does not claim it",
        "question cells was answered in the baseline; now the detector does not answer it"]
    assert lost(gate, baseline, results) == [], "a stronger one is none"


def test_level_that_is_no_longer_judged_is_broken_with_its_reason(gate, results):
    baseline = results.copy()
    row = results.row("paper")
    counts = row["levels"].pop("cell")
    assert lost(gate, results, baseline) == [
        "level cell was judged in the baseline; now the scene does not ask for it"]
    row["not_judged"] = {"cell": "not judged: open"}
    assert lost(gate, results, baseline) == ["level cell was judged in the baseline; now it is not judged: open"]
    row["levels"]["cell"] = {**counts, "informative": True}
    assert len(lost(gate, results, baseline)) == 1, "what is shown alone is not gated"
    baseline.row("paper")["levels"]["cell"]["informative"] = True
    assert lost(gate, results, baseline) == [], "nor was it"


@pytest.mark.parametrize("key, before, now, sentence, other_way", [
    ("margin", 0.001, 0.01, "it declares margin (metres) 0.001 in the baseline, 0.01 now", True),
    ("tolerance", 0.001, 0.01, "it declares tolerance (metres) 0.001 in the baseline, 0.01 now", False),
    ("tolerance_of_start", 0.25, 0.5, "it declares tolerance (share of the distance at the start) 0.25 in the "
     "baseline, 0.5 now", False),
    ("body", "surface", "solid", "it declares that containment is contact: no in the baseline, yes now", True),
    ("touching", "closed", "open", "it declares that touching is contact: yes in the baseline, no now", True),
    ("exact", True, False, "it declares that it is exact: yes in the baseline, no now", False),
    ("precision", "double", "single", "it declares precision double in the baseline, single now", True),
    ("scale", 1, 2, "it declares scale 1 in the baseline, 2 now", True),
    ("depth_kind", "vertex-surface", "none", "it declares depth vertex-surface in the baseline, none now", False)])
def test_other_measure_of_contact_than_in_the_baseline_is_broken(gate, results, key, before, now, sentence,
                                                                 other_way):
    baseline = results.copy()
    baseline.row("paper")["semantics"][key] = before
    results.row("paper")["semantics"][key] = now
    assert lost(gate, results, baseline) == [sentence]
    assert len(lost(gate, baseline, results)) == other_way


def test_fewer_frames_than_in_the_baseline_are_broken(gate, results):
    baseline = results.copy()
    results.row("paper")["frames"] = 7
    assert lost(gate, results, baseline) == ["judged frames: 8 in the baseline, 7 now"]
    assert lost(gate, baseline, results) == []


@pytest.mark.parametrize("key, what", [("depth_judged", "depths"), ("normal_judged", "normals")])
def test_depths_and_normals_that_are_no_longer_judged_are_broken(gate, results, key, what):
    baseline = results.copy()
    baseline.row("paper")["geometry"][key] = 9
    results.row("paper")["geometry"][key] = 0
    assert lost(gate, results, baseline) == [f"judged {what}: 9 in the baseline, none now"]
    assert lost(gate, baseline, results) == []


def test_times_and_motion_that_are_no_longer_judged_are_broken(gate, results):
    baseline = results.copy()
    impacts = {"tunnelled": [], "timed": 3, "early_max": 0, "late_max": 0}
    for of, timed in ((baseline, 3), (results, 0)):
        of.row("paper")["impacts"] = {**impacts, "timed": timed}
    baseline.row("paper")["closed_loop"] = {"error": "it diverged"}
    assert lost(gate, results, baseline) == [
        "judged times within steps: 3 in the baseline, none now",
        "the motion that it drives was judged in the baseline, and is not now"]
    del results.row("paper")["impacts"]
    assert len(lost(gate, results, baseline)) == 2
