"""Whole runs with one detector that strikes at its process: what becomes of its row, and that nothing
happens to the others."""

import os
import platform
import re
import signal

import pytest

from program import FIXTURES, run_program
from tiny_run import UNTIMED, TinyRun, child_dies

WITH_FAULTS = os.environ["CONTACTCHECK_WITH_FAULTS"]
# Two detectors of other makers, a library's and core's.
HONEST = ("fcl-aabb", "ffd-aabb-sphere2+tri")
# What no fault may change in the row of another detector.
ESSENCE = ("status", "message", "contact_hash", "levels", "per_frame", "geometry", "stages",
           "float_environment", "notes")
TIMED = ("--processes", "2")
SHORT_CALLS = ("--call-limit", "0.8")
TIME_LIMIT = "no progress for 0.8 s (time limit of one call)"
CRASH = "signal 11 (Segmentation fault)"
HAS_SSE = platform.machine() == "x86_64"


def run_of(detectors, flags, folder):
    words = [word for detector in detectors for word in ("--detector", detector)]
    run = TinyRun(folder, words, flags, of=WITH_FAULTS)
    assert {row["detector"] for row in run.results["runs"]} == set(detectors)
    return run


def essence(row):
    out = {field: row.get(field) for field in ESSENCE}
    out["per_frame"] = {key: value for key, value in row["per_frame"].items() if key != "frame_ms"}
    return out


@pytest.fixture(name="undisturbed", scope="module")
def fixture_undisturbed(tmp_path_factory):
    return run_of(HONEST, UNTIMED, tmp_path_factory.mktemp("undisturbed"))


@pytest.fixture(name="run_with")
def fixture_run_with(undisturbed, tmp_path):
    """Runs the fault before the honest detectors, so that what it leaves behind meets them; they must be
    as they are without it."""
    def run(fault, flags=UNTIMED):
        out = run_of([fault, *HONEST], flags, tmp_path)
        for honest in HONEST:
            assert essence(out.row(honest)) == essence(undisturbed.row(honest)), honest
        return out
    return run


def assert_error(run, fault, message):
    assert run.outcome.exit_code == 3, run.outcome.err
    assert run.row(fault)["status"] == "error"
    assert run.row(fault)["message"] == message


def assert_harmless(run, fault, undisturbed):
    assert run.outcome.exit_code == 0, run.outcome.err
    row = run.row(fault)
    assert row["status"] == "ok", row["message"]
    assert row["contact_hash"] == undisturbed.row("fcl-aabb")["contact_hash"], "it answers with the truth"
    assert run.outcome.err == "scene 1 of 1: tiny\n"


# What becomes of a fault that ends its worker, and the flags of its run.
LETHAL = {
    "fault-crash": (f"frame 2, phase update: {CRASH}", UNTIMED),
    "fault-crash:phase=prepare": (f"frame 0, phase prepare: {CRASH}", UNTIMED),
    "fault-crash:frame=4,phase=query": (f"frame 4, phase query: {CRASH}", UNTIMED),
    # Times between frames are given as frame 0; they are looked at up to frame 2, the first contact.
    "fault-crash:frame=0,phase=again": (f"frame 2, phase query: {CRASH}", UNTIMED),
    "fault-crash:frame=0,phase=update-again": (f"frame 2, phase update: {CRASH}", UNTIMED),
    "fault-hang:phase=update-timed": (f"frame 2, phase update: {TIME_LIMIT} (while timed)", (*TIMED, *SHORT_CALLS)),
    "fault-hang:phase=timed": (f"frame 2, phase query: {TIME_LIMIT} (while timed)", (*TIMED, *SHORT_CALLS)),
    "fault-hang": (f"frame 2, phase update: {TIME_LIMIT}", (*UNTIMED, *SHORT_CALLS)),
    "fault-abort": ("frame 2, phase update: signal 6 (Aborted)", UNTIMED),
    "fault-quick-exit": ("frame 2, phase update: exit code 0", UNTIMED),
    "fault-memory": ("frame 2, phase update: more than 400 MiB resident (memory limit)",
                     (*UNTIMED, "--memory-limit", "400")),
    "fault-flood": ("frame 2, phase update: more than 64 MiB written to standard output and error (output "
                    "limit)", UNTIMED),
    # A byte that cannot be printed is shown as "?".
    "fault-throw": ("frame 2, phase update: caf?is shut", UNTIMED),
    "fault-throw-int:phase=prepare": ("frame 0, phase prepare: threw int, which is no std::exception",
                                      UNTIMED),
    # A copy of the worker goes on; it is not listened to.
    "fault-fork": (f"frame 2, phase update: {CRASH}", UNTIMED),
}


@pytest.mark.parametrize("fault", LETHAL)
def test_lethal_fault_is_an_error_in_its_frame_and_phase(fault, run_with):
    message, flags = LETHAL[fault]
    assert_error(run_with(fault, flags), fault, f"scene tiny, {message}")


def test_known_defect_that_is_an_error_is_no_failure_of_the_run(tmp_path, monkeypatch):
    (tmp_path / "hard").mkdir()
    (tmp_path / "suites").symlink_to(FIXTURES / "suites")
    (tmp_path / "hard" / "readings.json").write_text("""{"readings": [
        {"where": "0", "kind": "error", "sentence": "ends",
         "seen": {"fault-abort": {"tiny": {"-": 1}}}}]}""", encoding="utf-8")
    monkeypatch.setenv("CONTACTCHECK_FIXTURES", str(tmp_path))
    assert run_of(["fault-abort"], UNTIMED, tmp_path).outcome.exit_code == 0
    assert run_of(["fault-crash"], UNTIMED, tmp_path).outcome.exit_code == 3


def test_crash_while_timed_leaves_the_others_their_times(run_with):
    fault = "fault-crash:phase=timed"
    run = run_with(fault, TIMED)
    assert re.fullmatch(r"scene tiny, frame 2, phase [a-z]+: signal 11 \(Segmentation fault\) \(while timed\)",
                        run.row(fault)["message"])
    assert run.outcome.exit_code == 3
    for honest in HONEST:
        assert run.row(honest)["time_ms"]["passes"] == 2


def test_throw_while_timed_is_an_error_of_its_row_alone(run_with):
    fault = "fault-throw-int:phase=timed"
    run = run_with(fault, TIMED)
    assert_error(run, fault, "scene tiny, frame 2, phase query: threw int, which is no std::exception "
                             "(while timed)")
    assert run.row("fcl-aabb")["time_ms"]["passes"] == 2


def test_terminate_in_a_thread_is_an_abort_and_its_words_are_shown(run_with):
    run = run_with("fault-terminate-thread")
    assert_error(run, "fault-terminate-thread", "scene tiny, frame 2, phase update: signal 6 (Aborted)")
    for piece in ("scene tiny, detector fault-terminate-thread", "  | ", "nobody catches this"):
        assert piece in run.outcome.err


def test_exit_in_the_middle_is_an_error(run_with):
    run = run_with("fault-exit")
    assert run.outcome.exit_code == 3
    # With leak checks on, exit turns 0 into the checker's own code.
    assert run.row("fault-exit")["message"].startswith("scene tiny, frame 2, phase update: exit code ")


def test_two_faults_are_two_errors(undisturbed, tmp_path):
    run = run_of(["fault-crash", "fcl-aabb", "fault-quick-exit:phase=query", "fault-throw"], UNTIMED,
                 tmp_path)
    assert run.outcome.exit_code == 3
    assert "signal 11" in run.row("fault-crash")["message"]
    assert "exit code 0" in run.row("fault-quick-exit:phase=query")["message"]
    assert "caf?" in run.row("fault-throw")["message"]
    assert essence(run.row("fcl-aabb")) == essence(undisturbed.row("fcl-aabb"))


@pytest.mark.parametrize("fault, changed", [
    ("fault-none", []),
    ("fault-rounding", ["update changed rounding mode"]),
] + HAS_SSE * [
    ("fault-flush", ["update changed flush-to-zero, denormals-are-zero"]),
    ("fault-trap", ["update changed traps"]),
])
def test_changed_float_environment_is_noted_and_restored(fault, changed, run_with, undisturbed):
    run = run_with(fault)
    assert_harmless(run, fault, undisturbed)
    assert run.row(fault)["float_environment"] == changed


@pytest.mark.parametrize("fault, notes", [
    ("fault-none", []),
    ("fault-locale", ["changed the locale"]),
    ("fault-directory", ["changed the working directory"]),
    ("fault-signals", [f"changed the handling of signals {signal.SIGUSR1:d}, {signal.SIGALRM:d}",
                       "left a timer running", "changed which signals are blocked"]),
])
def test_changed_process_is_noted_and_restored(fault, notes, run_with, undisturbed):
    run = run_with(fault)
    assert_harmless(run, fault, undisturbed)
    assert run.row(fault)["notes"] == notes


def test_output_is_noted_and_not_passed_on(run_with, undisturbed):
    run = run_with("fault-stdout")
    assert_harmless(run, "fault-stdout", undisturbed)
    assert run.row("fault-stdout")["notes"] == [
        "wrote to standard output: \"[31mhello from a library\"",
        "wrote to standard error: \"a warning\""]
    assert "hello" not in run.outcome.out


def test_closed_streams_are_noted_and_opened_again(undisturbed, tmp_path):
    run = run_of(["fault-close", "fault-stdout", "fcl-aabb"], UNTIMED, tmp_path)
    assert run.outcome.exit_code == 0, run.outcome.err
    assert run.row("fault-close")["notes"] == ["closed or replaced standard output",
                                               "closed or replaced standard error"]
    notes = run.row("fault-stdout")["notes"]
    assert "wrote to standard error: \"a warning\"" in notes
    assert any("hello from a library" in note for note in notes)
    assert essence(run.row("fcl-aabb")) == essence(undisturbed.row("fcl-aabb"))


def test_change_while_timed_alone_is_noted_once_as_that(run_with):
    fault = "fault-directory:phase=timed"
    row = run_with(fault, TIMED).row(fault)
    assert row["status"] == "ok", row["message"]
    assert row["notes"] == ["changed the working directory (while timed)"]


def test_change_while_judged_is_not_noted_again_while_timed(run_with):
    assert run_with("fault-directory", TIMED).row("fault-directory")["notes"] == [
        "changed the working directory"]


def test_crash_at_exit_comes_after_the_answer(run_with, undisturbed):
    assert_harmless(run_with("fault-at-exit"), "fault-at-exit", undisturbed)


def test_children_of_a_library_end_with_the_worker(run_with, undisturbed):
    run = run_with("fault-children")
    assert_harmless(run, "fault-children", undisturbed)
    assert len(run.row("fault-children")["notes"]) == 1
    assert child_dies(run.row("fault-children"))


def test_list_of_the_faulty_program_names_the_faults():
    outcome = run_program(WITH_FAULTS, ["list", "--detectors"])
    assert outcome.exit_code == 0
    assert "\nfault-hang\n" in outcome.out
