"""`contactcheck reduce` of the wrong answers of detectors from outside."""

import json
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


NEAR = """
import array, json, sys
def write(line, numbers=array.array("I")):
    line["bytes"] = 4 * len(numbers)
    sys.stdout.buffer.write(json.dumps(line).encode() + b"\\n" + numbers.tobytes())
    sys.stdout.buffer.flush()
for text in iter(sys.stdin.buffer.readline, b""):
    line = json.loads(text)
    data = sys.stdin.buffer.read(line.get("bytes", 0))
    if line["message"] == "hello":
        write({"message": "hello", "protocol": "contactcheck-pipe/1", "id": "near", "needs": ["vertices"],
               "prepares_again": True, "semantics": {"levels": ["body"], "questions": ["body"]}})
    elif line["message"] == "prepare":
        counts = [body["vertices"] for body in line["bodies"]]
        write({"message": "ready"})
    elif line["message"] == "frame":
        x = array.array("d", data)[::3]
        a, b = x[:counts[0]], x[counts[0]:]
        far = max(map(abs, x))
        close = min(abs(p - q) for p in a for q in b) < 0.1 * far
        write({"message": "done"})
    else:
        write({"message": "contacts", "bodies": int(close)}, array.array("I", [0, 1] if close else []))
"""


# It takes a tenth of the size for contact: two that are almost at one place would be wrong, too, but
# for another reason.
def test_what_is_spurious_stays_as_far_apart(tmp_path):
    file = tmp_path / "near.py"
    file.write_text(NEAR, encoding="utf-8")
    command = ["--detector-cmd", f"python3 -B {shlex.quote(str(file))}"]
    run = TinyRun(tmp_path, command)
    case = next(d for d in run.results["disagreements"] if d["kind"] == "spurious")
    successful("reduce", run.out / case["case"], *command)
    least = json.loads((run.out / case["case"]).with_suffix(".min.json").read_text(encoding="utf-8"))
    first, second = (body["mesh"]["vertices"] for body in least["bodies"])
    places = [place for vertices in (first, second) for place in vertices]
    size = max(max(p[k] for p in places) - min(p[k] for p in places) for k in range(3))
    assert min(max(abs(p[k] - q[k]) for k in range(3)) for p in first for q in second) > 1e-4 * size


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
