"""Which bodies are solids, and what lies inside them: `contactcheck check` and `run` on small meshes."""

import json
import math

import pytest

import validate_results
from meshes import box, obj_text
from program import contactcheck, successful

IS_INSIDE = "outer and inner: one is inside the other"


def cube(low, high):
    """The box [low, high]^3: 8 vertices, 12 triangles."""
    vertices, triangles = box(1)
    return [[low + (high - low) * x for x in vertex] for vertex in vertices], triangles


def shifted(mesh, *by):
    return [[a + b for a, b in zip(vertex, by)] for vertex in mesh[0]], mesh[1]


def joined(*meshes):
    vertices, triangles = [], []
    for mesh in meshes:
        triangles += [[v + len(vertices) for v in t] for t in mesh[1]]
        vertices += mesh[0]
    return vertices, triangles


def turned(mesh):
    return mesh[0], [[a, c, b] for a, b, c in mesh[1]]


def with_own_corners(mesh):
    """Every triangle has three vertices of its own, as in STL files."""
    return [list(mesh[0][v]) for t in mesh[1] for v in t], [[k, k + 1, k + 2] for k in range(0, 3 * len(mesh[1]), 3)]


def with_four_vertices_a_side():
    """As a textured cube: the two triangles of a side share their vertices, and no others."""
    vertices, triangles = cube(0, 4)
    sides = []
    for one, other in zip(triangles[::2], triangles[1::2]):
        side = sorted({*one, *other})
        sides.append(([vertices[v] for v in side], [[side.index(v) for v in t] for t in (one, other)]))
    return joined(*sides)


def with_zeros_below(mesh):
    """Every other vertex has -0 where it has 0."""
    return [[-0.0 if x == 0 and number % 2 else x for x in vertex] for number, vertex in enumerate(mesh[0])], mesh[1]


def split_edge(filled):
    """A cube with the middle of an edge in one of its two triangles; `filled`: by a triangle of no area."""
    vertices, triangles = cube(0, 4)
    a, b, c = triangles[0]
    middle = len(vertices)
    vertices = [*vertices, [(p + q) / 2 for p, q in zip(vertices[a], vertices[b])]]
    return vertices, [[a, middle, c], [middle, b, c], *([[b, middle, a]] if filled else []), *triangles[1:]]


def with_triangles(mesh, *more):
    return mesh[0], [*mesh[1], *(list(t) for t in more)]


INNER = shifted(cube(0.5, 0.75), 2, 0, 0)
WALL = ([[0, 0, 0], [4, 4, 0], [4, 4, 4]], [[0, 1, 2]])

CLOSED = {
    "repeated_corner": with_triangles(cube(0, 4), (1, 1, 3)),
    "triangle_that_is_a_point": with_triangles(cube(0, 4), (2, 2, 2)),
    "repeated_corner_in_front": (cube(0, 4)[0], [[5, 7, 5], *cube(0, 4)[1]]),
    "own_corners": with_own_corners(cube(0, 4)),
    "own_corners_and_a_repeated_one": with_triangles(with_own_corners(cube(0, 4)), (0, 1, 1)),
    "four_vertices_a_side": with_four_vertices_a_side(),
    "zero_and_minus_zero": with_zeros_below(with_own_corners(cube(0, 4))),
    "flap_of_no_area": with_triangles(joined(cube(0, 4), ([[0, 9, 0]], [])), (0, 1, 8)),
    "needle_of_no_area_elsewhere": joined(cube(0, 4), ([[7, 7, 7], [8, 8, 8], [9.5, 9.5, 9.5]], [[0, 1, 2]])),
    "seam_filled_by_no_area": split_edge(filled=True),
    "own_corners_filled_by_no_area": with_own_corners(split_edge(filled=True)),
    "four_triangles_on_an_edge": joined(cube(0, 4), shifted(cube(0, 4), 4, 4, 0)),
    "two_that_touch_in_a_corner": joined(cube(0, 4), cube(4, 8)),
    "wall_once_each_way": joined(cube(0, 4), WALL, turned(WALL)),
    "inside_out": turned(cube(0, 4)),
    "twice_the_same": joined(cube(0, 4), cube(0, 4)),
    "shell_in_it_inside_out": joined(cube(0, 4), turned(cube(1.5, 3.5))),
}


def torn_by_an_ulp():
    vertices, triangles = with_own_corners(cube(0, 4))
    vertices[5][0] = math.nextafter(vertices[5][0], 2)
    return vertices, triangles


OPEN = {
    "missing_triangle": (cube(0, 4)[0], cube(0, 4)[1][1:]),
    "missing_triangle_of_own_corners": with_own_corners((cube(0, 4)[0], cube(0, 4)[1][1:])),
    "turned_triangle": (cube(0, 4)[0], [cube(0, 4)[1][0][::-1], *cube(0, 4)[1][1:]]),
    "one_ulp_apart": torn_by_an_ulp(),
    "edge_against_its_halves": split_edge(filled=False),
    "three_triangles_on_an_edge": joined(cube(0, 4), WALL),
}


def write(folder, **meshes):
    for name, mesh in meshes.items():
        (folder / f"{name}.obj").write_text(mesh if isinstance(mesh, str) else obj_text(mesh), encoding="utf-8")


def check(folder, *names, more=("--allow", "self")):
    return contactcheck("check", *(folder / name for name in names), "--out", folder / "out", "--quiet", *more)


@pytest.mark.parametrize("mesh", CLOSED.values(), ids=CLOSED)
def test_solid_holds_what_is_inside(tmp_path, mesh):
    write(tmp_path, outer=mesh, inner=INNER)
    outcome = check(tmp_path, "outer.obj", "inner.obj")
    assert outcome.exit_code == 1, outcome.err
    assert IS_INSIDE in outcome.out
    assert "not judged" not in outcome.out


@pytest.mark.parametrize("mesh", OPEN.values(), ids=OPEN)
def test_open_body_is_named_with_its_first_edge(tmp_path, mesh):
    write(tmp_path, outer=mesh, inner=INNER)
    outcome = check(tmp_path, "outer.obj", "inner.obj")
    assert outcome.exit_code == 0, outcome.err
    line, = (line for line in outcome.out.splitlines() if "not judged" in line)
    assert line.startswith("outer: containment and depth in it not judged: open (frame 0, edge of vertices ")
    edge = {int(word) for word in line.rstrip(")").split() if word.isdigit()}
    assert any(edge <= {*triangle} for triangle in mesh[1])


def test_first_open_edge_is_that_of_the_first_triangle(tmp_path):
    write(tmp_path, outer=([[0, 0, 0], [9, 0, 0], [0, 9, 0], [0, 0, 9]], [[0, 2, 1], [0, 1, 3], [1, 2, 3]]),
          inner=INNER)
    assert "open (frame 0, edge of vertices 0 and 2)\n" in check(tmp_path, "outer.obj", "inner.obj").out


@pytest.mark.parametrize("face", ["{0} {1} {2} {2}", "{0} {0} {1} {2}", "{0} {1} {1} {2}", "{0} {1} {2} {0}",
                                  "{0} {1} {2}\nf {0} {0} {1}", "{0} {1} {2}\nf {2} {2} {0} {0}"])
def test_faces_of_an_obj_file_with_a_corner_twice(tmp_path, face):
    vertices, triangles = cube(0, 4)
    faces = "".join("f " + face.format(*(v + 1 for v in t)) + "\n" for t in triangles)
    write(tmp_path, outer=obj_text((vertices, [])) + faces, inner=INNER)
    outcome = check(tmp_path, "outer.obj", "inner.obj")
    assert (IS_INSIDE in outcome.out, "not judged" in outcome.out) == (True, False), outcome.out + outcome.err


@pytest.mark.parametrize("weld", [[], ["--weld"]], ids=["as_it_is", "welded"])
def test_stl_is_a_solid_with_and_without_weld(tmp_path, weld):
    vertices, triangles = cube(0, 4)
    facets = "".join("facet normal 0 0 0\nouter loop\n" + "".join("vertex {} {} {}\n".format(*vertices[v]) for v in t) +
                     "endloop\nendfacet\n" for t in triangles)
    (tmp_path / "outer.stl").write_text(f"solid\n{facets}endsolid\n", encoding="utf-8")
    write(tmp_path, textured=with_four_vertices_a_side(), inner=INNER)
    for name in ("outer.stl", "textured.obj"):
        outcome = check(tmp_path, name, "inner.obj", more=["--allow", "self", *weld])
        assert outcome.exit_code == 1, outcome.err
        assert "and inner: one is inside the other" in outcome.out
        assert "not judged" not in outcome.out


@pytest.mark.parametrize("parts", [(cube(1, 2), cube(9, 11)), (cube(9, 11), cube(1, 2)),
                                   (cube(-3, -2), cube(9, 11), cube(1, 2), cube(5, 6))],
                         ids=["first", "second", "third_of_four"])
def test_one_part_inside_suffices(tmp_path, parts):
    write(tmp_path, outer=cube(0, 4), inner=joined(*parts))
    for names in (("outer.obj", "inner.obj"), ("inner.obj", "outer.obj")):
        outcome = check(tmp_path, *names, more=())
        assert outcome.exit_code == 1, outcome.err
        assert "one is inside the other" in outcome.out


def test_each_has_a_part_in_the_other(tmp_path):
    write(tmp_path, outer=joined(cube(0, 4), shifted(cube(1, 2), 20, 0, 0)),
          inner=joined(shifted(cube(0, 4), 20, 0, 0), cube(1, 2)))
    assert IS_INSIDE in check(tmp_path, "outer.obj", "inner.obj").out


@pytest.mark.parametrize("held, inside", [(cube(1, 2), True), (cube(4, 5), False), (cube(2, 7), True),
                                          (joined(cube(4, 5), cube(1, 2)), True), (cube(10, 11), False)],
                         ids=["in_the_wall", "in_the_cavity", "round_the_cavity", "in_both", "beside"])
def test_wall_between_shells_is_solid_and_the_cavity_is_not(tmp_path, held, inside):
    write(tmp_path, outer=joined(cube(0, 9), turned(cube(3, 6))), inner=held)
    outcome = check(tmp_path, "outer.obj", "inner.obj")
    assert outcome.exit_code == inside, outcome.err
    assert (IS_INSIDE in outcome.out) == inside


def test_cloth_of_two_sides_contains_nothing(tmp_path):
    sheet = ([[-9, -9, 2], [90, -9, 2], [-9, 90, 2]], [[0, 1, 2]])
    write(tmp_path, outer=joined(sheet, turned(sheet)), inner=INNER)
    outcome = check(tmp_path, "outer.obj", "inner.obj")
    assert (outcome.exit_code, "not judged" in outcome.out) == (0, False)


def test_seam_that_opens_leaves_its_frame_unjudged(tmp_path):
    closed = with_own_corners(cube(0, 4))
    torn = [[x + (number == 7) * 0.125 for x in vertex] for number, vertex in enumerate(closed[0])], closed[1]
    write(tmp_path, outer_0=closed, outer_1=torn, outer_2=closed, inner=INNER)
    outcome = check(tmp_path, "outer_0.obj", "outer_1.obj", "outer_2.obj", "inner.obj")
    assert "2 of 3 frames have a contact" in outcome.out
    assert "outer: containment and depth in it not judged: open (frame 1, edge of vertices " in outcome.out


def test_programs_are_told_what_was_not_judged(tmp_path):
    write(tmp_path, outer=OPEN["missing_triangle"], inner=INNER)
    outcome = check(tmp_path, "outer.obj", "inner.obj", more=("--json-lines",))
    end = json.loads(outcome.out.splitlines()[-1])
    told, = end["not_judged"]
    assert (told["body"], told["level"]) == ("outer", "containment")
    assert told["reason"].startswith("open (frame 0, edge of vertices ")
    for more in (("--json-lines", "--allow", "contact"), ("--json-lines",)):
        write(tmp_path, outer=cube(0, 4))
        end = json.loads(check(tmp_path, "outer.obj", "inner.obj", more=more).out.splitlines()[-1])
        assert end["not_judged"] == []


def test_body_alone_has_no_containment_to_be_judged(tmp_path):
    write(tmp_path, outer=OPEN["missing_triangle"])
    assert "not judged" not in check(tmp_path, "outer.obj", more=()).out


@pytest.mark.parametrize("mesh", [joined(cube(0, 4), cube(0, 4)), with_own_corners(joined(cube(0, 4), cube(0, 4)))],
                         ids=["second_vertices", "own_corners"])
def test_weld_names_the_duplicates_that_it_makes(tmp_path, mesh):
    write(tmp_path, doubled=mesh, one=cube(0, 4))
    assert "12 duplicate-triangle (first: triangle 12)" in check(tmp_path, "doubled.obj", more=["--weld"]).out
    assert "duplicate-triangle" not in check(tmp_path, "one.obj", more=["--weld"]).out


def scene_of(folder, levels, **meshes):
    write(folder, **meshes)
    (folder / "scene.json").write_text(json.dumps({
        "id": "solids", "frames": 1, "duration": 1, "levels": levels,
        "bodies": [{"name": name, "mesh": {"file": f"{name}.obj"}} for name in meshes]}), encoding="utf-8")


def run(folder):
    outcome = successful("run", folder / "scene.json", "--no-timing", "--detector", "fcl-aabb", "--out", folder / "out")
    return validate_results.load(folder / "out" / "results.json")["scenes"][0], outcome


@pytest.mark.parametrize("mesh", [CLOSED[kind] for kind in ("own_corners", "four_triangles_on_an_edge",
                                                            "seam_filled_by_no_area", "repeated_corner")],
                         ids=["own_corners", "four_triangles", "filled_seam", "repeated_corner"])
def test_run_judges_containment_and_vertices_in_every_solid(tmp_path, mesh):
    scene_of(tmp_path, ["body", "containment", "vertex"], outer=mesh, inner=joined(INNER, cube(20, 21)))
    scene, outcome = run(tmp_path)
    assert scene["truth"] == {"body": 0, "containment": 1, "vertex": 8}
    assert scene["bodies"][0]["solid"] is True
    assert "not judged" not in outcome.out


def test_run_names_the_frame_in_which_a_seam_opens(tmp_path):
    closed = with_own_corners(cube(0, 4))
    torn = [[x + (number == 7) * 0.125 for x in vertex] for number, vertex in enumerate(closed[0])], closed[1]
    scene_of(tmp_path, ["body", "containment"], outer_0=closed, outer_1=torn, inner=INNER)
    scene = json.loads((tmp_path / "scene.json").read_text(encoding="utf-8"))
    scene |= {"frames": 2, "bodies": [{"name": "outer", "recording": {"frames": "outer_%d.obj"}}, scene["bodies"][2]]}
    (tmp_path / "scene.json").write_text(json.dumps(scene), encoding="utf-8")
    truth = run(tmp_path)[0]["truth"]
    assert truth["containment"].startswith('not judged: open (body "outer", frame 1, edge of vertices ')


def test_run_says_in_one_line_what_is_not_judged(tmp_path):
    scene_of(tmp_path, ["body", "containment", "vertex"], outer=OPEN["missing_triangle"], inner=INNER)
    scene, outcome = run(tmp_path)
    why = scene["truth"]["containment"]
    assert why.startswith('not judged: open (body "outer", frame 0, edge of vertices ')
    assert scene["truth"]["vertex"] == why
    assert f"\n  containment, vertex {why}\n" in outcome.out
    assert scene["bodies"][0]["solid"] is False
