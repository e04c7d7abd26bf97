#!/usr/bin/env python3
"""Checks what `contactcheck export` wrote: which triangles of different bodies touch, and that no
others do; of a scene that asks for it, which triangles of one body meet in more than the vertices
they share. Exact; only this script has to be trusted.   python3 check.py [FOLDER...]   (its own)
Exit code 0: every proof holds; 1: one line names the first that does not.
scene.json             bodies, frames, counts, and the CRC-32 of every file below
bodies/B/frame_N.ply   the deformed surface of a body: doubles, metres; what was judged, to the bit
bodies/B/order.json    a permutation of the body's triangles; a range is a stretch of it
bodies/B/welded.json   of a welded body: its triangles, one vertex for all that are at one place
truth/frame_N.json     "contacts": [body, body, triangle, triangle, weights, weights], all pairs of
    triangles that share a point, with one: the corners of either times their weights (hexadecimal
    integers, not negative) over the sum of the weights. "body_pairs": the bodies of contacts.
    "gaps": [body, body, triangle, triangle, [x, y, z, offset]], the other pairs whose boxes meet,
    each with a plane: normal * corner <= offset for the corners of the first triangle, > offset for
    the second's. A number is that double; a text is a rational, "n" or "n/d", hexadecimal.
    "decisions": a letter each, for the pairs of bodies (0,1), (0,2), ... (1,2), ... in turn. Begin
    with all triangles of the one and all of the other: every pair of them is in question.
      a, b    split the first or second range i .. j at i + (j - i) // 2; lower half first
      x, y, z the boxes of the two ranges are apart along this axis: no pair of them touches
      t, s    one triangle and one triangle, that touch ("contacts") or do not ("gaps")
    With "self", every body follows with itself: pairs within the lower half of a range, within the
    upper half, and between both; one triangle has none. Two that share vertices may share these:
      t       they share another point
      s       they share one corner: the plane goes through it, and only with equality there, or in
              the other one, which is then strictly on its side
      e       nothing else: they share an edge, or are segments (share_hull_alone)
      d       they have the same vertices: not asked
Not certified: containment, vertices inside, cells, margins, lengths and depths, which vertices are
welded, nor that the vertices are what the scene's lattices make of its meshes.

An export with --between is checked likewise: what meets within steps. A step goes from a frame to
the next one; every vertex moves straight, from its place at t = 0 to that at t = 1.
steps.json             as scene.json; "steps": how many pairs of bodies are proven apart or in
    contact, or are unproved: then nothing is said of them
truth/step_N.json      a pair of bodies each: (0,1), (0,2), ... (1,2), ...; with "self" every body
    follows with itself. One of these is proven of a pair:
    "decisions": at no t in [0, 1] do the two have a common point. Of a body with itself: two
      triangles without a common vertex have none, nor a vertex and a triangle, nor two edges,
      without a common vertex. Ranges of triangles as above, and a part of the step, at first all:
        h       split the part in its middle; earlier half first
        x, y, z at both ends of the part the one box is apart from the other along this axis, on
                the same side: so it is in between, as what moves straight stays within a box that
                does. A box at a time t: (1 - t) times that at the start + t times that at the end
        s       the next of "directions": at both ends of the part it is larger along all corners of
                the first triangles than along those of the second; and so in between
        n       one triangle and one triangle, of one body, that share a vertex
        f       one and one, in the whole step: the next of "triangles", a plane between them at
                the start, and proofs as below that their elements do not meet: each vertex of the
                first with the second, each of the second with the first, the edges (0, 1), (1, 2),
                (2, 0) of the first with each of the second. Triangles that are apart at the start
                first meet in such elements
      "elements": of a body with itself, proofs that such of its elements do not meet of which no
        two triangles without a common vertex have one each (loose_elements)
    "touch": [triangle, triangle, weights, weights]: they share a point at t = 0
    "meet": [KIND, [body, vertex], [body, triangle], proof] or [KIND, [body, vertex, vertex], [body,
      vertex, vertex], proof]: elements that meet, as below. That nothing meets before is not proven
Not certified, besides the above: what meets on other paths; which neighbours among triangles meet
in more than they share.

An export with --queries --certificates is checked likewise: whether two moving elements meet.
queries.json           counts, and the CRC-32 of every file below
KIND.csv               eight lines a query: its four points at t = 0, then at t = 1, as
    x_num,x_den,y_num,y_den,z_num,z_den,truth. Points move straight. KIND is vertex-face (vertex;
    three corners of a triangle) or edge-edge (two ends; two ends): a first and a second element.
KIND.certificates.jsonl  a line a query: its proof; or null: there is none, which is counted
    "apart": pieces of the step, [end, reason, ...], each from where the one before it ends, the
    first from t = 0. Throughout a piece the elements have no common point:
      "volume"              the four points are not in one plane
      "side", axis, i, j    in the projection along the axis, all points of one element are on one
                            side of the line through points i and j, which are of the other
                            element, and no point of that is on this side
      "direction", x, y, z  is larger along the points of the first element than of the second
    No contact: the pieces end at t = 1. Contact: it is first at most 2^-40 after the last piece:
    "crosses": [start, end, axis]: within these times the points come to be in one plane, and
        whenever they are, the elements have a common point, which the projection shows
    "meets": [time, weights]: the point of both elements then, as the weighted sum of the points of
        either; [x, y] is x + y * sqrt(root), where "meets" is [time, weights, root]
"""
import json, math, pathlib, struct, sys, zlib  # noqa: E401
from fractions import Fraction
from itertools import combinations

HEADER = """ply\nformat binary_little_endian 1.0\nelement vertex {vertices}
property double x\nproperty double y\nproperty double z
element face {triangles}\nproperty list uchar int vertex_indices"""


class Wrong(Exception):
    pass


# What the code below raises when a file is not as exports are written.
NOT_AS_WRITTEN = ArithmeticError, AttributeError, LookupError, TypeError, ValueError


def require(condition, sentence):
    if not condition:
        raise Wrong(sentence)


def read(folder, index, name):
    require((folder / name).is_file(), f"{name} is missing")
    data = (folder / name).read_bytes()
    require(f"{zlib.crc32(data):08x}" == index["crc32"].get(name),
            f"{name} ({len(data)} bytes) is not the file that was exported: another CRC-32")
    return data


class Body:  # in one frame after the other; the extents of its boxes are doubles, only compared
    def __init__(self, entry, order, welded=None):
        self.entry, self.order, self.faces = entry, json.loads(order), None
        self.welded, self.loose_ = welded and json.loads(welded), None
        require(self.order and sorted(self.order) == list(range(entry["triangles"])),
                f"{entry['folder']}/order.json is no permutation of the triangles")

    def load(self, name, ply):
        header, _, data = ply.partition(b"end_header\n")
        lines = [x for x in header.decode().splitlines() if not x.startswith("comment ")]
        require("\n".join(lines) == HEADER.format(**self.entry), f"{name}: another header")
        vertices, split = self.entry["vertices"], 24 * self.entry["vertices"]
        require(len(data) == split + 13 * self.entry["triangles"], f"{name}: another length")
        self.vertices = list(struct.iter_unpack("<3d", data[:split]))
        require(all(math.isfinite(x) for v in self.vertices for x in v), f"{name}: not finite")
        if self.faces is None:
            self.faces = data[split:]
            self.triangles = list(struct.iter_unpack("<B3i", self.faces))
            require(all(t[0] == 3 and min(t[1:]) >= 0 and max(t[1:]) < vertices
                        for t in self.triangles), f"{name}: faces that are no triangles")
        require(data[split:] == self.faces, f"{name}: other triangles than in earlier frames")
        self.linked = self.welded or [list(t[1:]) for t in self.triangles]
        require(len(self.linked) == len(self.triangles) and all(
            self.vertices[v] == self.vertices[w] for own, linked in zip(self.triangles, self.linked)
            for v, w in zip(own[1:], linked)), f"{name}: welded vertices are not at one place")
        self.known = {}

    def corners(self, triangle):
        return [self.vertices[v] for v in self.triangles[triangle][1:]]

    def loose(self):
        self.loose_ = self.loose_ or loose_elements([t[1:] for t in self.triangles], self.linked)
        return self.loose_

    def extent(self, axis, i, j):
        if not self.known:
            places = [self.corners(t) for t in self.order]
            self.low = [[min(a[k], b[k], c[k]) for a, b, c in places] for k in range(3)]
            self.high = [[max(a[k], b[k], c[k]) for a, b, c in places] for k in range(3)]
        if (axis, i, j) not in self.known:
            self.known[axis, i, j] = min(self.low[axis][i:j]), max(self.high[axis][i:j])
        return self.known[axis, i, j]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def whole(numbers):
    """Rationals times the least integer that makes integers of them all; and that integer."""
    unit = math.lcm(*(x.denominator for x in numbers))
    return [x.numerator * (unit // x.denominator) for x in numbers], unit


def whole_corners(p, q):
    values, unit = whole([Fraction(x) for corner in p + q for x in corner])
    return [values[i:i + 3] for i in (0, 3, 6)], [values[i:i + 3] for i in (9, 12, 15)], unit


def is_common_point(p, q, weights_p, weights_q):
    p, q, _ = whole_corners(p, q)
    u, v = [int(w, 16) for w in weights_p], [int(w, 16) for w in weights_q]
    return (len(u) == len(v) == 3 and min(u + v) >= 0 and sum(u) > 0 and sum(v) > 0 and
            all(dot(u, x) * sum(v) == dot(v, y) * sum(u) for x, y in zip(zip(*p), zip(*q))))


def number(n):
    if isinstance(n, str):
        return Fraction(*(int(part, 16) for part in n.split("/")))
    return Fraction(n)


def separates(p, q, plane):
    p, q, unit = whole_corners(p, q)
    (*normal, offset), _ = whole([number(n) for n in plane])
    return (len(normal) == 3 and all(dot(normal, corner) <= offset * unit for corner in p) and
            all(dot(normal, corner) > offset * unit for corner in q))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def rational(triangle):
    return [[Fraction(x) for x in corner] for corner in triangle]


def is_further_point(p, q, weights_p, weights_q, shared):
    """A common point that is not on the hull of the first corners, one or two."""
    if not is_common_point(p, q, weights_p, weights_q):
        return False
    p, weights = rational(p), [int(w, 16) for w in weights_p]
    at = [Fraction(dot(weights, x), sum(weights)) for x in zip(*p)]
    edge, to = minus(p[shared - 1], p[0]), minus(at, p[0])
    return any(to) and (not any(edge) or any(cross(edge, to)) or
                        not 0 <= dot(to, edge) <= dot(edge, edge))


def separates_at_corner(p, q, plane):
    p, q, unit = whole_corners(p, q)
    (*normal, offset), _ = whole([number(n) for n in plane])
    of_p, of_q = ([dot(normal, corner) - offset * unit for corner in t] for t in (p, q))
    return (len(normal) == 3 and of_p[0] == of_q[0] == 0 and max(of_p) <= 0 <= min(of_q) and
            (max(of_p[1:]) < 0 or min(of_q[1:]) > 0))


def share_hull_alone(p, q, shared):
    """Of triangles whose first two corners are the same, or the first if both are segments."""
    p, q = rational(p), rational(q)
    normals = [cross(minus(t[1], t[0]), minus(t[2], t[0])) for t in (p, q)]
    proper = [any(n) for n in normals]
    if shared == 2 and all(proper):  # off one plane, or on two sides of the edge
        return dot(normals[0], minus(q[2], q[0])) != 0 or dot(*normals) < 0
    if any(proper):  # a proper triangle meets the line of its edge in the edge alone
        return shared == 2
    u, v = (minus(t[2] if t[1] == t[0] else t[1], t[0]) for t in (p, q))
    if any(cross(u, v)) or not any(u) or not any(v):  # on two lines, or a point, which is shared
        return True
    s, t = ([dot(minus(x, p[0]), u) for x in triangle] for triangle in (p, q))
    hull = sorted([s[0], s[shared - 1]])
    return hull[0] <= max(min(s), min(t)) and min(max(s), max(t)) <= hull[1]


def prove_neighbours(step, body, pair, listed, where):
    """What is said of two triangles of one body; False if they share no vertex."""
    *_, s, t = pair
    one, other = body.linked[s], body.linked[t]
    common = [v for n, v in enumerate(one) if v in other and v not in one[:n]]
    if not common:
        return False
    if set(one) == set(other):
        require(step == "d", f"{where} have the same vertices, and \"{step}\" was decided")
        return True
    orders = []
    for linked in (one, other):
        first = [linked.index(v) for v in common]
        orders.append(first + [n for n in range(3) if n not in first])
    p, q = ([body.corners(t)[n] for n in order] for t, order in zip((s, t), orders))
    if step == "e":
        require(share_hull_alone(p, q, len(common)), f"{where} share more than their vertices")
        return True
    kind = {"t": "contacts", "s": "gaps"}.get(step)
    proof = kind and listed[kind].pop(pair, None)
    require(proof, f"{where}: \"{step}\" was decided, but nothing is listed")
    if step == "s":
        require(len(common) == 1 and separates_at_corner(p, q, *proof),
                f"{where}: the plane does not separate them")
    else:
        weights = [[w[n] for n in order] for w, order in zip(proof, orders)]
        require(is_further_point(p, q, *weights, len(common)),
                f"{where}: the witness is no further point of both")
    return True


def replay(decisions, bodies, listed, own):
    """Follows the decisions. Pairs that they call contacts or gaps are checked and unlisted."""
    at = 0
    pairs = [*combinations(range(len(bodies)), 2), *((a, a) for a in range(len(bodies)) if own)]
    for a, b in pairs:
        one, other = bodies[a], bodies[b]
        todo = [(0, len(one.order), 0, len(other.order))]
        while todo:
            i, j, k, l = todo.pop()
            if a == b and i == k:
                half = i + (j - i) // 2
                if j - i > 1:
                    todo += [(i, half, half, j), (half, j, half, j), (i, half, i, half)]
                continue
            step, at = decisions[at:at + 1], at + 1
            where = f"decision {at} (\"{step}\": {i} .. {j} of body {a}, {k} .. {l} of body {b})"
            require(step, f"{where}: the decisions end before all pairs are covered")
            if step == "a" and j - i > 1:
                todo += [(i + (j - i) // 2, j, k, l), (i, i + (j - i) // 2, k, l)]
            elif step == "b" and l - k > 1:
                todo += [(i, j, k + (l - k) // 2, l), (i, j, k, k + (l - k) // 2)]
            elif step in "xyz":
                low, high = one.extent("xyz".index(step), i, j)
                other_low, other_high = other.extent("xyz".index(step), k, l)
                require(high < other_low or other_high < low, f"{where}: the boxes are not apart")
            else:
                require(step in "tsed" and j - i == l - k == 1, f"{where}: cannot be decided so")
                s, t = one.order[i], other.order[k]
                if a == b:
                    s, t = sorted((s, t))
                    named = f"triangles {s} and {t} of body {a}"
                    if prove_neighbours(step, one, (a, b, s, t), listed, named):
                        continue
                require(step in "ts", f"{where}: cannot be decided so")
                where = f"triangle {s} of body {a} and triangle {t} of body {b}"
                kind, holds, fault = (
                    ("contacts", is_common_point, "the witness is no point of both") if step == "t"
                    else ("gaps", separates, "the plane does not separate them"))
                proof = listed[kind].pop((a, b, s, t), None)
                require(proof, f"{where}: \"{step}\" was decided, but {kind} do not list them")
                require(holds(one.corners(s), other.corners(t), *proof), f"{where}: {fault}")
    require(at == len(decisions), "the decisions go on when all pairs are covered")


def chain_hash(previous, frame, body_pairs, contacts):
    """The contact_hash of results.json: 64-bit FNV-1a over sets that have no cells or vertices."""
    data = struct.pack("<QQQ", previous, frame, len(body_pairs))
    data += b"".join(struct.pack("<2I", *p) for p in body_pairs)
    between = [c for c in contacts if c[0] != c[1]]
    own = [(c[0], *c[2:4]) for c in contacts if c[0] == c[1]]
    data += struct.pack("<QQ", 0, len(between))
    data += b"".join(struct.pack("<4I", *c[:4]) for c in between) + bytes(8)
    data += b"".join(struct.pack("<3I", *c) for c in own)
    data += b"".join(struct.pack("<I", body) for body in sorted({c[0] for c in own}))
    state = 0xcbf29ce484222325
    for byte in data:
        state = (state ^ byte) * 0x100000001b3 & 0xffffffffffffffff
    return state


def check_frame(entry, truth, bodies, own):
    listed = {kind: {tuple(x[:4]): x[4:] for x in truth[kind]} for kind in ("contacts", "gaps")}
    for kind, pairs in listed.items():
        require(sorted(pairs) == [tuple(x[:4]) for x in truth[kind]],
                f"{kind} are not in order, each once")
    require(truth["body_pairs"] == sorted([*pair] for pair in {x[:2] for x in listed["contacts"]}
                                          if pair[0] != pair[1]),
            "body_pairs are not those of the contacts")
    for key in ("body_pairs", "contacts", "gaps"):
        require(len(truth[key]) == entry[key], f"scene.json has another number of {key}")
    replay(truth["decisions"], bodies, listed, own)
    for kind, rest in listed.items():
        require(not rest, f"{kind} list {next(iter(rest), ())}, which nothing decided to be one")


def read_bodies(folder, index):
    return [Body(b, read(folder, index, b["folder"] + "/order.json"),
                 b.get("welded") and read(folder, index, b["folder"] + "/welded.json"))
            for b in index["bodies"]]


def load_frame(folder, index, bodies, frame):
    for body in bodies:
        name = f"{body.entry['folder']}/frame_{frame:04}.ply"
        body.load(name, read(folder, index, name))


def check_frames(folder):
    index, chained = json.loads((folder / "scene.json").read_bytes()), 0
    require(index["schema"] == "contactcheck-certificates/1", "scene.json: another schema")
    frames, every = index["frames"], index["every"]
    require([f["frame"] for f in frames] == list(range(0, index["scene_frames"], every)),
            f"scene.json: not every frame out of {every} is there")
    bodies = read_bodies(folder, index)
    for entry in frames:
        try:
            load_frame(folder, index, bodies, entry["frame"])
            truth = json.loads(read(folder, index, f"truth/frame_{entry['frame']:04}.json"))
            check_frame(entry, truth, bodies, index.get("self", False))
        except Wrong as wrong:
            raise Wrong(f"frame {entry['frame']}: {wrong}") from None
        chained = chain_hash(chained, truth["frame"], truth["body_pairs"], truth["contacts"])
    require(index["contact_hash"] == f"0x{chained:016x}", "scene.json: another contact_hash")
    contacts, gaps = (sum(f[key] for f in frames) for key in ("contacts", "gaps"))
    return (f"{index['scene']}: {len(frames)} frames proven: {contacts} pairs of triangles share a "
            f"point; {gaps} are separated by a plane, all others by boxes")


# --- Queries of moving elements. Below, `first` is the number of points of the first element.

FIRST = {"vertex-face": 1, "edge-edge": 2}
WIDTH = Fraction(1, 2 ** 40)  # of the interval that holds the first contact, a fraction of the step


class Form:
    """A polynomial on a piece: c[0] (1-s)^n + c[1] (1-s)^(n-1) s + ... + c[n] s^n, where s goes
    from 0 to 1. The products are not negative, so it has the sign that all of c have."""

    def __init__(self, c):
        self.c = c

    def __add__(self, other):  # of the same degree, as in all sums below
        return Form([x + y for x, y in zip(self.c, other.c)])

    def __sub__(self, other):
        return Form([x - y for x, y in zip(self.c, other.c)])

    def __mul__(self, other):
        product = [0] * (len(self.c) + len(other.c) - 1)
        for i, x in enumerate(self.c):
            for j, y in enumerate(other.c):
                product[i + j] += x * y
        return Form(product)

    def positive(self):
        return min(self.c) > 0

    def negative(self):
        return max(self.c) < 0


class Query:
    """The places of the points at both ends of the step, times one number that makes integers."""

    def __init__(self, kind, start, end, contact):
        self.start, self.end = start, end
        self.first, self.contact = FIRST[kind], contact

    @classmethod
    def of_rows(cls, kind, rows):
        truths, places = set(), []
        for row in rows:
            *coordinates, truth = (int(x) for x in row.split(","))
            require(len(coordinates) == 6, "not six numbers and a truth")
            places += [Fraction(*coordinates[k:k + 2]) for k in (0, 2, 4)]
            truths.add(truth)
        require(truths in ({0}, {1}), "the truth is not 0, nor is it 1, on all its lines")
        places, _ = whole(places)
        points = [places[k:k + 3] for k in range(0, 24, 3)]
        return cls(kind, points[:4], points[4:], truths == {1})

    def at(self, time, unit):
        """The points at a time, times a number that makes it an integer."""
        k = time.numerator * (unit // time.denominator)
        return [[x * unit + (y - x) * k for x, y in zip(*p)] for p in zip(self.start, self.end)]

    def between(self, start, end):
        """The points as forms on a piece, times a positive number."""
        unit = math.lcm(start.denominator, end.denominator)
        return [[Form(c) for c in zip(*p)] for p in zip(self.at(start, unit), self.at(end, unit))]


def volume(points):
    u, v, w = (minus(p, points[0]) for p in points[1:])
    n = cross(u, v)
    return n[0] * w[0] + n[1] * w[1] + n[2] * w[2]


def is_side(first, points, axis, i, j):
    own = range(first) if i in range(first) else range(first, 4)
    require(i in own and j in own and axis in range(3), "no line of one element")
    line = minus(points[j], points[i])
    areas = [cross(line, minus(p, points[i]))[axis] for p in points]
    others = [areas[k] for k in range(4) if k not in own]
    if all(a.positive() for a in others):
        return all(max(areas[k].c) <= 0 for k in own)
    return all(a.negative() for a in others) and all(min(areas[k].c) >= 0 for k in own)


def leads(first, points, direction):
    along = [dot(direction, p) for p in points]
    return min(along[:first]) > max(along[first:])


def are_apart(query, start, end, reason, *rest):
    """Whether the reason holds from start to end, so that the elements have no common point."""
    if reason == "volume":
        f = volume(query.between(start, end))
        return f.positive() or f.negative()
    if reason == "side":
        return is_side(query.first, query.between(start, end), *rest)
    require(reason == "direction" and len(rest) == 3, "an unknown reason")
    direction, _ = whole([number(x) for x in rest])
    # Points move straight: what holds at both ends holds in between.
    return all(leads(query.first, query.at(t, t.denominator), direction) for t in (start, end))


def shares(first, points, axis):
    """In a projection, the weights of the points at the point that the elements' planes or lines
    have in common, times the number that comes first. Where that is not 0 and the points are in one
    plane, the plane does not collapse in the projection: the weights are those of a common point in
    space. Of a vertex they are for the corners alone."""
    p = points
    if first == 1:
        a, b, c = (minus(x, p[0]) for x in p[1:])
        weights = [cross(u, v)[axis] for u, v in ((b, c), (c, a), (a, b))]
        return weights[0] + weights[1] + weights[2], weights
    one, other, between = minus(p[1], p[0]), minus(p[3], p[2]), minus(p[2], p[0])
    total, s, t = (cross(u, v)[axis] for u, v in ((one, other), (between, other), (between, one)))
    return total, [total - s, s, total - t, t]


def do_cross(query, reached, start, end, axis):
    """The volume changes its sign, so it is 0 in between; the weights are never negative."""
    start, end = number(start), number(end)
    if not reached <= start < end <= min(1, reached + WIDTH) or axis not in range(3):
        return False
    points = query.between(start, end)
    f, (total, weights) = volume(points), shares(query.first, points, axis)
    if f.c[0] * f.c[-1] >= 0:
        return False
    if total.positive():
        return all(min(w.c) >= 0 for w in weights)
    return total.negative() and all(max(w.c) <= 0 for w in weights)


class Surd:
    """x + y * sqrt(root)"""

    def __init__(self, n, root):
        self.x, self.y = (number(k) for k in (n if isinstance(n, list) else (n, 0)))
        self.root = root

    def __add__(self, other):
        return Surd([self.x + other.x, self.y + other.y], self.root)

    def __sub__(self, other):
        return Surd([self.x - other.x, self.y - other.y], self.root)

    def __mul__(self, other):
        return Surd([self.x * other.x + self.y * other.y * self.root,
                     self.x * other.y + self.y * other.x], self.root)

    def sign(self):
        # x > -y sqrt(root) where x |x| > -y |y| root, as u |u| grows with u.
        value = self.x * abs(self.x) + self.y * abs(self.y) * self.root
        return (value > 0) - (value < 0)


def do_meet(query, reached, time, weights, root=0):
    root = number(root)
    require(root >= 0 and len(weights) == 4, "no time and four weights")

    def surd(n):
        return Surd(n, root)

    def total(values):
        return sum(values, start=surd(0))

    time, weights = surd(time), [surd(w) for w in weights]
    if (time - surd(reached)).sign() < 0 or (surd(min(1, reached + WIDTH)) - time).sign() < 0:
        return False
    if any(w.sign() < 0 for w in weights):
        return False
    points = [[surd(x) + surd(y - x) * time for x, y in zip(*p)]
              for p in zip(query.start, query.end)]
    parts = [[surd(1), *p] for p in points]  # the 1: the weights of both elements add up to 1
    parts = [[w * x for x in part] for w, part in zip(weights, parts)]
    one, other = ([total(x) for x in zip(*group)]
                  for group in (parts[:query.first], parts[query.first:]))
    return (one[0] - surd(1)).sign() == 0 and all((x - y).sign() == 0 for x, y in zip(one, other))


def prove_query(query, proof):
    """Raises Wrong unless the proof holds and is one of the query's truth."""
    reached = Fraction(0)
    for end, *reason in proof["apart"]:
        end = number(end)
        require(reached < end <= 1, "the pieces do not follow one another in the step")
        require(are_apart(query, reached, end, *reason),
                f"the elements are not proven apart up to t = {float(end)}")
        reached = end
    contacts = [key for key in ("crosses", "meets") if key in proof]
    require(len(contacts) == query.contact,
            f"the truth is {int(query.contact)}, the proof's is not")
    if not contacts:
        require(reached == 1, f"the pieces end at t = {float(reached)}")
    elif contacts == ["crosses"]:
        require(do_cross(query, reached, *proof["crosses"]), "the elements are not proven to cross")
    else:
        require(do_meet(query, reached, *proof["meets"]), "the elements are not proven to meet")


def check_kind(folder, index, kind):
    name, proofs = f"{kind}.csv", f"{kind}.certificates.jsonl"
    rows, lines = (read(folder, index, x).decode().splitlines() for x in (name, proofs))
    require(len(rows) == 8 * len(lines), f"{proofs} has not one line for eight of {name}")
    apart = contacts = unproved = 0
    for n, line in enumerate(lines):
        try:
            query, proof = Query.of_rows(kind, rows[8 * n:8 * n + 8]), json.loads(line)
            if proof is None:
                unproved += 1
                continue
            prove_query(query, proof)
        except (Wrong, *NOT_AS_WRITTEN) as wrong:
            what = wrong if isinstance(wrong, Wrong) else f"{type(wrong).__name__}: {wrong}"
            raise Wrong(f"{name}, line {8 * n + 1}; {proofs}, line {n + 1}: {what}") from None
        contacts += query.contact
        apart += not query.contact
    counts = index[kind.replace("-", "_")]
    require((apart + contacts, unproved) == (counts["proved"], counts["unproved"]),
            f"queries.json has other counts of proofs of {kind}")
    return f"{kind}: {contacts} contacts proven, {apart} proven apart, {unproved} without proof"


def check_queries(folder):
    index = json.loads((folder / "queries.json").read_bytes())
    require(index["schema"] == "contactcheck-query-export/1", "queries.json: another schema")
    require(index.get("certificates"), "there is nothing to check: exported without --certificates")
    return f"{index['scene']}: " + "; ".join(check_kind(folder, index, kind) for kind in FIRST)


# --- Steps: what meets between frames.


def loose_elements(triangles, linked):
    """What the whole triangles say nothing of: vertices with triangles, and edges with edges, that
    share no vertex, where every triangle of the one shares a vertex with every triangle of the
    other. The first are (vertex, triangle), the second (vertex, vertex, vertex, vertex)."""
    sets = [frozenset(corners) for corners in linked]
    around, edges = {}, []
    for t, corners in enumerate(linked):
        for v in sets[t]:
            around.setdefault(v, set()).add(t)
        edges.append({tuple(sorted((corners[i], corners[i - 1]))) for i in range(3)
                      if triangles[t][i] != triangles[t][i - 1]})

    def all_share(of_one, of_other):
        return all(sets[s] & sets[t] for s in of_one for t in of_other)

    vertices, pairs = set(), set()
    for s, own in enumerate(sets):
        for t in set().union(*(around[v] for v in own)) - {s}:
            vertices.update((v, t) for v in own - sets[t] if all_share(around[v], [t]))
            for e in edges[s]:
                for f in edges[t]:
                    if e < f and not {*e} & {*f} and e + f not in pairs and all_share(
                            around[e[0]] & around[e[1]], around[f[0]] & around[f[1]]):
                        pairs.add(e + f)
    return sorted(vertices), sorted(pairs)


WHOLE = 0, 1  # part 0 of 1 of the step


class Moving:
    """A body in a step: vertices at both ends, and boxes of ranges of triangles."""

    def __init__(self, body, start, end, unit):
        self.body, self.order, self.linked, self.unit = body, body.order, body.linked, unit
        self.triangles = [t[1:] for t in body.triangles]
        self.points = [p + q for p, q in zip(start, end)]  # x, y, z at t = 0, then at t = 1
        self.boxes, self.known = {}, {}

    def whole(self, v):
        """A vertex as six integers: all of a step times one power of two."""
        if v not in self.known:
            ratios = [x.as_integer_ratio() for x in self.points[v]]
            self.known[v] = tuple(n * (self.unit // d) for n, d in ratios)
        return self.known[v]

    def box(self, i, j):
        """Six times (low, high), doubles: along x, y, z at t = 0, then at t = 1."""
        if (i, j) not in self.boxes:
            if j - i == 1:
                corners = zip(*[self.points[v] for v in self.triangles[self.order[i]]])
                self.boxes[i, j] = [(min(x), max(x)) for x in corners]
            else:
                half = i + (j - i) // 2
                self.boxes[i, j] = [(min(a, c), max(b, d)) for (a, b), (c, d)
                                    in zip(self.box(i, half), self.box(half, j))]
        return self.boxes[i, j]

    def vertices(self, i, j):
        return [self.whole(v) for v in {v for t in self.order[i:j] for v in self.triangles[t]}]


def ends(at_start, at_end, part):
    """What moves straight, at both ends of a part of the step, times the number of parts."""
    if part == WHOLE:
        return at_start, at_end
    n, parts = part
    if isinstance(at_start, float):
        at_start, at_end = Fraction(at_start), Fraction(at_end)
    return at_start * (parts - n) + at_end * n, at_start * (parts - n - 1) + at_end * (n + 1)


def boxes_apart(one, other, axis, part):
    def before(first, second):
        high = ends(first[axis][1], first[axis + 3][1], part)
        low = ends(second[axis][0], second[axis + 3][0], part)
        return high[0] < low[0] and high[1] < low[1]
    return before(one, other) or before(other, one)


def direction_leads(direction, one, other, part):
    x, y, z = direction
    low, high = (list(zip(*(ends(x * a + y * b + z * c, x * d + y * e + z * f, part)
                            for a, b, c, d, e, f in points))) for points in (one, other))
    return min(low[0]) > max(high[0]) and min(low[1]) > max(high[1])


def elements_of(p, q):
    """The fifteen pairs of elements of two triangles: kind, and the corners' places in p + q."""
    for i in range(3):
        yield "vertex-face", (i, 3, 4, 5)
    for j in range(3):
        yield "vertex-face", (3 + j, 0, 1, 2)
    for i in range(3):
        for j in range(3):
            yield "edge-edge", (i, (i + 1) % 3, 3 + j, 3 + (j + 1) % 3)


def prove_elements(kind, points, proof, contact=False):
    prove_query(Query(kind, [p[:3] for p in points], [p[3:] for p in points], contact), proof)


def prove_triangles(p, q, plane, proofs):
    """Two triangles, as corners at both ends, do not meet in the step."""
    corners = [[p[:3] for p in triangle] for triangle in (p, q)]
    # The plane speaks of doubles, not of these integers times a unit: a direction is enough.
    (*normal, _), _ = whole([number(n) for n in plane])
    require(len(normal) == 3 and max(dot(normal, x) for x in corners[0]) <
            min(dot(normal, x) for x in corners[1]), "the plane does not separate them")
    wanted = list(elements_of(p, q))
    require(len(proofs) == len(wanted), "not a proof for each of the fifteen pairs of elements")
    for (kind, places), proof in zip(wanted, proofs):
        prove_elements(kind, [(p + q)[n] for n in places], proof)


def prove_decisions(one, other, entry):
    """Follows the decisions on two bodies, or on one with itself."""
    own, at = one is other, 0
    directions, triangles = iter(entry["directions"]), iter(entry["triangles"])
    decisions = entry["decisions"]
    require(all(type(x) is int for n in entry["directions"] for x in n),
            "directions are not of integers")
    todo = [(0, len(one.order), 0, len(other.order), WHOLE)]
    while todo:
        i, j, k, l, part = todo.pop()
        if own and i == k:
            half = i + (j - i) // 2
            if j - i > 1:
                todo += [(i, half, half, j, part), (half, j, half, j, part),
                         (i, half, i, half, part)]
            continue
        step, at = decisions[at:at + 1], at + 1
        try:
            if step == "a" and j - i > 1:
                todo += [(i + (j - i) // 2, j, k, l, part), (i, i + (j - i) // 2, k, l, part)]
            elif step == "b" and l - k > 1:
                todo += [(i, j, k + (l - k) // 2, l, part), (i, j, k, k + (l - k) // 2, part)]
            elif step == "h":
                n, parts = part
                todo += [(i, j, k, l, (2 * n + 1, 2 * parts)), (i, j, k, l, (2 * n, 2 * parts))]
            elif step and step in "xyz":
                require(boxes_apart(one.box(i, j), other.box(k, l), "xyz".index(step), part),
                        "the boxes are not apart")
            elif step == "s":
                require(direction_leads(next(directions), one.vertices(i, j), other.vertices(k, l),
                                        part), "the direction does not separate them")
            else:
                require(step, "the decisions end before all pairs are covered")
                require(step in "nf" and j - i == l - k == 1, "cannot be decided so")
                s, t = one.order[i], other.order[k]
                if step == "n":
                    require(own and {*one.linked[s]} & {*one.linked[t]}, "they share no vertex")
                else:
                    require(part == WHOLE, "not in the whole step")
                    p, q = ([body.whole(v) for v in body.triangles[x]]
                            for body, x in ((one, s), (other, t)))
                    prove_triangles(p, q, *next(triangles))
        except Wrong as wrong:
            raise Wrong(f"decision {at} (\"{step}\": {i} .. {j} of the first, {k} .. {l} of the "
                        f"second, part {part[0]} of {part[1]}): {wrong}") from None
        except StopIteration:
            raise Wrong(f"decision {at} (\"{step}\"): it has no proof") from None
    require(at == len(decisions), "the decisions go on when all pairs are covered")
    require(next(directions, None) is None and next(triangles, None) is None,
            "there are more proofs than decisions")
    loose = one.body.loose() if own else ([], [])
    require(len(entry["elements"]) == sum(map(len, loose)),
            f"not a proof for each of the {sum(map(len, loose))} loose pairs of elements")
    proofs = iter(entry["elements"])
    for v, t in loose[0]:
        prove_elements("vertex-face", [one.whole(w) for w in (v, *one.linked[t])], next(proofs))
    for four in loose[1]:
        prove_elements("edge-edge", [one.whole(v) for v in four], next(proofs))


def prove_touch(one, other, s, t, *weights):
    require(one is not other or not {*one.linked[s]} & {*one.linked[t]}, "they share a vertex")
    p, q = ([body.points[v][:3] for v in body.triangles[x]] for body, x in ((one, s), (other, t)))
    require(is_common_point(p, q, *weights), "the witness is no point of both")


def prove_meeting(bodies, pair, kind, first, second, proof):
    """Each element as its body, and a vertex, a triangle or two vertices of an edge."""
    require(sorted([first[0], second[0]]) == pair, "they are not of these bodies")
    vertices, places = [], []
    for place, (b, *named) in enumerate((first, second)):
        body = bodies[b]
        if kind == "vertex-face":
            require(len(named) == 1, "not one vertex or triangle")
            used = body.triangles[named[0]] if place else named
        else:
            used = named
            require(any({*named} <= {*t} for t in body.triangles) and len({*named}) == 2,
                    "this is no edge")
        at = {v: w for t, linked in zip(body.triangles, body.linked) for v, w in zip(t, linked)}
        vertices.append({at[v] for v in used})
        places += [body.whole(v) for v in used]
    require(first[0] != second[0] or not vertices[0] & vertices[1], "they share a vertex")
    prove_elements(kind, places, proof, True)


def check_pair(bodies, pair, entry):
    """What is proven of a pair of bodies: "apart", "contacts" or, that is nothing, "unproved"."""
    require(entry["bodies"] == pair, "this pair of bodies is not in its place")
    one, other = (bodies[b] for b in pair)
    if "unproved" in entry:
        return "unproved"
    if "decisions" in entry:
        prove_decisions(one, other, entry)
        return "apart"
    if "touch" in entry:
        prove_touch(one, other, *entry["touch"])
    else:
        prove_meeting(bodies, pair, *entry["meet"])
    return "contacts"


def check_step(entry, truth, bodies, own):
    pairs = [list(p) for p in combinations(range(len(bodies)), 2)]
    pairs += [[b, b] for b in range(len(bodies)) if own]
    require(len(truth["pairs"]) == len(pairs), "not one proof for every pair of bodies")
    counts = dict.fromkeys(("apart", "contacts", "unproved"), 0)
    for pair, proof in zip(pairs, truth["pairs"]):
        try:
            counts[check_pair(bodies, pair, proof)] += 1
        except Wrong as wrong:
            raise Wrong(f"bodies {pair[0]} and {pair[1]}: {wrong}") from None
    require(all(entry[key] == count for key, count in counts.items()),
            "steps.json has other counts of pairs of bodies")


def unit_of(frames):
    """The least power of two that makes integers of all coordinates."""
    lowest = min((math.frexp(x)[1] - 53 for frame in frames for vertices in frame
                  for v in vertices for x in v if x), default=0)
    return 2 ** max(0, -lowest)


def check_steps(folder):
    index = json.loads((folder / "steps.json").read_bytes())
    require(index["schema"] == "contactcheck-step-certificates/1", "steps.json: another schema")
    own, steps = index["self"], index["steps"]
    require([s["step"] for s in steps] == list(range(index["frames"] - 1)) and steps,
            "steps.json: not every step is there")
    bodies, before = read_bodies(folder, index), None
    for frame in range(index["frames"]):
        step = frame - 1
        try:
            load_frame(folder, index, bodies, frame)
            places = [body.vertices for body in bodies]
            if before:
                truth = json.loads(read(folder, index, f"truth/step_{step:04}.json"))
                unit = unit_of((before, places))
                moving = [Moving(*both, unit) for both in zip(bodies, before, places)]
                check_step(steps[step], truth, moving, own)
        except Wrong as wrong:
            raise Wrong((f"step {step} to {frame}: " if before else "") + str(wrong)) from None
        before = places
    apart, contacts, unproved = (sum(s[key] for s in steps)
                                 for key in ("apart", "contacts", "unproved"))
    meet = [str(s["step"]) for s in steps if s["contacts"]]
    listed = f" (from frames {', '.join(meet[:10])}{', ...' * (len(meet) > 10)})" * bool(meet)
    pairs = "pairs of bodies" + ", each with itself among them," * own
    return (f"{index['scene']}: {len(steps)} steps, on straight paths between these frames: "
            f"{apart} {pairs} proven apart, {contacts} proven in contact{listed}, "
            f"{unproved} without proof")


def check_export(folder):
    if (folder / "steps.json").is_file():
        return check_steps(folder)
    if (folder / "queries.json").is_file():
        return check_queries(folder)
    require((folder / "scene.json").is_file(), "scene.json is missing: this is no whole export")
    return check_frames(folder)


if __name__ == "__main__":
    if {"-h", "--help"} & set(sys.argv[1:]):
        sys.exit(print(__doc__))
    for place in sys.argv[1:] or [pathlib.Path(__file__).resolve().parent]:
        try:
            print(check_export(pathlib.Path(place)), flush=True)
        except Wrong as wrong:
            sys.exit(f"{place}: {wrong}")
        except NOT_AS_WRITTEN as error:
            sys.exit(f"{place}: not as exports are written: {type(error).__name__}: {error}")
