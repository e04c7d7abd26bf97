"""`contactcheck init`: what it writes runs unchanged, by the commands that it prints."""

import pytest

from program import contactcheck, run_program, successful


@pytest.mark.parametrize("language", ["python", "c", "c++"])
def test_what_it_writes_runs_as_it_is(tmp_path, language):
    folder = tmp_path / "my own"
    init = successful("init", folder, "--language", language, cwd=tmp_path)
    _, commands = init.out.split("\nnext:\n")
    # C compilers that warn.
    script = 'set -e\ncc() { command cc -Wall -Wextra -Werror "$@"; }\n' + commands
    outcome = run_program("/bin/bash", ["-c", script], cwd=tmp_path)
    assert outcome.exit_code == 0, outcome.out + outcome.err
    assert "All 2 detectors have no missed and no spurious contacts" in outcome.out
    assert "gate: green" in outcome.out
    workflow = (folder / ".github" / "workflows" / "contactcheck.yml").read_text(encoding="utf-8")
    assert "BUILD" not in workflow
    assert "DETECTOR" not in workflow


def test_writes_over_nothing(tmp_path):
    folder = tmp_path / "my own"
    folder.mkdir()
    successful("init", folder)  # it was empty
    again = contactcheck("init", folder)
    assert again.exit_code == 2
    assert again.err == f'contactcheck: "{folder}" is there already and is not written over\n'
