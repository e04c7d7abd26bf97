"""Distances of points, the first contacts, and how much is too much."""

import contactcheck
import numpy as np
import pytest

V, F = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float), np.array(
    [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])


def single(point, vertices, faces):
    return contactcheck.distance([point] * 3, [[0, 1, 2]], vertices, faces)


def random_mesh(random):
    vertices = random.uniform(-1, 1, (60, 3))
    faces = np.array([random.choice(60, 3, replace=False) for _ in range(40)])
    return vertices, np.vstack([faces, [[3, 3, 3], [4, 5, 4]]])  # a point and a segment


@pytest.mark.parametrize("scale", (1, 1e-160, 1e150))
def test_distances_of_points_are_those_of_single_calls(scale):
    random = np.random.default_rng(5)
    vertices, faces = random_mesh(random)
    vertices = vertices * scale
    points = np.vstack([random.uniform(-2, 2, (40, 3)) * scale, vertices[faces[:3, 0]],
                        [[1e4 * scale, 0, 0]], random.uniform(-2, 2, (5, 3)) * scale])
    found = contactcheck.point_distances(points, vertices, faces)
    assert found.lower.dtype == found.upper.dtype == found.points.dtype == np.float64
    assert found.triangles.dtype == np.int32
    assert found.points.shape == points.shape and found.triangles.shape == (len(points),)
    for i, point in enumerate(points):
        expected = single(point, vertices, faces)
        assert (found.lower[i], found.upper[i]) == (expected.lower, expected.upper)
        assert np.array_equal(found.points[i], expected.points[1])
        corners = vertices[faces[found.triangles[i]]]
        slack = 1e-9 * np.abs(corners).max()
        assert (found.points[i] >= corners.min(axis=0) - slack).all()
        assert (found.points[i] <= corners.max(axis=0) + slack).all()
    assert (found.upper[40:43] == 0).all() and (found.lower[:40] > 0).all()


def test_a_point_far_away_widens_no_other_interval():
    near = [0.25, 0.25, -2]
    alone = contactcheck.point_distances([near], V, F)
    assert alone.upper[0] - alone.lower[0] < 1e-9
    for far in ([1e300, 0, 0], [0, -1e12, 0], [5, 5, 5]):
        found = contactcheck.point_distances([far, near, far], V, F)
        assert found.lower[1] == alone.lower[0] and found.upper[1] == alone.upper[0]
        assert found.lower[0] == found.lower[2] == single(far, V, F).lower


def test_no_point_has_no_distance():
    found = contactcheck.point_distances(np.zeros((0, 3)), V, F)
    assert [part.shape for part in found] == [(0,), (0,), (0, 3), (0,)]


@pytest.mark.parametrize("points, sentence", (
    ([[0, np.nan, 0]], r"points\[0, 1\] is nan"),
    ([[0, 0, 0], [0, 0, np.inf]], r"points\[1, 2\] is inf"),
    ([0, 0, 0], "points has shape"),
    ([[0, 0]], "points has shape"),
))
def test_what_is_no_point_is_refused(points, sentence):
    with pytest.raises(contactcheck.InputError, match=sentence):
        contactcheck.point_distances(points, V, F)


def test_the_first_contacts_are_some_of_all():
    lying = np.tile(F, (5, 1))
    every = contactcheck.contacts(V, lying, V + 0.125, lying)
    assert len(every) > 50
    for first in (0, 1, 7, len(every) - 1, np.int64(len(every)), len(every) + 1):
        found = contactcheck.contacts(V, lying, V + 0.125, lying, first=first)
        assert len(found.pairs) == min(first, len(every)) and found.more == (first < len(every))
        rows = found.pairs.tolist()
        assert rows == sorted(rows) and {tuple(r) for r in rows} <= {tuple(r) for r in every.tolist()}
        again = contactcheck.contacts(V, lying, V + 0.125, lying, first=first)
        assert np.array_equal(again.pairs, found.pairs)
    apart = contactcheck.contacts(V, F, V + 9, F, first=3)
    assert apart.pairs.shape == (0, 2) and apart.more is False


@pytest.mark.parametrize("first", (-1, 1.5, "2", 2**64, [1]))
def test_what_is_no_number_of_contacts_is_refused(first):
    with pytest.raises(contactcheck.InputError, match="first="):
        contactcheck.contacts(V, F, V, F, first=first)


# 3,000 meshes on one another: found without the pairs of all others, which no memory holds.
def test_the_first_contacts_of_very_many_are_few():
    lying = np.tile(F, (3000, 1))
    found = contactcheck.contacts(V, lying, V, lying, first=1000)
    assert len(found.pairs) == 1000 and found.more


@pytest.mark.parametrize("name", ("ffd-lazy", "full-refit", "fcl-aabb", "embree"))
@pytest.mark.parametrize("announced", ((), ("self",), ("triangles",)))
def test_crowded_vertices_are_refused_whatever_was_announced(name, announced):
    count = 9001  # triangles round one vertex, each with an edge in common with the next
    angles = np.linspace(0, 6, count + 1)
    fan = np.vstack([[[0, 0, 0]], np.stack([np.cos(angles), np.sin(angles), 0 * angles], axis=1)])
    faces = np.stack([np.zeros(count, int), np.arange(1, count + 1), np.arange(2, count + 2)], axis=1)
    try:
        detector = contactcheck.Detector(name)
        if "self" not in detector.declares["questions"]:
            pytest.skip("does not answer self")
    except contactcheck.Unavailable:
        pytest.skip("not built")
    with pytest.raises(contactcheck.RefusedInput, match="in 40513500 pairs .vertex 0 is in 9001 tri"):
        detector.prepare([(fan, faces)], announced)
        detector.update([fan])
        detector.query("self")
