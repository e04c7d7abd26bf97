"""`contactcheck check`: how deep bodies are in each other, and which depths may be allowed."""

import itertools
import json
import math
import re

import pytest

from meshes import box, obj_text, sphere
from program import contactcheck


def block(low, high, divisions=1):
    """The closed box from `low` to `high`."""
    vertices, triangles = box(divisions)
    return [[a + (b - a) * x for a, b, x in zip(low, high, vertex)] for vertex in vertices], triangles


def cells(filled, size=(1, 1, 1), origin=(0, 0, 0)):
    """The closed surface of a set of cells of a grid."""
    numbers, triangles = {}, []
    for cell, axis, side in itertools.product(sorted(filled), range(3), (0, 1)):
        beyond = list(cell)
        beyond[axis] += 2 * side - 1
        if tuple(beyond) in filled:
            continue
        quad = []
        for u, v in ((0, 0), (1, 0), (1, 1), (0, 1)):
            point = list(cell)
            point[axis] += side
            point[(axis + 1) % 3] += u
            point[(axis + 2) % 3] += v
            quad.append(numbers.setdefault(tuple(point), len(numbers)))
        a, b, c, d = quad if side else (quad[0], *reversed(quad[1:]))
        triangles += [[a, b, c], [a, c, d]]
    return [[o + s * k for o, s, k in zip(origin, size, point)] for point in numbers], triangles


def shifted(mesh, offset):
    vertices, triangles = mesh
    return [[x + o for x, o in zip(vertex, offset)] for vertex in vertices], triangles


def joined(first, second):
    count = len(first[0])
    return first[0] + second[0], first[1] + [[k + count for k in t] for t in second[1]]


def turned(mesh):
    """The other side of the surface is outside."""
    return mesh[0], [[a, c, b] for a, b, c in mesh[1]]


def both_sides(mesh):
    return joined(mesh, turned(mesh))


def soup(mesh):
    """Each triangle has vertices of its own."""
    vertices, triangles = mesh
    return ([vertices[k] for t in triangles for k in t],
            [[3 * i, 3 * i + 1, 3 * i + 2] for i in range(len(triangles))])


def check(folder, meshes, *more):
    for name, mesh in meshes.items():
        (folder / f"{name}.obj").write_text(obj_text(mesh), encoding="utf-8")
    return contactcheck("check", *(folder / f"{name}.obj" for name in meshes), "--out", folder / "out", *more)


def contact(folder, meshes, *more):
    """The contact that JSON lines tell of two bodies in one frame."""
    outcome = check(folder, meshes, "--json-lines", *more)
    assert outcome.exit_code == 1, outcome.err
    frame, = (event for event in map(json.loads, outcome.out.splitlines()) if event["event"] == "frame")
    found, = frame["contacts"]
    return found


RING = {(i, j, 0) for i in range(3) for j in range(3)} - {(1, 1, 0)}
ELL = {(0, 0, 0), (1, 0, 0), (2, 0, 0), (0, 1, 0), (0, 2, 0)}

# Two bodies, and their depth in metres by hand.
KNOWN = {
    "crossed_bars": (block((-3, -0.25, -0.25), (3, 0.25, 0.25)),
                     block((-0.125, -2, -0.125), (0.125, 2, 0.5)), 0.25),
    "bars_that_cross_shallowly": (block((-3, -0.25, -0.25), (3, 0.25, 0.25)),
                                  block((-0.5, -2, 0.125), (0.5, 2, 1)), 0.125),
    "bar_through_a_thin_floor": (block((-4, -4, -0.0625), (4, 4, 0), 3),
                                 block((-0.5, -0.75, -2), (0.5, 0.75, 3)), 0.5),
    "bar_through_the_side_of_a_hole": (cells(RING, (1, 1, 0.25)),
                                       block((1.25, 1.25, -1), (2.25, 1.75, 1)), 0.25),
    "two_ells": (cells(ELL), cells(ELL, origin=(0.25, -1.75, 0.5)), 0.5),
    "body_inside_another": (block((-4, -4, -4), (4, 4, 4), 2), block((-0.5, -0.5, -0.5), (1, 1, 1)), 3.5),
    "part_in_a_solid": (block((-4, -4, -4), (4, 4, 4)),
                        joined(block((1, 1, 1), (2, 2, 2)), block((-0.5, -6, -0.5), (0.5, -3, 0.5))), 3),
    "body_through_a_cavity": (joined(block((-4, -4, -4), (4, 4, 4)), turned(block((-3, -3, -3), (3, 3, 3)))),
                              block((-5, -2, -2), (5, 2, 2)), 2),
    "inside_out": (turned(block((-2, -2, -2), (2, 2, 2))), block((1.5, -8, -1), (9, 8, 1)), 0.5),
    "sunk_into_a_table": (block((-2, -2, -1), (2, 2, 0), 10),
                          block((-1, -1, -0.0625), (1, 1, 1), 7), 0.0625),
}


@pytest.mark.parametrize("name", KNOWN)
def test_depth_is_that_of_surfaces(tmp_path, name):
    a, b, depth = KNOWN[name]
    found = contact(tmp_path, {"a": a, "b": b})
    lower, upper = found["depth"]["lower"], found["depth"]["upper"]
    assert lower <= depth <= upper <= 1.001 * lower
    assert found["depth_unknown"] is None
    outcome = check(tmp_path, {"a": a, "b": b})
    words = f"{depth:.3g} m" if depth >= 1 else f"{1e3 * depth:.3g} mm"
    assert re.search(rf"\n  a and b: .*, {words} deep\n", outcome.out), outcome.out
    assert re.search(rf"\ndeepest: frame 0, .*, {words} deep\n", outcome.out), outcome.out


@pytest.mark.parametrize("name", ["crossed_bars", "bar_through_a_thin_floor", "two_ells", "body_inside_another"])
def test_limit_allows_from_the_upper_end_on(tmp_path, name):
    """A limit within the interval makes it narrow."""
    a, b, depth = KNOWN[name]
    upper = contact(tmp_path, {"a": a, "b": b}, "--allow", f"depth={depth!r}")["depth"]["upper"]
    assert depth < upper < depth + 4e-9
    for limit, exit_code in ((math.nextafter(upper, 0), 1), (upper, 0), (math.nextafter(upper, 9), 0)):
        outcome = check(tmp_path, {"a": a, "b": b}, "--allow", f"depth={limit!r}")
        assert outcome.exit_code == exit_code, outcome.err


def test_a_ball_through_a_thin_floor_is_deep(tmp_path):
    ball, floor = shifted(sphere(1, 4), (0, 0, 0.25)), block((-5, -5, -0.03125), (5, 5, 0))
    found = contact(tmp_path, {"ball": ball, "floor": floor})
    # The floor's upper side in the middle is .75 from the lower pole; a little less, for chords are inside.
    assert 0.74 < found["depth"]["lower"] < found["depth"]["upper"] <= 0.7501
    assert check(tmp_path, {"ball": ball, "floor": floor}, "--allow", "depth=0.7").exit_code == 1
    assert check(tmp_path, {"ball": ball, "floor": floor}, "--allow", "depth=0.76").exit_code == 0


def test_a_bar_through_a_hole_is_no_contact(tmp_path):
    outcome = check(tmp_path, {"plate": cells(RING, (1, 1, 0.25)),
                               "bar": block((1.25, 1.25, -1), (1.75, 1.75, 1))})
    assert outcome.exit_code == 0, outcome.out


@pytest.mark.parametrize("size", [1e-9, 1e-3, 1e7])
def test_depth_scales_with_the_bodies(tmp_path, size):
    a, b, depth = KNOWN["crossed_bars"]
    a, b = (([[size * x for x in vertex] for vertex in mesh[0]], mesh[1]) for mesh in (a, b))
    found = contact(tmp_path, {"a": a, "b": b})["depth"]
    assert found["lower"] <= size * depth * (1 + 1e-15) and found["upper"] >= size * depth * (1 - 1e-15)
    assert found["upper"] <= 1.001 * found["lower"]


def test_touching_has_no_lower_end_above_zero(tmp_path):
    table, resting = block((-1, -1, -1), (1, 1, 0), 2), block((-0.5, -0.5, 0), (0.5, 0.5, 1), 3)
    outcome = check(tmp_path, {"table": table, "resting": resting})
    assert re.search(r", at most \d[^ ]* mm deep\n", outcome.out), outcome.out
    assert "deepest" not in outcome.out
    depth = contact(tmp_path, {"table": table, "resting": resting})["depth"]
    assert depth["lower"] == 0 < depth["upper"] <= 1e-9
    assert check(tmp_path, {"table": table, "resting": resting}, "--allow", "depth=0").exit_code == 1
    assert check(tmp_path, {"table": table, "resting": resting}, "--allow", "depth=1e-9").exit_code == 0


SOLID = block((-1, -1, -1), (1, 1, 1))

# A body in contact with SOLID, and why no depth is known.
UNKNOWN = {
    "open_box": ((block((0, 0, 0), (2, 2, 2))[0], block((0, 0, 0), (2, 2, 2))[1][:-1]), "open"),
    "sheet": (([[-2, -2, 0], [2, -2, 0], [2, 2, 0]], [[0, 1, 2]]), "open"),
    "double_sided_cloth": (both_sides(([[-2, -2, 0.5], [2, -2, 0.5], [2, 2, 0.5], [-2, 2, 0.5]],
                                       [[0, 1, 2], [0, 2, 3]])), "no interior"),
    "solid_with_double_sided_cloth": (joined(block((0.5, -4, -4), (4, 4, 4)),
                                             both_sides(([[5, 0, 0], [6, 0, 0], [5, 1, 0]], [[0, 1, 2]]))),
                                      "no interior"),
    "parts_that_touch": (joined(block((0.5, 0, 0), (2, 1, 1)), block((2, 0.25, 0.25), (3, 0.75, 0.75))),
                         "self-contact"),
    "parts_that_cross": (joined(block((0.5, 0, 0), (2, 1, 1)), block((1.5, 0.25, 0.25), (3, 0.75, 0.75))),
                         "self-contact"),
    "shell_in_a_shell": (joined(block((0.5, -2, -2), (4, 2, 2)), block((0.75, -1, -1), (3, 1, 1))), "nested"),
    "every_triangle_twice": (joined(block((0.5, 0, 0), (2, 1, 1)), block((0.5, 0, 0), (2, 1, 1))), "nested"),
}


@pytest.mark.parametrize("name", UNKNOWN)
@pytest.mark.parametrize("first", [True, False], ids=["before_the_solid", "after_the_solid"])
def test_unknown_depth_has_a_reason_and_is_never_allowed(tmp_path, name, first):
    mesh, reason = UNKNOWN[name]
    meshes = {"body": mesh, "solid": SOLID} if first else {"solid": SOLID, "body": mesh}
    found = contact(tmp_path, meshes, "--allow", "self")
    assert found["depth"] is None
    assert (found["depth_unknown"]["body"], found["depth_unknown"]["reason"]) == ("body", reason)
    assert ("edge" in found["depth_unknown"]) == (reason == "open")
    outcome = check(tmp_path, meshes, "--allow", "self", "--allow", "depth=1e9")
    assert outcome.exit_code == 1, outcome.out
    assert f", depth unknown: body: {reason}" in outcome.out
    assert "deepest" not in outcome.out


def test_depth_between_solids_is_known_beside_others_of_unknown_depth(tmp_path):
    outcome = check(tmp_path, {"solid": SOLID, "sheet": UNKNOWN["sheet"][0],
                               "box": block((0.5, 0, 0.5), (3, 1, 0.75))})
    assert re.search(r"\n  solid and box: .*, 500 mm deep\n", outcome.out), outcome.out
    assert re.search(r"\n  solid and sheet: .*, depth unknown: sheet: open \(edge of ", outcome.out), outcome.out
    assert re.search(r"\ndeepest of known depth: frame 0, solid and box: ", outcome.out), outcome.out


def test_a_body_is_judged_anew_in_every_frame(tmp_path):
    """Its triangles have vertices of their own: closed where these meet."""
    whole = soup(block((0.5, 0, 0), (2, 0.5, 0.5)))
    torn = [[x + 0.125 for x in whole[0][0]], *whole[0][1:]], whole[1]
    meshes = {"box_0": whole, "box_1": torn, "box_2": whole, "solid": SOLID}
    outcome = check(tmp_path, meshes, "--allow", "self", "--json-lines")
    frames = [event for event in map(json.loads, outcome.out.splitlines()) if event["event"] == "frame"]
    unknown = [frame["contacts"][0]["depth_unknown"] for frame in frames]
    assert [reason and reason["reason"] for reason in unknown] == [None, "open", None]
