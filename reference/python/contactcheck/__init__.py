"""Is a collision answer right, and how fast is the detector? Exact answers for arrays.

A mesh is two arrays: V, (n, 3) coordinates in metres, and F, (m, 3) indices of vertices. What
trimesh calls vertices and faces, meshio points and cells, Open3D vertices and triangles and pyvista
points and faces goes in as it is. Coordinates of any type become float64, indices int32. Triangles
are closed sets of points: touching is contact. A vertex that no triangle uses is no part of a mesh:
it counts nowhere, and the others keep their numbers.

Bad arguments raise InputError, a ValueError, whose sentence names argument, place and value. Long
calls release the interpreter's lock.

>>> import contactcheck
>>> V = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
>>> F = [[0, 1, 2]]
>>> W = [[0.25, 0.25, -1], [0.25, 0.25, 1], [2, 2, 0]]
>>> contactcheck.contacts(V, F, W, F)
array([[0, 0]], dtype=int32)
"""

from __future__ import annotations

import json
import operator
import pathlib
import sys
import sysconfig
from typing import Any, Iterable, NamedTuple, Optional, Sequence, Union, overload

import numpy as np

try:
    from . import _binding
except ImportError as _error:
    # "cpython-311-x86_64-linux-gnu"
    _built_for = [file.name.split(".")[1] for file in pathlib.Path(__file__).parent.glob("_binding.*.so")]
    if not _built_for or sysconfig.get_config_var("SOABI") in _built_for:
        raise
    raise ImportError(f"contactcheck was built for {_built_for[0]}, and this Python is "
                      f"{sysconfig.get_config_var('SOABI')}: start the one or build for the other") from _error
from ._binding import InputError, RefusedInput, Unavailable, __version__
from ._run import Check, Results, Scene, Verdict, check, gate, run
from ._serve import Body, Frame, LatticeArrays

__all__ = [
    "Body", "Check", "Depth", "Detector", "Distance", "FirstContacts", "Frame", "Impact", "InputError",
    "Inside", "Lattice", "LatticeArrays", "PointDistances", "RefusedInput", "Results", "Scene",
    "SelfContacts", "Unavailable", "Verdict", "__version__", "check", "check_mesh", "contacts", "depth",
    "detectors", "distance", "gate", "impact", "inside", "point_distances", "run",
    "self_contacts",
]

for _public in (Body, Check, Frame, InputError, LatticeArrays, RefusedInput, Results, Scene,
                Unavailable, Verdict, check, gate, run):
    _public.__module__ = __name__


class FirstContacts(NamedTuple):
    """What contacts() answers where it stops early."""

    pairs: np.ndarray  #: (k, 2) int32, triangles, ascending
    more: bool  #: there are others


class SelfContacts(NamedTuple):
    """What self_contacts() answers."""

    pairs: np.ndarray  #: (k, 2) int32, triangles, the lower one first, ascending
    shared: np.ndarray  #: (k,) int32, vertices that both name: 0, 1 or 2


class Impact(NamedTuple):
    """What impact() answers, of each query. Times are fractions of the step, 0 without contact."""

    contact: np.ndarray  #: (n,) bool
    starts: np.ndarray  #: (n,) bool, in contact at t = 0
    earliest: np.ndarray  #: (n,) float64, earliest <= first time of contact
    latest: np.ndarray  #: (n,) float64, first time of contact <= latest


class Distance(NamedTuple):
    """What distance() answers: lower <= true distance <= upper."""

    lower: float  #: metres
    upper: float  #: metres
    points: np.ndarray  #: (2, 3) float64, a point of either surface, nearest to one another


class Depth(NamedTuple):
    """What depth() answers: lower <= true depth <= upper."""

    lower: float  #: metres
    upper: float  #: metres


class PointDistances(NamedTuple):
    """What point_distances() answers: lower <= true distance <= upper, of each point."""

    lower: np.ndarray  #: (n,) float64, metres
    upper: np.ndarray  #: (n,) float64, metres
    points: np.ndarray  #: (n, 3) float64, the nearest point of the surface
    triangles: np.ndarray  #: (n,) int32, the triangle that it is on


class Inside(NamedTuple):
    """What inside() answers."""

    winding: np.ndarray  #: (n,) int32, 0 outside; 0 where on_surface says True
    on_surface: np.ndarray  #: (n,) bool


@overload
def contacts(Va: Any, Fa: Any, Vb: Any, Fb: Any, first: None = None) -> np.ndarray: ...
@overload
def contacts(Va: Any, Fa: Any, Vb: Any, Fb: Any, first: int) -> FirstContacts: ...


def contacts(
    Va: Any, Fa: Any, Vb: Any, Fb: Any, first: Optional[int] = None
) -> Union[np.ndarray, FirstContacts]:
    """All pairs of triangles of two meshes that share a point: (k, 2) int32, ascending.

    Exact for every finite input, degenerate triangles too, which are the segment or point that they
    are. It is the oracle that judges detectors; a Detector is faster.

    `first`: stop after so many pairs, 0 or more, which are not always the lowest; the answer is
    FirstContacts, which says whether there are more. Raises RefusedInput beyond 20 million pairs.

    >>> V, F = [[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]
    >>> touching = [[1, 0, 0], [2, 0, 0], [2, 1, 0]]
    >>> contacts(V, F, touching, F)
    array([[0, 0]], dtype=int32)
    >>> apart = [[np.nextafter(1, 2), 0, 0], [2, 0, 0], [2, 1, 0]]
    >>> len(contacts(V, F, apart, F))
    0
    >>> some = contacts(V, [[0, 1, 2]] * 3, V, F, first=2)
    >>> len(some.pairs), some.more
    (2, True)
    """
    most = sys.maxsize
    if first is not None:
        try:
            most = operator.index(first)
        except TypeError:
            most = -1
        if not 0 <= most <= sys.maxsize:
            raise InputError(f"first={first!r} must be a whole number from 0 on")
    pairs, more = _binding.contacts(
        _binding.Shape(Va, Fa, "Va", "Fa"), _binding.Shape(Vb, Fb, "Vb", "Fb"), most
    )
    return pairs if first is None else FirstContacts(pairs, more)


def self_contacts(V: Any, F: Any, weld: bool = False) -> SelfContacts:
    """All pairs of triangles of one mesh that meet in more than the vertices they share; exact.

    `weld`: vertices with equal coordinates are one, as in files that store each corner anew. Two
    triangles that name the same three vertices are duplicates (check_mesh), no contact. Raises
    RefusedInput where more than 40 million pairs share a vertex, or more than 20 million meet.

    >>> V = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0.25, 0.25, -1], [0.25, 0.25, 1], [2, 2, 0]]
    >>> pairs, shared = self_contacts(V, [[0, 1, 2], [3, 4, 5]])
    >>> pairs.tolist(), shared.tolist()
    ([[0, 1]], [0])
    """
    return SelfContacts(*_binding.self_contacts(_binding.Shape(V, F, "V", "F", weld)))


def impact(kind: str, start: Any, end: Any) -> Impact:
    """Do moving elements meet between two frames, and when first? Exact.

    `kind`: "vertex-face", the four points of a query being a vertex and the corners of a triangle,
    or "edge-edge", the ends of two edges. `start` and `end`: (n, 4, 3) coordinates at t = 0 and
    t = 1; in between each point moves on a straight line at constant speed. Degenerate elements are
    the segment or point that they are at that time. `latest - earliest` is at most 2^-40.

    >>> start = [[[0.25, 0.25, 1], [0, 0, 0], [1, 0, 0], [0, 1, 0]]]
    >>> end = [[[0.25, 0.25, -3], [0, 0, 0], [1, 0, 0], [0, 1, 0]]]
    >>> found = impact("vertex-face", start, end)
    >>> found.contact.tolist(), (found.earliest <= 0.25).all(), (found.latest >= 0.25).all()
    ([True], True, True)
    """
    if kind not in ("vertex-face", "edge-edge"):
        raise InputError(f"kind={kind!r} must be 'vertex-face' or 'edge-edge'")
    rows = []
    for name, places in (("start", start), ("end", end)):
        try:
            points = np.asarray(places)
        except ValueError:  # rows of different lengths
            points = np.asarray(None)
        if points.dtype.kind not in "biuf":
            raise InputError(f"{name}: an (n, 4, 3) array of numbers wanted, got {type(places).__name__}")
        if points.ndim != 3 or points.shape[1:] != (4, 3):
            raise InputError(f"{name} has shape {points.shape}; it must be (n, 4, 3)")
        if points.dtype.kind == "f" and not np.isfinite(points).all():
            place = tuple(int(i) for i in np.argwhere(~np.isfinite(points))[0])
            raise InputError(f"{name}{list(place)} is {points[place]}; it must be a finite number")
        rows.append(points.reshape(-1, 3))
    if len(rows[0]) != len(rows[1]):
        raise InputError(
            f"start has {len(rows[0]) // 4} queries, end {len(rows[1]) // 4}; they must be as many"
        )
    return Impact(*_binding.impacts(kind == "edge-edge", *rows))


def distance(Va: Any, Fa: Any, Vb: Any, Fb: Any) -> Distance:
    """The distance of two surfaces: certified bounds in metres, and two nearest points.

    Both bounds are 0 exactly where the surfaces share a point; else they differ by at most 1e-9 of
    the largest coordinate. A body inside another has a distance to its surface: see inside().

    >>> V, F = [[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]
    >>> lower, upper, points = distance(V, F, [[0, 0, 2], [1, 0, 3], [0, 1, 3]], F)
    >>> lower <= 2 <= upper, upper - lower < 1e-9
    (True, True)
    >>> points.tolist()
    [[0.0, 0.0, 0.0], [0.0, 0.0, 2.0]]
    """
    return Distance(
        *_binding.distance(_binding.Shape(Va, Fa, "Va", "Fa"), _binding.Shape(Vb, Fb, "Vb", "Fb"))
    )


def point_distances(points: Any, V: Any, F: Any) -> PointDistances:
    """The distance of each of (n, 3) points to a surface, bounded as by distance(); any n.

    As distance([p, p, p], [[0, 1, 2]], V, F) of each point p, in one call. A point within a body
    has a distance to its surface: see inside().

    >>> V, F = [[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]
    >>> near = point_distances([[0.25, 0.25, 3], [0, 0.5, 0]], V, F)
    >>> (near.lower <= [3, 0]).all(), (near.upper >= [3, 0]).all(), near.upper[1]
    (True, True, 0.0)
    >>> near.points.tolist(), near.triangles.tolist()
    ([[0.25, 0.25, 0.0], [0.0, 0.5, 0.0]], [0, 0])
    """
    return PointDistances(*_binding.point_distances(points, _binding.Shape(V, F, "V", "F")))


def depth(Va: Any, Fa: Any, Vb: Any, Fb: Any) -> Depth:
    """How deep two solids are in each other: certified bounds of their surface depth, in metres.

    Of the points of either surface that are inside the other solid, the deepest is farthest from
    that solid's surface; its distance is the depth. Crossed bars without a vertex inside are deep.
    The bounds differ by at most a thousandth of the upper one, or 1e-9 of the largest coordinate; a
    search that takes too long ends with wider ones. Both are 0 only where nothing is inside; of
    solids that touch the lower one is 0. Raises InputError, with the reason, for a mesh that is not
    a simple solid: open, in contact with itself, without interior, or nested.

    >>> V = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
    >>> F = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
    >>> lower, upper = depth(V, F, [[x, y, z + 0.75] for x, y, z in V], F)
    >>> lower <= 1 / 12 <= upper
    True
    """
    return Depth(
        *_binding.depth(_binding.Shape(Va, Fa, "Va", "Fa"), _binding.Shape(Vb, Fb, "Vb", "Fb"))
    )


def inside(points: Any, V: Any, F: Any) -> Inside:
    """How often a closed mesh winds round each of (n, 3) points, and which lie on it; exact.

    A point is inside where its winding number is not 0. Negative: the triangles run clockwise seen
    from outside. The mesh may intersect itself, have any number of triangles on an edge, triangles
    of no area, and several vertices at one place, which are one. Raises InputError, naming the
    first such edge, where the others do not run every edge equally often in both directions.

    >>> V = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
    >>> F = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
    >>> winding, on_surface = inside([[0.1, 0.1, 0.1], [2, 2, 2], [0.5, 0.5, 0]], V, F)
    >>> winding.tolist(), on_surface.tolist()
    ([1, 0, 0], [False, False, True])
    """
    return Inside(*_binding.inside(points, _binding.Shape(V, F, "V", "F")))


def check_mesh(V: Any, F: Any) -> dict[str, np.ndarray]:
    """The defects of a mesh by name, each with the vertices or triangles concerned, (k,) int32.

    empty-mesh, non-finite-vertex, index-out-of-range: such a mesh cannot be judged. repeated-index,
    zero-area-triangle, duplicate-triangle; non-manifold-edge, boundary-edge,
    inconsistent-orientation: without these three, inside() is defined. Of a vertex the index is
    given for non-finite-vertex, else that of a triangle. NaN and bad indices do not raise.

    >>> check_mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2], [0, 1, 1]])
    ... # doctest: +NORMALIZE_WHITESPACE
    {'repeated-index': array([1], dtype=int32),
     'boundary-edge': array([0, 0, 0], dtype=int32)}
    """
    return _binding.check_mesh(V, F)


class Lattice:
    """A mesh in a free-form-deformation lattice (Sederberg & Parry 1986, trilinear).

    `cells`: about so many cells that hold surface (1 to 10000), or how many along each axis (1 to
    128 each). `padding`: room round the mesh, as a fraction of its largest side. `smoothing`: of
    fit(), 1e-12 to 1.

    >>> V, F = [[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]
    >>> lattice = Lattice(V, F, cells=(2, 2, 1))
    >>> lattice.deform(lattice.nodes + [0, 0, 5]).tolist()
    [[0.0, 0.0, 5.0], [1.0, 0.0, 5.0], [0.0, 1.0, 5.0]]
    """

    def __init__(
        self,
        V: Any,
        F: Any,
        cells: Union[int, Sequence[int]] = 150,
        padding: float = 0.02,
        smoothing: float = 1e-6,
    ) -> None:
        amount = "cells" if np.ndim(cells) else "kept"
        lattice = {amount: np.asarray(cells).tolist(), "padding": padding}
        lattice.update(fit=True, smoothing=smoothing)
        try:
            text = json.dumps(lattice, allow_nan=False)
        except (TypeError, ValueError):
            raise InputError(f"Lattice: cells={cells!r}, padding={padding!r} and smoothing="
                             f"{smoothing!r} must be finite numbers") from None
        self._shape = _binding.Shape(V, F, "V", "F", False, text, f"Lattice(cells={cells!r})")
        self._nodes = self._shape.nodes
        self._nodes.flags.writeable = False

    @property
    def nodes(self) -> np.ndarray:
        """The nodes at rest, (n, 3) float64, read-only; nodes far from the surface are left out."""
        return self._nodes

    @property
    def cells(self) -> int:
        """How many cells hold surface."""
        return self._shape.cells

    def deform(self, nodes: Any) -> np.ndarray:
        """The mesh's vertices for (n, 3) moved nodes: the very doubles that detectors are given.

        A vertex that no triangle uses is at the place of the last one before it that is used.
        """
        return self._shape.deform(nodes)

    def fit(self, V: Any) -> np.ndarray:
        """The nodes whose deform() comes nearest to given vertices (least squares), (n, 3).

        >>> rest = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]])
        >>> lattice = Lattice(rest, [[0, 1, 2]])
        >>> np.abs(lattice.deform(lattice.fit(rest + 1.0)) - rest - 1.0).max() < 1e-9
        True
        """
        return self._shape.fit(V)

    def __repr__(self) -> str:
        return f"<contactcheck.Lattice: {self.cells} cells, {len(self.nodes)} nodes>"


def detectors() -> list[str]:
    """The detectors of this program.

    >>> "ffd-lazy" in detectors()
    True
    """
    return _binding.detectors()


def _shape(body: Any, name: str) -> _binding.Shape:
    if isinstance(body, Lattice):
        return body._shape
    for vertices in ("vertices", "points"):  # trimesh and Open3D; meshio and pyvista
        if hasattr(body, vertices):
            faces = next((getattr(body, key) for key in ("faces", "triangles") if hasattr(body, key)),
                         getattr(body, "cells_dict", {}).get("triangle"))
            body = (getattr(body, vertices), faces)
            break
    try:
        V, F = body
    except (TypeError, ValueError):
        got = type(body).__name__
        raise InputError(f"{name}: a Lattice or a pair (V, F) wanted, got {got}") from None
    return _binding.Shape(V, F, f"V of {name}", f"F of {name}")


class Detector:
    """A detector of contactcheck, by name and options as in `contactcheck list`.

    One call of prepare() for some bodies, then for every frame update() and query(), or for every
    step from a frame to the next update_step() and query(). Not exact
    unless `declares["exact"]` says so, and then at its `levels`. Each may be used by one thread at
    a time; others wait.

    >>> V, F = [[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]
    >>> detector = Detector("ffd-lazy")
    >>> detector.prepare([(V, F), (V, F)])
    >>> for height in (1.0, 0.0):
    ...     detector.update([V, np.add(V, [0, 0, height])])
    ...     print(detector.query("triangles")["triangles"].tolist())
    []
    [[0, 1, 0, 0]]
    """

    def __init__(self, name: str = "ffd-lazy", **options: Any) -> None:
        given = ",".join(f"{key}={value}" for key, value in options.items())
        separator = ":" if given and ":" not in name else "," if given else ""
        self._detector = _binding.Detector(name + separator + given)

    @property
    def name(self) -> str:
        """With its options, as tables show it."""
        return self._detector.name

    @property
    def declares(self) -> dict[str, Any]:
        """What it claims: levels, questions, closed, exact, margin, ... (as in results.json).

        A margin may depend on the bodies: final after prepare().
        """
        return json.loads(self._detector.declares())

    def prepare(self, bodies: Iterable[Any], questions: Sequence[str] = ()) -> None:
        """Once for these bodies: each a Lattice, (V, F), or a mesh of trimesh, meshio, Open3D, pyvista.

        `questions`: what will be asked. Some detectors then leave out what only others need.
        """
        shapes = [(f"bodies[{i}]", _shape(body, f"bodies[{i}]")) for i, body in enumerate(bodies)]
        self._detector.prepare(shapes, list(questions))

    def update(self, positions: Sequence[Any], time: float = 0.0) -> None:
        """The bodies of one frame: (n, 3) nodes of a Lattice, vertices of other bodies; copied.

        One that is refused leaves no frame to ask about.
        """
        self._detector.update(tuple(positions), time)

    def update_step(
        self,
        start: Sequence[Any],
        end: Sequence[Any],
        start_time: float = 0.0,
        end_time: float = 1.0,
    ) -> None:
        """The bodies at both ends of a step, each as in update(); steps come in any order.

        In between every vertex moves on a straight line at constant speed. For detectors that
        answer the questions impacts or self-impacts, such as ffd-lazy.

        >>> V, F = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]]), [[0, 1, 2]]
        >>> detector = Detector("ffd-lazy")
        >>> detector.prepare([(V, F), (V, F)])
        >>> detector.update_step([V, V + [0, 0, 1]], [V, V - [0, 0, 3]])
        >>> found = detector.query("impacts")
        >>> found["impacts"].tolist(), found["impact_times"].round(9).tolist()
        ([[0, 1]], [0.25])
        """
        self._detector.update_step(tuple(start), tuple(end), start_time, end_time)

    def query(self, question: str = "triangles") -> dict[str, np.ndarray]:
        """What touches in the frame: question triangles, body, cells, contacts or self.

        Of a step: impacts, or self-impacts for bodies with themselves.

        All lists are there, empty where the detector has none; int32, ascending, without repeats:

        bodies (k, 2); triangles and cells (k, 4): body a, body b, element of a, of b; vertices
        (k, 3): body, body that holds it, vertex; near (k, 4): body, other body, vertex, triangle.
        The question self has body a = body b. The question contacts also gives piece_contacts
        (k, 4) with piece_depths (k,) and piece_normals (k, 3): moving b by depth * normal separates
        them; and vertex_contacts (k, 3) with vertex_depths and vertex_normals: the way out. Of a
        step: impacts (k, 2), two bodies, with impact_times (k,), fractions of the step, below 0 if
        not known; impact_triangles (k, 4); impact_vertices (k, 4): body, other body, vertex,
        triangle; impact_edges (k, 6): body a, body b, the ends of an edge of a, of b.
        """
        return self._detector.query(question)

    def notes(self) -> list[str]:
        """What one must know about the answer to the last frame: limits that were reached."""
        return self._detector.notes()

    def __repr__(self) -> str:
        return f"<contactcheck.Detector {self.name}>"
