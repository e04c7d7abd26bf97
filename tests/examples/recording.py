"""Reads recordings (.ccr) and maps their bodies: a worked example in another language.

The format is fixtures/README.md, "Recordings (.ccr)"; the mapping is core/deform/mapping.h.
Python's floats are IEEE doubles and its operators never fuse, so deformed_vertices gives the very
doubles that contactcheck's detectors and oracle judge. Standard library only.

    recording = read("out/recordings/bunny-touch.ccr")
    for body, nodes in zip(recording.bodies, recording.nodes(30)):
        vertices = deformed_vertices(body.shape, nodes)
"""

import dataclasses
import math
import struct

MAGIC = b"\x89CCR\r\n\x1a\n"
VERSIONS = (1, 2)
SMALLEST_FILE = 32  # bytes: magic, version, size, hash
HASH_SIZE = 8

Point = tuple[float, float, float]


class BadRecording(Exception):
    """The file is not a recording, or what it says does not hold together. One sentence."""


@dataclasses.dataclass
class Lattice:
    cell_nodes: list[tuple[int, ...]]  # 8 node numbers per kept cell; bits 0, 1, 2 are x, y, z
    node_count: int
    home_cell: tuple[int, ...]  # one per vertex
    local: list[Point]  # (s, t, u) of each vertex in its home cell


@dataclasses.dataclass
class Shape:
    rest_vertices: list[Point]  # metres
    triangles: list[tuple[int, int, int]]
    lattice: Lattice | None  # none: the nodes are the vertices

    def node_count(self) -> int:
        return self.lattice.node_count if self.lattice else len(self.rest_vertices)


@dataclasses.dataclass
class Body:
    name: str
    shape: Shape  # shared by its instances


class Reader:
    """A place in the bytes. Every count is checked against the bytes left before it is believed."""

    def __init__(self, data: bytes, file: str):
        self.data = data
        self.file = file
        self.at = 0

    def fail(self, what: str):
        raise BadRecording(f'"{self.file}" {what}, at byte {self.at}.')

    def values(self, code: str, size: int, count: int) -> tuple:
        """`count` little-endian values, then the zero bytes up to the next multiple of 8."""
        if count > (len(self.data) - self.at) // size:
            self.fail(f"ends before {count} values of {size} bytes")
        out = struct.unpack_from(f"<{count}{code}", self.data, self.at)
        self.at += -(-count * size // 8) * 8
        return out

    def u64(self) -> int:
        return self.values("Q", 8, 1)[0]

    def f64s(self, count: int) -> tuple[float, ...]:
        out = self.values("d", 8, count)
        if not all(map(math.isfinite, out)):
            self.fail("holds a number that is not finite")
        return out

    def points(self, count: int) -> list[Point]:
        return rows(self.f64s(3 * count), 3)

    def u32_rows(self, count: int, width: int, below: int) -> list[tuple[int, ...]]:
        """Rows of numbers of things of which there are `below`."""
        out = self.values("I", 4, count * width)
        if max(out, default=0) >= max(below, 1):
            self.fail(f"refers to number {max(out)} of {below}")
        return rows(out, width)

    def text(self) -> str:
        return b"".join(self.values("c", 1, self.u64())).decode("utf-8", "replace")


def rows(values: tuple, width: int) -> list[tuple]:
    return list(zip(*[iter(values)] * width))


def fnv1a(data: bytes) -> int:
    """64-bit FNV-1a; about a quarter of a second per megabyte."""
    value = 0xCBF29CE484222325
    for byte in data:
        value = (value ^ byte) * 0x100000001B3 & 0xFFFFFFFFFFFFFFFF
    return value


def read_lattice(reader: Reader, vertex_count: int, triangle_count: int) -> Lattice:
    for _ in range(3):
        reader.f64s(reader.u64())  # grid lines
    cells = reader.u64()
    reader.values("I", 4, 3 * cells)  # grid positions of the cells
    nodes = reader.u64()
    reader.values("I", 4, 3 * nodes)  # grid positions of the nodes
    cell_nodes = reader.u32_rows(cells, 8, nodes)
    home = reader.u32_rows(vertex_count, 1, cells)
    local = reader.points(vertex_count)
    reader.values("I", 4, triangle_count + 1)  # where each triangle's labels start
    reader.values("I", 4, reader.u64())  # the labels, which drawing does not need
    return Lattice(cell_nodes, nodes, tuple(cell for cell, in home), local)


def read_shape(reader: Reader) -> Shape:
    reader.u64()  # key, for those who store shapes by content
    vertices = reader.points(reader.u64())
    if not vertices:
        reader.fail("has a shape without vertices")
    triangles = reader.u32_rows(reader.u64(), 3, len(vertices))
    has_lattice = reader.u64() & 1 == 1  # bit 1, of version 2: welded
    lattice = read_lattice(reader, len(vertices), len(triangles)) if has_lattice else None
    return Shape(vertices, triangles, lattice)


def read_body(reader: Reader, shapes: list[Shape]) -> Body:
    name = reader.text()
    number = reader.u64()
    if number >= len(shapes):
        reader.fail(f"has no shape number {number}")
    return Body(name, shapes[number])


class Recording:
    """Scene, bodies and frames; the nodes of a frame are decoded when they are asked for."""

    def __init__(self, reader: Reader, version: int):
        self.time_step = reader.f64s(1)[0]  # seconds
        self.scene = reader.text()
        self.levels = [reader.text() for _ in range(reader.u64())] if version > 1 else []
        shapes = [read_shape(reader) for _ in range(reader.u64())]
        self.bodies = [read_body(reader, shapes) for _ in range(reader.u64())]
        self.frame_count = reader.u64()
        self._reader = reader
        self._begin = reader.at
        if not self.bodies:
            reader.fail("has no body")
        self._frame_bytes = 24 * sum(body.shape.node_count() for body in self.bodies)
        if self._begin + self.frame_count * self._frame_bytes != len(reader.data):
            reader.fail(f"does not hold exactly {self.frame_count} frames")

    def nodes(self, frame: int) -> list[list[Point]]:
        """Positions of the nodes of each body, metres. @pre 0 <= frame < frame_count"""
        self._reader.at = self._begin + frame * self._frame_bytes
        return [self._reader.points(body.shape.node_count()) for body in self.bodies]


def read(file: str) -> Recording:
    """Raises BadRecording, or OSError when the file cannot be read."""
    with open(file, "rb") as stream:
        data = stream.read()
    if data[:8] != MAGIC or len(data) < SMALLEST_FILE:
        raise BadRecording(f'"{file}" is not a recording: it does not start as a .ccr file does.')
    version, size = struct.unpack_from("<2Q", data, 8)
    if version not in VERSIONS:
        raise BadRecording(f'"{file}" has version {version}, only versions 1 and 2 are known.')
    if size != len(data):
        raise BadRecording(f'"{file}" has {len(data)} bytes but was written with {size}.')
    content, told_hash = data[:-HASH_SIZE], struct.unpack("<Q", data[-HASH_SIZE:])[0]
    if fnv1a(content) != told_hash:
        raise BadRecording(f'"{file}" is damaged: its bytes do not have the hash at its end.')
    reader = Reader(content, file)
    reader.at = 24
    return Recording(reader, version)


def blend(a: float, b: float, w: float) -> float:
    return a * (1.0 - w) + b * w


def map_point(corners: list[Point], local: Point) -> Point:
    """The trilinear blend of eight corners: along s, then t, then u; this order makes the bits."""
    s, t, u = local
    out = []
    for k in range(3):
        x00 = blend(corners[0][k], corners[1][k], s)
        x10 = blend(corners[2][k], corners[3][k], s)
        x01 = blend(corners[4][k], corners[5][k], s)
        x11 = blend(corners[6][k], corners[7][k], s)
        out.append(blend(blend(x00, x10, t), blend(x01, x11, t), u))
    return tuple(out)


def deformed_vertices(shape: Shape, nodes: list[Point]) -> list[Point]:
    """Every vertex of a body, metres, from the nodes of a frame."""
    if shape.lattice is None:
        return nodes
    cells = [[nodes[n] for n in cell] for cell in shape.lattice.cell_nodes]
    home, local = shape.lattice.home_cell, shape.lattice.local
    return [map_point(cells[cell], at) for cell, at in zip(home, local)]


def lattice_edges(shape: Shape) -> list[tuple[int, int]]:
    """Node numbers at both ends of each edge of the kept cells, every edge once."""
    if shape.lattice is None:
        return []
    corner_pairs = [(c, c | bit) for bit in (1, 2, 4) for c in range(8) if not c & bit]
    cells = shape.lattice.cell_nodes
    return sorted({(cell[a], cell[b]) for cell in cells for a, b in corner_pairs})
