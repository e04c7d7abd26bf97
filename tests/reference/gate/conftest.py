"""What the tests of `contactcheck gate` share: results written by hand, and the checks that the program
makes of them, as its JUnit file tells them.
"""

import copy
import dataclasses
import json
import pathlib
import xml.etree.ElementTree

import pytest

from program import contactcheck

SAMPLE = pathlib.Path(__file__).parent / "sample_results.json"


class Results(dict):
    """Scene "touch", 8 frames: "exact" (all right, timed, 4 times as fast as "ref" within 5 %), "ref"
    (timed), "paper" (three contacts missed and two spurious at level cell, most of both in frame 5),
    "single" (one level, informative), "broken" (ended in an error at frame 4), "lost" (absent). Family
    "hard-gap", values 0, 1e-9 and 1: "exact". Scene "random-pairs": "exact".
    """

    def row(self, detector, scene="touch"):
        return next(row for row in self["runs"] if (row["scene"], row["detector"]) == (scene, detector))

    def copy(self):
        return copy.deepcopy(self)


@dataclasses.dataclass(frozen=True)
class Check:
    rule: str
    name: str  # scene and detector; of a pattern that matches nothing, its sentence
    verdict: str
    red: bool
    sentence: str  # scene, detector, measured, allowed, frame, reason; empty where the check passes
    rerun: str  # the command that shows it again, of a red check


@pytest.fixture
def results():
    return Results(json.loads(SAMPLE.read_text(encoding="utf-8")))


@pytest.fixture
def run_gate(tmp_path):
    """The outcome of the program with a policy of these rules, and with the baseline where there is one."""

    def outcome(rules, results, baseline=None, words=(), env=None, **policy):
        named = [{"rule": f"R{i}", **rule} for i, rule in enumerate(rules)]
        documents = {"results": results, "policy": {"schema": "contactcheck-policy/1", "id": "p",
                                                    "title": "t", "rules": named, **policy}}
        if baseline is not None:
            documents["baseline"] = baseline
            words = [*words, "--baseline", tmp_path / "baseline.json"]
        for name, document in documents.items():
            (tmp_path / f"{name}.json").write_text(json.dumps(document), encoding="utf-8")
        found = contactcheck("gate", tmp_path / "results.json", "--policy", tmp_path / "policy.json", *words,
                             env=env)
        assert found.err == ""
        assert ("\ngate: red\n" in found.out, found.exit_code) in ((True, 1), (False, 0))
        return found

    return outcome


@pytest.fixture
def gate(run_gate, tmp_path):
    """The checks of these rules."""

    def checks(rules, results, baseline=None, **policy):
        file = tmp_path / "gate.xml"
        outcome = run_gate(rules, results, baseline, ["--junit", file], **policy)
        found = [check_of(case) for case in xml.etree.ElementTree.parse(file).iter("testcase")]
        assert outcome.exit_code == (1 if any(check.red for check in found) else 0)
        return found

    return checks


def check_of(case):
    failure, skipped = case.find("failure"), case.find("skipped")
    verdict, sentence, rerun = "pass", "", ""
    if failure is not None:
        verdict = failure.get("type")
        sentence, *rest = failure.text.split("\n")
        assert failure.get("message") == sentence
        rerun = next((line for line in rest if line.startswith("contactcheck run ")), "")
    elif skipped is not None:
        verdict, sentence = skipped.get("message").split(": ", 1)
    return Check(case.get("classname"), case.get("name"), verdict, failure is not None, sentence, rerun)


@pytest.fixture
def touch(gate):
    """The only check of a rule about scene "touch" and one detector; `rule` is the rest of the rule. What
    the baseline has and the results have not is left out."""

    def check(detector, results, baseline=None, **rule):
        found = gate([{"scenes": ["touch"], "detectors": [detector], **rule}], results, baseline)
        found = [check for check in found if check.rule == "R0"]
        assert len(found) == 1
        return found[0]

    return check
