"""`contactcheck reduce` of the wrong answers of detectors from outside."""

import shlex

import pytest

import misbehaving
from program import PROGRAM, contactcheck, run_program, successful
from tiny_run import TinyRun

LIBRARY = ["--detector", misbehaving.library("always-lies")]
COMMAND = ["--detector-cmd", misbehaving.command("always-lies")]


def spurious_case(run):
    """The file of the run's first spurious contact."""
    return run.out / next(d["case"] for d in run.results["disagreements"]
                          if d["kind"] == "spurious" and d["level"] == "triangle")


def assert_reduced(case, *words):
    outcome = successful("reduce", case, *words)
    least = case.with_suffix(".min.json")
    assert str(least) in outcome.err
    assert least.exists()


def test_case_of_a_library(tmp_path):
    # Its option is in the case's name.
    assert_reduced(spurious_case(TinyRun(tmp_path, LIBRARY)), "--detector", misbehaving.LIBRARY)


def test_case_of_a_command(tmp_path):
    assert_reduced(spurious_case(TinyRun(tmp_path, COMMAND)), *COMMAND, "--budget", "60")


def test_command_that_prepares_again_is_started_once(tmp_path):
    # For its declaration, for all candidates, and for the last answer, which is asked anew.
    starts = tmp_path / "starts"
    command = ["--detector-cmd", misbehaving.command("always-lies-again") + f" --starts {shlex.quote(str(starts))}"]
    case = spurious_case(TinyRun(tmp_path, command))
    starts.unlink()
    assert_reduced(case, *command, "--budget", "60")
    assert len(starts.read_text(encoding="utf-8").splitlines()) == 3


def test_answer_that_depends_on_earlier_bodies_is_not_reduced(tmp_path):
    command = ["--detector-cmd", misbehaving.command("lies-when-kept")]
    case = spurious_case(TinyRun(tmp_path, command))
    outcome = contactcheck("reduce", case, *command, "--budget", "60")
    assert outcome.exit_code == 2
    assert "depends on what ran before it in its process" in outcome.err


@pytest.mark.parametrize("detector", [LIBRARY, COMMAND], ids=["library", "command"])
def test_command_that_the_run_prints_reduces(detector, tmp_path):
    run = TinyRun(tmp_path, detector, ["--no-timing", "--detector", "fcl-aabb"])
    _, mark, rest = run.outcome.out.partition("\nnext: ")
    assert mark, run.outcome.out
    program, *words = shlex.split(rest.splitlines()[0])
    assert program == PROGRAM
    outcome = run_program(program, [*words, "--budget", "60"])
    assert outcome.exit_code == 0, outcome.err


def test_within_the_run(tmp_path):
    out = TinyRun(tmp_path, LIBRARY, ["--no-timing", "--reduce"]).outcome.out
    assert "\nreduced: tiny, " in out
    assert "not reduced" not in out
    assert "\nnext: " not in out


def test_case_without_its_detector_is_refused(tmp_path):
    outcome = contactcheck("reduce", spurious_case(TinyRun(tmp_path, LIBRARY)))
    assert outcome.exit_code == 2
    assert ("is of the detector \"misbehaving\", which this program does not have; one from outside is "
            "brought along by --detector FILE.so or --detector-cmd CMD") in outcome.err
