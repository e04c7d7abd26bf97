"""`contactcheck check`: frames of a simulation, clean and with contacts."""

import json
import re

import pytest

from meshes import box, moved, obj_text, sphere
from point_caches import mdd_bytes, pc2_bytes
from program import contactcheck, refused

# In any order, as a shell gives them: 10 before 8.
MOVING = [f"moving_{number}.obj" for number in (10, 11, 12, 8, 9)]


@pytest.fixture
def folder(tmp_path):
    """A box of 1 m rests; another one comes from the right, is 0.1 m deep in it in frame 3 and leaves."""
    for number, gap in enumerate((0.5, 0.2, 0.01, -0.1, 0.3)):
        mesh = moved(box(2), (1 + gap, 0.25, 0.25), 0.5)
        (tmp_path / f"moving_{8 + number}.obj").write_text(obj_text(mesh), encoding="utf-8")
    (tmp_path / "rest.obj").write_text(obj_text(box(2)), encoding="utf-8")
    return tmp_path


def check(folder, files, *more):
    return contactcheck("check", *(folder / name for name in files), "--out", folder / "out", *more)


def check_both(folder, *more):
    return check(folder, [*MOVING, "rest.obj"], *more)


def test_names_the_frame_the_triangles_and_the_depth(folder):
    outcome = check_both(folder)
    assert outcome.exit_code == 1, outcome.err
    assert re.search(r"moving_'?\*\.obj\n", outcome.out)
    assert "5 frames\n" in outcome.out
    assert re.search(r"\nframe 3 \(moving_11\.obj\)\n  moving and rest: \d+ pairs of triangles, "
                     r"first \d+ and \d+, 100 mm deep\n", outcome.out)
    assert "1 of 5 frames has a contact that is not allowed, the first is frame 3" in outcome.out
    assert re.search(r"check\.(html|csv) shows it\n", outcome.out)
    assert (folder / "out" / "frame-3.ccr").exists()


def test_finds_nothing_in_clean_frames(folder):
    outcome = check(folder, MOVING)
    assert outcome.exit_code == 0, outcome.err
    assert "no frame has a contact that is not allowed" in outcome.out
    assert not list((folder / "out").glob("*.ccr"))


@pytest.mark.parametrize(("allowed", "exit_code"),
                         [("contact", 0), ("self", 1), ("depth=0.11", 0), ("depth=0.09", 1)])
def test_allows_what_it_is_told(folder, allowed, exit_code):
    outcome = check_both(folder, "--allow", allowed)
    assert outcome.exit_code == exit_code, outcome.err


@pytest.mark.parametrize(("words", "sentence"), [
    (["depth=nan"], "metres from 0 to 1e9"),
    (["all"], "not one of contact, self, depth"),
    (["contact", "--allow", "self"], "leave nothing to be checked")],
    ids=["depth_of_nan", "unknown", "all_there_is"])
def test_refuses_what_cannot_be_allowed(folder, words, sentence):
    refused("check", *(folder / name for name in [*MOVING, "rest.obj"]), "--out", folder / "out", "--allow",
            *words, named=[sentence], folder=folder)


def test_allows_no_depth_between_open_surfaces(tmp_path):
    """There no depth is known."""
    for name, z, tilt in (("a.obj", 0.0, 0.0), ("b.obj", -0.1, 0.3)):
        mesh = [(0, 0, z), (1, 0, z + tilt), (0, 1, z)], [(0, 1, 2)]
        (tmp_path / name).write_text(obj_text(mesh), encoding="utf-8")
    outcome = check(tmp_path, ["a.obj", "b.obj"], "--allow", "depth=10")
    assert outcome.exit_code == 1, outcome.err
    assert ("a and b: 1 pair of triangles, first 0 and 0, depth unknown: a: open (edge of vertices 0 and 1)\n"
            in outcome.out)


def test_sees_a_body_inside_another(folder):
    inner = moved(box(1), (0.4, 0.4, 0.4), 0.2)
    (folder / "inner.obj").write_text(obj_text(inner), encoding="utf-8")
    outcome = check(folder, ["rest.obj", "inner.obj"])
    assert outcome.exit_code == 1, outcome.err
    assert "rest and inner: one is inside the other, 400 mm deep\n" in outcome.out


# Two triangles side by side, each with vertices of its own along the seam.
SEAM = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
SIDES = [(0, 1, 2), (3, 4, 5)]


def test_welds_seams_where_asked_to(tmp_path):
    (tmp_path / "seam.obj").write_text(obj_text((SEAM, SIDES)), encoding="utf-8")
    split = check(tmp_path, ["seam.obj"])
    assert split.exit_code == 1, split.err
    assert ("seam with itself: 1 pair of triangles, first 0 and 1 (1 without a shared vertex)\n"
            in split.out)
    welded = check(tmp_path, ["seam.obj"], "--weld")
    assert welded.exit_code == 0, welded.err


def test_a_welded_seam_that_comes_apart_is_refused(tmp_path):
    torn = [*SEAM[:3], (1, 0, 0.25), *SEAM[4:]]
    for name, vertices in (("torn_0.obj", SEAM), ("torn_1.obj", torn)):
        (tmp_path / name).write_text(obj_text((vertices, SIDES)), encoding="utf-8")
    outcome = check(tmp_path, ["torn_0.obj", "torn_1.obj"], "--weld")
    assert outcome.exit_code == 2
    assert 'frame 1: vertices 1 and 3 of body "torn" are welded and come apart' in outcome.err


@pytest.mark.parametrize(("cache", "bytes_of"), [("ball.pc2", pc2_bytes), ("ball.mdd", mdd_bytes)])
def test_reads_point_caches(folder, cache, bytes_of):
    vertices, triangles = moved(sphere(0.5, 3), (3, 0.5, 0.5), 1)
    (folder / "ball.obj").write_text(obj_text((vertices, triangles)), encoding="utf-8")
    nearer = [(x - 1.75, y, z) for x, y, z in vertices]
    (folder / cache).write_bytes(bytes_of([vertices, nearer, vertices]))
    outcome = check(folder, ["ball.obj", cache, "rest.obj"])
    assert outcome.exit_code == 1, outcome.err
    assert "3 frames\n\nframe 1\n  ball and rest: " in outcome.out
    assert "1 of 3 frames has a contact" in outcome.out


def test_refuses_a_vertex_of_too_many_triangles(tmp_path):
    """A vertex of n triangles has n (n - 1) / 2 pairs of neighbours. Where self-contact is not judged there
    may be as many; few touch the other body, so that the check is short."""
    rim = [(1.0, 1e-4 * number, 0.0) for number in range(1, 10_002)]
    fan = [(0, 0, 0), *rim], [(0, number, number + 1) for number in range(1, 10_001)]
    (tmp_path / "fan.obj").write_text(obj_text(fan), encoding="utf-8")
    (tmp_path / "post.obj").write_text(obj_text(moved(box(1), (0.9, 0.01, -0.0005), 0.001)), encoding="utf-8")
    outcome = check(tmp_path, ["fan.obj"])
    assert outcome.exit_code == 2
    assert ('self-contact of body "fan": its triangles share a vertex in 50004999 pairs (vertex 0 is in '
            "10000 triangles)") in outcome.err
    outcome = check(tmp_path, ["fan.obj", "post.obj"], "--allow", "self")
    assert outcome.exit_code == 1, outcome.err
    assert "fan and post: " in outcome.out


@pytest.fixture
def sheet(tmp_path):
    """A body of two triangles, one through the other in both frames."""
    triangles = [(0, 1, 2), (3, 4, 5)]
    vertices = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0.2, 0.2, -1), (0.2, 0.2, 1)]
    (tmp_path / "sheet").mkdir()
    for name, last in (("frame_1.obj", (2, 2, 1)), ("frame_2.obj", (0.2, 0.2, 0))):
        mesh = [*vertices, last], triangles
        (tmp_path / "sheet" / name).write_text(obj_text(mesh), encoding="utf-8")
    return tmp_path


def test_finds_a_body_that_meets_itself(sheet):
    outcome = check(sheet, ["sheet/frame_1.obj", "sheet/frame_2.obj"], "--allow", "contact")
    assert outcome.exit_code == 1, outcome.err
    assert ("\nframe 0 (frame_1.obj)\n  sheet with itself: 1 pair of triangles, first 0 and 1 (1 without a "
            "shared vertex)\n") in outcome.out
    # Detectors are judged by the same: nothing is asked about other bodies.
    contactcheck("run", sheet / "out" / "frame-0.ccr", "--no-timing", "--detector", "full-refit", "--out",
                 sheet / "run")
    results = json.loads((sheet / "run" / "results.json").read_text(encoding="utf-8"))
    assert results["runs"]
    assert all("triangle" not in run["levels"] for run in results["runs"])


def test_refuses_to_allow_all_that_one_body_can_have(sheet):
    outcome = check(sheet, ["sheet/frame_1.obj", "sheet/frame_2.obj"], "--allow", "self")
    assert outcome.exit_code == 2
    assert "--allow self leaves nothing to be checked of one body" in outcome.err


def test_json_lines_say_it_to_programs(folder):
    outcome = check_both(folder, "--json-lines")
    assert outcome.exit_code == 1, outcome.err
    events = [json.loads(line) for line in outcome.out.splitlines()]
    assert (events[0]["event"], events[0]["frames"]) == ("start", 5)
    bad, = (event for event in events if event["event"] == "frame")
    assert (bad["frame"], bad["file"]) == (3, "moving_11.obj")
    assert bad["contacts"][0]["bodies"] == ["moving", "rest"]
    assert bad["contacts"][0]["depth"]["lower"] == pytest.approx(0.1, abs=1e-9, rel=0)
    assert bad["contacts"][0]["depth"]["upper"] == pytest.approx(0.1, abs=1e-9, rel=0)
    end = events[-1]
    assert (end["event"], end["bad_frames"], end["exit_code"]) == ("end", 1, 1)


@pytest.mark.parametrize(("files", "sentence"), [
    (["moving_8.obj", "moving_10.obj", "moving_11.obj"], "go from 10 to 11, and before in steps of 2; all steps must be alike"),
    (["gone.pc2"], "is a point cache; the mesh that it moves is named before it"),
    (["gone.obj"], "gone.obj")], ids=["frames_with_a_gap", "cache_without_mesh", "missing_file"])
def test_refuses_what_it_cannot_read(folder, files, sentence):
    outcome = check(folder, files)
    assert outcome.exit_code == 2
    assert sentence in outcome.err
