"""What goes in as it is, and what is refused: with argument, place and value."""

import os
import pathlib
import re
import subprocess
import sys
import types

import contactcheck
import numpy as np
import pytest

V = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0.25, 0.25, -1], [0.25, 0.25, 1], [2, 2, 0]])
F = np.array([[0, 1, 2], [3, 4, 5]], np.int32)


def with_value(value, row=1, column=2):
    out = V.copy()
    out[row, column] = value
    return out


def whole(value, dtype=np.int64):
    out = np.zeros(V.shape, dtype)
    out[1, 2] = value
    return out


@pytest.mark.parametrize("vertices", [
    V.tolist(), np.asfortranarray(V), V[::-1][::-1], V.astype(np.float32), np.stack([V, V])[1],
    np.ma.array(V), V.view(type("TrackedArray", (np.ndarray,), {})), V.astype(">f8"),
])
@pytest.mark.parametrize("faces", [
    F.tolist(), F.astype(np.int64), F.astype(np.uint8), F.astype(np.uint64), np.asfortranarray(F),
    F.astype(">i4"), np.array([3, 0, 1, 2, 3, 3, 4, 5]), [[0, 1, 2], (3, 4, 5)], F[::-1][::-1],
])
def test_arrays_of_any_kind_go_in_as_they_are(vertices, faces):
    pairs, shared = contactcheck.self_contacts(vertices, faces)
    assert pairs.tolist() == [[0, 1]] and shared.tolist() == [0]


@pytest.mark.parametrize("vertices", [whole(2**53 - 1), whole(2**53), whole(-(2**53)), whole(2**53, np.uint64)])
def test_whole_numbers_that_a_double_holds_go_in(vertices):
    assert contactcheck.contacts(vertices, F, V + 1e6, F).tolist() == []


def test_an_array_is_not_changed_and_may_be_read_only():
    vertices, faces = V.copy(), F.copy()
    vertices.flags.writeable = faces.flags.writeable = False
    contactcheck.self_contacts(vertices, faces)
    assert np.array_equal(vertices, V) and np.array_equal(faces, F)


def mesh(**attributes):
    return types.SimpleNamespace(**attributes)


@pytest.mark.parametrize("body", [
    (V, F), [V, F], contactcheck.Lattice(V, F), mesh(vertices=V, faces=F), mesh(vertices=V, triangles=F),
    mesh(points=V, faces=np.array([3, 0, 1, 2, 3, 3, 4, 5])), mesh(points=V, cells_dict={"triangle": F}),
])
def test_bodies_of_any_kind(body):
    detector = contactcheck.Detector("ffd-lazy")
    detector.prepare([body], ["self"])
    detector.update([body.nodes if isinstance(body, contactcheck.Lattice) else V])
    assert detector.query("self")["triangles"].tolist() == [[0, 0, 0, 1]]


class Lazily:
    """A sequence that makes its items when they are asked for."""

    def __len__(self):
        return 2

    def __getitem__(self, index):
        return [V.copy(), V + 0.0][index]


@pytest.mark.parametrize("positions", [lambda: np.stack([V, V]), lambda: Lazily(), lambda: (V + 0.0 for _ in range(2))])
def test_positions_of_any_kind(positions):
    detector = prepared()
    expected = updated().query()["triangles"]
    for _ in range(100):
        detector.update(positions())
    assert np.array_equal(detector.query()["triangles"], expected)


HUGE = np.broadcast_to(np.zeros(3), (2**31, 3))
MOVING = np.zeros((2, 4, 3))
BAD = [
    (lambda: contactcheck.contacts(with_value(np.nan), F, V, F), "Va[1, 2] is nan; coordinates must be finite"),
    (lambda: contactcheck.contacts(V, F, with_value(-np.inf, 3, 0), F), "Vb[3, 0] is -inf;"),
    (lambda: contactcheck.contacts(V, F, V, [[0, 1, 6]]), "Fb[0, 2] is 6; the mesh has 6 vertices"),
    (lambda: contactcheck.contacts(V, [[0, -1, 2]], V, F), "Fa[0, 1] is -1; the mesh has 6 vertices"),
    (lambda: contactcheck.contacts(V, np.array([[0, 1, 2**40]]), V, F), "Fa[0, 2] is 1099511627776;"),
    (lambda: contactcheck.contacts(V, np.array([[0, 1, 2**64 - 1]], np.uint64), V, F), "is 18446744073709551615;"),
    (lambda: contactcheck.contacts(V[:, :2], F, V, F), "Va has shape (6, 2); it must be (n, 3)"),
    (lambda: contactcheck.contacts(V.ravel(), F, V, F), "Va has shape (18,); it must be (n, 3)"),
    (lambda: contactcheck.contacts(V, F[:, :2], V, F), "Fa has shape (2, 2); it must be (m, 3)"),
    (lambda: contactcheck.contacts(V, [3, 0, 1, 2, 4, 0, 1, 2], V, F), "one row of 3, a, b, c for every triangle"),
    (lambda: contactcheck.contacts(V, [3, 0, 1], V, F), "one row of 3, a, b, c for every triangle"),
    (lambda: contactcheck.contacts(V, F.astype(float), V, F), "integers wanted, got dtype float64"),
    (lambda: contactcheck.contacts(V, F > 0, V, F), "integers wanted, got dtype bool"),
    (lambda: contactcheck.contacts(V + 0j, F, V, F), "Va: an (n, 3) array of numbers wanted, got dtype complex128"),
    (lambda: contactcheck.contacts(V.astype(np.longdouble), F, V, F), "got dtype float128"),
    (lambda: contactcheck.contacts(V.astype(object), F, V, F), "got dtype object"),
    (lambda: contactcheck.contacts(V.astype(str), F, V, F), "got dtype <U"),
    (lambda: contactcheck.contacts(V.astype(int) + 2**53 + 2, F, V, F), "Va[0, 0] is 9007199254740994; a double would round it"),
    (lambda: contactcheck.contacts(whole(2**53 + 1), F, V, F), "Va[1, 2] is 9007199254740993; a double would round it"),
    (lambda: contactcheck.contacts(whole(-(2**53) - 1), F, V, F), "Va[1, 2] is -9007199254740993; a double would round it"),
    (lambda: contactcheck.contacts(whole(2**53 + 1, np.uint64), F, V, F), "Va[1, 2] is 9007199254740993; a double"),
    (lambda: contactcheck.contacts(whole(2**64 - 1, np.uint64), F, V, F), "Va[1, 2] is 18446744073709551615; a double"),
    (lambda: contactcheck.contacts(None, F, V, F), "Va: an (n, 3) array of numbers wanted, got"),
    (lambda: contactcheck.contacts([[1, 2], [3]], F, V, F), "Va: an (n, 3) array of numbers wanted, got"),
    (lambda: contactcheck.contacts(V, np.zeros((0, 3), int), V, F), "Fa has no triangle"),
    (lambda: contactcheck.contacts(V, [], V, F), "Fa"),
    (lambda: contactcheck.contacts([], F, V, F), "Va has shape (0,)"),
    (lambda: contactcheck.contacts(HUGE, F, V, F), "Va has 2147483648 rows; at most 2147483647"),
    (lambda: contactcheck.contacts(V, np.broadcast_to(np.zeros(3, np.int32), (2**31, 3)), V, F),
     "Fa has 2147483648 rows; at most 2147483647"),
    (lambda: contactcheck.self_contacts(with_value(np.nan), F), "V[1, 2] is nan"),
    (lambda: contactcheck.impact("vf", MOVING, MOVING), "kind='vf' must be 'vertex-face' or 'edge-edge'"),
    (lambda: contactcheck.impact("edge-edge", MOVING[0], MOVING), "start has shape (4, 3); it must be (n, 4, 3)"),
    (lambda: contactcheck.impact("edge-edge", MOVING, MOVING[:, :, :2]), "end has shape (2, 4, 2)"),
    (lambda: contactcheck.impact("edge-edge", MOVING, MOVING[:1]), "start has 2 queries, end 1"),
    (lambda: contactcheck.impact("edge-edge", MOVING + np.nan, MOVING), "start[0, 0, 0] is nan"),
    (lambda: contactcheck.impact("edge-edge", MOVING, [[1], [1, 2]]), "end: an (n, 4, 3) array of numbers wanted"),
    (lambda: contactcheck.impact("edge-edge", MOVING, MOVING + 0j), "end: an (n, 4, 3) array of numbers wanted"),
    (lambda: contactcheck.impact("edge-edge", MOVING.astype(int) + 2**53 + 1, MOVING), "a double would round it"),
    (lambda: contactcheck.distance(V, F, V, [[0, 0, 9]]), "Fb[0, 2] is 9"),
    (lambda: contactcheck.inside([[0, 0]], V, F), "points has shape (1, 2)"),
    (lambda: contactcheck.inside([[0, 0, 0]], V, F), "V, F has no inside: it is open (edge of vertices 0 and 1)"),
    (lambda: contactcheck.check_mesh(V, F.astype(float)), "F: an (m, 3) array of integers wanted"),
    (lambda: contactcheck.Lattice(V, F, cells=0), "Lattice(cells=0)"),
    (lambda: contactcheck.Lattice(V, F, cells=(1, 2)), "Lattice(cells=(1, 2))"),
    (lambda: contactcheck.Lattice(V, F, cells=(1, 2, 129)), "129"),
    (lambda: contactcheck.Lattice(V, F, padding=float("nan")), "padding"),
    (lambda: contactcheck.Lattice(V, F, smoothing=0), "smoothing"),
    (lambda: contactcheck.Lattice(V, F, cells=1j), "cells=1j"),
    (lambda: contactcheck.contacts(V, F, V, np.array(3)), "Fb has shape (); it must be (m, 3)"),
    (lambda: contactcheck.Lattice(V, F).deform(V[:2]), "nodes has 2 rows; the nodes of the lattice are"),
    (lambda: contactcheck.Lattice(V, F).fit(V[:2]), "V has 2 rows; the vertices of the mesh are 6"),
    (lambda: contactcheck.Detector("ffd-lasy"), "ffd-lasy"),
    (lambda: contactcheck.Detector("ffd-lazy", bounds="none"), "none"),
    (lambda: contactcheck.Detector("ffd-lazy:bounds=nodes", bounds="nodes"), "bounds"),
    (lambda: contactcheck.Detector().update([V]), "prepare() comes before update()"),
    (lambda: contactcheck.Detector().query(), "update() comes before query()"),
    (lambda: contactcheck.Detector().prepare([3]), "bodies[0]: a Lattice or a pair (V, F) wanted, got int"),
    (lambda: contactcheck.Detector().prepare([(V, F), (V, F[:, :2])]), "F of bodies[1] has shape (2, 2)"),
    (lambda: contactcheck.Detector().prepare([(V, F)], ["faces"]), 'no question is called "faces"'),
    (lambda: prepared().update([V]), "positions: 1 array for 2 bodies"),
    (lambda: prepared().update([V, V[:3]]), 'positions[1] has 3 rows; "bodies[1]" has 6 vertices'),
    (lambda: prepared().update([V, with_value(np.nan)]), "positions[1][1, 2] is nan"),
    (lambda: prepared().query("triangles"), "update() comes before query()"),
    (lambda: updated().query("faces"), 'no question is called "faces"'),
    (lambda: updated("embree").query("contacts"), 'does not answer the question "contacts"'),
]


def prepared(name="ffd-lazy"):
    detector = contactcheck.Detector(name)
    detector.prepare([(V, F), (V, F)])
    return detector


def updated(name="ffd-lazy"):
    detector = prepared(name)
    detector.update([V, V])
    return detector


@pytest.mark.parametrize("call, sentence", BAD)
def test_bad_arguments_are_refused_with_name_place_and_value(call, sentence):
    with pytest.raises(ValueError, match=re.escape(sentence)) as caught:
        call()
    assert isinstance(caught.value, contactcheck.InputError)


def test_a_bad_question_leaves_the_frame_as_it_was():
    detector = updated()
    before = detector.query()["triangles"]
    with pytest.raises(contactcheck.InputError):
        detector.query("faces")
    assert np.array_equal(detector.query()["triangles"], before)


def test_a_frame_that_is_refused_is_not_answered_for_by_the_one_before():
    detector = updated()
    before = detector.query()["triangles"]
    for bad in ([V], [V, V[:3]], [V, with_value(np.nan)]):
        with pytest.raises(contactcheck.InputError):
            detector.update(bad)
        with pytest.raises(contactcheck.InputError, match="update.* comes before query"):
            detector.query()
        detector.update([V, V])
        assert np.array_equal(detector.query()["triangles"], before)


def test_too_many_triangles_at_one_vertex_are_refused():
    count = 9000
    angle = np.linspace(0, 6, count)
    fan = np.vstack([[[0, 0, 0]], np.column_stack([np.cos(angle), np.sin(angle), 0 * angle])])
    faces = np.column_stack([np.zeros(count - 1, int), np.arange(1, count), np.arange(2, count + 1)])
    with pytest.raises(contactcheck.RefusedInput, match="40"):
        contactcheck.self_contacts(fan, faces)


def test_a_detector_that_refused_begins_anew():
    detector = contactcheck.Detector("ffd-aabb")
    with pytest.raises(contactcheck.RefusedInput):
        detector.prepare([(V, F)])
    with pytest.raises(contactcheck.InputError, match="prepare\\(\\) begins anew"):
        detector.update([V])
    detector.prepare([contactcheck.Lattice(V, F)])


def test_module_of_another_python_names_both(tmp_path):
    package = pathlib.Path(contactcheck.__file__).parent
    (tmp_path / "contactcheck").mkdir()
    for file in package.iterdir():
        if file.suffix == ".py":
            (tmp_path / "contactcheck" / file.name).write_bytes(file.read_bytes())
    [binding] = package.glob("_binding.*.so")
    _, own, _ = binding.name.split(".")
    (tmp_path / "contactcheck" / binding.name.replace(own, "cpython-23-some-machine")).symlink_to(binding)
    outcome = subprocess.run([sys.executable, "-c", "import contactcheck"], check=False, capture_output=True,
                             text=True, env={**os.environ, "PYTHONPATH": str(tmp_path)})
    assert outcome.stderr.splitlines()[-1] == (
        f"ImportError: contactcheck was built for cpython-23-some-machine, and this Python is {own}: start the one "
        "or build for the other")
