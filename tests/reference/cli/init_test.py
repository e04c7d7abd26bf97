"""`contactcheck init`: what it writes runs unchanged, by the commands that it prints."""

import json
import shutil

import pytest

from program import contactcheck, run_program, successful


@pytest.mark.parametrize("language", ["python", "c", "c++", "javascript"])
def test_what_it_writes_runs_as_it_is_and_shows_its_fault(tmp_path, language):
    if language == "javascript" and shutil.which("node") is None:
        pytest.skip("there is no node")
    folder = tmp_path / "my own"
    init = successful("init", folder, "--language", language, cwd=tmp_path)
    _, commands = init.out.split("\nnext:\n")
    run_it, gate_it = commands[:commands.rindex("  ")], commands[commands.rindex("  "):]
    # Compilers that warn.
    script = ('set -e\ncc() { command cc -std=c11 -pedantic -Wall -Wextra -Werror "$@"; }\n'
              'c++() { command c++ -std=c++17 -pedantic -Wall -Wextra -Wshadow -Werror "$@"; }\n' + run_it)
    outcome = run_program("/bin/bash", ["-c", script], cwd=tmp_path)
    assert outcome.exit_code == 0, outcome.out + outcome.err
    assert "1 of 2 detectors has no missed and no spurious contacts" in outcome.out
    mine = next(line for line in outcome.out.splitlines() if line.startswith("  mine "))
    assert mine.split()[1:6] == ["body", "6", "1", "0", "12"]
    gate = run_program("/bin/bash", ["-c", gate_it], cwd=folder)
    assert gate.exit_code == 1
    assert "7 checks of 7 rules: 5 pass, 2 fail, 0 too noisy to judge, 0 cannot judge" in gate.out
    assert "FAIL  no spurious contacts" in gate.out
    workflow = (folder / ".github" / "workflows" / "contactcheck.yml").read_text(encoding="utf-8")
    assert "BUILD" not in workflow
    assert "DETECTOR" not in workflow


def begun(folder):
    """A folder in which the detector compares balls: in its scene that is right."""
    successful("init", folder)
    file = folder / "detector.py"
    text = file.read_text(encoding="utf-8")
    for old, new in (
            ("    return [(min(x[k::3]), max(x[k::3])) for k in range(3)]",
             "    return [(min(x[k::3]) + max(x[k::3])) / 2 for k in range(3)]"),
            ("all(p[0] <= q[1] and q[0] <= p[1] for p, q in zip(now[a], now[b]))",
             "sum((p - q) ** 2 for p, q in zip(now[a], now[b])) < 0.98")):
        assert old in text
        text = text.replace(old, new)
    file.write_text(text, encoding="utf-8")
    return file


def gate_of(folder):
    successful("run", "scene.json", "--detector-cmd", "python3 detector.py", "--no-timing", cwd=folder)
    return contactcheck("gate", "out/results.json", "--policy", "policy.json", cwd=folder)


def test_its_policy_is_green_for_a_detector_that_is_right(tmp_path):
    begun(tmp_path / "mine")
    gate = gate_of(tmp_path / "mine")
    assert gate.exit_code == 0, gate.out
    assert "7 checks of 7 rules: 7 pass" in gate.out


# A rule without a level is about the finest one that is claimed, here pairs of triangles.
def test_its_policy_is_red_for_missed_bodies_beside_triangles_that_are_right(tmp_path):
    begun(tmp_path / "mine")
    assert gate_of(tmp_path / "mine").exit_code == 0
    file = tmp_path / "mine" / "out" / "results.json"
    results = json.loads(file.read_text(encoding="utf-8"))
    [run] = results["runs"]
    body = run["levels"]["body"]
    run["levels"]["triangle"] = dict(body)
    run["per_frame"]["level"] = "triangle"
    body.update(hit=body["hit"] - 2, missed=2, reported=body["reported"] - 2)
    file.write_text(json.dumps(results), encoding="utf-8")
    gate = contactcheck("gate", "out/results.json", "--policy", "policy.json", cwd=tmp_path / "mine")
    assert gate.exit_code == 1
    assert "FAIL  no missed pairs of bodies" in gate.out
    assert "FAIL  no missed contacts" not in gate.out


# It would be wrong about nothing.
def test_its_policy_is_red_for_a_detector_that_claims_less(tmp_path):
    file = begun(tmp_path / "mine")
    file.write_text(file.read_text(encoding="utf-8").replace('"levels": ["body"]', '"levels": ["containment"]'),
                    encoding="utf-8")
    gate = gate_of(tmp_path / "mine")
    assert gate.exit_code == 1
    assert "scene  mine: levels containment, allowed body among them" in gate.out


def test_writes_over_nothing(tmp_path):
    folder = tmp_path / "my own"
    folder.mkdir()
    successful("init", folder)  # it was empty
    again = contactcheck("init", folder)
    assert again.exit_code == 2
    assert again.err == f'contactcheck: "{folder}" is there already and is not written over\n'
