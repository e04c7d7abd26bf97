"""What becomes of a command that misbehaves: one sentence before anything runs, or a row that says so."""

import pytest

from misbehaving import (LEAKING_LONG, LITTLE_MEMORY, SHORT_CALLS, assert_only_its_row, command, fault,
                         refused_on_tiny_scene)
from tiny_run import TinyRun, child_dies

# ---- at hello: the run is refused


@pytest.mark.parametrize("name, pieces, _, flags", [
    fault("no-answer", "said nothing for 1.5 s (time limit)", flags=("--call-limit", "1.5")),
    fault("ends-at-once", "the command ended with exit code 3"),
    fault("raises-at-once", "exit code 1", "ValueError: no such model"),
    fault("garbage", "where its message \"hello\" was due", "standard error"),
    fault("not-utf8", "line 1"),
    fault("version-2", "protocol is \"contactcheck-pipe/2\"", "contactcheck-pipe/1"),
    fault("bad-id", "id is \"a:b\"", "it must be"),
    fault("built-in-id", "calls itself \"fcl-aabb\"", "another detector's name"),
    fault("unknown-level", "semantics.levels[0] is \"voxel\"", "one of body"),
    fault("no-semantics", "semantics is missing"),
    fault("warms-up-once", "warm_up needs \"prepares_again\": true"),
    fault("endless-line", "a line of more than 1024 KiB"),
    fault("eats-memory-at-once", "more than 400 MiB (memory limit)", flags=("--memory-limit", "400")),
])
def test_fault_at_hello_is_refused_with_one_sentence(name, pieces, _, flags, tmp_path):
    refused_on_tiny_scene("--detector-cmd", command(name), *flags,
                          named=[*pieces, "command \"", name], folder=tmp_path)


def test_command_that_does_not_exist_is_refused(tmp_path):
    refused_on_tiny_scene("--detector-cmd", "./no-such-command --fast", "--no-timing",
                          named=["command \"./no-such-command --fast\"", "exit code 127", "not found"],
                          folder=tmp_path)


def test_sentence_about_a_long_command_is_not_cut(tmp_path):
    # 200 bytes of the command are shown; two bytes a character, and so half of one would be the first.
    refused_on_tiny_scene("--detector-cmd", command("garbage") + " " + "é" * 300 + "x", "--no-timing",
                          named=["command \"..." + "é" * 99 + "x\" wrote", "belongs on standard error"],
                          folder=tmp_path)


def test_two_commands_of_one_name_are_refused(tmp_path):
    refused_on_tiny_scene("--detector-cmd", command("none"), "--detector-cmd", command("lies"),
                          "--no-timing",
                          named=["lies\" calls itself \"misbehaving\", which is another detector's name; "
                                 "change the id that it declares"], folder=tmp_path)


# ---- at work: its row says so, and no other is disturbed


@pytest.mark.parametrize("name, pieces, status, flags", [
    fault("exits-in-frame", "frame 2", "the command ended with exit code 0"),
    fault("raises-in-frame", "frame 2", "ZeroDivisionError: division by zero in a frame"),
    fault("kills-itself", "frame 2", "ended with signal 9 (Killed)"),
    fault("hangs-in-frame", "frame 2", "no progress for 1.5 s", flags=SHORT_CALLS),
    fault("floods", "frame 2", "a line of more than 1024 KiB"),
    fault("floods-errors", "frame 2", "more than 64 MiB to standard error"),
    fault("eats-memory", "frame 2", "more than 400 MiB resident", flags=LITTLE_MEMORY),
    fault("eats-memory-in-a-child", "frame 2", "more than 400 MiB", flags=LITTLE_MEMORY),
    fault("leaks", "more than 400 MiB resident", flags=LEAKING_LONG),
    fault("closes-its-output", "frame 2", "closed its standard output"),
    fault("half-a-line", "frame 2", "ended with exit code 0"),
    fault("exact-later", "declares another \"exact\" after prepare than before"),
    fault("wrong-message", "message is \"ready\"; it must be \"done\""),
    fault("talks-too-much", "message is \"done\"; it must be \"contacts\""),
    fault("reports-an-error", "frame 2", "the solver did not converge"),
    fault("refuses", "only convex bodies, please", status="refused"),
    fault("negative-time", "ms is -1"),
    fault("no-such-body", "frame 2: the answer names body 9 of 2 bodies"),
    fault("no-such-triangle", "frame 2: the answer names triangle 1000000"),
    fault("with-itself", "frame 2: the answer names body \"right\" in contact with itself"),
    fault("counts-disagree", "lists of 32 bytes together and says 16"),
    fault("too-many", "triangles is 1e+12", "whole number from 0 to 16777216"),
    fault("half-a-message", "frame 2", "ended with exit code 0"),
    fault("nan-depth", "frame 2: the answer holds a depth or normal"),
])
def test_fault_at_work_is_in_its_row_alone(name, pieces, status, flags, tmp_path):
    run = TinyRun(tmp_path, ["--detector-cmd", command(name), "--detector", "fcl-aabb"], flags)
    assert_only_its_row(run, "misbehaving", pieces, status)


def test_lies_are_spurious_and_silence_is_missed(tmp_path):
    run = TinyRun(tmp_path, ["--detector-cmd", command("lies")])
    assert run.outcome.exit_code == 0, run.outcome.err
    level = run.row("misbehaving")["levels"]["triangle"]
    assert level["reported"] == 1
    assert level["hit"] + level["missed"] == level["truth"]


# The child works 40 ms a frame. Once it has ended, its time is known in whole ticks of user and of
# system time, of 10 ms each over all frames.
def test_work_of_a_child_during_a_call_is_cpu_time(tmp_path):
    run = TinyRun(tmp_path, ["--detector-cmd", command("works-in-a-child")], ["--processes", "1"])
    row = run.row("misbehaving")
    assert row["status"] == "ok", row["message"]
    for regime in ("playback", "cold"):
        times = row["time_ms"][regime]
        assert times["frame"] >= 39
        assert times["cpu"] >= 30
        assert times["taken"] == 0, "the program waited for the command"


# As a compiler in the background does: between its turns it is stopped, so that this lies within them.
def test_work_behind_an_answer_waits_for_the_next_turn(tmp_path):
    row = TinyRun(tmp_path, ["--detector-cmd", command("works-behind-its-answer")], []).row("misbehaving")
    assert row["status"] == "ok", row["message"]


# What is no longer in its group cannot be stopped.
def test_process_that_leaves_the_group_is_an_error(tmp_path):
    row = TinyRun(tmp_path, ["--detector-cmd", command("leaves-its-group")], []).row("misbehaving")
    assert row["status"] == "error"
    assert "its process \"sleep\" has left the process group of its command" in row["message"]
    assert "(while timed)" in row["message"]


def test_memory_is_that_of_its_processes(tmp_path):
    row = TinyRun(tmp_path, ["--detector-cmd", command("leaks")]).row("misbehaving")
    assert row["status"] == "ok", row["message"]
    grown = row["memory_bytes"] - row["prepared_bytes"]
    assert row["prepared_bytes"] > 1 << 20, "an interpreter"
    assert grown >= 5 << 24, "16 MiB a frame, and five frames"


def test_warm_up_is_on_bodies_of_its_own_before_those_of_the_scene(tmp_path):
    row = TinyRun(tmp_path, ["--detector-cmd", command("warms-up")]).row("misbehaving")
    assert row["status"] == "ok", row["message"]
    notes = " ".join(row["notes"])
    assert "wrote to standard error: \"40 frames of 896 triangles\"" in notes
    assert "warmed up by 40 frames of contactcheck's own before the scene's bodies" in notes


def test_fault_in_the_warm_up_is_no_frames_fault(tmp_path):
    run = TinyRun(tmp_path, ["--detector-cmd", command("fails-while-warm")])
    message = run.row("misbehaving")["message"]
    assert "in frame 7 of the warm-up: the command ended with exit code 1" in message
    assert "ValueError: seven were enough" in message
    assert "next:" not in run.outcome.out
    assert "next:" not in TinyRun(tmp_path, ["--detector-cmd", command("fails-while-warm"), "--reduce"]).outcome.out


def test_scale_may_follow_from_the_bodies(tmp_path):
    row = TinyRun(tmp_path, ["--detector-cmd", command("scale-later")]).row("misbehaving")
    assert row["status"] == "ok", row["message"]
    assert row["semantics"]["scale"] == 2


def test_what_was_said_of_the_warm_up_is_not_said_of_the_scene(tmp_path):
    row = TinyRun(tmp_path, ["--detector-cmd", command("scale-of-the-warm-up")]).row("misbehaving")
    assert row["status"] == "ok", row["message"]
    assert row["semantics"]["scale"] == 1


def test_another_name_than_at_first_is_an_error(tmp_path):
    run = TinyRun(tmp_path, ["--detector-cmd", command("renamed")])
    assert run.outcome.exit_code == 3, run.outcome.err
    assert "when the run began it was \"renamed-" in run.results["runs"][0]["message"]


def test_command_that_does_not_leave_is_ended(tmp_path):
    run = TinyRun(tmp_path, ["--detector-cmd", command("stays")])
    assert run.outcome.exit_code == 0, run.outcome.err
    assert run.row("misbehaving")["status"] == "ok"


def test_children_end_with_the_worker(tmp_path):
    run = TinyRun(tmp_path, ["--detector-cmd", command("leaves-a-child")])
    assert run.outcome.exit_code == 0, run.outcome.err
    assert child_dies(run.row("misbehaving"))
