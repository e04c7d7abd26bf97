#!/usr/bin/env python3
"""A collision detector that contactcheck talks to over pipes. Standard library only.

    contactcheck run bunny-touch --detector-cmd "python3 tests/examples/python-pipe/detector.py"

It answers with all pairs of triangles that share a point, exactly: the boxes of triangles are swept
along x, and what is left is tested in integers (every double is one, times a power of two). The
protocol is described in reference/plugin/README.md.
"""

import array
import json
import sys
import time


# ---- exact tests on points with integer coordinates; closed: touching counts ----------------


def sub(p, q):
    return (p[0] - q[0], p[1] - q[1], p[2] - q[2])


def dot(p, q):
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]


def cross(p, q):
    return (p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0])


NOTHING = (0, 0, 0)
EDGES = ((0, 1), (1, 2), (2, 0))


def on_segment(p, a, b):
    along = sub(b, a)
    to_p = sub(p, a)
    if along == NOTHING:
        return to_p == NOTHING
    return cross(along, to_p) == NOTHING and 0 <= dot(to_p, along) <= dot(along, along)


def segments_meet(a, b, c, d):
    u, v, w = sub(b, a), sub(d, c), sub(c, a)
    n = cross(u, v)
    if n == NOTHING:  # parallel, or one of them is a point
        return on_segment(a, c, d) or on_segment(c, a, b) or on_segment(d, a, b)
    if dot(n, w) != 0:
        return False
    size = dot(n, n)
    return 0 <= dot(cross(w, v), n) <= size and 0 <= dot(cross(w, u), n) <= size


def in_triangle(p, weight, triangle, n):
    """p / weight, a point of the triangle's plane; n: the plane's normal; weight > 0."""
    for i, j in EDGES:
        corner = triangle[i]
        to_p = (p[0] - weight * corner[0], p[1] - weight * corner[1], p[2] - weight * corner[2])
        if dot(n, cross(sub(triangle[j], corner), to_p)) < 0:
            return False
    return True


def segment_meets_triangle(a, b, triangle, n):
    if n != NOTHING:
        side_a, side_b = dot(n, sub(a, triangle[0])), dot(n, sub(b, triangle[0]))
        if (side_a > 0 and side_b > 0) or (side_a < 0 and side_b < 0):
            return False
        weight = side_a - side_b
        if weight != 0:  # the point where it meets the plane
            if weight < 0:
                side_a, side_b, weight = -side_a, -side_b, -weight
            point = tuple(side_a * y - side_b * x for x, y in zip(a, b))
            return in_triangle(point, weight, triangle, n)
        if in_triangle(a, 1, triangle, n) or in_triangle(b, 1, triangle, n):
            return True
    return any(segments_meet(a, b, triangle[i], triangle[j]) for i, j in EDGES)


def triangles_meet(p, q):
    normal_p = cross(sub(p[1], p[0]), sub(p[2], p[0]))
    normal_q = cross(sub(q[1], q[0]), sub(q[2], q[0]))
    return any(segment_meets_triangle(p[i], p[j], q, normal_q) for i, j in EDGES) or any(
        segment_meets_triangle(q[i], q[j], p, normal_p) for i, j in EDGES
    )


def is_proper(a, b, c):
    return cross(sub(b, a), sub(c, a)) != NOTHING


def same_direction(c, e, f):
    """On one ray from c; not where one of them is c."""
    return cross(sub(e, c), sub(f, c)) == NOTHING and dot(sub(e, c), sub(f, c)) > 0


def more_than_corner(c, p, q):
    """Triangles (c, *p) and (c, *q): do they share more than c?"""
    if is_proper(c, *p) and is_proper(c, *q):
        normal_p, normal_q = (cross(sub(t[0], c), sub(t[1], c)) for t in (p, q))
        return segment_meets_triangle(*p, (c, *q), normal_q) or segment_meets_triangle(
            *q, (c, *p), normal_p
        )
    segment, other = (q, p) if is_proper(c, *p) else (p, q)
    normal = cross(sub(other[0], c), sub(other[1], c))
    for end in segment:  # two arms from c
        if end == c:
            continue
        if normal == NOTHING:
            if any(same_direction(c, end, f) for f in other):
                return True
        elif dot(normal, sub(end, c)) == 0 and (
            in_triangle(end, 1, (c, *other), normal) or segments_meet(c, end, *other)
        ):
            return True
    return False


def more_than_edge(a, b, p, q):
    """Triangles (a, b, p) and (a, b, q): do they share more than the segment a b?"""
    along, normal = sub(b, a), cross(sub(b, a), sub(p, a))
    if is_proper(a, b, p) and is_proper(a, b, q):
        to_q = sub(q, a)
        return dot(normal, to_q) == 0 and dot(normal, cross(along, to_q)) > 0
    if is_proper(a, b, p) or is_proper(a, b, q):
        return False  # a triangle meets the line of its edge in the edge alone
    if along == NOTHING:
        return same_direction(a, p, q)
    places = [dot(sub(point, a), along) for point in (p, q)]
    return max(places) < 0 or min(places) > dot(along, along)


def neighbours_meet(p, q, points):
    """Two triangles of one body (three vertex numbers each; points: where these are), in more than
    what both name."""
    shared = sorted(set(p) & set(q))
    if not shared:
        return triangles_meet([points[v] for v in p], [points[v] for v in q])
    corners = [points[v] for v in shared]
    # A triangle that names a vertex twice is a segment.
    p, q = ([points[v] for v in t if v not in shared] + corners for t in (p, q))
    if len(shared) == 1:
        return more_than_corner(corners[0], tuple(p[:2]), tuple(q[:2]))
    return more_than_edge(*corners, p[0], q[0])


def in_integers(points):
    """The same points times one power of two, which moves no contact."""
    ratios = [[x.as_integer_ratio() for x in point] for point in points]
    common = max(below for point in ratios for _, below in point)
    return [tuple(above * (common // below) for above, below in point) for point in ratios]


# ---- the detector ---------------------------------------------------------------------------


class Body:
    def __init__(self, triangles):
        self.triangles = triangles  # three vertex numbers each
        self.points = []

    def move(self, numbers):
        self.points = list(zip(numbers[0::3], numbers[1::3], numbers[2::3]))

    def corners(self, triangle):
        a, b, c = self.triangles[triangle]
        return [self.points[a], self.points[b], self.points[c]]

    def boxes(self):
        """(low, high) of every triangle."""
        out = []
        for a, b, c in self.triangles:
            columns = list(zip(self.points[a], self.points[b], self.points[c]))
            out.append((tuple(map(min, columns)), tuple(map(max, columns))))
        return out


def overlap(one, other):
    return all(one[0][k] <= other[1][k] and other[0][k] <= one[1][k] for k in range(3))


def hull(boxes):
    lows, highs = zip(*boxes)
    return tuple(map(min, zip(*lows))), tuple(map(max, zip(*highs)))


def candidates(boxes_a, boxes_b):
    """Pairs (a, b) whose boxes overlap: both lists, thinned out, swept along x."""
    hull_a, hull_b = hull(boxes_a), hull(boxes_b)
    if not overlap(hull_a, hull_b):
        return
    events = [(box[0][0], 0, i) for i, box in enumerate(boxes_a) if overlap(box, hull_b)]
    events += [(box[0][0], 1, i) for i, box in enumerate(boxes_b) if overlap(box, hull_a)]
    events.sort()
    boxes, open_now = (boxes_a, boxes_b), ([], [])
    for low, side, i in events:
        box, others = boxes[side][i], boxes[1 - side]
        open_now[1 - side][:] = [j for j in open_now[1 - side] if others[j][1][0] >= low]
        for j in open_now[1 - side]:
            if overlap(box, others[j]):
                yield (i, j) if side == 0 else (j, i)
        open_now[side].append(i)


class Detector:
    def prepare(self, triangles_of_bodies):
        self.bodies = [Body(triangles) for triangles in triangles_of_bodies]

    def update(self, vertices_of_bodies):
        for body, numbers in zip(self.bodies, vertices_of_bodies):
            body.move(numbers)
        self.boxes = [body.boxes() if body.triangles else [] for body in self.bodies]

    def meeting(self, a, b):
        if not self.boxes[a] or not self.boxes[b]:
            return
        for i, j in candidates(self.boxes[a], self.boxes[b]):
            points = in_integers(self.bodies[a].corners(i) + self.bodies[b].corners(j))
            if triangles_meet(points[:3], points[3:]):
                yield a, b, i, j

    def meeting_itself(self, body):
        triangles, boxes = self.bodies[body].triangles, self.boxes[body]
        for i, j in candidates(boxes, boxes) if boxes else ():
            p, q = triangles[i], triangles[j]
            if i < j and set(p) != set(q):
                names = sorted({*p, *q})
                points = in_integers([self.bodies[body].points[v] for v in names])
                if neighbours_meet(p, q, dict(zip(names, points))):
                    yield body, body, i, j

    def pairs_of_bodies(self):
        count = len(self.bodies)
        return [(a, b) for a in range(count) for b in range(a + 1, count)]

    def triangles(self):
        return [pair for a, b in self.pairs_of_bodies() for pair in self.meeting(a, b)]

    def self_triangles(self):
        return [pair for body in range(len(self.bodies)) for pair in self.meeting_itself(body)]

    def touching_bodies(self):
        return [(a, b) for a, b in self.pairs_of_bodies() if any(True for _ in self.meeting(a, b))]


# ---- the protocol: lines of JSON, numbers behind them ---------------------------------------

HELLO = {
    "message": "hello",
    "protocol": "contactcheck-pipe/1",
    "id": "python-sweep",
    "summary": "example: boxes swept along x, triangles tested in integers, in Python",
    "semantics": {
        "levels": ["body", "triangle", "self", "self-vertex", "self-edge", "self-body"],
        "questions": ["triangles", "body", "self"],
        "exact": True,
    },
    "needs": ["vertices"],
}


def write(line, payload=b""):
    if payload:
        line["bytes"] = len(payload)
    sys.stdout.buffer.write(json.dumps(line).encode() + b"\n" + payload)
    sys.stdout.buffer.flush()


def take(kind, count):
    """So many numbers: "d" doubles, "I" unsigned 32-bit integers; both little-endian."""
    out = array.array(kind)
    out.frombytes(sys.stdin.buffer.read(count * out.itemsize))
    if sys.byteorder == "big":
        out.byteswap()
    return out


def read_bodies(line):
    out = []
    for body in line["bodies"]:
        take("d", 3 * body["vertices"])  # at rest
        numbers = take("I", 3 * body["triangles"])
        out.append(list(zip(numbers[0::3], numbers[1::3], numbers[2::3])))
        if body["lattice"]:
            skip_lattice(body)
    return out


def skip_lattice(body):
    lattice = body["lattice"]
    take("d", 3 * lattice["nodes"])  # at rest
    take("I", 8 * lattice["cells"])  # nodes of each cell
    take("I", body["vertices"])  # home cell of each vertex
    take("d", 3 * body["vertices"])  # where in that cell
    take("I", body["triangles"] + 1 + lattice["labels"])  # cells that each triangle met at rest


def answer(detector, question):
    find = {"triangles": detector.triangles, "self": detector.self_triangles}
    pairs = find.get(question, detector.touching_bodies)()
    numbers = array.array("I", [number for pair in pairs for number in pair])
    if sys.byteorder == "big":
        numbers.byteswap()
    return {"triangles" if question in find else "bodies": len(pairs)}, numbers.tobytes()


def milliseconds(start):
    return 1e3 * (time.perf_counter() - start)


def main():
    detector = Detector()
    counts = []
    while True:
        text = sys.stdin.buffer.readline()
        if not text:
            return  # contactcheck is done
        line = json.loads(text)
        if line["message"] == "hello":
            write(HELLO)
        elif line["message"] == "prepare":
            counts = [body["vertices"] for body in line["bodies"]]
            detector.prepare(read_bodies(line))
            write({"message": "ready"})
        elif line["message"] == "frame":
            vertices = [take("d", 3 * count) for count in counts]
            start = time.perf_counter()
            detector.update(vertices)
            write({"message": "done", "ms": milliseconds(start)})
        elif line["message"] == "query":
            start = time.perf_counter()
            found, payload = answer(detector, line["question"])
            write({"message": "contacts", "ms": milliseconds(start), **found}, payload)


if __name__ == "__main__":
    main()
