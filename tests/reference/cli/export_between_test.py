"""`contactcheck export --between`: what it says, and that its checker agrees. That certificates are right is
tested in tests/reference/oracle, that faulty ones are refused in tests/reference/judge."""

import json
import sys

from meshes import box, moved, obj_text, sphere
from program import contactcheck, names_in, refused, run_program, successful, tiny_scene

PATHS = "on straight paths between these frames"
SHEET = [(-4, -4, 0), (4, -4, 0), (0, 8, 0)], [(0, 1, 2)]


def exported(folder, bodies, *words):
    """Each body is a list of its frames; the lines on standard output."""
    files = []
    for name, frames in bodies.items():
        for number, mesh in enumerate(frames):
            files.append(folder / f"{name}_{number}.obj")
            files[-1].write_text(obj_text(mesh), encoding="utf-8")
    return successful("export", *files, "--between", "--out", folder / "out", *words).out.splitlines()


def checked(folder):
    check = run_program(sys.executable, ["-B", folder / "check.py"])
    assert check.exit_code == 0, check.err
    return check.out


def index(folder):
    return json.loads((folder / "steps.json").read_text(encoding="utf-8"))


def ball(z):
    """Its lowest point is (0.5, 0.25, z - 0.25)."""
    return moved(sphere(0.25, 2), (0.5, 0.25, z), 1)


def test_proves_frames_in_which_nothing_meets(tmp_path):
    lines = exported(tmp_path, {"ball": [ball(2), ball(1), ball(0.5)], "sheet": [SHEET] * 3})
    folder = tmp_path / "out" / "frames"
    assert lines == [
        f"{folder}: 2 steps, {PATHS}: 6 pairs of bodies proven apart, 0 in contact, 0 without proof",
        f"to check them: python3 {folder}/check.py"]
    assert names_in(folder) == {"bodies", "check.py", "steps.json", "truth"}
    assert names_in(folder / "truth") == {"step_0000.json", "step_0001.json"}
    assert index(folder)["self"]
    assert checked(folder) == (f"frames: 2 steps, {PATHS}: 6 pairs of bodies, each with itself among them, "
                               "proven apart, 0 proven in contact, 0 without proof\n")


# From .75 above the sheet to .75 below it, then away; frames show nothing.
def test_proves_a_contact_between_frames(tmp_path):
    lines = exported(tmp_path, {"ball": [ball(1), ball(-0.5), ball(-1)], "sheet": [SHEET] * 3})
    folder = tmp_path / "out" / "frames"
    assert lines[:2] == [
        f"frame 0 to 1, ball and sheet: contact at 0.5 of the step, {PATHS}",
        f"{folder}: 2 steps, {PATHS}: 5 pairs of bodies proven apart, 1 in contact, 0 without proof"]
    assert index(folder)["steps"] == [{"step": 0, "apart": 2, "contacts": 1, "unproved": 0},
                                      {"step": 1, "apart": 3, "contacts": 0, "unproved": 0}]
    assert "1 proven in contact (from frames 0), 0 without proof" in checked(folder)


def test_proves_a_body_that_meets_itself(tmp_path):
    def wings(by):
        return [(0, 0, 0), (0, 1, 0), (3, 0, by), (5, 0, 0), (5, 1, 0), (2, 0.2, -by)], [(0, 1, 2), (3, 4, 5)]
    lines = exported(tmp_path, {"wings": [wings(1), wings(1), wings(-1)]})
    assert lines[0].startswith("frame 1 to 2, wings with itself: contact at 0.5 of the step")
    assert "1 proven in contact (from frames 1)" in checked(tmp_path / "out" / "frames")


def test_welds_the_corners_of_frames(tmp_path):
    quad = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 0, 0), (1, 1, 0), (0, 1, 0)], [(0, 1, 2), (3, 4, 5)]
    bodies = {"quad": [quad, moved(quad, (0, 0, 1), 1)]}
    assert exported(tmp_path, bodies)[0] == f"frame 0 to 1, quad with itself: contact at 0 of the step, {PATHS}"
    assert "1 pairs of bodies proven apart, 0 in contact" in exported(tmp_path, bodies, "--weld")[0]
    checked(tmp_path / "out" / "frames")


def test_names_ten_contacts_and_counts_the_rest(tmp_path):
    heights = [1, -0.5] * 6 + [1]
    lines = exported(tmp_path, {"ball": [ball(z) for z in heights], "sheet": [SHEET] * len(heights)})
    assert lines[9].startswith("frame 9 to 10, ball and sheet: contact at 0.166667 of the step")
    assert lines[10] == "... and 2 more contacts"


def test_of_a_scene_asks_about_bodies_with_themselves_where_the_scene_does(tmp_path):
    scene = json.loads(tiny_scene())
    for levels, own in ((["body"], False), (["body", "self"], True), (["impact-self-vf"], True)):
        (tmp_path / "tiny.json").write_text(json.dumps({**scene, "levels": levels}), encoding="utf-8")
        successful("export", tmp_path / "tiny.json", "--between", "--out", tmp_path / "out")
        assert index(tmp_path / "out" / "tiny")["self"] is own
        assert "tiny: 4 steps, " in checked(tmp_path / "out" / "tiny")


def test_replaces_an_export_of_frames(tmp_path):
    scene, out = tmp_path / "tiny.json", tmp_path / "out"
    scene.write_text(tiny_scene(), encoding="utf-8")
    successful("export", scene, "--out", out)
    successful("export", scene, "--between", "--out", out)
    assert "scene.json" not in names_in(out / "tiny")
    successful("export", scene, "--out", out)
    assert "steps.json" not in names_in(out / "tiny")


def test_refuses_frames_of_some_bodies(tmp_path):
    bodies = {"ball": [ball(3), ball(2), ball(1)], "box": [moved(box(1), (0, 0, -9), 1)] * 2}
    files = []
    for name, frames in bodies.items():
        for number, mesh in enumerate(frames):
            files.append(tmp_path / f"{name}_{number}.obj")
            files[-1].write_text(obj_text(mesh), encoding="utf-8")
    refused("export", *files, "--between", "--out", tmp_path / "out", folder=tmp_path,
            named=['not every body has that of "', "ball_2.obj"])


def test_refuses_welded_vertices_that_come_apart(tmp_path):
    def quad(by):
        return [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 0, by), (1, 1, 0), (0, 1, 0)], [(0, 1, 2), (3, 4, 5)]
    for number in (0, 1):
        (tmp_path / f"q_{number}.obj").write_text(obj_text(quad(number)), encoding="utf-8")
    outcome = contactcheck("export", tmp_path / "q_0.obj", tmp_path / "q_1.obj", "--between", "--weld",
                           "--out", tmp_path / "out")
    assert outcome.exit_code == 2
    assert "frame 1, body \"q\": vertices 0 and 3 are welded and come apart" in outcome.err
