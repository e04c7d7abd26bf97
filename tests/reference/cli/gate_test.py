"""`contactcheck gate` and `accept`: policies by name, JUnit, GitHub, and a baseline of a real run. What the
gate says of changed results are cases.
"""

import json
import shutil
import xml.etree.ElementTree as ElementTree

import pytest

from program import ROOT, contactcheck, successful, tiny_scene, valid_results

GATE = ROOT / "tests" / "reference" / "gate"


@pytest.fixture
def folder(tmp_path):
    """Results, a baseline that equals them, and a policy that both satisfy."""
    for name in ("results.json", "baseline.json"):
        shutil.copyfile(GATE / "sample_results.json", tmp_path / name)
    shutil.copyfile(GATE / "sample_policy.json", tmp_path / "policy.json")
    return tmp_path


def gate(folder, *more, policy="policy.json"):
    words = ["--policy", policy] if policy else []
    return contactcheck("gate", "results.json", *words, "--baseline", "baseline.json", *more, cwd=folder)


def change_exact(folder, change):
    """Changes the row of detector exact in scene touch."""
    results = json.loads((folder / "results.json").read_text(encoding="utf-8"))
    row = results["runs"][0]
    assert (row["scene"], row["detector"]) == ("touch", "exact")
    change(row)
    (folder / "results.json").write_text(json.dumps(results), encoding="utf-8")


def write_policy(folder, rule):
    policy = {"schema": "contactcheck-policy/1", "id": "own", "title": "Of a test", "rules": [rule]}
    (folder / "policy.json").write_text(json.dumps(policy), encoding="utf-8")


def test_policy_may_be_the_name_of_one_that_comes_along(folder):
    named, default = gate(folder, policy="unchanged"), gate(folder, policy=None)
    assert named.out.startswith("unchanged ")
    assert (named.exit_code, named.out) == (default.exit_code, default.out)


def test_policy_of_no_known_name_is_refused_with_the_nearest(folder):
    outcome = contactcheck("gate", "results.json", "--policy", "defualt", cwd=folder)
    assert outcome.exit_code == 2
    assert outcome.err.startswith(
        'contactcheck: there is no policy "defualt"; did you mean default? there are ')


def test_writes_xml_that_a_parser_reads(folder):
    change_exact(folder, lambda row: row.update(detector="<exact> & \"co\"\x01ä'"))
    assert gate(folder, "--junit", "gate.xml").exit_code == 1
    suite = ElementTree.parse(folder / "gate.xml").getroot()
    cases = list(suite.iter("testcase"))
    failed = [case for case in cases if case.find("failure") is not None]
    # Three rules want "exact" in "touch" and match nothing, the fourth has two other scenes; the
    # baseline's row is gone, and the new one is covered by no rule.
    assert (suite.get("tests"), len(cases), suite.get("failures"), len(failed)) == ("6", 6, "4", 4)
    assert not [case.get("name") for case in cases if "<" in case.get("name")]
    assert not [case.get("time") for case in cases if case.get("time")]


def test_writes_names_that_need_escapes_into_xml(folder):
    change_exact(folder, lambda row: row.update(detector="<e> & \"co\"ä'"))
    write_policy(folder, {"rule": '<R> & "S"', "scenes": ["touch"], "detectors": ["<e>*"],
                          "measure": "missed", "at_most": 0})
    successful("gate", "results.json", "--policy", "policy.json", "--junit", "gate.xml", cwd=folder)
    case, = ElementTree.parse(folder / "gate.xml").getroot().iter("testcase")
    assert case.attrib == {"classname": '<R> & "S"', "name": "touch <e> & \"co\"ä'"}


def test_annotates_for_github_and_appends_to_its_summary(folder, monkeypatch):
    change_exact(folder, lambda row: row["levels"]["triangle"].update(missed=1))
    summary = folder / "summary.md"
    summary.write_text("before\n", encoding="utf-8")
    monkeypatch.setenv("GITHUB_STEP_SUMMARY", str(summary))
    outcome = gate(folder, "--github")
    assert outcome.exit_code == 1, outcome.err
    assert ("\n::error title=none missed::touch  exact: missed 1 at level triangle, allowed at most 0"
            "%0Acontactcheck run") in outcome.out
    assert summary.read_text(encoding="utf-8").startswith("before\n## contactcheck gate own: red\n")
    assert "::error" not in gate(folder).out, "unless asked for"


def test_annotates_where_github_gives_no_summary(folder, monkeypatch):
    monkeypatch.setenv("GITHUB_STEP_SUMMARY", "")
    outcome = gate(folder, "--github")
    assert outcome.exit_code == 0, outcome.err


def test_accept_writes_a_valid_baseline_that_another_run_passes(tmp_path):
    (tmp_path / "tiny.json").write_text(tiny_scene(), encoding="utf-8")
    run = ["run", "tiny.json", "--quiet", "--processes", "1", "--detector", "fcl-aabb", "--detector",
           "ffd-aabb", "--detector", "ffd-lazy", "--out", "out"]
    successful(*run, cwd=tmp_path)
    accepted = successful("accept", "out/results.json", "--as", "base.json", cwd=tmp_path)
    assert accepted.out.startswith("base.json: 3 rows of contactcheck run ")
    baseline = tmp_path / "base.json"
    assert baseline.stat().st_size < (tmp_path / "out" / "results.json").stat().st_size
    valid_results(baseline)
    successful(*run, cwd=tmp_path)
    write_policy(tmp_path, {"rule": "same", "scenes": ["*"], "detectors": ["*"], "measure": "contact_hash",
                            "unchanged": True, "unjudged": "fail"})
    passed = successful("gate", "out/results.json", "--policy", "policy.json", "--baseline", "base.json",
                        cwd=tmp_path)
    assert "3 checks of 1 rule: 3 pass" in passed.out
