"""Runs that are killed: what they leave unchanged, what `run --resume` takes over, and what is not
discarded without `--overwrite`."""

import json
import shutil
import signal

import pytest

from program import (PROGRAM, RunningProgram, contactcheck, names_in, run_files, successful, tiny_scene,
                     valid_results)

# Long enough that a run is still in it when the test has seen the first scene finished.
MANY_FRAMES = 3000

KEPT = "out/partial/first.partial.json"
INTERRUPTED = ("contactcheck: interrupted; finished scenes are kept: repeat the command with --resume to "
               "continue\n")


def first_scene(frames=5):
    """With a mesh out of a file, which may change under a scene that does not."""
    return json.dumps({
        "id": "first", "title": "A box and a triangle", "duration": 1, "frames": frames,
        "levels": ["body", "cell", "triangle"],
        "bodies": [{"name": "box", "mesh": {"shape": "box"}, "lattice": {"cells": [3, 3, 3]},
                    "motion": {"position": [[0, [-0.6, 0.1, 0.2]], [1, [0.2, 0.1, 0.2]]]}},
                   {"name": "corner", "mesh": {"file": "corner.obj"}, "lattice": {"cells": [2, 2, 2]}}]})


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "first.json").write_text(first_scene())
    (tmp_path / "second.json").write_text(tiny_scene("second", MANY_FRAMES))
    (tmp_path / "corner.obj").write_text("v 0.4 0 0\nv 1.4 0 0\nv 0.4 1 0\nf 1 2 3\n")
    return tmp_path


@pytest.fixture
def interrupted(folder):
    """After a run that was killed in its second scene."""
    interrupt(folder)
    return folder


def command(folder, scenes=("first", "second"), more=(), out="out"):
    return ["run", "--no-timing", "--detector", "ffd-grid", "--detector", "ffd-aabb+tri",
            "--out", folder / out, *(folder / f"{scene}.json" for scene in scenes), *more]


def run(folder, scenes=("first", "second"), more=(), out="out"):
    outcome = successful(*command(folder, scenes, more, out))
    return valid_results(folder / out / "results.json"), outcome


def interrupt(folder, number=signal.SIGKILL, more=()):
    """Ends a run when its first scene is finished and the worker of its second is at work."""
    kept, second = folder / KEPT, folder / "out/recordings/second.ccr"
    with RunningProgram(PROGRAM, command(folder, more=more)) as program:
        program.wait_for(lambda: kept.exists() and second.exists())
        assert kept.exists(), "the first scene was never finished"
        program.send(number)
        outcome = program.outcome()
    assert outcome.exit_code == 128 + number, "it was not in its second scene"
    return outcome


def expect_run_again(folder, *more):
    """Nothing of the first scene is taken over. (The second would only take time.)"""
    results, outcome = run(folder, ["first"], [*more, "--resume"])
    assert results["resumed"] == []
    assert outcome.err == (f"resumed: nothing: no scene of this run is finished in {folder}/out\n"
                           "scene 1 of 1: first\n")
    assert not (folder / "out/partial").exists()


def refusal(folder, scenes=("first", "second"), more=()):
    """What is said about scenes that would be lost, all of which are still there."""
    kept = contents(folder / "out/partial")
    outcome = contactcheck(*command(folder, scenes, more))
    assert outcome.exit_code == 2
    assert contents(folder / "out/partial") == kept
    head = f"contactcheck: --out {folder}/out: an interrupted run has left 1 finished scene there"
    assert outcome.err.startswith(head)
    return outcome.err[len(head):]


def expect_refused_and_overwritten(folder, names, *more):
    """The first scene, of which `names` have changed, is not lost without --overwrite."""
    for resume in ([], ["--resume"]):
        words = refusal(folder, ["first"], [*more, *resume])
        assert words.startswith(f", of which first is of another run (other {names}): contactcheck run ")
        assert words.endswith("; --overwrite discards them, another --out keeps them\n")
    expect_run_again(folder, *more, "--overwrite")


def contents(folder):
    """Of a folder of files: bytes by name."""
    return {name: (folder / name).read_bytes() for name in names_in(folder)}


def in_order(node):
    """What is kept is compared with its order."""
    return json.dumps(node, indent=1)


def test_killed_runs_leave_earlier_results_unchanged(folder):
    out = folder / "out"
    successful("run", folder / "first.json", "--no-timing", "--detector", "ffd-grid", "--out", out)
    valid_results(out / "results.json")

    def left():
        return [(out / "results.json").read_bytes(), (out / "report.md").read_bytes(),
                contents(out / "cases"), contents(out / "contacts")]

    before = left()
    assert before[2]
    for number in (signal.SIGKILL, signal.SIGINT, signal.SIGTERM):
        interrupt(folder, number)
        assert left() == before, f"signal {number}"
        (folder / KEPT).unlink()


def test_interrupted_run_removes_its_scratch_folder(folder):
    interrupt(folder, signal.SIGINT)
    assert names_in(folder / "out") == {"cases", "contacts", "partial", "recordings"}
    assert names_in(folder / "out/partial") == {"first.partial.json"}


def test_interrupted_run_says_how_to_continue(folder):
    for number in (signal.SIGINT, signal.SIGTERM):
        assert interrupt(folder, number).err == "scene 1 of 2: first\nscene 2 of 2: second\n" + INTERRUPTED
        shutil.rmtree(folder / "out")
    assert interrupt(folder, signal.SIGINT, ["--quiet", "--json-lines"]).err == INTERRUPTED


# Their results would be those of one and their recordings those of the other.
def test_second_run_into_a_folder_is_refused_until_the_first_has_ended(folder):
    with RunningProgram(PROGRAM, command(folder, ["second"])) as holder:
        holder.wait_for((folder / "out/recordings/second.ccr").exists)
        second = contactcheck(*command(folder, ["first"]))
        assert second.exit_code == 2
        assert second.err == (f"contactcheck: --out {folder}/out: another run is writing there; "
                              "wait for its end or name another folder\n")
        assert not holder.has_ended(), "it must hold its folder meanwhile"
        holder.send(signal.SIGKILL)
        holder.outcome()
    results, _ = run(folder, ["first"], ["--resume", "--overwrite"])
    assert len(results["runs"]) == 2, "at once"


def expect_the_same(folder, results, whole):
    """Of a run in out/ and one in whole/."""
    def hashes(of):
        return {(row["scene"], row["detector"]): row["contact_hash"] for row in of["runs"]}

    assert hashes(results) == hashes(whole)
    assert len(hashes(results)) == 4
    assert in_order(results["scenes"]) == in_order(whole["scenes"])
    assert in_order(results["disagreements"]) == in_order(whole["disagreements"])
    assert results["disagreements"][0]["scene"] == "first", "there is a case to keep"
    assert contents(folder / "out/cases") == contents(folder / "whole/cases")
    assert contents(folder / "out/contacts") == contents(folder / "whole/contacts")
    assert names_in(folder / "out/contacts") == {"first.json", "second.json"}


def test_resumed_run_gives_what_an_uninterrupted_run_gives_without_the_first_scene_again(folder):
    whole, _ = run(folder, out="whole")
    interrupt(folder)
    results, outcome = run(folder, more=["--resume"])
    assert results["resumed"] == ["first"]
    assert outcome.err == (f"resumed: 1 of 2 scenes, finished in {folder}/out: first\n"
                           "scene 2 of 2: second\n")
    expect_the_same(folder, results, whole)


def test_finished_run_is_taken_over_whole(folder):
    whole, _ = run(folder, out="whole")
    run(folder)
    results, outcome = run(folder, more=["--resume"])
    assert results["resumed"] == ["first", "second"]
    assert outcome.err == f"resumed: 2 of 2 scenes, finished in {folder}/out: first, second\n"
    assert names_in(folder / "out") == run_files("plots")
    expect_the_same(folder, results, whole)


def test_finished_scenes_are_taken_into_a_larger_run_that_may_be_interrupted(folder):
    run(folder, ["first"])
    with RunningProgram(PROGRAM, command(folder, more=["--resume"])) as program:
        program.wait_for((folder / "out/recordings/second.ccr").exists)
        program.send(signal.SIGKILL)
        program.outcome()
    assert names_in(folder / "out/partial") == {"first.partial.json"}
    results, _ = run(folder, more=["--resume"])
    assert results["resumed"] == ["first"]


def test_other_finished_scenes_are_taken_over_beside_a_damaged_one(folder):
    (folder / "third.json").write_text(tiny_scene("third", 5))
    run(folder, ["first", "third"])
    (folder / "out/recordings/first.ccr").unlink()
    results, _ = run(folder, ["first", "third"], ["--resume"])
    assert results["resumed"] == ["third"]


def test_scenes_of_two_runs_are_taken_over_or_discarded(interrupted):
    (interrupted / "third.json").write_text(tiny_scene("third", 5))
    with RunningProgram(PROGRAM, command(interrupted, ["third", "second"],
                                         ["--resume", "--overwrite"])) as program:
        program.wait_for((interrupted / "out/partial/third.partial.json").exists)
        program.send(signal.SIGKILL)
        program.outcome()
    outcome = contactcheck(*command(interrupted, ["first"]))
    assert outcome.exit_code == 2
    assert "has left 2 finished scenes there, of which third is of another run (other scenes): " in outcome.err
    assert outcome.err.endswith("; --resume --overwrite takes over first and discards the others\n")
    results, _ = run(interrupted, ["first"], ["--resume", "--overwrite"])
    assert results["resumed"] == ["first"]
    assert not (interrupted / "out/partial").exists()


@pytest.mark.parametrize("damaged", ["recordings/first.ccr", "contacts/first.json", "results.json",
                                     "cases/0001.json"])
@pytest.mark.parametrize("remove", [True, False])
def test_finished_scene_that_is_damaged_is_run_again(folder, damaged, remove):
    run(folder, ["first"])
    if remove:
        (folder / "out" / damaged).unlink()
    elif damaged in ("recordings/first.ccr", "results.json"):
        content = (folder / "out" / damaged).read_bytes()
        (folder / "out" / damaged).write_bytes(content[:-9])
    else:
        return
    expect_run_again(folder)


def test_resumed_run_says_what_it_took_over_and_leaves_nothing_else(interrupted):
    _, outcome = run(interrupted, more=["--resume"])
    assert "finished in" in outcome.err
    assert "Taken over from an earlier run (`--resume`)" in (interrupted / "out/report.md").read_text()
    assert names_in(interrupted / "out") == run_files("plots")


def test_rows_are_those_that_were_kept(interrupted):
    kept = interrupted / KEPT
    content = json.loads(kept.read_text())
    content["results"]["runs"][0]["message"] = "as it was kept"
    kept.write_text(json.dumps(content))
    results, outcome = run(interrupted, ["first"], ["--resume"])
    assert results["runs"][0]["message"] == "as it was kept"
    assert "scene 1" not in outcome.err, "no scene is run"


def test_run_that_is_killed_again_keeps_what_it_took_over(interrupted):
    kept = (interrupted / KEPT).read_bytes()
    interrupt(interrupted, signal.SIGINT, ["--resume"])
    assert (interrupted / KEPT).read_bytes() == kept
    results, _ = run(interrupted, more=["--resume"])
    assert results["resumed"] == ["first"]


def test_without_resume_nothing_is_lost(interrupted):
    assert refusal(interrupted) == " (first): --resume takes them over, --overwrite discards them\n"


def test_scenes_of_another_run_are_not_lost(interrupted):
    for resume in ([], ["--resume"]):
        words = refusal(interrupted, ["second"], resume)
        assert words.startswith(", of which first is of another run (other scenes): contactcheck run ")
    results, _ = run(interrupted, more=["--resume"])
    assert results["resumed"] == ["first"], "as if the other had not been tried"


def test_check_leaves_the_scenes_of_an_interrupted_run(interrupted):
    kept = contents(interrupted / "out/partial")
    for frame in (0, 1):
        (interrupted / f"ball_{frame}.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        (interrupted / f"wall_{frame}.obj").write_text("v 0 0 -1\nv 1 0 1\nv 0 1 1\nf 1 2 3\n")
    found = contactcheck("check", *sorted(interrupted.glob("*_?.obj")), "--out", interrupted / "out")
    assert found.exit_code == 1, found.err
    assert contents(interrupted / "out/partial") == kept
    results, _ = run(interrupted, more=["--resume"])
    assert results["resumed"] == ["first"]


def test_with_overwrite_every_scene_runs_again(interrupted):
    results, outcome = run(interrupted, more=["--overwrite"])
    assert "resumed" not in results
    assert "scene 1 of 2: first\n" in outcome.err
    assert "--resume" not in (interrupted / "out/report.md").read_text()


def test_nothing_to_take_over_is_no_error(folder):
    expect_run_again(folder)


@pytest.mark.parametrize("option, names", [
    ("--frames=4", "frames"), ("--detector=fcl-aabb", "detector"), ("--call-limit=50", "call_limit")])
def test_scene_of_other_settings_is_not_lost(interrupted, option, names):
    expect_refused_and_overwritten(interrupted, names, *option.split("="))


def test_changed_scene_is_run_again(interrupted):
    (interrupted / "first.json").write_text(first_scene(6))
    expect_refused_and_overwritten(interrupted, "content")


def test_changed_mesh_is_run_again(interrupted):
    (interrupted / "corner.obj").write_text("v 0.3 0 0\nv 1.4 0 0\nv 0.4 1 0\nf 1 2 3\n")
    expect_refused_and_overwritten(interrupted, "content")


def test_scene_without_its_recording_is_run_again(interrupted):
    recording = interrupted / "out/recordings/first.ccr"
    for damage in (recording.unlink, lambda: recording.write_bytes(b"another")):
        kept = contents(interrupted / "out/partial")
        damage()
        expect_run_again(interrupted)
        (interrupted / "out/partial").mkdir()
        for name, text in kept.items():
            (interrupted / "out/partial" / name).write_bytes(text)
        (interrupted / "out/results.json").unlink()


def test_damaged_files_are_run_again(interrupted):
    kept = interrupted / KEPT
    text = kept.read_text()
    without_runs = json.loads(text)
    del without_runs["results"]["runs"]
    for damaged in (text[:len(text) // 2], "", "[]", json.dumps(without_runs), "[" * 100_000):
        kept.parent.mkdir(exist_ok=True)
        kept.write_text(damaged)
        (interrupted / "out/results.json").unlink(missing_ok=True)
        expect_run_again(interrupted)


def test_files_of_others_stay(interrupted):
    (interrupted / "out/partial/notes.txt").write_text("mine")
    (interrupted / "out/partial/third.partial.json.77-0.tmp").write_text("half")
    run(interrupted, more=["--resume"])
    assert names_in(interrupted / "out/partial") == {"notes.txt"}
