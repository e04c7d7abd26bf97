"""`contactcheck gate --advisory-times`: rules on times are judged and shown, and do not decide."""

import xml.etree.ElementTree

ADVISORY = ["--advisory-times"]
FAST = {"rule": "fast", "scenes": ["touch"], "detectors": ["exact"], "measure": "speedup",
        "question": "triangles", "reference": "ref", "at_least": 5}
MISSED = {"rule": "none missed", "scenes": ["touch"], "detectors": ["exact"], "measure": "missed", "at_most": 0}
TOO_SLOW = ("touch  exact: speedup 4.00x [3.80, 4.20] over ref, triangles, playback, allowed at least 5x; "
            "200 us too long per frame of 1000 us")


def test_missed_speedup_is_shown_and_green(run_gate, results):
    assert run_gate([FAST], results).exit_code == 1
    shown = run_gate([FAST, MISSED], results, words=ADVISORY)
    assert shown.exit_code == 0
    assert "2 checks of 2 rules: 1 pass, 1 fail," in shown.out
    assert f"fail (advisory)\n  fast: {TOO_SLOW}\ngate: green\n" in shown.out


def test_missed_contact_is_red_all_the_same(run_gate, results):
    row = results.row("exact")
    row["levels"]["triangle"]["missed"] = row["per_frame"]["missed"][7] = 1
    shown = run_gate([FAST, MISSED], results, words=ADVISORY)
    assert shown.exit_code == 1
    assert "FAIL  none missed\n" in shown.out and "FAIL  fast" not in shown.out


def test_any_number_of_rules_may_be_unable_to_judge(run_gate, results):
    results.row("exact")["speedup"] = {}
    rules = [{**FAST, "unjudged": "fail"}, MISSED]
    assert run_gate(rules, results, cannot_judge_at_most=0).exit_code == 1
    shown = run_gate(rules, results, words=ADVISORY, cannot_judge_at_most=0)
    assert shown.exit_code == 0 and "cannot judge\n  fast: touch  exact" in shown.out


def test_noisy_rule_that_would_fail_is_green(run_gate, results):
    noisy = {**FAST, "at_least": 4, "noise_width": 0.05, "noisy": "fail"}
    assert run_gate([noisy], results).exit_code == 1
    assert run_gate([noisy], results, words=ADVISORY).exit_code == 0


def test_rule_on_times_without_a_row_is_shown_and_green(run_gate, results):
    nothing = {**FAST, "scenes": ["gone"]}
    shown = run_gate([nothing, MISSED], results, words=ADVISORY)
    assert shown.exit_code == 0 and "fail (advisory)\n  fast: matches nothing" in shown.out
    assert run_gate([{**MISSED, "scenes": ["gone"]}], results, words=ADVISORY).exit_code == 1


def test_junit_github_and_summary_call_it_advisory(run_gate, results, tmp_path):
    junit, summary = tmp_path / "gate.xml", tmp_path / "summary.md"
    shown = run_gate([FAST, MISSED], results, words=[*ADVISORY, "--github", "--junit", junit],
                     env={"GITHUB_STEP_SUMMARY": str(summary)})
    cases = xml.etree.ElementTree.parse(junit).getroot()
    assert (cases.get("failures"), cases.get("skipped")) == ("0", "1")
    assert cases.find(".//skipped").get("message") == f"fail (advisory): {TOO_SLOW}"
    assert f"::warning title=fast::fail (advisory): {TOO_SLOW}" in shown.out and "::error" not in shown.out
    assert f"- fast, fail (advisory):\n  - {TOO_SLOW.replace('[', chr(92) + '[').replace(']', chr(92) + ']')}" \
        in summary.read_text(encoding="utf-8")
