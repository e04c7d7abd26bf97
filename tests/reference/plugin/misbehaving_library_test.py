"""What becomes of a library that misbehaves: one sentence before anything runs, or a row that says so."""

import os

import pytest

import misbehaving
from misbehaving import (LEAKING_LONG, LITTLE_MEMORY, SHORT_CALLS, assert_only_its_row, fault, library,
                         refused_on_tiny_scene)
from program import names_in
from tiny_run import TinyRun

# ---- at load: the run is refused


@pytest.mark.parametrize("name, pieces, _, flags", [
    fault("version", "version 99", "this program speaks versions 1 to 4"),
    fault("size", "contactcheck_body a size of", "here it has"),
    fault("no-table", "cannot be used: it gave no table from contactcheck_plugin_entry()"),
    fault("no-function", "lacks one of its functions"),
    fault("no-id", "has no id"),
    fault("bad-id", "id is \"two words\"", "it must be"),
    fault("built-in-id", "\"ffd-lazy\"", "another detector's name"),
    fault("library-id", "\"fcl-mine\"", "kept for fcl"),
    fault("no-question", "answers no question"),
    fault("bad-default", "option fault is \"nonsense\"", "allowed: none, "),
    fault("crash", "ended in signal 11"),
    fault("exit", "ended in exit code "),
    fault("hang", "said nothing for 1.5 s (time limit)", flags=("--call-limit", "1.5")),
    fault("memory", "took more than 400 MiB (memory limit)", flags=("--memory-limit", "400")),
])
def test_fault_at_load_is_refused_with_one_sentence(name, pieces, _, flags, tmp_path, monkeypatch):
    monkeypatch.setenv("CONTACTCHECK_PLUGIN_FAULT", name)
    refused_on_tiny_scene("--detector", misbehaving.LIBRARY, *flags,
                          named=[*pieces, f"library \"{misbehaving.LIBRARY}\""], folder=tmp_path)


def test_file_that_does_not_exist_is_refused(tmp_path):
    refused_on_tiny_scene("--detector", "./no-such-library.so", "--no-timing",
                          named=["no-such-library.so\" does not exist"], folder=tmp_path)


def test_pipe_is_refused_and_not_waited_for(tmp_path):
    pipe = tmp_path / "mine.so"
    os.mkfifo(pipe)
    refused_on_tiny_scene("--detector", pipe, "--no-timing",
                          named=[f"{pipe}\" is a pipe, not a regular file"], folder=tmp_path)


def test_file_that_is_no_library_is_refused(tmp_path):
    refused_on_tiny_scene("--detector", misbehaving.COMMAND_FILE, "--no-timing",
                          named=["cannot be loaded"], folder=tmp_path)


def test_library_that_is_no_plugin_is_refused(tmp_path):
    refused_on_tiny_scene("--detector", os.environ["CONTACTCHECK_NO_PLUGIN"], "--no-timing",
                          named=["is no detector: it has no function contactcheck_plugin_entry"],
                          folder=tmp_path)


@pytest.mark.parametrize("option, pieces", [
    ("colour=red", ["unknown option \"colour\"", "misbehaving knows fault"]),
    ("fault=boredom", ["option fault is \"boredom\"", "allowed: none"]),
])
def test_unknown_options_and_values_are_refused(option, pieces, tmp_path):
    refused_on_tiny_scene("--detector", f"{misbehaving.LIBRARY}:{option}", "--no-timing", named=pieces,
                          folder=tmp_path)


# ---- at work: its row says so, and no other is disturbed


def run_beside_fcl(name, flags, folder):
    return TinyRun(folder, ["--detector", library(name), "--detector", "fcl-aabb"], flags)


@pytest.mark.parametrize("name, pieces, status, flags", [
    fault("create-fails", "create failed: no licence for this machine"),
    fault("unknown-level", "declares levels that do not exist"),
    fault("no-question", "it answers no question"),
    fault("exact-later", "declares another \"exact\" after prepare than before"),
    fault("nodes-later", "declares another \"needs_vertices\" after prepare"),
    fault("refuses", "bodies without a licence", status="refused"),
    fault("crash", "frame 2", "signal 11"),
    fault("exit", "frame 2", "exit code "),
    fault("hang", "frame 2", "no progress for 1.5 s", flags=SHORT_CALLS),
    fault("fails", "frame 2", "update failed: xxx"),
    fault("strange-status", "frame 2", "update failed"),
    fault("memory", "frame 2", "memory limit", flags=LITTLE_MEMORY),
    fault("leaks", "frame", "phase", "more than 400 MiB resident", flags=LEAKING_LONG),
    fault("crash-when-destroyed", "phase destroy", "signal 11"),
    fault("no-such-body", "frame 2: the answer names body 7 of 2 bodies"),
    fault("no-such-triangle", "frame 2: the answer names triangle 1000000"),
    fault("endless-answer", "frame 2", "memory limit", flags=LITTLE_MEMORY),
    fault("nan-depth", "frame 2: the answer holds a depth or normal"),
    fault("null-items", "frame 2"),
])
def test_fault_at_work_is_in_its_row_alone(name, pieces, status, flags, tmp_path):
    assert_only_its_row(run_beside_fcl(name, flags, tmp_path), f"misbehaving:fault={name}", pieces, status)


# Its times would be those of another answer.
def test_answers_that_differ_while_timed_are_an_error(tmp_path, monkeypatch):
    monkeypatch.setenv("CONTACTCHECK_PLUGIN_FOLDER", str(tmp_path))
    run = run_beside_fcl("lies-in-the-first-process", ["--processes", "1"], tmp_path)
    detector = "misbehaving:fault=lies-in-the-first-process"
    assert_only_its_row(run, detector, [
        "frame 0", "it answered 0 pairs of triangles and not the 1 that were judged (while timed)"])
    assert "time_ms" not in run.row(detector)
    assert "time_ms" in run.row("fcl-aabb")


@pytest.mark.parametrize("name, message", [
    ("aborts-in-its-second-pass", "scene tiny, frame 2, phase update: signal 6 (Aborted) (while timed)"),
    ("leaves-in-its-second-pass", "scene tiny, frame 2, phase update: exit code 0 (while timed)"),
], ids=["abort", "exit"])
def test_death_in_the_second_pass_leaves_others_their_times(name, message, tmp_path, monkeypatch):
    marks = tmp_path / "marks"
    marks.mkdir()
    monkeypatch.setenv("CONTACTCHECK_PLUGIN_FOLDER", str(marks))
    run = run_beside_fcl(name, ["--processes", "3"], tmp_path)
    assert_only_its_row(run, f"misbehaving:fault={name}", [message])
    assert "time_ms" not in run.row(f"misbehaving:fault={name}")
    assert "next:" not in run.outcome.out, "it was judged well: reduce would find nothing"
    assert run.row("fcl-aabb")["time_ms"]["passes"] == 3
    # Processes that judge, of the first pass (two) and of half the second.
    assert len(names_in(marks)) == 4


# It works 2 ms in every frame that it does not remember: in a pass it remembers none.
@pytest.mark.parametrize("name", ["works", "remembers-frames", "remembers-nodes", "remembers-in-a-file"])
def test_nothing_is_gained_by_remembering(name, tmp_path):
    row = run_beside_fcl(name, ["--processes", "2"], tmp_path).row(f"misbehaving:fault={name}")
    assert row["status"] == "ok", row["message"]
    assert row["time_ms"]["passes"] == 2
    for regime in ("playback", "cold"):
        for time in ("frame", "cpu"):
            assert row["time_ms"][regime][time] >= 2, (regime, time)
    assert row["time_ms"]["playback"]["first_frame"] >= 2


def test_work_in_a_background_thread_is_an_error(tmp_path):
    run = run_beside_fcl("works-in-a-thread", ["--processes", "1"], tmp_path)
    assert_only_its_row(run, "misbehaving:fault=works-in-a-thread",
                        ["it has used ", " ms of CPU time ", " of calls"])


def test_scale_may_follow_from_the_bodies(tmp_path):
    row = TinyRun(tmp_path, ["--detector", library("scale-later")]).row("misbehaving:fault=scale-later")
    assert row["status"] == "ok", row["message"]
    assert row["semantics"]["scale"] == 2


def test_lies_are_spurious_and_silence_is_missed(tmp_path):
    run = TinyRun(tmp_path, ["--detector", library("lies"), "--detector", library("repeats"),
                             "--detector", "fcl-aabb"])
    assert run.outcome.exit_code == 0, run.outcome.err
    truth = run.row("fcl-aabb")["levels"]["triangle"]["truth"]
    assert truth > 1
    for detector in ("misbehaving:fault=lies", "misbehaving:fault=repeats"):
        level = run.row(detector)["levels"]["triangle"]
        assert level["reported"] == 1, "a repeat is no second contact"
        assert level["missed"] + level["hit"] == truth
        assert level["spurious"] + level["hit"] == 1


def test_what_it_prints_is_a_note(tmp_path):
    run = TinyRun(tmp_path, ["--detector", library("prints")])
    assert run.outcome.exit_code == 0, run.outcome.err
    assert any("garbage on standard output" in note for note in run.row("misbehaving:fault=prints")["notes"])
    assert "\ngarbage" not in run.outcome.out, "not among the program's lines"
    assert ("\n  misbehaving:fault=prints: wrote to standard output: \"garbage on standard output\"\n"
            in run.outcome.out)
