"""Vertices that no triangle uses: no part of a mesh of arrays, and the others keep their numbers."""

import contactcheck
import numpy as np
import pytest

CORNERS = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
FACES = np.array([(0, 2, 3), (0, 3, 1), (4, 5, 7), (4, 7, 6), (0, 1, 5), (0, 5, 4),
                  (2, 6, 7), (2, 7, 3), (0, 4, 6), (0, 6, 2), (1, 3, 7), (1, 7, 5)])
PLACES = (0.0, 40.0, 1e12, -1e300)


def box(low, high):
    return low + (np.array(high, float) - low) * CORNERS, FACES


def strewn(mesh, place, at=2):
    """With a vertex at (place, place / 2, 0) before vertex `at`, which no triangle uses."""
    V, F = mesh
    return np.insert(V, at, (place, place / 2, 0), axis=0), np.where(F < at, F, F + 1)


ROOM, BALL = box((-4, -4, -4), (4, 4, 4)), box((-0.5, -0.5, -0.5), (0.5, 0.5, 0.5))


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize("at", (0, 3, 8))
def test_a_distance_is_as_without(place, at):
    expected = contactcheck.distance(*ROOM, *BALL)
    assert expected.lower == pytest.approx(3.5, abs=1e-8)
    for a, b in ((ROOM, strewn(BALL, place, at)), (strewn(ROOM, place, at), BALL),
                 (strewn(ROOM, place, at), strewn(BALL, -place, at))):
        found = contactcheck.distance(*a, *b)
        assert found[:2] == expected[:2] and np.array_equal(found.points, expected.points)


@pytest.mark.parametrize("place", PLACES)
def test_other_calls_answer_as_without(place):
    crossing = box((-5, -0.1, -0.1), (5, 0.1, 0.1))
    assert np.array_equal(contactcheck.contacts(*strewn(ROOM, place), *strewn(crossing, place)),
                          contactcheck.contacts(*ROOM, *crossing))
    points = [[0, 0, 0], [5, 0, 0], [4, 0, 0]]
    assert contactcheck.inside(points, *strewn(ROOM, place)).winding.tolist() == [1, 0, 0]
    for mine, expected in zip(contactcheck.point_distances(points, *strewn(BALL, place)),
                              contactcheck.point_distances(points, *BALL)):
        assert np.array_equal(mine, expected)
    both = np.vstack([ROOM[0], crossing[0]]), np.vstack([FACES, FACES + 8])
    for mine, expected in zip(contactcheck.self_contacts(*strewn(both, place)),
                              contactcheck.self_contacts(*both)):
        assert np.array_equal(mine, expected)


@pytest.mark.parametrize("place", PLACES)
def test_a_lattice_is_as_without(place):
    V, F = strewn(BALL, place)
    for cells in (40, (2, 3, 4)):
        lattice, expected = contactcheck.Lattice(V, F, cells), contactcheck.Lattice(*BALL, cells)
        assert np.array_equal(lattice.nodes, expected.nodes) and lattice.cells == expected.cells
        moved = lattice.nodes + [0, 0, 5]
        deformed = lattice.deform(moved)
        assert np.array_equal(np.delete(deformed, 2, axis=0), expected.deform(moved))
        assert np.array_equal(deformed[2], deformed[1])  # within the box of the others
        deformed[2] = place
        assert np.array_equal(lattice.fit(deformed), expected.fit(np.delete(deformed, 2, axis=0)))
    with pytest.raises(contactcheck.InputError, match="V has 8 rows; the vertices of the mesh are 9"):
        lattice.fit(BALL[0])


def test_a_detector_is_given_all_and_names_them_as_given():
    V, F = strewn(BALL, 99)
    detector = contactcheck.Detector("bullet-vf", margin=0.25)
    try:
        detector.prepare([ROOM, (V, F)])
    except contactcheck.Unavailable:
        pytest.skip("no Bullet")
    V = V + [3.3, 0, 0]  # the side x = 0.5 is at 3.8
    V[2] = 1e5
    detector.update([ROOM[0], V])
    near = detector.query("contacts")["near"]
    mine = {row[2] for row in near.tolist() if row[0] == 1}
    assert mine == set(np.flatnonzero(V[:, 0] == V[1, 0]).tolist()) - {2}
    with pytest.raises(contactcheck.InputError, match="has 8 rows; .* has 9 vertices"):
        detector.update([ROOM[0], BALL[0]])


class Silent:
    """Says that nothing touches."""

    def __init__(self, level):
        self.declares = {"id": "silent", "levels": [level], "questions": ["triangles"],
                         **({"margin": 0.5} if level == "near" else {})}

    def prepare(self, bodies):
        assert [body.vertices.shape for body in bodies] == [(8, 3), (8, 3)]
        assert all(body.faces.max() == 7 for body in bodies)

    def update(self, frame):
        assert [len(vertices) for vertices in frame.vertices] == [8, 8]

    def query(self, question):
        return {}


@pytest.mark.parametrize("level", ("vertex", "near"))
def test_what_a_detector_of_ones_own_misses_is_named_as_given(level):
    bodies = []
    for x, (V, F) in ((0, strewn(ROOM, 300, 0)), (3.75, strewn(BALL, -70, 3))):
        frames = [V + [x, 0, 0] for _ in range(2)]
        frames[1][3] = -1e6 if len(bodies) else frames[1][3]
        bodies.append((frames, F))
    scene = contactcheck.Scene.from_frames(bodies, levels=("body", level))
    results = contactcheck.run(scene, [Silent(level)], timing=False)
    missed = results.contacts("silent")[1]["missed"]
    assert len(missed) > 0
    numbers = {0: {n for n in range(1, 9)}, 1: {n for n in range(9) if n != 3}}
    inside = set(np.flatnonzero(bodies[1][0][0][:, 0] < 4).tolist())
    for a, _, vertex, _ in missed.tolist():
        assert vertex in numbers[a] and (level == "near" or a == 0 or vertex in inside)
    if level == "vertex":
        assert {tuple(row[:3]) for row in missed.tolist()} == {(1, 0, v) for v in inside - {3}}
    case = results.disagreements()[0]
    named = case["first"]
    V = bodies[0 if named["body"] == "body0" else 1][0][0]
    assert np.array_equal(named["position"], V[named["vertex"]])


@pytest.mark.parametrize("bad", (np.nan, np.inf))
def test_no_number_is_still_refused(bad):
    V, F = strewn(BALL, bad)
    with pytest.raises(contactcheck.InputError, match=r"Va\[2, 0\]"):
        contactcheck.distance(V, F, *ROOM)
