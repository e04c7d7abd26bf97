"""`contactcheck check --between`: contact between frames, where frames alone may be clean.

Times and places are by hand: all is linear."""

import csv
import json

import pytest

from meshes import box, moved, obj_text, sphere
from program import contactcheck

PATHS = "on straight paths between these frames"
SHEET = [(-4, -4, 0), (4, -4, 0), (0, 8, 0)], [(0, 1, 2)]


def write(folder, bodies):
    """Each body is a mesh that rests, or a list of its frames; the names of the files."""
    names = []
    for name, meshes in bodies.items():
        frames = meshes if isinstance(meshes, list) else [meshes]
        for number, mesh in enumerate(frames):
            file = f"{name}_{number}.obj" if isinstance(meshes, list) else f"{name}.obj"
            (folder / file).write_text(obj_text(mesh), encoding="utf-8")
            names.append(file)
    return names


def check(folder, bodies, *more):
    return contactcheck("check", *(folder / name for name in write(folder, bodies)), "--out", folder / "out",
                        *more)


def told(folder, bodies, *more):
    """The events of --json-lines: steps, and the end."""
    outcome = check(folder, bodies, "--between", "--json-lines", *more)
    events = [json.loads(line) for line in outcome.out.splitlines()]
    assert events[-1]["event"] == "end", outcome.err
    assert events[-1]["exit_code"] == outcome.exit_code
    return [event for event in events if event["event"] == "step"], events[-1]


def ball(z):
    """Its lowest point is vertex 5, at (0.5, 0.25, z - 0.25)."""
    return moved(sphere(0.25, 2), (0.5, 0.25, z), 1)


# Down through the sheet: the lowest point goes from .75 to -.75.
BALL = {"ball": [ball(1), ball(-0.5)], "sheet": SHEET}


def test_frames_alone_show_no_ball_that_passes_a_sheet(tmp_path):
    outcome = check(tmp_path, BALL)
    assert outcome.exit_code == 0, outcome.err
    assert "no frame has a contact that is not allowed\n" in outcome.out
    assert PATHS not in outcome.out


def test_finds_a_ball_that_passes_a_sheet(tmp_path):
    outcome = check(tmp_path, BALL, "--between")
    assert outcome.exit_code == 1, outcome.err
    step = "frame 0 (ball_0.obj) to frame 1 (ball_1.obj)"
    assert (f"\n{step}\n  ball and sheet: first at 0.5 of the step, vertex 5 of ball and triangle 0 of sheet at "
            f"(0.5, 0.25, 0), apart at both frames, {PATHS}\n") in outcome.out
    assert "\nno frame has a contact that is not allowed\n" in outcome.out
    assert f"\n1 of 1 step has a contact that is not allowed, {PATHS}, the first is {step}\n" in outcome.out
    assert f"\n1 step has a contact that neither of its frames shows, {PATHS}\n" in outcome.out
    assert "check." in outcome.out.splitlines()[-1]
    said = [line for line in outcome.out.splitlines() if " of the step" in line or " a step" in line or
            " of 1 step" in line or " step has" in line]
    assert len(said) == 6 and all(PATHS in line for line in said)


def test_writes_both_ends_of_the_first_step(tmp_path):
    assert check(tmp_path, BALL, "--between").exit_code == 1
    found = json.loads((tmp_path / "out" / "check.json").read_text(encoding="utf-8"))
    assert " --between" in found["command"]
    assert (found["checked_frames"], found["frames"], found["exit_code"]) == (2, [], 1)
    step, = found["steps"]
    assert step["contacts"][0]["first"]["elements"] == [{"body": "ball", "vertex": 5},
                                                        {"body": "sheet", "triangle": 0}]
    # What was written is a sequence itself, and the same is found in it.
    again = contactcheck("check", tmp_path / "out" / "frames-0-1.ccr", "--between", "--out", tmp_path / "again")
    assert again.exit_code == 1, again.err
    assert "first at 0.5 of the step, vertex 5 of ball" in again.out


def test_lists_every_step(tmp_path):
    outcome = check(tmp_path, {"ball": [ball(1), ball(-0.5), ball(1)], "sheet": SHEET}, "--between",
                    "--keep", "1-2")
    assert "2 of 2 steps have a contact that is not allowed" in outcome.out
    with open(tmp_path / "out" / "check.csv", encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert [(row["kind"], row["frame"], row["first_b"]) for row in rows] == [
        ("step", "0", "triangle 0"), ("step", "1", "triangle 0")]
    assert all(float(row["time_lower"]) <= 0.5 for row in rows)
    # Of a step that was asked for, both ends, with what to judge detectors by.
    contactcheck("run", tmp_path / "out" / "frames-1-2.ccr", "--no-timing", "--detector", "full-refit", "--out",
                 tmp_path / "run")
    results = json.loads((tmp_path / "run" / "results.json").read_text(encoding="utf-8"))
    assert "impact" in results["runs"][0]["levels"]


def test_json_lines_say_it_to_programs(tmp_path):
    (step,), end = told(tmp_path, BALL)
    assert (step["step"], step["files"], step["paths"]) == (0, ["ball_0.obj", "ball_1.obj"], PATHS)
    contact, = step["contacts"]
    assert contact["bodies"] == ["ball", "sheet"]
    assert (contact["start"], contact["end"], contact["allowed"]) == ("apart", "apart", False)
    first = contact["first"]
    assert first["time"]["lower"] <= 0.5 <= first["time"]["upper"] <= first["time"]["lower"] + 2**-40
    assert first["elements"] == [{"body": "ball", "vertex": 5}, {"body": "sheet", "triangle": 0}]
    assert first["place"] == pytest.approx([0.5, 0.25, 0], abs=1e-12, rel=0)
    assert 0 < first["place_error"] < 1e-11
    # Every vertex of the ball meets the sheet, and no edge of it does; edges of the sheet are far.
    assert (contact["later_pairs"], contact["passing_pairs"]) == (66, 66)
    between = end["between"]
    assert (end["bad_frames"], end["exit_code"]) == (0, 1)
    assert (between["steps"], between["with_impacts"], between["first"]) == (1, 1, 0)
    assert (between["unseen"], between["starting"], between["allowed"]) == (1, 0, False)
    assert between["largest_motion"]["body"] == "ball"


def test_counts_the_pairs_that_it_tested(tmp_path):
    """All 66 vertices of the ball with the sheet, and its 192 edges with that edge of the sheet in whose box the
    ball passes."""
    _, end = told(tmp_path, BALL, "--allow", "self")
    assert end["between"]["element_tests"] == 66 + 192
    outcome = check(tmp_path, BALL, "--between", "--allow", "self")
    assert f"\n258 pairs of elements, whose boxes meet in a step, tested exactly, {PATHS}\n" in outcome.out


def test_allowed_impacts_are_listed_and_do_not_count(tmp_path):
    outcome = check(tmp_path, BALL, "--between", "--allow", "impact")
    assert outcome.exit_code == 0, outcome.err
    assert "first at 0.5 of the step" in outcome.out
    assert f"1 of 1 step has a contact, which is allowed, {PATHS}" in outcome.out
    assert not (tmp_path / "out" / "results.json").exists()
    (step,), end = told(tmp_path, BALL, "--allow", "impact")
    assert step["contacts"][0]["allowed"] and end["between"]["allowed"]


def test_two_edges_meet(tmp_path):
    """An edge along x, and one across it that falls from 1 to -3."""
    def fin(h):
        return [(0.25, -1, h), (0.25, 1, h), (0.25, 0, h + 1)], [(0, 1, 2)]
    ridge = [(-1, 0, 0), (1, 0, 0), (0, 0, -1)], [(0, 1, 2)]
    bodies = {"fin": [fin(1), fin(-3)], "ridge": ridge}
    outcome = check(tmp_path, bodies, "--between")
    assert ("fin and ridge: first at 0.25 of the step, the edge of vertices 0 and 1 of fin and the edge of "
            "vertices 0 and 1 of ridge at (0.25, 0, 0), apart at both frames, ") in outcome.out
    (step,), _ = told(tmp_path, bodies)
    assert step["contacts"][0]["first"]["elements"] == [{"body": "fin", "edge": [0, 1]},
                                                        {"body": "ridge", "edge": [0, 1]}]


def flap(h):
    """A body of two triangles; vertex 3 of the other is above triangle 0, at height h."""
    return ([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0.25, 0.25, h), (0.25, 0.5, h + 1), (0.5, 0.25, h + 1)],
            [(0, 1, 2), (3, 4, 5)])


def test_finds_a_body_that_passes_itself(tmp_path):
    bodies = {"flap": [flap(1), flap(-3)]}
    assert check(tmp_path, bodies).exit_code == 0
    outcome = check(tmp_path, bodies, "--between")
    assert outcome.exit_code == 1, outcome.err
    assert (f"  flap with itself: first at 0.25 of the step, vertex 3 and triangle 0 at (0.25, 0.25, 0), apart at "
            f"both frames, {PATHS}\n") in outcome.out
    assert check(tmp_path, {**bodies, "sheet": moved(SHEET, (0, 0, -9), 1)}, "--between", "--allow",
                 "self").exit_code == 0


def test_time_that_is_no_double_is_an_interval_around_it(tmp_path):
    """The lowest point goes from .75 to -1.5: a third."""
    (step,), _ = told(tmp_path, {"ball": [ball(1), ball(-1.25)], "sheet": SHEET})
    time = step["contacts"][0]["first"]["time"]
    assert time["lower"] < 1 / 3 <= time["upper"] <= time["lower"] + 2**-40
    outcome = check(tmp_path, {"ball": [ball(1), ball(-1.25)], "sheet": SHEET}, "--between")
    assert "first at 0.333333 of the step, vertex 5 of ball and triangle 0 of sheet at (0.5, 0.25, 0)," in outcome.out


CUBE = box(2)


def neighbour(gap):
    """Right of the cube."""
    return moved(box(2), (1 + gap, 0.25, 0.25), 0.5)


def test_contact_that_a_frame_shows_begins_in_the_step_before(tmp_path):
    """From .25 before the cube to .125 in it: at two thirds; then it starts in contact and leaves."""
    bodies = {"moving": [neighbour(0.25), neighbour(-0.125), neighbour(0.25)], "rest": CUBE}
    outcome = check(tmp_path, bodies, "--between")
    assert outcome.exit_code == 1, outcome.err
    assert "moving and rest: first at 0.666667 of the step, " in outcome.out
    assert f"apart at frame 0, in contact at frame 1, {PATHS}\n" in outcome.out
    # The order is that of time.
    assert outcome.out.index("\nframe 0 (moving_0.obj) to frame 1") < outcome.out.index("\nframe 1 (moving_1.obj)\n")
    assert "1 of 3 frames has a contact" in outcome.out
    assert "1 of 2 steps has a contact that is not allowed" in outcome.out
    assert f"\n1 step starts in contact, {PATHS}; in them " in outcome.out
    assert "neither of its frames" not in outcome.out
    steps, end = told(tmp_path, bodies)
    assert [(s["contacts"][0]["start"], s["contacts"][0]["end"]) for s in steps] == [
        ("apart", "in contact"), ("in contact", "apart")]
    assert end["between"]["starting"] == 1
    time = steps[0]["contacts"][0]["first"]["time"]
    assert time["lower"] < 2 / 3 < time["upper"] <= time["lower"] + 2**-40


def test_rest_in_contact_starts_in_contact(tmp_path):
    """A block lies on a table, and nothing moves."""
    bodies = {"block": [moved(box(1), (0.25, 0.25, 1), 0.5)] * 2, "table": CUBE}
    outcome = check(tmp_path, bodies, "--between")
    assert outcome.exit_code == 1, outcome.err
    assert f"\nno step has a contact that is not allowed, {PATHS}\n" in outcome.out
    assert (f"\n1 step starts in contact, {PATHS}; in them 0 pairs of elements meet apart at both frames\n"
            in outcome.out)
    assert "\nnothing moves from frame to frame\n" in outcome.out
    (step,), end = told(tmp_path, bodies)
    contact, = step["contacts"]
    assert (contact["start"], contact["end"], contact["allowed"]) == ("in contact", "in contact", True)
    assert (contact["first"], contact["later_pairs"]) == (None, 0)
    assert (end["bad_frames"], end["between"]["with_impacts"]) == (2, 0)


@pytest.mark.parametrize(("depth", "exit_code"), [("0.2", 0), ("0.1", 1)])
def test_depth_at_either_frame_allows_the_step(tmp_path, depth, exit_code):
    bodies = {"moving": [neighbour(0.25), neighbour(-0.125), neighbour(0.25)], "rest": CUBE}
    outcome = check(tmp_path, bodies, "--between", "--allow", f"depth={depth}")
    assert outcome.exit_code == exit_code, outcome.out
    assert "no step has a contact that is not allowed" in outcome.out


def test_depth_allows_nothing_that_no_frame_shows(tmp_path):
    assert check(tmp_path, BALL, "--between", "--allow", "depth=10").exit_code == 1


def test_allowed_contact_is_not_looked_for(tmp_path):
    outcome = check(tmp_path, BALL, "--between", "--allow", "contact")
    assert outcome.exit_code == 0, outcome.err
    assert f"no step has a contact that is not allowed, {PATHS}" in outcome.out


def test_a_body_that_jumps_into_another_is_inside_at_the_end(tmp_path):
    small = [moved(box(1), (x, 0.5, 0.5), 0.25) for x in (1.25, 0.25)]
    outcome = check(tmp_path, {"small": small, "big": CUBE}, "--between")
    assert outcome.exit_code == 1, outcome.err
    # Its left side goes from 1.25 to .25, the cube ends at 1.
    assert "small and big: first at 0.25 of the step, " in outcome.out
    assert f"apart at frame 0, one inside the other at frame 1, {PATHS}\n" in outcome.out


def test_frames_that_do_not_meet_are_clean(tmp_path):
    outcome = check(tmp_path, {"ball": [ball(1), ball(0.5)], "sheet": SHEET}, "--between")
    assert outcome.exit_code == 0, outcome.err
    assert outcome.out.count(PATHS) == 4
    assert f"no step has a contact that is not allowed, {PATHS}\n" in outcome.out
    assert f"largest turn of a triangle in a step, {PATHS}: less than 0.001 degrees\n" in outcome.out


def test_says_the_largest_motion_and_turn_with_their_steps(tmp_path):
    """Sides of 3, 4 and 5 m: 4 m on average. First it moves by 8 m, then a corner goes up: the triangle turns by
    a right angle."""
    def at(x, last):
        return [(x, 0, 0), (x + 3, 0, 0), (x, *last)], [(0, 1, 2)]
    frames = [at(0, (4, 0)), at(8, (4, 0)), at(8, (0, 4))]
    outcome = check(tmp_path, {"sail": frames}, "--between")
    assert outcome.exit_code == 0, outcome.err
    assert (f"largest motion in a step, {PATHS}: 2 edge lengths (sail, frame 0 (sail_0.obj) to frame 1 "
            "(sail_1.obj))\n") in outcome.out
    assert (f"largest turn of a triangle in a step, {PATHS}: 90 degrees (triangle 0 of sail, frame 1 (sail_1.obj) "
            "to frame 2 (sail_2.obj))\n") in outcome.out
    _, end = told(tmp_path, {"sail": frames})
    assert end["between"]["largest_motion"] == {"edges": 2, "step": 0, "body": "sail"}
    turn = end["between"]["largest_turn"]
    assert turn["degrees"] == pytest.approx(90)
    assert (turn["step"], turn["body"], turn["triangle"]) == (1, "sail", 0)


def test_numbers_are_those_of_the_file(tmp_path):
    """Its first vertex is used by no triangle."""
    def with_unused(mesh):
        return [(9, 9, 9), *mesh[0]], [[k + 1 for k in t] for t in mesh[1]]
    frames = [with_unused(ball(z)) for z in (1, -0.5)]
    outcome = check(tmp_path, {"ball": frames, "sheet": SHEET}, "--between")
    assert "vertex 6 of ball and triangle 0 of sheet" in outcome.out


def test_welded_seams_are_no_contact(tmp_path):
    """Two triangles side by side, each with vertices of its own along the seam, turn and move."""
    sides = [(0, 1, 2), (3, 4, 5)]
    frames = [([(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], sides),
              ([(0, 0, 1), (1, 0, 1), (0, 1, 2), (1, 0, 1), (1, 1, 2), (0, 1, 2)], sides)]
    split, end = told(tmp_path, {"seam": frames})
    assert split[0]["contacts"][0]["bodies"] == ["seam", "seam"]
    assert (split[0]["contacts"][0]["start"], end["exit_code"]) == ("in contact", 1)
    steps, end = told(tmp_path, {"seam": frames}, "--weld")
    assert (steps, end["exit_code"]) == ([], 0)


def test_says_ten_steps_and_how_many_more(tmp_path):
    frames = [ball(1 if number % 2 else -0.5) for number in range(13)]
    outcome = check(tmp_path, {"ball": frames, "sheet": SHEET}, "--between", "--quiet")
    assert outcome.exit_code == 1
    # Down, the lowest point is first; up, the highest, a quarter below the sheet, is first at a sixth.
    assert outcome.out.count("first at 0.166667 of the step") == outcome.out.count("first at 0.5 of the step") == 5
    assert "\n... and 2 more steps\n" in outcome.out
    assert "12 of 12 steps have a contact that is not allowed" in outcome.out


@pytest.mark.parametrize(("bodies", "words", "sentence"), [
    ({"ball": ball(1), "sheet": SHEET}, ["--between"], "--between looks from frame to frame, and here is one frame"),
    (BALL, ["--between", "--every", "2"], "--every"),
    (BALL, ["--allow", "impact"], "--allow impact is about steps, which are checked with --between"),
    ({"ball": [ball(1), ball(0.9), ball(0.8)], "late": [SHEET] * 2}, ["--between"],
     'not every body has that of "'),
    ({"sheet": [SHEET, (SHEET[0], [(0, 2, 1)])]}, ["--between"], "has other triangles than the body's mesh"),
    ({"sheet": [SHEET, ([*SHEET[0], (0, 0, 9)], [*SHEET[1], (0, 1, 3)])]}, ["--between"],
     "has 4 vertices and 2 triangles, the body's mesh has 3 vertices and 1 triangles"),
    ({"sheet": [SHEET, ([*SHEET[0][:2], (0, float("inf"), 0)], SHEET[1])]}, ["--between"], "frame 1"),
    ({"sheet": [SHEET, ([*SHEET[0][:2], (0, float("nan"), 0)], SHEET[1])]}, ["--between"], "frame 1")],
    ids=["one_frame", "frames_left_out", "impact_without_steps", "frames_of_some_bodies", "turned_faces",
         "other_faces", "infinite_place", "place_that_is_no_number"])
def test_refuses_what_is_no_step(tmp_path, bodies, words, sentence):
    outcome = check(tmp_path, bodies, *words)
    assert outcome.exit_code == 2
    assert sentence in outcome.err
    assert outcome.err.count("\n") == 1


def test_allowed_impacts_are_listed_as_such(tmp_path):
    outcome = check(tmp_path, BALL, "--between", "--allow", "impact")
    assert outcome.exit_code == 0, outcome.err
    with open(tmp_path / "out" / "check.csv", encoding="utf-8", newline="") as file:
        assert [row["allowed"] for row in csv.DictReader(file)] == ["yes"]
    assert not list((tmp_path / "out").glob("*.ccr"))


# A body is named before the other by the order of files, a vertex before its triangle.
def test_elements_of_a_table_are_those_of_its_bodies(tmp_path):
    assert check(tmp_path, {"a_sheet": SHEET, "ball": [ball(1), ball(-0.5)]}, "--between").exit_code == 1
    with open(tmp_path / "out" / "check.csv", encoding="utf-8", newline="") as file:
        row, = csv.DictReader(file)
    assert (row["body_a"], row["first_a"]) == ("a_sheet", "triangle 0")
    assert (row["body_b"], row["first_b"]) == ("ball", "vertex 5")
    assert row["allowed"] == "no"


def test_steps_that_start_in_contact_are_left_to_their_frames(tmp_path):
    check(tmp_path, {"ball": [ball(0), ball(-0.1)], "sheet": SHEET}, "--between")
    with open(tmp_path / "out" / "check.csv", encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert [row["allowed"] for row in rows if row["kind"] == "step"] == ["frames"]
    found = json.loads((tmp_path / "out" / "check.json").read_text(encoding="utf-8"))
    assert found["command"].endswith(f" --between --out {tmp_path / 'out'}")
