#!/usr/bin/env python3
"""A detector of queries of moving elements that contactcheck talks to over pipes. Standard library
only.

    contactcheck queries vf.csv --detector-cmd "python3 tests/examples/python-pipe/impacts.py"

It looks for the times at which four points lie in one plane, where a determinant changes its sign
between two of 33 samples, and asks there whether the elements meet. That is plain and misses what
touches without crossing, two crossings between samples, and motion within a plane.

The protocol is described in reference/plugin/README.md.
"""

import array
import json
import sys

from detector import cross, dot, sub

SAMPLES = 32
HALVINGS = 50


def points_at(start, end, t):
    return [tuple((1 - t) * a + t * b for a, b in zip(p, q)) for p, q in zip(start, end)]


def volume(points):
    """Of the four points; zero where they lie in one plane."""
    p, q, r, s = points
    return dot(sub(q, p), cross(sub(r, p), sub(s, p)))


def in_triangle(p, a, b, c):
    """Of a point in the triangle's plane."""
    normal = cross(sub(b, a), sub(c, a))
    return all(
        dot(normal, cross(sub(end, begin), sub(p, begin))) >= 0
        for begin, end in ((a, b), (b, c), (c, a))
    )


def edges_meet(a, b, c, d):
    """Of edges in one plane."""
    normal = cross(sub(b, a), sub(d, c))
    size = dot(normal, normal)
    along = [dot(cross(sub(c, a), edge), normal) for edge in (sub(d, c), sub(b, a))]
    return size > 0 and all(0 <= place <= size for place in along)


def first_contact(start, end, meet):
    """The first time in [0, 1] at which a change of sign is a contact; None without one."""
    times = [k / SAMPLES for k in range(SAMPLES + 1)]
    values = [volume(points_at(start, end, t)) for t in times]
    for k in range(SAMPLES):
        low, high = times[k], times[k + 1]
        if (values[k] > 0) == (values[k + 1] > 0):
            continue
        for _ in range(HALVINGS):
            middle = (low + high) / 2
            if (volume(points_at(start, end, middle)) > 0) == (values[k] > 0):
                low = middle
            else:
                high = middle
        if meet(*points_at(start, end, low)):
            return low
    return None


HELLO = {
    "message": "hello",
    "protocol": "contactcheck-pipe/1",
    "id": "python-samples",
    "summary": "example: changes of a sign between samples, in Python",
    "impacts": {"kinds": ["vertex-face", "edge-edge"]},
}


def write(line):
    sys.stdout.buffer.write(json.dumps(line).encode() + b"\n")
    sys.stdout.buffer.flush()


def read_points(size):
    numbers = array.array("d", sys.stdin.buffer.read(size))
    if sys.byteorder == "big":
        numbers.byteswap()
    points = list(zip(numbers[0::3], numbers[1::3], numbers[2::3]))
    return points[:4], points[4:]


def main():
    for text in iter(sys.stdin.buffer.readline, b""):
        line = json.loads(text)
        if line["message"] == "hello":
            write(HELLO)
        elif line["message"] == "prepare":
            write({"message": "ready"})
        elif line["message"] == "impact":
            start, end = read_points(line["bytes"])
            meet = in_triangle if line["kind"] == "vertex-face" else edges_meet
            time = first_contact(start, end, meet)
            if time is None:
                write({"message": "impact", "contact": False})
            else:
                write({"message": "impact", "contact": True, "time": time})


if __name__ == "__main__":
    main()
