"""Queries of moving elements whose truth is known by construction, and the files of them.

    python3 tests/reference/queries/by_hand.py      # writes fixtures/queries/*/*.csv, prints what is where

Each family is a function whose docstring says why its truth is what it is. Nothing is solved: every
query has a proof of its truth, which by_hand_test.py checks in rationals.

Vertex-face: v, a, b, c; edge-edge: a0, a1, b0, b1. The first element is the vertex or the first edge.
"""

import dataclasses
import math
import pathlib
from fractions import Fraction

FOLDER = pathlib.Path(__file__).resolve().parents[3] / "fixtures" / "queries"
VERTEX_FACE, EDGE_EDGE = "vertex-face", "edge-edge"
SIZES = {VERTEX_FACE: (1, 3), EDGE_EDGE: (2, 2)}  # points of the first and of the second element

HALF = Fraction(1, 2)
TINY = Fraction(1, 2**1074)  # the least double above 0
X, Y, Z = (1, 0, 0), (0, 1, 0), (0, 0, 1)


@dataclasses.dataclass(frozen=True)
class Meet:
    """At time `at` the points of each element, with weights that are not negative and add up to 1, give
    the same point. At time 0 where a query begins in contact."""

    at: Fraction
    weights: tuple


@dataclasses.dataclass(frozen=True)
class Cross:
    """From one time to another the elements overlap strictly when looked at along an axis, and the four
    points turn from one side to the other: in between they are in one plane, and meet."""

    begin: Fraction
    end: Fraction
    axis: int


@dataclasses.dataclass(frozen=True)
class Apart:
    """Pieces (until, direction) that cover the step: at both ends of a piece, and so all through it, the
    first element is further along the direction than the second."""

    pieces: tuple


@dataclasses.dataclass(frozen=True)
class Query:
    kind: str
    start: tuple
    end: tuple
    proof: object

    @property
    def truth(self):
        return not isinstance(self.proof, Apart)


def unit(value):
    """The unit in the last place of a double."""
    return Fraction(math.ulp(float(value)))


def apart(*direction):
    return Apart(((1, direction),))


# --- What keeps the truth


def mapped(query, matrix, offset=(0, 0, 0), drift=(0, 0, 0)):
    """All points through one affine map, and all at one more velocity: that keeps what meets, and when.
    A direction that separates goes through the cofactors of the matrix, with the sign of its determinant."""
    def image(p, time):
        return tuple(dot(row, p) + o + time * d for row, o, d in zip(matrix, offset, drift))

    proof = query.proof
    if isinstance(proof, Apart):
        r = matrix
        cofactors = (cross(r[1], r[2]), cross(r[2], r[0]), cross(r[0], r[1]))
        sign = 1 if dot(r[0], cofactors[0]) > 0 else -1
        proof = Apart(tuple((until, tuple(sign * dot(row, direction) for row in cofactors))
                            for until, direction in proof.pieces))
    return Query(query.kind, tuple(image(p, 0) for p in query.start),
                 tuple(image(p, 1) for p in query.end), proof)


def moved(query, offset=(0, 0, 0), drift=(0, 0, 0)):
    return mapped(query, (X, Y, Z), offset, drift)


def sheared(query, drift=(0, 0, 0)):
    return mapped(query, ((1, 1, 0), (0, 1, 2), (1, 0, 1)), (1, 2, 3), drift)


def in_general_position(query, number):
    """Through a matrix of numbers of 45 bits: the coordinates are doubles, and their products round."""
    state, drawn = number, []
    for _ in range(12):
        state = (6364136223846793005 * state + 1442695040888963407) % 2**64  # Knuth's MMIX
        drawn.append((state >> 19) - 2**44)
    return mapped(query, (drawn[0:3], drawn[3:6], drawn[6:9]), drawn[9:12])


def scaled(query, s):
    return mapped(query, ((s, 0, 0), (0, s, 0), (0, 0, s)))


def backwards(query):
    """What meets in [0, 1] meets when it runs backwards."""
    return Query(query.kind, query.end, query.start, Meet(1 - query.proof.at, query.proof.weights))


def edges_swapped(query):
    """Either edge may be the first one."""
    first, second = query.proof.weights[:2], query.proof.weights[2:]
    return Query(query.kind, query.start[2:] + query.start[:2], query.end[2:] + query.end[:2],
                 Meet(query.proof.at, second + first))


# --- A vertex and a triangle

CORNERS = ((0, 0, 0), (4, 0, 0), (0, 4, 0))


def vertex(start, end, proof, corners=CORNERS, corners_end=None):
    return Query(VERTEX_FACE, (start, *corners), (end, *(corners_end or corners)), proof)


def at_place(time, x, y):
    """Meets CORNERS at (x, y, 0)."""
    return Meet(time, (1, 1 - Fraction(x + y) / 4, Fraction(x) / 4, Fraction(y) / 4))


def falls(x, y, proof):
    """The vertex is over (x, y) all the time and in the triangle's plane at t = 1/2 alone."""
    return vertex((x, y, 1), (x, y, -1), proof)


def through(x, y):
    return falls(x, y, at_place(HALF, x, y))


def inside_the_triangle():
    """x > 0, y > 0 and x + y < 4 at t = 1/2."""
    return [through(x, y) for x, y in ((1, 1), (Fraction(1, 2**20), 3))]


def beside_the_triangle():
    """x < 0, y < 0 or x + y > 4 all the time, by 1, 2 and 2^-30."""
    small = Fraction(1, 2**30)
    return [falls(-1, 1, apart(-1, 0, 0)), falls(2, -2, apart(0, -1, 0)),
            falls(2, 2 + small, apart(1, 1, 0))]


def on_edges_and_corners():
    """x = 0, y = 0 or x + y = 4, or two of these, at t = 1/2: triangles are closed."""
    return [through(x, y) for x, y in ((0, 1), (1, 3), (0, 0), (0, 4))]


def one_unit_from_an_edge():
    """The least doubles on either side of an edge: x = 2^-1074 or -2^-1074, and 1 + y one unit of 3 above
    or below 4."""
    return [falls(-TINY, 1, apart(-1, 0, 0)), falls(1, -TINY, apart(0, -1, 0)),
            falls(1, 3 + unit(3), apart(1, 1, 0)), through(TINY, 1), through(1, TINY),
            through(1, 3 - unit(3))]


def begins_in_contact():
    """At t = 0 the vertex is in the triangle, on an edge, at a corner; then it leaves."""
    return [vertex((1, 1, 0), (1, 1, 1), at_place(0, 1, 1)),
            vertex((2, 2, 0), (9, 9, -1), at_place(0, 2, 2)),
            vertex((0, 4, 0), (0, 5, 0), at_place(0, 0, 4))]


def nothing_moves():
    """All stay, or move at one velocity: in the triangle, over it, beside it in its plane, at a corner."""
    return [vertex((1, 1, 0), (1, 1, 0), at_place(0, 1, 1)),
            vertex((1, 1, TINY), (1, 1, TINY), apart(*Z)),
            vertex((2, 2 + unit(2), 0), (2, 2 + unit(2), 0), apart(1, 1, 0)),
            moved(vertex((0, 4, 0), (0, 4, 0), at_place(0, 0, 4)), drift=(3, -5, 7)),
            moved(vertex((1, 1, 1), (1, 1, 1), apart(*Z)), drift=(0, 0, -2))]


def ends_at_the_triangle():
    """z goes from 1 to 0: contact at t = 1 alone. Or to 2^-52, to 2^-1074, or from -1 to -2^-52: none."""
    return [vertex((1, 1, 1), (1, 1, 0), at_place(1, 1, 1)),
            vertex((5, 3, 1), (2, 2, 0), at_place(1, 2, 2)),
            vertex((1, 1, 1), (1, 1, unit(1)), apart(*Z)),
            vertex((1, 1, 1), (1, 1, TINY), apart(*Z)),
            vertex((1, 1, -1), (1, 1, -unit(1)), apart(0, 0, -1))]


def moves_along_the_plane():
    """z stays 2^-52, 2^-1074 or 1 above the triangle, which rises with the vertex in the last one."""
    return [vertex((-1, 1, unit(1)), (5, 1, unit(1)), apart(*Z)),
            vertex((-1, 1, TINY), (5, 1, TINY), apart(*Z)),
            moved(vertex((-1, 1, 1), (5, 1, 1), apart(*Z)), drift=(0, 0, 9))]


def stays_in_the_plane():
    """z = 0 all the time. The vertex goes through the triangle, stays in it, touches the corner (0, 4),
    passes one unit beyond it, runs along the line x + y = 4 or 2^-30 outside of it, ends on an edge, ends
    2^-53 before it."""
    small = Fraction(1, 2**30)
    sixth = Fraction(1, 6)
    return [vertex((-1, 1, 0), (5, 1, 0), at_place(sixth, 0, 1)),
            vertex((1, 1, 0), (2, 1, 0), at_place(0, 1, 1)),
            vertex((-1, 4, 0), (1, 4, 0), at_place(HALF, 0, 4)),
            vertex((-1, 4 + unit(4), 0), (1, 4 + unit(4), 0), apart(*Y)),
            vertex((5, -1, 0), (-1, 5, 0), at_place(sixth, 4, 0)),
            vertex((5, -1 + small, 0), (-1, 5 + small, 0), apart(1, 1, 0)),
            vertex((-1, 1, 0), (0, 1, 0), at_place(1, 0, 1)),
            vertex((-1, 1, 0), (-unit(HALF), 1, 0), apart(-1, 0, 0))]


def stays_in_another_plane():
    """In the plane x = 0 or y = 0. The vertex goes along the line on which the other two coordinates add
    up to 5/2, and crosses the corner (0, 0) of the triangle (0, 0), (16, 4), (4, 16) from (2, 1/2) to
    (1/2, 2). Or the triangle is 3 further along both axes, and so behind the line."""
    def crosses(axis, shift, proof):
        def place(p, q):
            return (0, p, q) if axis == 0 else (q, 0, p)

        corners = tuple(place(p + shift, q + shift) for p, q in ((0, 0), (16, 4), (4, 16)))
        return vertex(place(Fraction(7, 2), -1), place(-1, Fraction(7, 2)), proof, corners)

    enters = Meet(Fraction(1, 3), (1, Fraction(7, 8), Fraction(1, 8), 0))
    return [crosses(0, 0, enters), crosses(1, 0, enters), crosses(0, 3, apart(0, -1, -1))]


def degenerate_triangles():
    """The segment from (0, 0, 0) to (4, 0, 0), with two equal corners or one in between, and the point
    (2, 2, 0): the vertex falls through it, through an end, 2^-52 beside it, beyond its end. Or all is on
    one line: the vertex goes through a segment, or follows a point that is faster."""
    segment, between, point = ((0, 0, 0), (4, 0, 0), (4, 0, 0)), ((0, 0, 0), (4, 0, 0), (1, 0, 0)), (
        (2, 2, 0),) * 3

    def onto(corners, x, y, proof):
        return vertex((x, y, 1), (x, y, -1), proof, corners)

    return [onto(segment, 1, 0, at_place(HALF, 1, 0)), onto(segment, 4, 0, at_place(HALF, 4, 0)),
            onto(segment, 1, unit(1), apart(*Y)), onto(segment, 4 + unit(4), 0, apart(*X)),
            onto(between, 3, 0, at_place(HALF, 3, 0)),
            onto(point, 2, 2, Meet(HALF, (1, 1, 0, 0))), onto(point, 2, 2 + unit(2), apart(*Y)),
            vertex((-1, 0, 0), (3, 0, 0), Meet(Fraction(1, 4), (1, 1, 0, 0)), ((0, 0, 0), X, X)),
            vertex((-1, 0, 0), (3, 0, 0), apart(-1, 0, 0), ((0, 0, 0),) * 3, ((4, 0, 0),) * 3)]


def triangles_that_collapse():
    """Corners that go through the origin to their opposites are the point (0, 0, 0) at t = 1/2; before and
    after, x is above or below 0 in all of the triangle. A corner that goes from (0, 4) to (0, -4) or
    (0, -8) leaves the segment from (0, 0) to (4, 0) at t = 1/2 or 1/3, when the vertex comes through it, or
    2^-52 beside it."""
    away = ((1, 1, 0), (2, 1, 0), (1, 2, 0))
    opposite = tuple((-x, -y, -z) for x, y, z in away)
    flat, flatter = ((CORNERS[0], CORNERS[1], (0, y, 0)) for y in (-4, -8))
    third = Fraction(1, 3)

    def beside(at):
        short = Fraction(1, 2**60)  # in so short a time the corner moves by less than 2^-56
        return Apart(((at - short, Z), (at + short, Y), (1, (0, 0, -1))))

    return [vertex((0, 0, 0), (0, 0, 0), Meet(HALF, (1, 1, 0, 0)), away, opposite),
            vertex((0, 0, unit(1)), (0, 0, unit(1)), apart(*Z), away, opposite),
            vertex((1, 0, 1), (1, 0, -1), at_place(HALF, 1, 0), CORNERS, flat),
            vertex((1, unit(1), 1), (1, unit(1), -1), beside(HALF), CORNERS, flat),
            vertex((1, 0, 1), (1, 0, -2), at_place(third, 1, 0), CORNERS, flatter),
            vertex((1, unit(1), 1), (1, unit(1), -2), beside(third), CORNERS, flatter)]


def close_times():
    """The vertex is in the triangle's plane at t = 1/2 + 2^-43 alone. At 1/2 + 2^-44 the third corner, on
    its way from above (0, 0) to below, makes a segment of the triangle: when the vertex comes, the corner
    is at (0, -2^-41). With y = -2^-42 the vertex is inside, with y = 2^-60 outside. Likewise with the two
    times exchanged, and the corner at (0, 2^-41)."""
    first, second = HALF + Fraction(1, 2**44), HALF + Fraction(1, 2**43)
    middle = (first + second) / 2

    def comes(y, plane, flat, proof):
        def corners(time):
            return (0, 0, 0), (4, 0, 0), (0, 8 * (flat - time), 0)

        return vertex((1, y, plane), (1, y, plane - 1), proof, corners(0), corners(1))

    quarter, width = Fraction(1, 4), Fraction(1, 2**41)
    inside = (1, quarter, quarter, HALF)
    return [comes(-width / 2, second, first, Meet(second, inside)),
            comes(Fraction(1, 2**60), second, first, Apart(((middle, Z), (1, Y)))),
            comes(width / 2, first, second, Meet(first, inside))]


def close_times_of_a_crossing():
    """With s = t - 1/2 - 2^-42 and d = 2^-44, the vertex is at (s, 1/4 + s, s/4), and the plane of the
    triangle (-w, 0, -d^2), (w, 0, -d^2), (0, 1, s) is below it by d^2 (3/4 - s) - s^2: above 0 within
    d/2 of s = 0, below 0 at -d and d. So there are two times in the plane. With w = 2^-92 the vertex is
    left of the triangle at the first one, and right of it at the second. With the first corner at x = -1
    and the second at 0, it is inside at the first one."""
    now, d, w = HALF + Fraction(1, 2**42), Fraction(1, 2**44), Fraction(1, 2**92)
    quarter = Fraction(1, 4)

    def comes(left, right, proof):
        def corners(time):
            return (left, 0, -d * d), (right, 0, -d * d), (0, 1, time - now)

        return vertex(*((t - now, quarter + t - now, (t - now) / 4) for t in (0, 1)), proof, corners(0),
                      corners(1))

    beside = Apart(((now - 2 * w, (-1, 0, 0)), (now + 2 * w, (0, -d * d, 1)), (1, X)))
    return [comes(-w, w, beside), comes(-1, 0, Cross(now - d, now - d / 2, 2))]


def differences_that_round():
    """The vertex falls onto the edge from (4, 12) to (-4, -12), at (m, 3 m) with m = 5 * 2^-54: doubles round
    4 - m down and 12 - 3 m up. The third corner is on either side. Or it moves along that edge, in which
    the triangle is the point (m, 3 m)."""
    m, begin, end = Fraction(5, 2**54), (4, 12, 0), (-4, -12, 0)
    at, share = (4 - m) / 8, (4 + m) / 8
    place = Meet(HALF, (1, 0, share, 1 - share))
    sides = [vertex((m, 3 * m, 1), (m, 3 * m, -1), place, (third, begin, end))
             for third in ((12, -4, 0), (-12, 4, 0))]
    return [*sides, vertex(begin, end, Meet(at, (1, 1, 0, 0)), ((m, 3 * m, 0),) * 3)]


def triangles_in_general_position():
    """Onto and through edges, corners and the inside, and beside an edge: what a map of space keeps."""
    def onto(x, y):
        return vertex((x, y, 1), (x, y, 0), at_place(1, x, y))

    beside = falls(2, 2 + Fraction(1, 16), apart(1, 1, 0))
    return [in_general_position(query, number)
            for number, query in enumerate([onto(0, 1), through(4, 0), onto(1, 1), onto(2, 2), beside])]


def triangles_of_every_size():
    """From 1e-12 m to 1e12 m: coordinates are 0, 1, 2 and 4 times the double that is nearest to a power of
    ten. Through the inside; and one unit beside the middle of the long edge."""
    queries = []
    for power in (-12, -6, -3, 6, 12):
        s = Fraction(10.0**power)
        beside = 2 * s + unit(2 * s)
        queries += [scaled(through(1, 1), s), scaled(falls(beside / s, 2, apart(1, 1, 0)), s)]
    return queries


def triangles_far_away():
    """Whole numbers up to 2^52, where the unit in the last place is 1: through the inside, an edge and one
    unit beside."""
    near, far = (2**50, -2**50, 2**49), (2**52, 2**52, -2**52)
    return [moved(through(1, 1), near), moved(falls(-1, 1, apart(-1, 0, 0)), near),
            moved(through(2, 2), far), moved(falls(2, 3, apart(1, 1, 0)), far)]


def triangles_that_move():
    """Sheared, and at one more velocity. With (0, 0, 2) more, the vertex rests and the triangle comes."""
    return [sheared(through(1, 1), (8, -3, 5)), sheared(through(2, 2), (8, -3, 5)),
            sheared(falls(3, 3, apart(1, 1, 0)), (1, 1, 1)),
            moved(through(0, 4), drift=(0, 0, 2))]


def planes_that_turn():
    """The triangle turns about the x axis and meets it in its corner (0, 0, 0) alone. The vertex runs
    along the axis and is there at t = 1/2; or ends 2^-53 before. At y = 0, z = 1/4 it is in the triangle
    at t = 1/2 alone, when that stands in the plane y = 0. At z = -1/4 it is below the triangle."""
    begin, end = ((0, 0, 0), (-2, 2, 0), (2, 2, 0)), ((0, 0, 0), (-2, -2, 2), (2, -2, 2))
    quarter = Fraction(1, 4)
    before = Apart(((quarter, (-1, -8, 0)), (1, (-1, 0, -8))))
    over = Meet(HALF, (1, Fraction(3, 4), Fraction(1, 8), Fraction(1, 8)))
    return [vertex((-1, 0, 0), (1, 0, 0), Meet(HALF, (1, 1, 0, 0)), begin, end),
            vertex((-1, 0, 0), (-unit(HALF), 0, 0), before, begin, end),
            vertex((-1, 0, quarter), (1, 0, quarter), over, begin, end),
            vertex((-1, 0, -quarter), (1, 0, -quarter), apart(0, 0, -1), begin, end)]


def meets_in_the_plane(query, at):
    """The same points with the weights, at that time, of a place where the elements meet when they are
    looked at along z: by areas, nothing is solved for the time."""
    p = [tuple(a + at * (b - a) for a, b in zip(*ends)) for ends in zip(query.start, query.end)]

    def area(a, b, c):
        return Fraction((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))

    if query.kind == VERTEX_FACE:
        v, a, b, c = p
        whole = area(a, b, c)
        weights = (1, area(v, b, c) / whole, area(a, v, c) / whole, area(a, b, v) / whole)
    else:
        a0, a1, b0, b1 = p
        weights = (*shares(area(b0, b1, a0), area(b0, b1, a1)), *shares(area(a0, a1, b0), area(a0, a1, b1)))
    return dataclasses.replace(query, proof=Meet(at, weights))


def shares(first, second):
    """Weights of two points on either side of a line, at distances of that proportion, of the place
    where their connection meets it."""
    return second / (second - first), first / (first - second)


def many_contacts_of_a_vertex():
    """Three or four separate times of contact, found by a search for many: a place of contact in one of
    them is given, or a crossing. The fourth query is in contact at t = 1/4, 1/2 and 4/5."""
    three = vertex((0, 2, 0), (-3, 0, 0), None, ((-8, -2, 0), (-49, 50, 0), (0, 6, 0)),
                   ((-3, 3, 0), (41, -33, 0), (3, -17, 0)))
    four = vertex((-46, -6, 0), (-55, 14, 0), None, ((-48, -19, 0), (-214, 193, 0), (-1, 188, 0)),
                  ((-60, 20, 0), (83, -76, 0), (-97, -274, 0)))
    instants = vertex((0, 2, 153932), (-3, 0, -1280943), None,
                      ((-8, -2, -5434960), (-49, 50, -1428626), (0, 6, 0)),
                      ((-3, 3, 0), (41, -33, 0), (3, -17, 0)))
    resting = vertex((0, 0, 0), (0, 0, 0), Cross(Fraction(2, 100), Fraction(3, 100), 2),
                     ((2, 1, -4), (3, 5, 3), (-1, 0, 1)), ((-9, 3, 3), (4, 7, -13), (18, -19, 11)))
    rising = vertex((0, 0, 0), (0, 0, 0), Cross(Fraction(4, 100), Fraction(6, 100), 2),
                    ((0, -4, -3), (4, 3, 3), (-1, 5, 3)), ((-2, -13, 5), (-4, 2, -6), (2, 3, -4)))
    three = meets_in_the_plane(three, Fraction(1, 5))
    return [three, backwards(three), meets_in_the_plane(four, 0),
            meets_in_the_plane(instants, Fraction(1, 4)), resting, rising]


def flips_as_floats():
    """Triangles (0, 0), (c, 0), (0, c), where rounding to floats moves the vertex across an edge: x + y is
    above c = 1 by 2^-29, and not as floats; and it is below c, and not as floats."""
    x = HALF + Fraction(1, 2**30)
    c, inside_x, inside_y = map(Fraction, map(float.fromhex, (
        "0x1.0000006666666p+0", "0x1.000001051eb85p-1", "0x1.ffffff3333333p-2")))
    place = Meet(HALF, (1, 1 - (inside_x + inside_y) / c, inside_x / c, inside_y / c))
    return [vertex((x, x, 1), (x, x, -1), apart(1, 1, 0), ((0, 0, 0), (1, 0, 0), (0, 1, 0))),
            vertex((inside_x, inside_y, 1), (inside_x, inside_y, -1), place,
                   ((0, 0, 0), (c, 0, 0), (0, c, 0)))]


# --- Two edges


def edges(first, second, proof, first_end=None, second_end=None):
    return Query(EDGE_EDGE, (*first, *second), (*(first_end or first), *(second_end or second)), proof)


def at_height(first, z):
    return tuple((x, y, z) for x, y in first)


def over(x, y, proof, z=1, to=-1):
    """An edge along x of length 4 with its middle over (x, y), at heights from z to `to`, and one along y
    of length 4 about the origin. Seen from above they are where they are all the time."""
    first = ((x - 2, y), (x + 2, y))
    return edges(at_height(first, z), ((0, -2, 0), (0, 2, 0)), proof, at_height(first, to))


def crossing(x, y, at=HALF, z=1, to=-1):
    """They meet at (0, y, 0) if |x| and |y| are at most 2, when the first one comes to height 0."""
    return over(x, y, Meet(at, (Fraction(2 + x) / 4, Fraction(2 - x) / 4, Fraction(2 - y) / 4,
                                Fraction(2 + y) / 4)), z, to)


def inside_both_edges():
    """|x| < 2 and |y| < 2."""
    return [crossing(x, y) for x, y in ((0, 0), (-Fraction(3, 2), Fraction(7, 4)))]


def beside_an_edge():
    """|x| is above 2, by 1 and by 2^-30: one edge is on one side of the other."""
    return [over(-3, 1, apart(-1, 0, 0)), over(2 + Fraction(1, 2**30), 0, apart(*X))]


def at_an_end():
    """|x| = 2, |y| = 2 or both: an end meets the inside or an end of the other edge."""
    return [crossing(x, y) for x, y in ((0, -2), (-2, 1), (2, 2), (-2, 2))]


def one_unit_from_an_end():
    """The end is 2^-1074 beyond or before the line of the other edge, or one unit of 2 from its end."""
    def from_to(begin, end, y, proof):
        """The first edge from x = begin to x = end."""
        first = ((begin, y), (end, y))
        return edges(at_height(first, 1), ((0, -2, 0), (0, 2, 0)), proof, at_height(first, -1))

    def met(begin, end, y):
        return from_to(begin, end, y, Meet(HALF, (*shares(Fraction(begin), Fraction(end)),
                                                  Fraction(2 - y) / 4, Fraction(2 + y) / 4)))

    return [from_to(TINY, 2, 0, apart(*X)), from_to(-2, -TINY, 1, apart(-1, 0, 0)),
            from_to(-1, 1, 2 + unit(2), apart(*Y)), met(-2, TINY, 1),
            met(-1, 1, 2 - unit(1))]


def edges_begin_in_contact():
    """At t = 0 they cross, meet in an end, in two ends, or overlap on one line; then they part."""
    lifted = edges(((1, 0, 0), (4, 0, 0)), ((0, 0, 0), (2, 0, 0)), Meet(0, (1, 0, HALF, HALF)),
                   ((1, 0, 1), (4, 0, 1)))
    return [crossing(0, 1, 0, 0, 1), crossing(2, 0, 0, 0, -1), crossing(2, 2, 0, 0, 1), lifted]


def no_edge_moves():
    """All stay, or move at one velocity: end to end, 2^-1074 above, parallel, crossing, above."""
    return [crossing(2, -2, 0, 0, 0), over(0, 0, apart(*Z), TINY, TINY),
            edges(((0, 1, 0), (4, 1, 0)), ((0, 0, 0), (4, 0, 0)), apart(*Y)),
            moved(crossing(1, 1, 0, 0, 0), drift=(3, -5, 7)), moved(over(0, 0, apart(*Z), 1, 1),
                                                                    drift=(0, 0, -2))]


def ends_at_the_edge():
    """The height goes from 1 to 0: contact at t = 1 alone. Or to 2^-52, 2^-1074, or from -1 to -2^-52."""
    return [crossing(0, 1, 1, 1, 0), crossing(2, 2, 1, -1, 0),
            over(0, 1, apart(*Z), 1, unit(1)), over(0, 1, apart(*Z), 1, TINY),
            over(0, 1, apart(0, 0, -1), -1, -unit(1))]


def parallel_edges():
    """Both along x. The first one falls or sweeps onto the other's line: they overlap, meet in an end, or
    have a gap of one unit. It moves above it at height 1 and 2^-52, and stops 2^-53 before it."""
    second = ((0, 0, 0), (2, 0, 0))

    def onto(begin, end, proof):
        first = ((begin, 0), (end, 0))
        return edges(at_height(first, 1), second, proof, at_height(first, -1))

    def past(z, to=(3, 0)):
        return edges(((-3, 0, z), (-1, 0, z)), second, apart(*Z), tuple((x, 0, z) for x in to))

    return [onto(1, 3, Meet(HALF, (1, 0, HALF, HALF))), onto(2, 4, Meet(HALF, (1, 0, 0, 1))),
            onto(2 + unit(2), 4, apart(*X)), past(1), past(unit(1), (3, 5)),
            edges(((0, 1, 0), (2, 1, 0)), second, Meet(HALF, (1, 0, 1, 0)), ((0, -1, 0), (2, -1, 0))),
            edges(((0, 1, 0), (2, 1, 0)), second, apart(*Y), ((0, unit(HALF), 0), (2, unit(HALF), 0)))]


def edges_on_one_line():
    """All on the x axis, the second one from 0 to 2. The first one comes from the left: it gets there at
    t = 1/2, at t = 1, ends 2^-53 before, goes through, rests with its end there, or one unit before."""
    second = ((0, 0, 0), (2, 0, 0))

    def slides(begin, end, to_begin, to_end, proof):
        return edges(((begin, 0, 0), (end, 0, 0)), second, proof, ((to_begin, 0, 0), (to_end, 0, 0)))

    left = apart(-1, 0, 0)
    return [slides(-3, -1, -1, 1, Meet(HALF, (0, 1, 1, 0))), slides(-3, -1, -2, 0, Meet(1, (0, 1, 1, 0))),
            slides(-3, -1, -2, -unit(HALF), left), slides(-6, -4, 6, 8, Meet(Fraction(1, 3), (0, 1, 1, 0))),
            slides(-2, 0, -2, 0, Meet(0, (0, 1, 1, 0))), slides(-2, -TINY, -2, -TINY, left)]


def edges_in_one_plane():
    """z = 0. The first edge, from (x, 0) to (x, 2), moves from x = -3 to 3; the second one, from x = -1 to
    1, is at height 1, at 2 (ends touch), one unit above. Or the first one ends at -1, one unit before, or
    begins at 0."""
    def sweeps(y, proof, begin=-3, end=3):
        return edges(((begin, 0, 0), (begin, 2, 0)), ((-1, y, 0), (1, y, 0)), proof,
                     ((end, 0, 0), (end, 2, 0)))

    third = Fraction(1, 3)
    middle = (HALF, HALF, 1, 0)
    return [sweeps(1, Meet(third, middle)), sweeps(2, Meet(third, (0, 1, 1, 0))),
            sweeps(2 + unit(2), apart(0, -1, 0)), sweeps(1, Meet(1, middle), -3, -1),
            sweeps(1, apart(-1, 0, 0), -3, -1 - unit(1)), sweeps(1, Meet(0, (HALF, HALF, HALF, HALF)), 0, 3)]


def edges_in_another_plane():
    """In the plane x = 0 or y = 0, the first edge goes along the line on which the other two coordinates
    add up to 5/2, and through the second one, from (0, 0) to (4, 16), at (1/2, 2). Or that one is 3 further
    along both axes, and so behind the line."""
    def crosses(axis, shift, proof):
        def place(p, q):
            return (0, p, q) if axis == 0 else (q, 0, p)

        def at(p):
            return place(p, Fraction(5, 2) - p), place(p + Fraction(1, 8), Fraction(19, 8) - p)

        return edges(at(Fraction(7, 2)), (place(shift, shift), place(4 + shift, 16 + shift)), proof, at(-1))

    comes = Meet(Fraction(2, 3), (1, 0, Fraction(7, 8), Fraction(1, 8)))
    return [crosses(0, 0, comes), crosses(1, 0, comes), crosses(1, 3, apart(-1, 0, -1))]


def edges_that_are_points():
    """A point falls through the edge from (0, -2, 0) to (0, 2, 0), or 2^-52 beside it, or moves on the edge's
    line into it. Two points meet at t = 1/2; or are at the only place that both pass, the origin, at
    t = 1/2 and t = 1/4; or rest at one place, or at two."""
    second = ((0, -2, 0), (0, 2, 0))

    def point(start, end, proof, other=second, other_end=None):
        return edges((start, start), other, proof, (end, end), other_end)

    def both(start, end):
        return ((start, start), (end, end))

    quarter, later = Fraction(1, 4), Fraction(3, 8)
    origin = (0, 0, 0)
    return [point((0, 1, 1), (0, 1, -1), Meet(HALF, (1, 0, quarter, 1 - quarter))),
            point((unit(1), 1, 1), (unit(1), 1, -1), apart(*X)),
            point((0, -4, 0), (0, 0, 0), Meet(HALF, (1, 0, 1, 0))),
            point((-1, 0, 0), (1, 0, 0), Meet(HALF, (1, 0, 1, 0)), *both((0, -1, 0), (0, 1, 0))),
            point((-1, 0, 0), (1, 0, 0), Apart(((later, (-1, 0, 0)), (1, (0, -1, 0)))),
                  *both((0, -1, 0), (0, 3, 0))),
            point(origin, origin, Meet(0, (1, 0, 1, 0)), *both(origin, origin)),
            point(origin, origin, apart(0, 0, -1), *both((0, 0, TINY), (0, 0, TINY)))]


def edges_that_collapse():
    """An edge from (1, 1) to (2, 1) that goes through the origin to its opposite is the point (0, 0) at
    t = 1/2; before and after, it is off the z axis. The other edge, on that axis, begins below the origin,
    or 2^-52 above. An edge whose ends change places, and at t = 1/3 go on to twice the distance, is a point
    at t = 1/2 (or 1/3), when the other one comes through it, or 2^-52 beside it."""
    def shrinks(z, proof):
        return edges(((1, 1, 0), (2, 1, 0)), ((0, 0, z), (0, 0, 1)), proof, ((-1, -1, 0), (-2, -1, 0)))

    def comes(y, to, proof):
        first = ((-2, y), (2, y))
        return edges(at_height(first, 1), ((0, -1, 0), (0, 1, 0)), proof, at_height(first, -to),
                     ((0, to, 0), (0, -to, 0)))

    def beside(at):
        short = Fraction(1, 2**60)
        return Apart(((at - short, Z), (at + short, Y), (1, (0, 0, -1))))

    third, met = Fraction(1, 3), (HALF, HALF, 1, 0)
    return [shrinks(-1, Meet(HALF, (1, 0, HALF, HALF))), shrinks(unit(1), apart(0, 0, -1)),
            comes(0, 1, Meet(HALF, met)), comes(unit(1), 1, beside(HALF)),
            comes(0, 2, Meet(third, met)), comes(unit(1), 2, beside(third))]


def close_times_of_edges():
    """The first edge is at height 0 at t = 1/2 + 2^-43 alone. At 1/2 + 2^-44 the second one, whose ends
    go through the origin to the other side, is a point: when the first one comes, it is from (0, -2^-42) to
    (0, 2^-42). The first one is over y = 0, y = 2^-42, 2^-41. Likewise with the two times exchanged."""
    first, second = HALF + Fraction(1, 2**44), HALF + Fraction(1, 2**43)
    width = Fraction(1, 2**42)

    def comes(y, plane, flat, proof):
        def ends(time):
            return (0, 4 * (time - flat), 0), (0, 4 * (flat - time), 0)

        along = ((-2, y), (2, y))
        return edges(at_height(along, plane), ends(0), proof, at_height(along, plane - 1), ends(1))

    middle, after = (first + second) / 2, second + Fraction(1, 2**50)
    beside = Apart(((middle, Z), (after, Y), (1, (0, 0, -1))))
    return [comes(0, second, first, Meet(second, (HALF, HALF, HALF, HALF))),
            comes(width, second, first, Meet(second, (HALF, HALF, 1, 0))),
            comes(2 * width, second, first, beside),
            comes(-width, first, second, Meet(first, (HALF, HALF, 1, 0)))]


def edges_whose_differences_round():
    """As differences_that_round(): an edge that begins at (m, 3 m) and goes to either side falls onto the
    edge; a point moves along it, through the point (m, 3 m)."""
    m, second = Fraction(5, 2**54), ((4, 12, 0), (-4, -12, 0))
    at, share = (4 - m) / 8, (4 + m) / 8

    def falls_onto(side):
        first = ((m, 3 * m), side)
        return edges(at_height(first, 1), second, Meet(HALF, (1, 0, share, 1 - share)), at_height(first, -1))

    passes = edges((second[0],) * 2, ((m, 3 * m, 0),) * 2, Meet(at, (1, 0, 1, 0)), (second[1],) * 2)
    return [falls_onto((12, -4)), falls_onto((-12, 4)), passes]


def edges_in_general_position():
    """They come to the other edge at t = 1, cross it, meet it in an end or pass beside an end: what a map
    of space keeps."""
    small = Fraction(1, 16)
    queries = [crossing(2, 2), crossing(0, 1, 1, 1, 0), crossing(1, -2), over(2 + small, 1, apart(*X)),
               over(1, -2 - small, apart(0, -1, 0)), crossing(0, 1, 1, 1, 0)]
    return [in_general_position(query, number) for number, query in enumerate(queries)]


def edges_of_every_size():
    """From 1e-12 m to 1e12 m, as triangles_of_every_size(): through the middle; one unit beside an end."""
    queries = []
    for power in (-12, -6, -3, 6, 12):
        s = Fraction(10.0**power)
        beside = 2 + unit(2 * s) / s
        queries += [scaled(crossing(0, 0), s), scaled(over(0, beside, apart(*Y)), s)]
    return queries


def edges_far_away():
    """Whole numbers up to 2^52, where the unit in the last place is 1."""
    near, far = (2**50, -2**50, 2**49), (2**52, 2**52, -2**52)
    return [moved(crossing(0, 0), near), moved(over(3, 0, apart(*X)), near), moved(crossing(2, 2), far),
            moved(over(0, 3, apart(*Y)), far)]


def edges_that_move():
    """Sheared, and at one more velocity."""
    return [sheared(crossing(0, 0), (8, -3, 5)), sheared(crossing(2, 1), (8, -3, 5)),
            sheared(over(1, -3, apart(0, -1, 0)), (1, 1, 1)), moved(crossing(1, 1), drift=(0, 0, 2))]


def planes_of_edges_that_turn():
    """The first edge turns about the x axis and meets it in its end (0, 0, 0) alone. The second one lies on
    the axis; its end gets to the origin at t = 1/2, or ends 2^-53 before."""
    def comes_to(x, proof):
        return edges(((0, 0, 0), (0, 2, 0)), ((-5, 0, 0), (-1, 0, 0)), proof, ((0, 0, 0), (0, -2, 2)),
                     ((-5, 0, 0), (x, 0, 0)))

    return [comes_to(1, Meet(HALF, (1, 0, 0, 1))), comes_to(-unit(HALF), apart(*X))]


def many_contacts_of_edges():
    """Three to five separate times of contact, found by a search for many: a place of contact in one of
    them is given, or a crossing. The last query is in contact at t = 1/5, 9/20 and 3/4."""
    four = edges(((-26, -11, 0), (0, -2, 0)), ((-8, 7, 0), (3, -3, 0)), None,
                 ((25, 10, 0), (9, -1, 0)), ((13, -3, 0), (-9, 0, 0)))
    five = edges(((-94, -42, 0), (18, -41, 0)), ((-108, -194, 0), (41, 15, 0)), None,
                 ((-54, 27, 0), (-415, -148, 0)), ((-78, 274, 0), (-231, -61, 0)))
    crossings = edges(((3, -3, 0), (1, -1, -2)), ((2, -1, -2), (-4, -4, 2)),
                      Cross(Fraction(1, 100), Fraction(2, 100), 2), ((6, 4, 1), (-2, -11, -1)),
                      ((2, -8, -14), (2, -3, 12)))
    instants = edges(((-26, -11, 30744013), (0, -2, -2146695)), ((-8, 7, -12372809), (3, -3, 0)), None,
                     ((25, 10, -37676430), (9, -1, 0)), ((13, -3, 0), (-9, 0, 0)))
    four = meets_in_the_plane(four, Fraction(3, 20))
    return [four, edges_swapped(four), meets_in_the_plane(five, 0), crossings,
            meets_in_the_plane(instants, Fraction(1, 5))]


# --- Coordinates that are no doubles


def no_doubles():
    """As above, the vertex is over (x, y) all the time and in the plane at one time. Thirds and tenths on an
    edge, and 2^-70 beside it; lengths of 10^400 and 10^-400 m; whole numbers above 2^53; heights of 1/3 and
    -2/3, so that they meet at t = 1/3."""
    third, tenth = Fraction(1, 3), Fraction(1, 10)
    small = Fraction(1, 2**70)
    huge = 10**400
    return [through(4 * third, 8 * third), falls(4 * third + small, 8 * third, apart(1, 1, 0)),
            through(4 * tenth, 36 * tenth), falls(4 * tenth, 36 * tenth + small, apart(1, 1, 0)),
            scaled(through(1, 1), huge), scaled(falls(2, 3, apart(1, 1, 0)), Fraction(1, huge)),
            moved(through(2, 2), (2**53 + 1, 0, 0)),
            vertex((1, 1, third), (1, 1, third - 1), at_place(third, 1, 1))]


# --- Files


def text_of(queries):
    """Eight lines a query, as the public collections have them."""
    lines = []
    for query in queries:
        for point in (*query.start, *query.end):
            parts = (part for x in map(Fraction, point) for part in (x.numerator, x.denominator))
            lines.append(",".join(map(str, (*parts, int(query.truth)))))
    return "\n".join(lines) + "\n"


FAMILIES = {
    "vertex-face/by_hand.csv": (
        inside_the_triangle, beside_the_triangle, on_edges_and_corners, one_unit_from_an_edge,
        begins_in_contact, nothing_moves, ends_at_the_triangle, moves_along_the_plane, stays_in_the_plane,
        stays_in_another_plane, degenerate_triangles, triangles_that_collapse, close_times,
        close_times_of_a_crossing, differences_that_round, triangles_in_general_position,
        triangles_of_every_size, triangles_far_away, triangles_that_move, planes_that_turn,
        many_contacts_of_a_vertex, flips_as_floats),
    "edge-edge/by_hand.csv": (
        inside_both_edges, beside_an_edge, at_an_end, one_unit_from_an_end, edges_begin_in_contact,
        no_edge_moves, ends_at_the_edge, parallel_edges, edges_on_one_line, edges_in_one_plane,
        edges_in_another_plane, edges_that_are_points, edges_that_collapse, close_times_of_edges,
        edges_whose_differences_round, edges_in_general_position, edges_of_every_size, edges_far_away,
        edges_that_move, planes_of_edges_that_turn, many_contacts_of_edges),
    "vertex-face/no_doubles.csv": (no_doubles,)}


def queries_of(name):
    return [query for family in FAMILIES[name] for query in family()]


def lines_of(name):
    """The first line of each family."""
    line = 1
    for family in FAMILIES[name]:
        yield line, family.__name__
        line += 8 * len(family())


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


if __name__ == "__main__":
    for name in FAMILIES:
        (FOLDER / name).parent.mkdir(parents=True, exist_ok=True)
        (FOLDER / name).write_text(text_of(queries_of(name)), encoding="utf-8")
        for line, family in lines_of(name):
            print(f"{name}:{line}: {family}")
