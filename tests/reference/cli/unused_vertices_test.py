"""Vertices that no triangle uses, by the commands: no part of a body, and the others keep their numbers."""

import json
import sys

import pytest

from meshes import box, obj_text
from program import contactcheck, has_html_report, run_program, successful, valid_results


def block(low, high):
    vertices, triangles = box(1)
    return [[a + (b - a) * x for a, b, x in zip(low, high, v)] for v in vertices], triangles


def strewn(mesh, place, at=4):
    """With a vertex at `place` before vertex `at`, which no triangle uses."""
    vertices, triangles = mesh
    return [*vertices[:at], list(place), *vertices[at:]], [[v + (v >= at) for v in t] for t in triangles]


ROOM, BALL = block((-3, -3, -3), (3, 3, 3)), block((-0.5, -0.5, -0.5), (0.5, 0.5, 0.5))


@pytest.fixture
def write(tmp_path):
    def writer(name, mesh):
        (tmp_path / name).write_text(obj_text(mesh), encoding="utf-8")
        return tmp_path / name
    return writer


@pytest.mark.parametrize("at", (0, 4, 8))
@pytest.mark.parametrize("place", ((80, 80, 80), (0, 0, -1e9), (3, 0, 0)))
def test_check_finds_a_body_inside_another_whatever_lies_outside(tmp_path, write, place, at):
    files = write("room.obj", strewn(ROOM, place, at)), write("ball.obj", strewn(BALL, place, at))
    outcome = contactcheck("check", *files, "--quiet", "--out", tmp_path / "out")
    assert outcome.exit_code == 1
    assert "ball and room: one is inside the other" in outcome.out or (
        "room and ball: one is inside the other" in outcome.out)
    assert outcome.out.count("1 vertex that no triangle uses, dropped") == 2


def test_check_of_frames_in_which_it_moves(tmp_path, write):
    files = [write("room.obj", ROOM)]
    for number, place in enumerate(((0, 0, 0), (90, 0, 0), (-4, 5, 1e20))):
        files.append(write(f"ball_{number}.obj", strewn(BALL, place)))
    outcome = contactcheck("check", *files, "--quiet", "--out", tmp_path / "out")
    assert outcome.exit_code == 1 and "3 of 3 frames have a contact that is not allowed" in outcome.out


def scene(tmp_path, levels, bodies):
    file = tmp_path / "strewn.json"
    file.write_text(json.dumps({
        "id": "strewn", "frames": 2, "duration": 1, "levels": levels,
        "bodies": [{"name": name, "mesh": {"file": mesh}, **more} for name, mesh, more in bodies]}))
    return file


def test_none_is_near_anything(tmp_path, write):
    """One unit from the ball stands a block, on which the vertex lies."""
    write("ball.obj", BALL)
    write("block.obj", strewn(block((1.5, -0.5, -0.5), (2, 0.5, 0.5)), (0.5, 0, 0)))
    file = scene(tmp_path, ["body", "triangle", "vertex", "near"],
                 [("ball", "ball.obj", {}), ("block", "block.obj", {})])
    successful("run", file, "--no-timing", "--out", tmp_path / "out",
               "--detector", "bullet-vf", "--detector", "bullet-cl", "--detector", "full-refit")
    results = valid_results(tmp_path / "out" / "results.json")
    for row in results["runs"]:
        for level, counts in row["levels"].items():
            assert (counts["truth"], counts["reported"]) == (0, 0), (row["detector"], level)
    assert results["scenes"][0]["separation"] == pytest.approx([1, 1])
    assert [body["vertices"] for body in results["scenes"][0]["bodies"]] == [8, 8]
    assert "1 vertex that no triangle uses, dropped" in results["scenes"][0]["bodies"][1]["notes"]


def test_meshes_alone_meet_as_without(tmp_path, write):
    write("room.obj", ROOM)
    lines = []
    for folder, mesh in (("with", strewn(BALL, (60, 0, 0))), ("without", BALL)):
        file = write("ball.obj", mesh)
        outcome = successful("run", tmp_path / "room.obj", file, "--motion", "approach", "--no-timing",
                             "--detector", "full-refit", "--out", tmp_path / folder)
        lines.append(next(line for line in outcome.out.splitlines() + outcome.err.splitlines()
                          if line.strip().startswith("ball: ")))
    with_it, without = (valid_results(tmp_path / folder / "results.json") for folder in ("with", "without"))
    assert lines[0] == lines[1] and "60" not in lines[0]
    for results in (with_it, without):
        del results["scenes"][0]["bodies"][1]["notes"]
    assert with_it["scenes"] == without["scenes"]
    assert with_it["runs"][0]["contact_hash"] == without["runs"][0]["contact_hash"]


@pytest.fixture
def touching(tmp_path, write):
    write("room.obj", strewn(ROOM, (0, 0, 0), 0))
    write("ball.obj", strewn(BALL, (50, 0, 0), 3))
    return scene(tmp_path, ["body", "triangle", "near"], [
        ("room", "room.obj", {}),
        ("ball", "ball.obj", {"motion": {"position": [[0, [2.7, 0, 0]], [1, [2.8, 0, 0]]]}})])


def test_export_writes_all_vertices_by_their_numbers(tmp_path, touching):
    successful("export", touching, "--out", tmp_path / "proof")
    proof = tmp_path / "proof" / "strewn"
    bodies = json.loads((proof / "scene.json").read_text())["bodies"]
    assert [body["vertices"] for body in bodies] == [9, 9]
    check = run_program(sys.executable, ["-B", proof / "check.py"])
    assert check.exit_code == 0, check.err
    ply = (proof / bodies[1]["folder"] / "frame_0000.ply").read_bytes()
    assert b"element vertex 9\n" in ply
    # Read again, the dropped ones are within the boxes of the others.
    again = contactcheck("check", *(proof / body["folder"] / "frame_0000.ply" for body in bodies),
                         "--out", tmp_path / "again")
    assert again.exit_code == 1 and again.out.count("no triangle uses, dropped") == 2


def test_a_replayed_run_and_its_report_name_the_same(tmp_path, touching):
    words = ["--no-timing", "--detector", "full-refit", "--detector", "bullet-vf", "--quiet"]
    successful("run", touching, *words, "--out", tmp_path / "first")
    successful("run", tmp_path / "first" / "recordings" / "strewn.ccr", *words, "--out", tmp_path / "again")
    first, again = (valid_results(tmp_path / name / "results.json") for name in ("first", "again"))
    assert [r["contact_hash"] for r in first["runs"]] == [r["contact_hash"] for r in again["runs"]]
    texts = [(tmp_path / name / "contacts" / "strewn.json").read_text() for name in ("first", "again")]
    assert texts[0] == texts[1]
    if has_html_report():
        successful("report", tmp_path / "first" / "results.json", "--out", tmp_path / "page")
