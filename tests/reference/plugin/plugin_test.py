"""Detectors from outside as part of a run: their names, their options, and what tells one build of a
detector from the next."""

import os
import shlex
import shutil
import signal
import sys
import time

import pytest

from program import PROGRAM, RunningProgram, contactcheck, refused, successful, tiny_scene, valid_results
from tiny_run import TinyRun

VERSION_1 = os.environ["CONTACTCHECK_VERSION_1_LIBRARY"]

# Claims that bodies touch, and reports nothing. Scenes of more than 5 frames take it forever.
SCRIPT = """
import json, sys, time
semantics = {"levels": ["body"], "questions": ["body"]}
hello = {"message": "hello", "protocol": "contactcheck-pipe/1", "id": sys.argv[1], "semantics": semantics,
         "options": [{"name": "leaf", "default": "4", "min": 1, "max": 8, "integer": True}]}
for text in iter(sys.stdin.buffer.readline, b""):
    line = json.loads(text)
    sys.stdin.buffer.read(line.get("bytes", 0))
    if line.get("index", 0) >= 5:
        time.sleep(1000)
    kind = {"prepare": "ready", "frame": "done", "query": "contacts"}.get(line["message"])
    print(json.dumps({"message": kind} if kind else hello), flush=True)
"""


@pytest.fixture(name="script")
def fixture_script(request, tmp_path):
    file = tmp_path / getattr(request, "param", "mine.py")
    file.parent.mkdir(exist_ok=True)
    file.write_text(SCRIPT, encoding="utf-8")
    return file


def command(script, *flags, name="mine"):
    return shlex.join([sys.executable, "-B", *flags, str(script), name])


def append_newline(file):
    with open(file, "ab") as stream:
        stream.write(b"\n")


def content(folder, *words):
    run = TinyRun(folder, words)
    assert run.outcome.exit_code == 0, run.outcome.err
    return run.results["plugins"][0]["content"]


# A name with a space is quoted in the command.
@pytest.mark.parametrize("script", ["mine.py", "two words/mine.py"], indirect=True)
def test_content_of_a_command_follows_its_line_and_its_script(script, tmp_path):
    first = content(tmp_path, "--detector-cmd", command(script))
    assert content(tmp_path, "--detector-cmd", command(script)) == first
    assert content(tmp_path, "--detector-cmd", command(script, "-E")) != first
    append_newline(script)
    assert content(tmp_path, "--detector-cmd", command(script)) != first


def test_content_of_a_library_follows_its_bytes(tmp_path):
    library = tmp_path / "libmine.so"
    shutil.copyfile(VERSION_1, library)
    first = content(tmp_path, "--detector", library)
    assert content(tmp_path, "--detector", library) == first
    append_newline(library)
    assert content(tmp_path, "--detector", library) != first


# A run is killed in its second scene; the first is taken over if the detector is as it was.
def test_resume_takes_nothing_over_when_the_content_has_changed(script, tmp_path):
    scenes = []
    for name, frames in (("first", 5), ("second", 6)):
        scenes.append(tmp_path / f"{name}.json")
        scenes[-1].write_text(tiny_scene(name, frames), encoding="utf-8")
    out = tmp_path / "out"
    words = ["--detector-cmd", command(script), "--no-timing", "--out", out]
    with RunningProgram(PROGRAM, ["run", *scenes, *words]) as running:
        while not (out / "partial" / "first.partial.json").exists():
            assert not running.has_ended()
            time.sleep(0.01)
        running.send(signal.SIGKILL)
        running.outcome()
    shutil.copytree(out, tmp_path / "kept")
    successful("run", scenes[0], *words, "--resume")
    assert valid_results(out / "results.json")["resumed"] == ["first"]
    shutil.rmtree(out)
    shutil.copytree(tmp_path / "kept", out)
    append_newline(script)
    again = contactcheck("run", scenes[0], *words, "--resume")
    assert again.exit_code == 2
    assert "first is of another run (other plugins): contactcheck run " in again.err
    successful("run", scenes[0], *words, "--resume", "--overwrite")
    assert valid_results(out / "results.json")["resumed"] == []


@pytest.mark.parametrize("name, sentence", [
    ("embree", "another detector's name"),
    ("bullet-mine", "a name that is kept for bullet"),
    ("fcl", "a name that is kept for fcl"),
    ("embree-2", "a name that is kept for embree"),
    ("libccd-epa", "a name that is kept for libccd"),
    ("oracle", "a name that is kept for the oracle"),
])
def test_name_of_another_is_refused(name, sentence, script, tmp_path):
    refused("list", "--detector-cmd", command(script, name=name), folder=tmp_path,
            named=[f" calls itself \"{name}\"", sentence])


def test_named_by_its_id_it_takes_its_options(script, tmp_path):
    words = ("list", "--detector-cmd", command(script), "--detector")
    assert "\nmine:leaf=8\n" in successful(*words, "mine:leaf=8").out
    out = successful(*words, "mine:leaf=4").out
    assert "\nmine\n" in out
    assert "\nmine:leaf" not in out, "it is the default"
    refused(*words, "mine:leaf=9", named=["leaf is \"9\""], folder=tmp_path)
