"""What `contactcheck gate` writes of its checks: for a screen, as JUnit XML and for GitHub."""

import copy
import os
import pty
import subprocess
import xml.etree.ElementTree

import pytest

from program import PROGRAM

AGAIN = "contactcheck run scenes/touch.json --frames 8 --detector "
MISSED = {"scenes": ["touch"], "detectors": ["exact"], "measure": "missed", "at_most": 0}
# Of 4.00x [3.80, 4.20].
NOISY = {"scenes": ["touch"], "detectors": ["exact"], "measure": "speedup", "question": "triangles",
         "reference": "ref", "at_least": 4, "noise_width": 0.05}
NOISE = ("speedup 4.00x [3.80, 4.20] over ref, triangles, playback, allowed at least 4x; the limit lies "
         "inside the 95 % interval, whose ends are 1.11x apart")
NO_STAGES = {"scenes": ["touch", "hard-gap"], "detectors": ["exact", "single"], "measure": "stage_missed",
             "stage": "spheres", "at_most": 0}


@pytest.fixture
def broken(results):
    """The results with 3 contacts that "exact" misses, in frame 7, and as many copies of it as are asked
    for."""
    def with_copies(*names):
        row = results.row("exact")
        row["levels"]["triangle"]["missed"] = row["per_frame"]["missed"][7] = 3
        results["runs"] += [{**copy.deepcopy(row), "detector": name} for name in names]
        return results
    return with_copies


def line_of(detector):
    return f"touch  {detector}: missed 3 at level triangle, allowed at most 0, frame 7"


def test_screen_of_a_green_gate_is_three_lines(run_gate, results):
    assert run_gate([MISSED], results, title="A fast run").out == (
        "p  A fast run\n1 check of 1 rule: 1 pass, 0 fail, 0 too noisy to judge, 0 cannot judge\n"
        "gate: green\n")


def test_screen_names_each_broken_rule_with_its_command_and_what_is_open(run_gate, broken):
    missed = {"rule": "none missed", "why": "exact is exact", "detectors": ["exact", "lazy", "refit"]}
    rules = [{**MISSED, **missed}, {**NOISY, "rule": "fast"},
             {**NO_STAGES, "rule": "no loss"}]
    assert run_gate(rules, broken("lazy", "refit")).out == f"""\
p  t
7 checks of 3 rules: 0 pass, 3 fail, 1 too noisy to judge, 3 cannot judge (of 1 rule)
FAIL  none missed
  (exact is exact)
  {line_of("exact")}
    {AGAIN}exact --no-timing
  {line_of("lazy")}
    {AGAIN}lazy --no-timing
  ... and 1 more of this rule
too noisy to judge
  fast: touch  exact: {NOISE}
cannot judge
  no loss: touch  exact: the detector has no stage "spheres"; and 2 more
gate: red
"""


def test_screen_shows_what_the_policy_makes_red_among_the_broken_rules(run_gate, results):
    out = run_gate([{**NOISY, "rule": "fast", "noisy": "fail"}], results).out
    assert f"FAIL  fast\n  touch  exact: too noisy to judge: {NOISE}\n" in out
    assert out.endswith("gate: red\n")


def test_screen_of_a_thousand_breaches_is_one_screen(run_gate, broken):
    names = [f"d{i}" for i in range(10)]
    rules = [{**MISSED, "rule": f"rule {i}", "detectors": names} for i in range(100)]
    out = run_gate(rules, broken(*names)).out
    assert out.count("\n") <= 55
    assert "1000 fail" in out
    assert "  ... and 92 more broken rules\n" in out


def test_screen_is_coloured_for_a_terminal_alone(run_gate, broken, tmp_path):
    assert "\x1b" not in run_gate([MISSED], broken()).out
    terminal, end = pty.openpty()
    subprocess.run([PROGRAM, "gate", tmp_path / "results.json", "--policy", tmp_path / "policy.json"],
                   stdout=end, check=False)
    os.close(end)
    text = os.read(terminal, 65536).decode()
    os.close(terminal)
    assert "\x1b[31mFAIL\x1b[0m" in text


def test_junit_is_a_suite_per_rule_and_a_case_per_check(run_gate, broken, tmp_path):
    results = broken("lazy")
    results.row("exact")["levels"]["triangle"]["missed"] = 0
    rules = [{**MISSED, "rule": "none missed", "why": "all are promised", "detectors": ["exact", "lazy"]},
             {**NO_STAGES, "rule": "no loss", "scenes": ["touch"], "detectors": ["single"]}]
    run_gate(rules, results, words=["--junit", tmp_path / "gate.xml"])
    assert (tmp_path / "gate.xml").read_text(encoding="utf-8") == f"""\
<?xml version="1.0" encoding="UTF-8"?>
<testsuites name="contactcheck gate p" tests="3" failures="1" errors="0" skipped="1">
  <testsuite name="none missed" tests="2" failures="1" errors="0" skipped="0">
    <testcase classname="none missed" name="touch exact"/>
    <testcase classname="none missed" name="touch lazy">
      <failure type="fail" message="{line_of("lazy")}">{line_of("lazy")}&#10;{AGAIN}lazy --no-timing&#10;\
all are promised</failure>
    </testcase>
  </testsuite>
  <testsuite name="no loss" tests="1" failures="0" errors="0" skipped="1">
    <testcase classname="no loss" name="touch single">
      <skipped message="cannot judge: touch  single: the detector has no stage &quot;spheres&quot;"/>
    </testcase>
  </testsuite>
</testsuites>
"""


@pytest.mark.parametrize("name, escaped", [
    ('a<b>&"c"\n\t\x01\x1b', "a&lt;b&gt;&amp;&quot;c&quot;&#10;&#9;??"), ("ä\ufffe\uffff", "ä??")])
def test_junit_has_nothing_that_xml_takes_apart_or_refuses(run_gate, results, tmp_path, name, escaped):
    run_gate([{**MISSED, "rule": name}], results, words=["--junit", tmp_path / "gate.xml"])
    text = (tmp_path / "gate.xml").read_text(encoding="utf-8")
    assert f'<testcase classname="{escaped}" name="touch exact"/>' in text
    xml.etree.ElementTree.fromstring(text)


@pytest.fixture
def github(run_gate, tmp_path):
    """Annotations and job summary."""
    def texts(rules, results, **policy):
        summary = tmp_path / "summary.md"
        summary.unlink(missing_ok=True)
        out = run_gate(rules, results, words=["--github"], env={"GITHUB_STEP_SUMMARY": str(summary)},
                       **policy).out
        return out.partition("\ngate: ")[2].partition("\n")[2], summary.read_text(encoding="utf-8")
    return texts


def test_github_annotations_escape_what_the_runner_takes_apart(github, broken):
    rule = {**MISSED, "rule": "100 %: a, b", "detectors": ["d:x=1,y=2"]}
    assert github([rule], broken("d:x=1,y=2"))[0] == (
        f"::error title=100 %25%3A a%2C b::{line_of('d:x=1,y=2')}%0A{AGAIN}d:x=1,y=2 --no-timing\n")


def test_github_annotations_are_warnings_and_notices_for_what_is_open(github, results):
    assert github([{**NOISY, "rule": "fast"}, {**NO_STAGES, "rule": "no loss"}], results)[0] == (
        f"::warning title=fast::too noisy to judge: touch  exact: {NOISE}\n".replace(" % ", " %25 ") +
        '::notice title=no loss::cannot judge: touch  exact: the detector has no stage "spheres"; '
        "and 2 more\n")


def test_github_annotations_are_ten_at_most_of_which_the_last_counts(github, broken):
    names = [f"d{i}" for i in range(11)]
    results = broken(*names)
    text, _ = github([{**MISSED, "detectors": names[:10]}], results)
    assert text.count("\n") == 10
    assert "touch  d9" in text
    text, _ = github([{**MISSED, "detectors": names}], results)
    assert text.count("\n") == 10
    assert "touch  d9" not in text
    assert "::and 2 more; the job summary lists them\n" in text


def test_github_summary_is_a_table_of_what_is_red_and_a_list_of_what_is_open(github, broken):
    rules = [{**MISSED, "rule": "a|b", "detectors": ["d<1>"]},
             {**NO_STAGES, "rule": "no loss", "scenes": ["touch"], "detectors": ["single"]}]
    assert github(rules, broken("d<1>"), title="A fast run")[1] == f"""\
## contactcheck gate p: red

A fast run. 2 checks of 2 rules: 0 pass, 1 fail, 0 too noisy to judge, 1 cannot judge (of 1 rule).

| rule | scene | detector | measured | allowed | frame | remark | again |
|---|---|---|---|---|---|---|---|
| a\\|b | touch | d&lt;1> | missed 3 at level triangle | at most 0 | frame 7 |  | \
`{AGAIN}'d<1>' --no-timing` |

- no loss, cannot judge:
  - touch  single: the detector has no stage "spheres"
"""


def test_github_summary_of_a_green_gate_has_no_table(github, results):
    assert github([MISSED], results, title="A fast run")[1] == (
        "## contactcheck gate p: green\n\nA fast run. 1 check of 1 rule: 1 pass, 0 fail, 0 too noisy to "
        "judge, 0 cannot judge.\n\n")
