"""The functions of the module, against the command line's answers and against numpy."""

import json

import contactcheck
import numpy as np
import pytest
import recording

TETRAHEDRON = ([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])


def test_contacts_are_those_of_the_command_line(bunnies):
    for frame in bunnies:
        (Va, Fa), (Vb, Fb) = frame.bodies
        found = contactcheck.contacts(Va, Fa, Vb, Fb)
        assert found.dtype == np.int32
        assert np.array_equal(found, frame.contacts[:, 2:])


def test_self_contacts_are_those_of_the_command_line(letter):
    ((V, F),) = letter.bodies
    pairs, shared = contactcheck.self_contacts(V, F)
    assert np.array_equal(pairs, letter.contacts[:, 2:])
    expected = [len(set(F[a]) & set(F[b])) for a, b in pairs]
    assert np.array_equal(shared, expected)


def test_welding_makes_neighbours_of_triangles_with_corners_of_their_own():
    V, F = np.array(TETRAHEDRON[0], float), np.array(TETRAHEDRON[1])
    soup, triangles = V[F].reshape(-1, 3), np.arange(12).reshape(-1, 3)
    assert len(contactcheck.self_contacts(soup, triangles).pairs) == 6
    assert len(contactcheck.self_contacts(soup, triangles, weld=True).pairs) == 0


def test_impacts_have_a_first_time():
    """A vertex falls through a triangle, beside it, onto it at the end, and rests on it; two edges pass."""
    still = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
    falls = [((0.25, 0.25, 1), (0.25, 0.25, -3)), ((0.75, 0.75, 1), (0.75, 0.75, -3)),
             ((0.5, 0.5, 8), (0.5, 0.5, 0)), ((0, 0, 0), (0, 0, 1))]
    start, end = (np.array([[fall[at], *still] for fall in falls]) for at in (0, 1))
    found = contactcheck.impact("vertex-face", start, end)
    assert found.contact.tolist() == [True, False, True, True]
    assert found.starts.tolist() == [False, False, False, True]
    for time, earliest, latest in zip((0.25, 0, 1, 0), found.earliest, found.latest):
        assert earliest <= time <= latest and latest - earliest <= 2**-40
    across = np.array([[[0, -1, 2], [0, 1, 2], [-1, 0, 0], [1, 0, 0]]], np.float32)
    found = contactcheck.impact("edge-edge", across, across - [0, 0, 4] * np.array([[[1], [1], [0], [0]]]))
    assert found.contact.tolist() == [True] and found.earliest[0] <= 0.5 <= found.latest[0]
    assert len(contactcheck.impact("edge-edge", start[:0], end[:0]).contact) == 0


def test_distance_is_that_of_the_command_line(bunnies, bunny_run):
    (scene,) = json.loads((bunny_run / "results.json").read_text())["scenes"]
    assert len(scene["separation"]) == len(bunnies)
    for frame, separation in zip(bunnies, scene["separation"]):
        (Va, Fa), (Vb, Fb) = frame.bodies
        lower, upper, points = contactcheck.distance(Va, Fa, Vb, Fb)
        assert lower <= separation <= upper + 1e-9
        assert (upper == 0) == (len(frame.contacts) > 0)
        assert np.linalg.norm(points[0] - points[1]) == pytest.approx(upper, abs=2e-9)
        # Each point is in the box of its own body's vertices at least, and on a touching frame in both.
        for point, V in zip(points, (Va, Vb)):
            assert np.all(point >= V.min(axis=0) - 1e-12) and np.all(point <= V.max(axis=0) + 1e-12)


def cube(low, high):
    V = np.array([[x, y, z] for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)])
    F = [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
         [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]
    return np.array(low) + V * (np.array(high) - np.array(low)), np.array(F)


def test_depth_of_crossed_bars_needs_no_vertex_inside():
    along_x, along_y = cube((-6, -0.5, -0.5), (6, 0.5, 0.5)), cube((-1, -6, 0.25), (1, 6, 2))
    for a, b in ((along_x, along_y), (along_y, along_x)):
        lower, upper = contactcheck.depth(*a, *b)
        assert lower <= 0.25 <= upper <= 1.001 * lower
    assert contactcheck.depth(*along_x, along_y[0] + [0, 0, 9], along_y[1]) == (0, 0)


@pytest.mark.parametrize("names", ["Va, Fa", "Vb, Fb"])
def test_depth_into_what_is_no_simple_solid_raises_with_the_reason(names):
    V, F = cube((0, 0, 0), (1, 1, 1))
    for faces, reason in ((F[1:], r"open \(edge of vertices \d+ and \d+\)"),
                          (np.vstack([F, F[:, ::-1]]), "no interior"), (np.vstack([F, F]), "nested")):
        meshes = [(V, faces), (V + 0.5, F)]
        with pytest.raises(contactcheck.InputError, match=f"{names} is not a simple solid: {reason}"):
            contactcheck.depth(*meshes[names != "Va, Fa"], *meshes[names == "Va, Fa"])


def solid_angles(points, V, F):
    """The winding number by solid angles (van Oosterom & Strackee 1983): another way, in doubles."""
    a, b, c = (V[F[:, k]][None] - points[:, None] for k in range(3))
    la, lb, lc = (np.linalg.norm(x, axis=2) for x in (a, b, c))
    volume = np.einsum("ijk,ijk->ij", a, np.cross(b, c))
    dot = lambda x, y: np.einsum("ijk,ijk->ij", x, y)
    below = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb
    return np.sum(2 * np.arctan2(volume, below), axis=1) / (4 * np.pi)


def test_inside_agrees_with_solid_angles(bunnies):
    V, F = bunnies[0].bodies[0]
    random = np.random.default_rng(4)
    points = random.uniform(V.min(axis=0), V.max(axis=0), (400, 3))
    winding, on_surface = contactcheck.inside(points, V, F)
    assert np.array_equal(winding, np.rint(solid_angles(points, V, F)))
    assert 20 < np.count_nonzero(winding) < 380 and not on_surface.any()
    assert np.array_equal(contactcheck.inside(points, V, F[:, ::-1]).winding, -winding)


def test_inside_tells_what_lies_on_the_surface(bunnies):
    V, F = bunnies[0].bodies[0]
    assert contactcheck.inside(V[:200], V, F).on_surface.all()
    V, F = TETRAHEDRON
    winding, on_surface = contactcheck.inside([[0.25, 0.25, 0], [0.25, 0.25, 5e-324]], V, F)
    assert winding.tolist() == [0, 1] and on_surface.tolist() == [True, False]


def welded(V, F):
    """The same with one vertex for all that are at one place."""
    V, at = np.unique(V + 0.0, axis=0, return_inverse=True)
    return V, at.ravel()[F]


def test_inside_answers_for_every_closed_chain():
    V, F = (np.array(x, float if k == 0 else int) for k, x in enumerate(TETRAHEDRON))
    points = [[0.1, 0.1, 0.1], [0.1, 0.1, 0.7], [2, 2, 2]]
    corners = V[F].reshape(-1, 3), np.arange(3 * len(F)).reshape(-1, 3)
    minus = corners[0].copy()
    minus[::2][minus[::2] == 0] = -0.0
    wall = np.vstack([F, [[0, 1, 2], [0, 2, 1]]])
    middle = np.vstack([V, (V[0] + V[1]) / 2])
    filled = np.vstack([[t for t in F.tolist() if t != [0, 1, 3]], [[0, 4, 3], [4, 1, 3], [0, 1, 4]]])
    for vertices, faces in ((V, F), corners, (minus, corners[1]), (V, wall), (middle, filled),
                            (V, np.vstack([F, [[1, 1, 3], [2, 2, 2]]]))):
        winding, on_surface = contactcheck.inside(points, vertices, faces)
        assert winding.tolist() == [1, 1, 0] and not on_surface.any()
    # Two that share an edge of four triangles, and two one upon the other.
    faces = np.vstack([F, F + 4])
    edge = welded(np.vstack([V, V * [-1, -1, 1]]), faces)
    around = [[-0.1, -0.1, 0.1], [0.1, 0.1, 0.1], [0.1, -0.1, 0.1], [-0.1, 0.1, 0.1]]
    assert contactcheck.inside(around, *edge).winding.tolist() == [1, 1, 0, 0]
    assert contactcheck.inside(points, *welded(np.vstack([V, V]), faces)).winding.tolist() == [2, 2, 0]


@pytest.mark.parametrize("change, edge", [
    (lambda F: F[1:], "0 and 1"), (lambda F: np.vstack([F, F[:1]]), "0 and 2"),
    (lambda F: np.vstack([F[:1, ::-1], F[1:]]), "1 and 2")], ids=["missing", "once_more", "turned"])
def test_inside_names_the_first_open_edge(change, edge):
    V, F = (np.array(x) for x in TETRAHEDRON)
    with pytest.raises(contactcheck.InputError, match=rf"no inside: it is open \(edge of vertices {edge}\)"):
        contactcheck.inside([[0, 0, 0]], V, change(F))


def test_check_mesh_names_every_kind_of_defect():
    V, F = (np.array(x) for x in TETRAHEDRON)
    flat = np.vstack([V, [[2, 0, 0]]])
    assert contactcheck.check_mesh(V, F) == {}
    nan = V.astype(float)
    nan[2, 1] = np.nan

    def defects(vertices, faces):
        return {name: indices.tolist() for name, indices in contactcheck.check_mesh(vertices, faces).items()}

    assert defects(np.zeros((0, 3)), np.zeros((0, 3), int)).keys() == {"empty-mesh"}
    assert defects(nan, F)["non-finite-vertex"] == [2]
    assert defects(V, np.vstack([F, [[0, 1, 4]]]))["index-out-of-range"] == [4]
    assert defects(V, np.vstack([F, [[0, 1, -1]]]))["index-out-of-range"] == [4]
    assert defects(V, np.vstack([F, [[0, 1, 1]]]))["repeated-index"] == [4]
    assert defects(flat, np.vstack([F, [[0, 1, 4]]]))["zero-area-triangle"] == [4]
    assert defects(V, np.vstack([F, F[:1]]))["duplicate-triangle"] == [4]
    assert "non-manifold-edge" in defects(V, np.vstack([F, F[:1]]))
    assert set(defects(V, F[1:])["boundary-edge"]) == {0, 1, 2}
    assert "inconsistent-orientation" in defects(V, np.vstack([F[:3], F[3:, ::-1]]))


def test_a_lattice_gives_the_bits_of_the_command_line(bunnies, bunny_run):
    recorded = recording.read(bunny_run / "recordings" / "bunny-touch.ccr")
    for body, shape in enumerate(b.shape for b in recorded.bodies):
        lattice = contactcheck.Lattice(shape.rest_vertices, shape.triangles, cells=220)
        assert lattice.cells == len(shape.lattice.cell_nodes)
        for frame in (0, 6, 11):
            vertices = lattice.deform(recorded.nodes(frame)[body])
            assert vertices.tobytes() == bunnies[frame].bodies[body][0].tobytes()
            error = np.abs(lattice.deform(lattice.fit(vertices)) - vertices).max()
            assert error < 1e-5


def test_a_detector_answers_as_on_the_command_line(bunnies, bunny_run):
    recorded = recording.read(bunny_run / "recordings" / "bunny-touch.ccr")
    lattices = [contactcheck.Lattice(b.shape.rest_vertices, b.shape.triangles, cells=220) for b in recorded.bodies]
    for name in ("ffd-lazy", "fcl-aabb", "embree"):
        detector = contactcheck.Detector(name)
        detector.prepare(lattices, ["triangles"])
        for frame in (6, 0, 5, 6):  # in any order
            detector.update(recorded.nodes(frame))
            found = detector.query("triangles")
            if detector.declares["exact"]:
                assert np.array_equal(found["triangles"], bunnies[frame].contacts)
            assert len(found["bodies"]) == (len(found["triangles"]) > 0)


OF_STEPS = {"impacts", "self-impacts"}


def test_every_detector_answers_its_questions_of_frames(bunnies):
    bodies = bunnies[6].bodies
    for name in contactcheck.detectors():
        detector = contactcheck.Detector(name)
        questions = [question for question in detector.declares["questions"] if question not in OF_STEPS]
        if not questions:
            detector.prepare(bodies)
            with pytest.raises(Exception, match="answers questions of steps alone"):
                detector.update([V for V, _ in bodies])
            continue
        try:
            detector.prepare(bodies)
            detector.update([V for V, _ in bodies])
        except contactcheck.RefusedInput as refused:  # those that need a lattice
            assert "lattice" in str(refused), name
            continue
        for question in questions:
            answer = detector.query(question)
            for key, items in answer.items():
                floats = any(word in key for word in ("depth", "normal", "times"))
                assert items.dtype == (np.float64 if floats else np.int32)
            assert len(answer["piece_contacts"]) == len(answer["piece_depths"]) == len(answer["piece_normals"])
            assert len(answer["vertex_contacts"]) == len(answer["vertex_normals"])
        assert detector.name == name and name in repr(detector)


def test_self_contacts_of_a_detector(letter):
    ((V, F),) = letter.bodies
    detector = contactcheck.Detector("ffd-lazy")
    detector.prepare([(V, F)], ["self"])
    detector.update([V])
    assert np.array_equal(detector.query("self")["triangles"], letter.contacts)


def test_contacts_of_a_detector_part_the_bodies(bunnies):
    (Va, Fa), (Vb, Fb) = bunnies[6].bodies
    detector = contactcheck.Detector("fcl-aabb")
    detector.prepare([(Va, Fa), (Vb, Fb)])
    detector.update([Va, Vb])
    found = detector.query("contacts")
    assert len(found["piece_contacts"]) > 0
    assert np.allclose(np.linalg.norm(found["piece_normals"], axis=1), 1)


def elements_that_meet(start, end, Fa, Fb):
    """Of two bodies, by impact() over all pairs: vertices with faces, edges with edges, the first time."""
    def of(kind, bodies, vertices):
        found = contactcheck.impact(kind, *([[[where[b][v] for b, v in zip(bodies, row)] for row in vertices]
                                             for where in (start, end)]))
        return found.contact, found.earliest
    vertices, first = set(), 2.0
    for a, b, F in ((0, 1, Fb), (1, 0, Fa)):
        rows = [(v, *t) for v in range(len(start[a])) for t in F]
        contact, times = of("vertex-face", (a, b, b, b), rows)
        vertices |= {(a, b, rows[i][0], i % len(F)) for i in np.flatnonzero(contact)}
        first = min([first, *times[contact]])
    sides = [sorted({tuple(sorted((t[i], t[i - 1]))) for t in F for i in range(3)}) for F in (Fa, Fb)]
    rows = [(*e, *f) for e in sides[0] for f in sides[1]]
    contact, times = of("edge-edge", (0, 0, 1, 1), rows)
    return vertices, {(0, 1, *rows[i]) for i in np.flatnonzero(contact)}, min([first, *times[contact]])


STEP_DETECTORS = ("ffd-lazy", "full-refit", "swept-aabb", "embree-swept")


@pytest.mark.parametrize("name", STEP_DETECTORS)
def test_steps_are_answered_exactly(name):
    V = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [9, 9, 9]], float)  # one that no triangle uses
    F = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    used = V[:4]
    detector = contactcheck.Detector(name)
    detector.prepare([(V, F), (used, F)], ["impacts"])
    start, end = [V, used + [0.3, 0.2, 2]], [V + [0, 0, 0.5], used + [0.1, 0.3, -0.5]]
    for first, last in ((start, end), (end, start), (start, start), (start, end)):  # in any order
        vertices, edges, time = elements_that_meet([first[0][:4], first[1]], [last[0][:4], last[1]], F, F)
        detector.update_step(first, last, 2, 3)
        found = detector.query("impacts")
        assert {tuple(row) for row in found["impact_vertices"].tolist()} == vertices
        assert {tuple(row) for row in found["impact_edges"].tolist()} == edges
        moves = first is not last
        assert found["impacts"].tolist() == ([[0, 1]] if moves else [])
        assert len(found["impact_triangles"]) > 0 if moves else len(found["impact_triangles"]) == 0
        if moves and first is start:
            assert abs(found["impact_times"][0] - time) < 2**-39


def test_vertices_of_a_step_are_numbered_as_given():
    V = np.array([[5, 5, 5], [0, 0, 0], [1, 0, 0], [0, 1, 0]], float)  # nothing uses the first one
    F = [[1, 2, 3]]
    detector = contactcheck.Detector("swept-aabb")
    detector.prepare([(V, F), (V + [0.2, 0.1, 1], F)])
    detector.update_step([V, V + [0.2, 0.1, 1]], [V, V + [0.2, 0.1, -1]])
    found = detector.query("impacts")
    assert found["impact_vertices"].tolist() == [[1, 0, 1, 0]]
    assert [1, 3] in found["impact_edges"][:, 4:].tolist() or [2, 3] in found["impact_edges"][:, 2:4].tolist()


def test_a_body_meets_itself_within_a_step():
    V = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0.2, 0.1, 0.5], [1.2, 0.1, 0.5], [0.2, 1.1, 0.5]])
    end = np.concatenate([V[:3], V[3:] - [0, 0, 1]])
    detector = contactcheck.Detector("ffd-lazy")
    detector.prepare([(V, [[0, 1, 2], [3, 4, 5]])], ["self-impacts"])
    detector.update_step([V], [end])
    found = detector.query("self-impacts")
    assert found["impact_vertices"].tolist() == [[0, 0, 3, 0]]
    assert all(row[:2] == [0, 0] for row in found["impact_edges"].tolist()) and len(found["impact_edges"]) > 0


def test_frames_and_steps_are_asked_after_their_own_update():
    V, F = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], float), [[0, 1, 2]]
    detector = contactcheck.Detector("ffd-lazy")
    with pytest.raises(contactcheck.InputError, match="prepare"):
        detector.update_step([V, V], [V, V])
    detector.prepare([(V, F), (V, F)])
    with pytest.raises(contactcheck.InputError, match="update_step"):
        detector.query("impacts")
    detector.update([V, V + 3])
    with pytest.raises(contactcheck.InputError, match="about a step: update_step"):
        detector.query("impacts")
    detector.update_step([V, V + 3], [V, V])
    with pytest.raises(contactcheck.InputError, match="about a frame: update"):
        detector.query("triangles")
    with pytest.raises(contactcheck.InputError, match=r"end\[1\] has 2 rows"):
        detector.update_step([V, V], [V, V[:2]])
    with pytest.raises(contactcheck.InputError, match="update_step"):
        detector.query("impacts")  # one that is refused leaves none
    with pytest.raises(contactcheck.InputError, match="comes after its start"):
        detector.update_step([V, V], [V, V], 1, 1)
    with pytest.raises(contactcheck.InputError, match="finite"):
        detector.update_step([V, V], [V, V + np.inf])
    frames = contactcheck.Detector("fcl-aabb")
    frames.prepare([(V, F), (V, F)])
    with pytest.raises(contactcheck.InputError, match="does not answer about steps"):
        frames.update_step([V, V], [V, V])
