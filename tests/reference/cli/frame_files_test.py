"""What `contactcheck check` makes of files whose frames are in another form: caches in a space of their own,
STL, polygons that fold."""

import itertools

import pytest

from meshes import box, moved, obj_text, sphere
from point_caches import mdd_bytes, pc2_bytes
from program import contactcheck


def check(folder, names, *more):
    return contactcheck("check", *(folder / name for name in names), *more, "--out", folder / "out")


def change_of_axes(axes, signs):
    return lambda points: [tuple(s * p[a] for a, s in zip(axes, signs)) for p in points]


CHANGES = {
    "y_up": (change_of_axes((0, 2, 1), (1, 1, -1)), "axes x -z y"),
    "z_up": (change_of_axes((0, 2, 1), (1, -1, 1)), "axes x z -y"),
    "cyclic": (change_of_axes((1, 2, 0), (1, 1, 1)), "axes z x y"),
    "half_a_turn": (change_of_axes((0, 1, 2), (-1, -1, 1)), "axes -x -y z"),
    "mirrored": (change_of_axes((0, 1, 2), (-1, 1, 1)), "axes -x y z"),
}


@pytest.fixture
def ball(tmp_path):
    """A ball of 1 m beside a box of 1 m, and in sample 1 of its motion in it."""
    vertices, triangles = moved(sphere(0.5, 3), (3, 0.5, 0.5), 1)
    (tmp_path / "ball.obj").write_text(obj_text((vertices, triangles)), encoding="utf-8")
    (tmp_path / "rest.obj").write_text(obj_text(box(2)), encoding="utf-8")
    nearer = [(x - 1.75, y, z) for x, y, z in vertices]
    return tmp_path, [vertices, nearer]


@pytest.mark.parametrize(("change", "axes"), CHANGES.values(), ids=CHANGES.keys())
@pytest.mark.parametrize(("name", "bytes_of"), [("ball.pc2", pc2_bytes), ("BALL.MDD", mdd_bytes)],
                         ids=["pc2", "mdd_in_capitals"])
def test_leads_a_cache_of_other_axes_to_the_mesh(ball, name, bytes_of, change, axes):
    folder, samples = ball
    (folder / name).write_bytes(bytes_of([change(sample) for sample in samples]))
    outcome = check(folder, ["ball.obj", name, "rest.obj"])
    assert outcome.exit_code == 1, outcome.err
    assert f"; the cache is led to the mesh by {axes}\n" in outcome.out
    assert "\nframe 1\n  ball and rest: " in outcome.out
    assert "1 of 2 frames has a contact" in outcome.out


def test_says_nothing_of_a_cache_in_the_space_of_its_mesh(ball):
    folder, samples = ball
    (folder / "ball.pc2").write_bytes(pc2_bytes(samples))
    first_line = check(folder, ["ball.obj", "ball.pc2", "rest.obj"]).out.splitlines()[0]
    assert first_line.endswith("ball.pc2")


# The OBJ is in the world, the cache in the space of its object: both balls are at its origin.
def test_takes_a_cache_with_an_offset_as_it_is_unless_told(ball):
    folder, samples = ball
    at_origin = [[(x - 3, y, z) for x, y, z in sample] for sample in samples]
    (folder / "ball.pc2").write_bytes(pc2_bytes(at_origin))
    files = ["ball.obj", "ball.pc2", "rest.obj"]
    outcome = check(folder, files)
    assert outcome.exit_code == 1
    assert ("; sample 0 of the cache is the mesh with an offset of (3, 0, 0): it is taken as it is "
            '(--cache-space mesh, in a scene "space": "mesh", leads it there)\n') in outcome.out
    assert "\nframe 0\n  ball and rest: " in outcome.out
    as_the_file = check(folder, files, "--cache-space", "file")
    assert as_the_file.exit_code == 1
    assert "sample 0" not in as_the_file.out
    as_the_mesh = check(folder, files, "--cache-space", "mesh")
    assert as_the_mesh.exit_code == 1
    assert "the cache is led to the mesh by an offset of (3, 0, 0)\n" in as_the_mesh.out
    assert "1 of 2 frames has a contact that is not allowed, the first is frame 1\n" in as_the_mesh.out


def test_says_that_a_cache_begins_elsewhere(ball):
    folder, samples = ball
    bent = [(x, y, z + 0.1 * x * x) for x, y, z in samples[0]]
    (folder / "ball.pc2").write_bytes(pc2_bytes([bent, *samples]))
    files = ["ball.obj", "ball.pc2", "rest.obj"]
    assert "; sample 0 of the cache is not the mesh: it is taken as it is\n" in check(folder, files).out
    refused = check(folder, files, "--cache-space", "mesh")
    assert refused.exit_code == 2
    assert "no change of axes and no offset lead sample 0 to it" in refused.err


def test_says_that_a_cache_stands_still_at_its_end(ball):
    folder, samples = ball
    (folder / "ball.pc2").write_bytes(pc2_bytes([*samples, samples[0], samples[0], samples[0]]))
    assert "; the last 3 samples are equal\n" in check(folder, ["ball.obj", "ball.pc2", "rest.obj"]).out


def test_says_that_a_cache_has_more_samples_than_the_rest_has_frames(ball):
    folder, samples = ball
    (folder / "ball.pc2").write_bytes(pc2_bytes([*samples, samples[0]]))
    for frame in range(2):
        (folder / f"box_{frame}.obj").write_text(obj_text(moved(box(1), (0, 0, 5), 1)), encoding="utf-8")
    outcome = check(folder, ["ball.obj", "ball.pc2", "rest.obj", "box_0.obj", "box_1.obj"])
    assert outcome.exit_code == 1, outcome.err
    assert "; only the first 2 of its 3 frames are used, as many as every recording has\n" in outcome.out
    (folder / "ball.pc2").write_bytes(pc2_bytes(samples[:1]))
    outcome = check(folder, ["ball.obj", "ball.pc2", "rest.obj", "box_0.obj", "box_1.obj"])
    assert outcome.exit_code == 0, outcome.err
    assert "box_*.obj; only the first 1 of its 2 frames are used, as many as every recording has\n" in outcome.out


# All points in a plane: a turn and a reflection lead them to the mesh, but not what moves out of it.
def test_turns_a_flat_cloth_and_reflects_it_not(tmp_path):
    n = 4
    vertices = [(0.25 * i, 0.25 * j + 0.01 * i, 0) for i in range(n) for j in range(n)]
    triangles = [t for i, j in itertools.product(range(n - 1), repeat=2) for t in
                 ((n * i + j, n * i + n + j, n * i + j + 1), (n * i + n + j, n * i + n + j + 1, n * i + j + 1))]
    (tmp_path / "cloth.obj").write_text(obj_text((vertices, triangles)), encoding="utf-8")
    (tmp_path / "roof.obj").write_text(
        obj_text(([(-1, -1, 0.5), (3, -1, 0.5), (-1, 3, 0.5)], [(0, 1, 2)])), encoding="utf-8")
    raised = [(x, y, 0.7 if x > 0.3 else 0) for x, y, _ in vertices]
    y_up = change_of_axes((0, 2, 1), (1, 1, -1))
    (tmp_path / "cloth.pc2").write_bytes(pc2_bytes([y_up(vertices), y_up(raised)]))
    outcome = check(tmp_path, ["cloth.obj", "cloth.pc2", "roof.obj"])
    assert outcome.exit_code == 1, outcome.out
    assert "the cache is led to the mesh by axes x -z y;" in outcome.out
    assert "\nframe 1\n  cloth and roof: " in outcome.out


def stl(vertices, triangles):
    facets = "".join("facet normal 0 0 0\nouter loop\n" +
                     "".join(f"vertex {' '.join(map(repr, vertices[i]))}\n" for i in triangle) +
                     "endloop\nendfacet\n" for triangle in triangles)
    return f"solid a\n{facets}endsolid a\n"


# Two triangles that share an edge, and fold onto one another: as OBJ tells it.
SQUARE = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)]
FOLDED = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 0)]


def test_keeps_the_corners_that_the_first_frame_of_stl_joined(tmp_path):
    for kind, text in (("stl", stl), ("obj", lambda v, t: obj_text((v, t)))):
        for frame, vertices in enumerate((SQUARE, FOLDED)):
            (tmp_path / f"seq_{frame}.{kind}").write_text(text(vertices, [(0, 1, 2), (2, 1, 3)]), encoding="utf-8")
    found = {kind: check(tmp_path, [f"seq_0.{kind}", f"seq_1.{kind}"]) for kind in ("stl", "obj")}
    for outcome in found.values():
        assert outcome.exit_code == 1, outcome.err
        assert "seq with itself: 1 pair of triangles, first 0 and 1 (1 that share an edge)\n" in outcome.out


def test_refuses_corners_of_stl_that_come_apart(tmp_path):
    torn = stl([*SQUARE, (1, 0, 0.5)], [(0, 1, 2), (2, 4, 3)])
    (tmp_path / "seq_0.stl").write_text(stl(SQUARE, [(0, 1, 2), (2, 1, 3)]), encoding="utf-8")
    (tmp_path / "seq_1.stl").write_text(torn, encoding="utf-8")
    outcome = check(tmp_path, ["seq_0.stl", "seq_1.stl"])
    assert outcome.exit_code == 2
    assert ("has corner 1 of triangle 0 and corner 1 of triangle 1 apart, which are vertex 1 of the body's mesh; "
            "STL has no vertices of several triangles, OBJ has") in outcome.err


def test_refuses_stl_of_another_number_of_triangles(tmp_path):
    (tmp_path / "seq_0.stl").write_text(stl(SQUARE, [(0, 1, 2), (2, 1, 3)]), encoding="utf-8")
    (tmp_path / "seq_1.stl").write_text(stl(SQUARE, [(0, 1, 2)]), encoding="utf-8")
    outcome = check(tmp_path, ["seq_0.stl", "seq_1.stl"])
    assert outcome.exit_code == 2
    assert "has 1 triangles, the body's mesh has 2" in outcome.err


def test_says_what_may_help_where_vertices_are_split(tmp_path):
    (tmp_path / "seq_0.obj").write_text(obj_text((SQUARE, [(0, 1, 2), (2, 1, 3)])), encoding="utf-8")
    (tmp_path / "seq_1.obj").write_text(
        obj_text(([*SQUARE, (1, 0, 0)], [(0, 1, 2), (2, 4, 3)])), encoding="utf-8")
    outcome = check(tmp_path, ["seq_0.obj", "seq_1.obj"])
    assert outcome.exit_code == 2
    assert ("has 5 vertices and 2 triangles, the body's mesh has 4 vertices and 2 triangles; a program that splits "
            "vertices at seams, as some do for PLY, keeps them in OBJ") in outcome.err


# A polygon that crosses itself; what touches its fan is found with --repair alone.
FLAG = [(0, 0, 0), (1, 1, 0), (1, 0, 0), (0, 1, 0), (-1, 0.5, 0), (0, 0, 5), (1, 0, 5)]
FLAG_FACES = "f 1 2 3 4 5\nf 6 7 1\n"


@pytest.mark.parametrize(("frames", "words"), [(1, 'left out (--repair, in a scene "repair": true, fills it by a fan)'), (2, "left out")],
                         ids=["at_rest", "recorded"])
def test_leaves_out_a_polygon_that_folds_or_fills_it(tmp_path, frames, words):
    vertices = "".join(f"v {x} {y} {z}\n" for x, y, z in FLAG)
    for frame in range(frames):
        (tmp_path / f"flag_{frame}.obj").write_text(vertices + FLAG_FACES, encoding="utf-8")
    (tmp_path / "pole.obj").write_text(
        obj_text(([(0.3, 0.2, -1), (0.3, 0.2, 1), (0.35, 0.2, 1)], [(0, 1, 2)])), encoding="utf-8")
    files = [*(f"flag_{frame}.obj" for frame in range(frames)), "pole.obj"]
    left_out = check(tmp_path, files, "--allow", "self")
    assert left_out.exit_code == 0, left_out.err
    assert "face 0 (line 8), of 5 corners, crosses or folds back on itself: " + words in left_out.out
    repaired = check(tmp_path, files, "--allow", "self", "--repair")
    assert repaired.exit_code == 1, repaired.err
    assert "face 0 (line 8), of 5 corners, crosses or folds back on itself: filled by a fan" in repaired.out
    assert "flag" in repaired.out and " and pole: " in repaired.out
