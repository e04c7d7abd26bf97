"""What `contactcheck ab` says of two builds, here scripts that leave results written by hand."""

import copy
import json

import pytest

from program import ROOT, contactcheck

SAMPLE = json.loads((ROOT / "tests/reference/gate/sample_results.json").read_text(encoding="utf-8"))
ROUNDS = 7
HEADING = ("base  {0}/base\nhead  {0}/head\n7 rounds in turns; time(head) / time(base), geometric mean and "
           "95 % interval over rounds; allowed 1.10x, or 20 us a frame\n\n")
# Copies NAME-ROUND.json to the folder behind --out.
SCRIPT = """#!/bin/sh
while [ $# -gt 0 ]; do
  [ "$1" = --out ] && out=$2
  shift
done
round=$(cat "$0.round" 2> /dev/null || echo 0)
echo $((round + 1)) > "$0.round"
mkdir -p "$out" && cp "$0-$round.json" "$out/results.json"
"""


def row(ms, detector="d", scene="s", missed=0, contact_hash="0x1"):
    """A row at `ms` a frame that missed so many of 10 true triangle pairs."""
    timed = copy.deepcopy(SAMPLE["runs"][0])
    timed["time_ms"]["playback"]["frame"] = ms
    levels = {"triangle": {"truth": 10, "reported": 10 - missed, "hit": 10 - missed, "missed": missed,
                           "spurious": 0, "recall": 1 - missed / 10, "spurious_rate": 0}}
    return {**timed, "scene": scene, "detector": detector, "levels": levels, "contact_hash": contact_hash,
            "speedup": {}}


@pytest.fixture
def ab(tmp_path):
    """What ab prints of the rows of each round of two builds."""
    def outcome(base, head, *words):
        for name, rounds in (("base", base), ("head", head)):
            for number, rows in enumerate(rounds):
                results = {**SAMPLE, "scenes": [], "disagreements": [], "runs": rows}
                (tmp_path / f"{name}-{number}.json").write_text(json.dumps(results), encoding="utf-8")
            (tmp_path / name).write_text(SCRIPT, encoding="utf-8")
            (tmp_path / name).chmod(0o700)
            (tmp_path / f"{name}.round").unlink(missing_ok=True)
        found = contactcheck("ab", tmp_path / "base", tmp_path / "head", "--quiet", "--out", tmp_path / "out",
                             *words, env={"GITHUB_STEP_SUMMARY": str(tmp_path / "summary.md")})
        assert found.err == ""
        assert found.exit_code == (1 if "FAIL: " in found.out else 0)
        return found.out
    return outcome


def steady(*rows):
    return [list(rows)] * ROUNDS


def annotations(out):
    return [line.partition("::")[2].partition("::")[2] for line in out.splitlines()
            if line.startswith("::error ")]


def test_pass_is_the_heading_and_one_line(ab, tmp_path):
    assert ab(steady(row(1.0)), steady(row(1.0))) == (
        HEADING.format(tmp_path) + "PASS: answers are equal, 1 time is within the limit.\n")


def test_slower_detector_is_named_with_its_times(ab, tmp_path):
    line = "s  d  1.30x [1.30, 1.30], 1 -> 1.3 ms a frame"
    out = ab(steady(row(1.0)), steady(row(1.3)), "--github")
    assert out.startswith(HEADING.format(tmp_path) + f"Slower than 1.10x (1)\n  {line}\n"
                          "FAIL: answers are equal, 1 time is too slow.\n")
    assert annotations(out) == [f"slower than 1.10x: {line}"]


def test_other_answers_fail_unless_they_may(ab):
    base, head = steady(row(1.0)), steady(row(1.0, missed=1))
    line = "s  d  triangle missed 0 -> 1"
    out = ab(base, head, "--github")
    assert (f"Worse answers, base -> head (1)\n  {line}\nFAIL: 1 answer is worse, 1 time is within the "
            "limit. --accuracy-may-change allows it.\n") in out
    assert annotations(out) == [f"worse answers than base: {line}"]
    out = ab(base, head, "--github", "--accuracy-may-change")
    assert (f"Worse answers, base -> head (allowed) (1)\n  {line}\nPASS: 1 answer is worse, 1 time is within "
            "the limit.\n") in out
    assert annotations(out) == []


def test_better_answers_are_told_from_worse(ab):
    out = ab(steady(row(1.0, missed=7), row(1.0, "e")), steady(row(1.0), row(1.0, "e", contact_hash="0x2")),
             "--github")
    assert "Better answers, base -> head (1)\n  s  d  triangle missed 7 -> 0\n" in out
    assert "Other answers, base -> head (1)\n  s  e  contact hash 0x1 -> 0x2\n" in out
    assert ("FAIL: 1 answer is better, 1 answer is another, 2 times are within the limit. "
            "--accuracy-may-change") in out
    assert annotations(out) == ["better answers than base: s  d  triangle missed 7 -> 0",
                                "other answers than base: s  e  contact hash 0x1 -> 0x2"]


def test_nothing_to_compare_is_no_pass(ab):
    out = ab(steady(row(1.0)), steady(row(1.0, "other")), "--github")
    assert ("Only in base (1)\n  detector d (in 1 scene)\nOnly in head (1)\n  detector other (in 1 scene)\n"
            "Nothing was timed in every round of both.\nFAIL: nothing was timed.\n") in out
    assert len(annotations(out)) == 1


def test_faster_and_too_noisy_have_their_lines(ab):
    head = [[row(ms), row(1.0, "e")] for ms in (0.7, 0.8, 0.9, 1.2, 1.5, 1.6, 1.7)]
    out = ab(steady(row(1.0), row(2.0, "e")), head)
    assert ("Too noisy to judge: more rounds or a quieter machine would tell (1)\n"
            "  s  d  1.14x [") in out
    assert ("Faster (1)\n  s  e  0.500x [0.500, 0.500], 2 -> 1 ms a frame\nPASS: answers are equal, 1 time is "
            "too noisy to judge, 1 time is within the limit.\n") in out


def test_markdown_has_all_times_and_escapes_names(ab, tmp_path):
    ab(steady(row(1.0, scene="a|b*")), steady(row(1.3, scene="a|b*")), "--github")
    text = (tmp_path / "summary.md").read_text(encoding="utf-8")
    assert text.startswith("## contactcheck ab\n\nFAIL: answers are equal, 1 time is too slow.")
    assert "\n### Slower than 1.10x (1)\n\n- a\\|b\\*  d  1.30x" in text
    assert "\n| a\\|b\\* | d | 1.30 | 1.30 to 1.30 | 1 | 1.3 | **slower** |\n" in text
