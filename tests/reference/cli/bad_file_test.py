"""Files that no command can use and that no text can describe: links, devices, pipes, bytes that are
no text, files larger than memory. (Those of a line of text are in bad_file_refusals.toml.)
"""

import json
import os
import pathlib
import shutil

import pytest

import program

GATE = program.ROOT / "tests" / "reference" / "gate"
DEEP = 100_000
BINARY = b"\x7fELF\0\1\2\3\xff\xfe"
RECORDING_MAGIC = b"\x89CCR\r\n\x1a\n"


def content(data):
    return lambda file: file.write_bytes(data)


def link_to(target):
    return lambda file: file.symlink_to(target)


def huge(file, start=b""):
    """Larger than any memory, and nothing on disk."""
    file.write_bytes(start)
    os.truncate(file, 1 << 40)


SCENES = {
    "dangling_link": (link_to("nowhere"), "does not exist"),
    "link_to_itself": (link_to("x.json"), "does not exist"),
    "huge": (huge, "has more than 256 MiB"),
    "endless": (link_to("/dev/zero"), "is a device, not a regular file"),
    "binary": (content(BINARY), "is not valid JSON at line 1, column 1"),
    "not_utf8": (content(b'{"id": "\xff"}'), "is not valid JSON at line 1"),
    "deep_arrays": (content(b"[" * DEEP), "deeper than 64 levels"),
    "deep_objects": (content(b'{"a":' * DEEP), "deeper than 64 levels"),
    "closed_deep_arrays": (content(b"[" * DEEP + b"]" * DEEP), "deeper than 64 levels"),
}


@pytest.mark.parametrize("make, piece", SCENES.values(), ids=SCENES)
def test_scene_file_is_refused(tmp_path, make, piece):
    (tmp_path / "tiny.json").write_text(program.tiny_scene())
    file = tmp_path / "x.json"
    make(file)
    program.refused("run", tmp_path / "tiny.json", file, "--out", tmp_path / "out",
                    named=[str(file), piece], folder=tmp_path)


def test_scene_file_of_a_long_name_is_refused(tmp_path):
    (tmp_path / "tiny.json").write_text(program.tiny_scene())
    program.refused("run", tmp_path / "tiny.json", tmp_path / ("n" * 300 + ".json"),
                    "--out", tmp_path / "out", named=["does not exist"], folder=tmp_path)


def test_scene_file_among_the_fixtures_that_is_deep_is_refused(tmp_path):
    file = tmp_path / "f" / "scenes" / "a.json"
    file.parent.mkdir(parents=True)
    file.write_text("[" * DEEP)
    program.refused("list", "--scenes", env={"CONTACTCHECK_FIXTURES": str(tmp_path / "f")},
                    named=[str(file), "deeper than 64"], folder=tmp_path)


MESHES = {
    "huge": (huge, "has more than 4096 MiB"),
    "binary": (content(BINARY), '/m.json"'),
}


@pytest.mark.parametrize("make, piece", MESHES.values(), ids=MESHES)
def test_mesh_file_is_refused(tmp_path, make, piece):
    scene = json.loads(program.tiny_scene())
    scene["bodies"][0]["mesh"] = {"file": "x.obj"}
    (tmp_path / "m.json").write_text(json.dumps(scene))
    file = tmp_path / "x.obj"
    make(file)
    program.refused("run", tmp_path / "m.json", "--out", tmp_path / "out",
                    named=[str(file), "bodies[0].mesh cannot be loaded", piece], folder=tmp_path)


RECORDINGS = {
    "endless": (link_to("/dev/zero"), "not a regular file"),
    "huge": (huge, "not a recording"),
    "huge_with_the_right_beginning": (
        lambda file: huge(file, RECORDING_MAGIC + b"\1\0\0\0\0\0\0\0"),
        "1099511627776 bytes but was written with 0"),
    "other_version": (content(RECORDING_MAGIC + b"\3\0\0\0\0\0\0\0" + bytes(64)),
                      "version 3 is not known, only versions 1 and 2"),
}


@pytest.mark.parametrize("make, piece", RECORDINGS.values(), ids=RECORDINGS)
def test_recording_is_refused(tmp_path, make, piece):
    file = tmp_path / "x.ccr"
    make(file)
    program.refused("run", file, "--out", tmp_path / "out", named=[str(file), piece], folder=tmp_path)


def test_recording_is_refused_wherever_it_is_cut(tmp_path):
    scene = tmp_path / "tiny.json"
    scene.write_text(program.tiny_scene(frames=1))
    program.successful("run", scene, "--no-timing", "--detector", "fcl-aabb", "--out", tmp_path / "whole")
    whole = (tmp_path / "whole" / "recordings" / "tiny.ccr").read_bytes()
    assert len(whole) > 1000
    cuts = [1, 8, 12, 16, 24, 31, 32, len(whole) - 8, len(whole) - 1]
    cuts += [i * len(whole) // 24 for i in range(1, 24)]
    for cut in cuts:
        file = tmp_path / f"first-{cut}-bytes.ccr"
        file.write_bytes(whole[:cut])
        program.refused("run", file, "--out", tmp_path / "out", named=[str(file)], folder=tmp_path)


RESULTS = {
    "binary": (b"\0\1\2\xff", "not JSON at byte 1"),
    "deep": (b"[" * DEEP, "not JSON at byte 100001"),
    "closed_deep": (b"[" * DEEP + b"]" * DEEP, 'field schema is not "contactcheck-results/2"'),
    "deep_inside": (
        b'{"schema": "contactcheck-results/2", "scenes": ' + b"[" * DEEP + b"]" * DEEP + b"}",
        "nested 100001 deep; at most 64 is allowed"),
    "deep_text_is_not_deep": (
        b'{"schema": "contactcheck-results/2", "command": "' + b"[" * DEEP + b'\\"{"}',
        "version is missing"),
}


@pytest.mark.parametrize("data, piece", RESULTS.values(), ids=RESULTS)
def test_results_file_is_refused(tmp_path, data, piece):
    file = tmp_path / "r.json"
    file.write_bytes(data)
    program.refused("report", file, "--out", tmp_path / "out", named=[str(file), piece], folder=tmp_path)


# The name of the pipe, and the command that reads it.
PIPES = {
    "scene": ("x.json", ["run", "x.json", "--out", "out"]),
    "scene_to_tune": ("x.json", ["tune", "x.json", "--out", "out"]),
    "scene_to_export": ("x.json", ["export", "x.json", "--out", "out"]),
    "scene_of_a_suite": ("x.json", ["run", "suite.json", "--out", "out"]),
    "recording": ("x.ccr", ["run", "x.ccr", "--out", "out"]),
    "point_cache": ("x.pc2", ["run", "cached.json", "--out", "out"]),
    "mesh": ("x.obj", ["run", "--mesh", "x.obj", "--mesh", "x.obj", "--out", "out"]),
    "mesh_for_assimp": ("x.glb", ["run", "--mesh", "x.glb", "--mesh", "x.glb", "--out", "out"]),
    "results": ("x.json", ["report", "x.json", "--out", "out"]),
    "results_before": ("x.json", ["diff", "x.json", "results.json"]),
    "results_after": ("x.json", ["diff", "results.json", "x.json"]),
    "results_of_a_shard": ("x.json", ["merge", "x.json", "--out", "out"]),
    "results_of_hard_cases": ("x.json", ["defects", "x.json"]),
    "results_to_accept": ("x.json", ["accept", "x.json", "--as", "baseline.json"]),
    "baseline_in_place": ("x.json", ["accept", "results.json", "--as", "x.json"]),
    "results_at_the_gate": ("x.json", ["gate", "x.json", "--policy", "policy.json"]),
    "policy": ("x.json", ["gate", "results.json", "--policy", "x.json"]),
    "baseline": ("x.json", ["gate", "results.json", "--policy", "policy.json", "--baseline", "x.json"]),
    "case": ("x.json", ["reduce", "x.json", "--out", "out"]),
    "recording_of_a_case": ("x.ccr", ["reduce", "case.json", "--out", "out"]),
}


@pytest.mark.parametrize("pipe, words", PIPES.values(), ids=PIPES)
def test_pipe_that_nobody_writes_to_is_not_waited_for(tmp_path, pipe, words):
    for source, name in (("sample_results", "results"), ("sample_results", "baseline"),
                         ("sample_policy", "policy")):
        shutil.copyfile(GATE / f"{source}.json", tmp_path / f"{name}.json")
    (tmp_path / "suite.json").write_text(json.dumps(
        {"id": "u", "scenes": [{"file": "x.json"}], "detectors": ["fcl-aabb"]}))
    (tmp_path / "cached.json").write_text(json.dumps(
        {"id": "c", "duration": 1, "levels": ["body"], "bodies": [
            {"name": "b", "mesh": {"shape": "box"}, "recording": {"cache": "x.pc2"}}]}))
    (tmp_path / "case.json").write_text(json.dumps(
        {"scene": "s", "frame": 0, "detector": "fcl-aabb", "level": "body", "kind": "missed",
         "first": {}, "second": {}, "recording": "x.ccr"}))
    os.mkfifo(tmp_path / pipe, 0o600)
    words = [tmp_path / word if pathlib.Path(word).suffix or word == "out" else word for word in words]
    program.refused(*words, named=[f'{tmp_path / pipe}" is a pipe, not a regular file'], folder=tmp_path)


# Sanitizers reserve more addresses than a limit leaves them.
@pytest.mark.skipif(any(name in os.environ.get("CONTACTCHECK_SANITIZE", "")
                        for name in ("address", "thread", "memory")), reason="a sanitizer is at work")
def test_little_memory_ends_in_a_sentence_that_names_a_mesh(tmp_path):
    # As clusters and containers limit it. Files of a gigabyte are allowed, and here nothing on disk.
    mesh, results = tmp_path / "x.obj", tmp_path / "x.json"
    for file, size in ((mesh, 1 << 30), (results, 200 << 20)):
        file.touch()
        os.truncate(file, size)

    def sentence(*words):
        outcome = program.run_program(
            "/bin/sh", ["-c", 'ulimit -v 300000 && exec "$0" "$@"', program.PROGRAM, *words], cwd=tmp_path)
        assert outcome.exit_code == 2, outcome.err
        return outcome.err

    assert sentence("run", "--mesh", mesh, "--mesh", mesh, "--detector", "fcl-aabb").endswith(
        f'"{mesh}" cannot be read: it takes more memory than there is.\n')
    assert sentence("report", results) == (
        "contactcheck: memory ran out: this takes more than the process may have\n")


def test_word_that_is_not_utf8_is_refused(tmp_path):
    (tmp_path / "tiny.json").write_text(program.tiny_scene())
    program.refused("run", tmp_path / "tiny.json", "--out", os.fsencode(tmp_path) + b"/\xff",
                    named=["word 4", f"{tmp_path}/?"], folder=tmp_path)
