"""A cloth that falls over a ball, as if recorded: the same faces in every frame.

Files: numbered OBJ and PLY, PC2 and MDD point caches (formats: fixtures/README.md). Coordinates are
floats, so that all four say the same numbers.
"""

import math
import pathlib
import struct

FRAMES = 8


def as_float(point):
    return struct.unpack("<3f", struct.pack("<3f", *point))


def grid_faces(columns, rows):
    """Two triangles per square of a grid of vertices, rows running fastest."""
    faces = []
    for i in range(columns - 1):
        for j in range(rows - 1):
            a = i * rows + j
            faces += [(a, a + 1, a + rows), (a + 1, a + rows + 1, a + rows)]
    return faces


CLOTH_FACES = grid_faces(17, 17)


def cloth(frame):
    """An open sheet of 1.6 m that comes down while its corners sag."""
    points = []
    for i in range(17):
        for j in range(17):
            x, z = i / 10 - 0.8, j / 10 - 0.8
            sag = 0.03 * frame * (x * x + z * z)
            points.append(as_float((x, 0.75 - 0.06 * frame - sag, z)))
    return points


RINGS, SECTORS = 12, 16


def ring(i, j):
    return 1 + (i - 1) * SECTORS + j % SECTORS


def ball_faces():
    last = 1 + (RINGS - 1) * SECTORS
    faces = []
    for j in range(SECTORS):
        faces.append((0, ring(1, j + 1), ring(1, j)))
        for i in range(1, RINGS - 1):
            a, b, c, d = ring(i, j), ring(i, j + 1), ring(i + 1, j), ring(i + 1, j + 1)
            faces += [(a, b, c), (b, d, c)]
        faces.append((ring(RINGS - 1, j), ring(RINGS - 1, j + 1), last))
    return faces


BALL_FACES = ball_faces()


def ball(frame):
    """A closed ball of 1 m, not below the middle of the cloth, which becomes flatter."""
    height = 1.0 - 0.02 * frame
    points = [(0.0, 0.5, 0.0)]
    for i in range(1, RINGS):
        for j in range(SECTORS):
            t, p = math.pi * i / RINGS, 2 * math.pi * j / SECTORS
            points.append((math.sin(t) * math.cos(p) / 2, math.cos(t) / 2,
                           math.sin(t) * math.sin(p) / 2))
    points.append((0.0, -0.5, 0.0))
    wide = 1 / math.sqrt(height)
    return [as_float((x * wide + 0.031, y * height, z * wide + 0.017)) for x, y, z in points]


def obj_text(points, faces):
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in points]
    lines += [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in faces]
    return "\n".join(lines) + "\n"


def ply_text(points, faces):
    lines = ["ply", "format ascii 1.0", f"element vertex {len(points)}",
             *(f"property double {axis}" for axis in "xyz"), f"element face {len(faces)}",
             "property list uchar int vertex_indices", "end_header"]
    lines += [f"{x!r} {y!r} {z!r}" for x, y, z in points]
    lines += [f"3 {a} {b} {c}" for a, b, c in faces]
    return "\n".join(lines) + "\n"


def floats(order, samples):
    values = [value for sample in samples for point in sample for value in point]
    return struct.pack(f"{order}{len(values)}f", *values)


def pc2_bytes(samples):
    head = struct.pack("<12siiffi", b"POINTCACHE2", 1, len(samples[0]), 0.0, 1.0, len(samples))
    return head + floats("<", samples)


def mdd_bytes(samples):
    times = [frame / 25 for frame in range(len(samples))]
    head = struct.pack(f">ii{len(times)}f", len(samples), len(samples[0]), *times)
    return head + floats(">", samples)


def write(folder: pathlib.Path):
    """cloth_0000.obj and on, ball_0000.ply and on, cloth.pc2, cloth.mdd."""
    for frame in range(FRAMES):
        (folder / f"cloth_{frame:04d}.obj").write_text(obj_text(cloth(frame), CLOTH_FACES))
        (folder / f"ball_{frame:04d}.ply").write_text(ply_text(ball(frame), BALL_FACES))
    samples = [cloth(frame) for frame in range(FRAMES)]
    (folder / "cloth.pc2").write_bytes(pc2_bytes(samples))
    (folder / "cloth.mdd").write_bytes(mdd_bytes(samples))
