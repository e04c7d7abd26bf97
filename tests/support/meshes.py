"""Meshes as (vertices, triangles): lists of three coordinates, lists of three indices."""

import itertools
import math


def box(divisions):
    """The closed unit box from the origin: 12 divisions^2 triangles, those of unit_box_mesh (shapes.h)."""
    numbers, triangles = {}, []

    def vertex(axis, layer, i, j):
        point = [0, 0, 0]
        point[axis], point[(axis + 1) % 3], point[(axis + 2) % 3] = layer, i, j
        return numbers.setdefault(tuple(point), len(numbers))

    for axis, layer in itertools.product(range(3), (0, divisions)):
        for i, j in itertools.product(range(divisions), repeat=2):
            quad = [vertex(axis, layer, i + u, j + v) for u, v in ((0, 0), (1, 0), (1, 1), (0, 1))]
            a, b, c, d = quad if layer else (quad[0], *reversed(quad[1:]))
            triangles += [[a, b, c], [a, c, d]]
    return [[k / divisions for k in point] for point in numbers], triangles


def sphere(radius, levels):
    """An octahedron about the origin, each triangle split in four `levels` times: closed."""
    vertices = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]]
    triangles = [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]]
    for _ in range(levels):
        middles, finer = {}, []

        def middle(a, b):
            key = min(a, b), max(a, b)
            if key not in middles:
                total = [p + q for p, q in zip(vertices[a], vertices[b])]
                middles[key] = len(vertices)
                vertices.append([x / math.hypot(*total) for x in total])
            return middles[key]

        for a, b, c in triangles:
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            finer += [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        triangles = finer
    return [[radius * x for x in vertex] for vertex in vertices], triangles


def moved(mesh, origin, size):
    """The mesh scaled by `size`, its origin moved to `origin`."""
    vertices, triangles = mesh
    return [[o + size * x for o, x in zip(origin, vertex)] for vertex in vertices], triangles


def obj_text(mesh):
    """Of an OBJ file, every coordinate to the bit."""
    vertices, triangles = mesh
    return "".join([*("v {!r} {!r} {!r}\n".format(*map(float, v)) for v in vertices),
                    *("f {} {} {}\n".format(*(k + 1 for k in t)) for t in triangles)])
