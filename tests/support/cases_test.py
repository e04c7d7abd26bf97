"""Cases kept as data fail where they must, with a program of a few lines in place of contactcheck."""

import os
import pathlib
import subprocess
import sys

import pytest

SUPPORT = pathlib.Path(__file__).parent
PROGRAM = """#!/bin/sh
case $1 in
  say) shift; printf '%s\\n' "$@" ;;
  warn) echo "careful" >&2 ;;
  refuse) echo "contactcheck: $2 is wrong" >&2; exit 2 ;;
  count) seq "$2" ;;
esac
"""
CASE = """about = "It says three lines."
command = ["say", "head", "took 12 ms", "in DIR"]
[[expect]]
in = "stdout"
lines = "lines.txt"
"""
LINES = "head\ntook {{[0-9]+}} ms\nin DIR\n"


@pytest.fixture
def outcome(tmp_path):
    """What pytest says of a folder with these files."""

    def run(*words, env=None, **files):
        program = tmp_path / "contactcheck"
        program.write_text(PROGRAM, encoding="utf-8")
        program.chmod(0o700)
        for name, text in files.items():
            (tmp_path / "a_case").mkdir(exist_ok=True)
            (tmp_path / "a_case" / name.replace("__", ".")).write_text(text, encoding="utf-8")
        words = [sys.executable, "-B", "-m", "pytest", "-p", "no:cacheprovider", "-p", "cases",
                 "--import-mode=importlib", "-q", "-rA", *words, tmp_path / "a_case"]
        without_ci = {name: value for name, value in os.environ.items() if name != "CI"}
        return subprocess.run(words, capture_output=True, text=True, check=False, cwd=tmp_path, env={
            **without_ci, "CONTACTCHECK_PROGRAM": str(program), "PYTHONPATH": str(SUPPORT), **(env or {})})

    return run


def test_lines_and_patterns_that_hold_pass(outcome):
    done = outcome(case__toml=CASE, lines__txt=LINES)
    assert done.returncode == 0 and "PASSED a_case" in done.stdout, done.stdout


@pytest.mark.parametrize("lines", [LINES.replace("head", "heads"), LINES + "more\n", "head\n", "",
                                   LINES.replace("[0-9]+", "[a-z]+"), LINES.replace("DIR", "folder")])
def test_other_lines_fail_with_the_difference(outcome, lines):
    done = outcome(case__toml=CASE, lines__txt=lines)
    assert done.returncode == 1 and "It says three lines." in done.stdout and "+++ stdout" in done.stdout


@pytest.mark.parametrize("case, files, message", [
    (CASE, {}, "missing: ['lines.txt']; --rewrite writes them"),
    (CASE, {"lines__txt": LINES, "old__txt": "x\n"}, "nothing in case.toml names ['old.txt']"),
    (CASE.replace('"head", "took', '"other", "took'), {"lines__txt": LINES}, "-head"),
    (CASE + 'from = "tail"\n', {"lines__txt": LINES}, 'no line begins with "tail"'),
    (CASE + 'to = "tail"\n', {"lines__txt": LINES}, 'no later line begins with "tail"'),
    (CASE + 'contains = ["thirteen"]\n', {"lines__txt": LINES}, 'does not contain "thirteen"'),
    (CASE + 'absent = ["12 ms"]\n', {"lines__txt": LINES}, 'contains "12 ms"'),
    (CASE + 'kontains = ["12 ms"]\n', {"lines__txt": LINES}, "unknown keys: ['kontains']"),
    (CASE.replace('lines = "lines.txt"', ""), {}, "demands nothing"),
    (CASE.replace('in = "stdout"', 'in = "out.txt"'), {"lines__txt": LINES}, "out.txt was not written"),
    ("exit = 1\n" + CASE, {"lines__txt": LINES}, "exit code 0, not 1"),
    ('about = "Quiet."\ncommand = ["warn"]\n[[expect]]\nin = "stdout"\nabsent = ["x"]\n', {},
     "standard error is not empty"),
    ('about = "Long."\ncommand = ["count", "41"]\n[[expect]]\nin = "stdout"\nlines = "lines.txt"\n',
     {"lines__txt": "1\n"}, "41 lines; at most 40"),
])
def test_case_fails_and_says_why(outcome, case, files, message):
    done = outcome(case__toml=case, **files)
    assert done.returncode == 1 and message in done.stdout, done.stdout


def test_rewriting_writes_what_differs_and_keeps_patterns(outcome, tmp_path):
    done = outcome("--rewrite", case__toml=CASE, lines__txt=LINES.replace("head", "heads"))
    assert done.returncode == 0 and "-heads" in done.stdout and "+head" in done.stdout, done.stdout
    assert (tmp_path / "a_case" / "lines.txt").read_text(encoding="utf-8") == LINES


def test_rewriting_is_refused_under_ci(outcome, tmp_path):
    wrong = LINES.replace("head", "heads")
    done = outcome("--rewrite", env={"CI": "true"}, case__toml=CASE, lines__txt=wrong)
    assert done.returncode == 4 and "--rewrite is for people, and CI is set" in done.stderr
    assert (tmp_path / "a_case" / "lines.txt").read_text(encoding="utf-8") == wrong


@pytest.mark.parametrize("row, code", [
    ('Wrong = {words = ["refuse", "five"], named = ["five is wrong"]}', 0),
    ('Wrong = {words = ["refuse", "five"], named = ["six"]}', 1),
    ('Wrong = {words = ["say", "five"], named = ["five"]}', 1),
    ('Wrong = {words = ["warn"], named = ["careful"]}', 1),
    ('Wrong = {words = ["refuse", "five"], nammed = ["five"]}', 2)])
def test_refusals_are_told_from_other_answers(outcome, row, code):
    done = outcome(own_refusals__toml=f"[Numbers]\n{row}\n")
    assert done.returncode == code, done.stdout
