"""An export of a small scene is accepted; every way to break it is refused with its own sentence.

CONTACTCHECK_PROGRAM names the program. A faulty file gets the checksum that belongs to it, unless
the checksum is what the test is about: the proofs must hold by themselves.
"""

import json
import os
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib
from fractions import Fraction

SCENE = {
    "id": "tiny", "title": "Two boxes that come to touch, and a cube with a lid, which touch in one plane", "frames": 3, "duration": 1,
    "levels": ["body", "triangle"],
    "bodies": [
        {"name": "left/box", "mesh": {"shape": "box", "divisions": 3}, "lattice": {"cells": [3, 3, 3]}},
        {"name": "right", "mesh": {"shape": "box", "divisions": 3}, "lattice": {"cells": [3, 3, 3]},
         "motion": {"position": [[0, [1.4, 0.1, 0.2]], [0.3, [0.9, 0.1, 0.2]], [1, [0.95, 0.1, 0.2]]],
                    "deformers": [{"twist": {"axis": "x", "degrees": [[0, 0], [1, 20]]}}]}},
        {"name": "cube", "mesh": {"shape": "box", "divisions": 1, "center": [0, 9, 0]}},
        {"name": "lid", "mesh": {"shape": "box", "divisions": 1, "center": [0, 10, 0]}}]}
CONTACT_FRAME = "truth/frame_0001.json"

# Triangles by the vertices they share with the first: two (on its side of the edge, and beyond), one
# (through it, and away from it), all, one that welding alone makes one, one of a segment, two of it.
NEIGHBOURS = """
v 0 0 0
v 1 0 0
v 0 1 0
v 0.3 0.5 0
v 0.3 0.3 -1
v 0.3 0.3 1
v -1 -1 0.2
v -1 -0.5 0
v 1 1 0
v 0 0 0
v -1 1 -0.2
v -0.5 1 0
f 1 2 3
f 1 2 4
f 3 5 6
f 1 7 8
f 2 3 9
f 2 3 1
f 10 11 12
f 1 7 7
f 1 7 1
"""
SELF_SCENE = {
    "id": "neighbours", "frames": 2, "duration": 1,
    "levels": ["self", "self-vertex", "self-edge", "self-body"],
    "bodies": [{"name": "all", "mesh": {"file": "neighbours.obj", "weld": True}}]}


# Two bodies at 45 degrees to the axes: a gap in the first step, first contact in the second, contact
# from the start in the third. A third one passes: apart along x first, then along y.
MOVING_SCENE = {
    "id": "moving", "title": "Boxes that come to touch, and one that passes", "frames": 4, "time_step": 1,
    "levels": ["body", "self"],
    "bodies": [
        {"name": "still", "mesh": {"shape": "box", "divisions": 3}, "lattice": {"cells": [3, 3, 3]},
         "motion": {"spins": [{"axis": "z", "degrees": 45}],
                    "deformers": [{"twist": {"axis": "z", "degrees": [[0, 0], [3, 6]]}}]}},
        {"name": "moves", "mesh": {"shape": "box", "divisions": 3}, "lattice": {"cells": [3, 3, 3]},
         "motion": {"spins": [{"axis": "z", "degrees": 45}],
                    "position": [[0, [0.78, 0.78, 0.1]], [1, [0.74, 0.76, 0.1]], [3, [0.6, 0.6, 0.2]]]}},
        {"name": "passes", "mesh": {"file": "tetrahedron.obj"},
         "motion": {"position": [[0, [9, -1, 0]], [1, [-1, 9, 0]]]}}]}

# All its triangles share vertices.
TETRAHEDRON = "v 0 0 0\nv 0.5 0 0\nv 0 0.5 0\nv 0 0 0.5\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"

# A corner of the second is 1e-30 off the plane of the first, over its middle: doubles find no
# direction between them.
CLOSE = {"one": "v 1234567891 987654321 555555555\nv -333333337 777777771 123456797\n"
                "v -901234554 -1765432092 -679012352\nf 1 2 3\n",
         "other": "v 1e-30 0 0\nv -9 100000000 -99999999\nv -12 100000000 -200000000\nf 1 2 3\n"}
CLOSE_SCENE = {
    "id": "close", "frames": 2, "duration": 1, "levels": ["body"],
    "bodies": [{"name": name, "mesh": {"file": name + ".obj"}} for name in CLOSE]}


class Exported(unittest.TestCase):
    scene, words, last = SCENE, (), "scene.json"

    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.exported = pathlib.Path(scratch.name)
        (cls.exported / "neighbours.obj").write_text(NEIGHBOURS)
        for name, text in {**CLOSE, "tetrahedron": TETRAHEDRON}.items():
            (cls.exported / f"{name}.obj").write_text(text)
        cls.file = cls.exported / f"{cls.scene['id']}.json"
        cls.file.write_text(json.dumps(cls.scene))
        cls.contactcheck("export", cls.file, *cls.words, "--out", cls.exported)

    def setUp(self):
        """Every test breaks a copy of its own."""
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.scratch = pathlib.Path(scratch.name) / "export"
        shutil.copytree(self.exported, self.scratch)
        self.folder = self.scratch / self.scene["id"]

    @staticmethod
    def contactcheck(*words):
        subprocess.run([os.environ["CONTACTCHECK_PROGRAM"], *words], check=True,
                       stdout=subprocess.DEVNULL)

    def check(self):
        command = [sys.executable, "-B", self.folder / "check.py"]
        return subprocess.run(command, capture_output=True, text=True)

    def refused(self, *pieces):
        done = self.check()
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        for piece in pieces:
            self.assertIn(piece, done.stderr)

    def index(self):
        return json.loads((self.folder / self.last).read_bytes())

    def write(self, name, data):
        """Replaces a file, and its checksum in the index."""
        (self.folder / name).write_bytes(data)
        if name != self.last:
            index = self.index()
            index["crc32"][name] = f"{zlib.crc32(data):08x}"
            self.write(self.last, json.dumps(index).encode())

    def change_index(self, change):
        index = self.index()
        change(index)
        self.write(self.last, json.dumps(index).encode())

    def change_truth(self, change, name=CONTACT_FRAME):
        truth = json.loads((self.folder / name).read_bytes())
        change(truth)
        self.write(name, json.dumps(truth).encode())

    def expect_hash_of_results(self, *detectors):
        named = [word for name in detectors for word in ("--detector", name)]
        self.contactcheck("run", self.file, "--no-timing", "--quiet", *named,
                          "--out", self.scratch / "out")
        results = json.loads((self.scratch / "out/results.json").read_bytes())
        hashes = {run["contact_hash"] for run in results["runs"]}
        self.assertEqual(hashes, {self.index()["contact_hash"]})


class CheckExport(Exported):
    def test_help_is_the_head_of_the_script(self):
        help_text = subprocess.run([sys.executable, "-B", self.folder / "check.py", "--help"],
                                   capture_output=True, text=True, check=True).stdout
        self.assertTrue(help_text.startswith("Checks what `contactcheck export` wrote"), help_text)

    def test_accepts_an_export(self):
        done = self.check()
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("tiny: 3 frames proven: ", done.stdout)
        self.assertEqual([f["body_pairs"] for f in self.index()["frames"]], [1, 2, 2])
        self.assertTrue(all(f["gaps"] > 0 for f in self.index()["frames"][1:]))

    def test_hash_is_that_of_results(self):
        self.expect_hash_of_results("fcl-aabb", "ffd-lazy")

    def moved_vertex(self):
        name = "bodies/1-right/frame_0001.ply"
        data = bytearray((self.folder / name).read_bytes())
        start = data.index(b"end_header\n") + 11
        triangle = json.loads((self.folder / CONTACT_FRAME).read_bytes())["contacts"][0][3]
        face = start + 24 * self.index()["bodies"][1]["vertices"] + 13 * triangle + 1
        vertex = start + 24 * int.from_bytes(data[face:face + 4], "little")
        data[vertex] ^= 1  # the last bit of x
        return name, bytes(data)

    def test_refuses_a_moved_vertex(self):
        name, data = self.moved_vertex()
        (self.folder / name).write_bytes(data)
        self.refused("frame 1", name, "another CRC-32")

    def test_refuses_a_vertex_moved_with_its_checksum(self):
        self.write(*self.moved_vertex())
        self.refused("frame 1: triangle ", "of body 1: the witness is no point of both")

    def test_refuses_a_dropped_contact(self):
        def drop(truth):
            del truth["contacts"][4]
        self.change_truth(drop)
        self.refused("frame 1: scene.json has another number of contacts")
        self.change_index(lambda index: index["frames"][1].update(
            contacts=index["frames"][1]["contacts"] - 1))
        self.refused("\"t\" was decided, but contacts do not list them")

    def test_refuses_a_changed_witness(self):
        def change(truth):
            weights = truth["contacts"][2][4]
            k = next(k for k in range(3) if weights[k] != "0")
            weights[k] = f"{int(weights[k], 16) + 1:x}"
            weights[k - 1] = f"{int(weights[k - 1], 16) + 1:x}"
        self.change_truth(change)
        a, b, s, t = json.loads((self.folder / CONTACT_FRAME).read_bytes())["contacts"][2][:4]
        self.refused(f"frame 1: triangle {s} of body {a} and triangle {t} of body {b}",
                     "the witness is no point of both")

    def test_refuses_a_negative_weight(self):
        # All weights of either side negative: the point would be the same.
        def negate(truth):
            for weights in truth["contacts"][0][4:]:
                weights[:] = ["-" + w for w in weights]
        self.change_truth(negate)
        self.refused("the witness is no point of both")

    def test_refuses_a_changed_plane(self):
        def turn(truth):
            plane = truth["gaps"][0][4]
            plane[:] = [-x for x in plane]
        self.change_truth(turn)
        a, b, s, t = json.loads((self.folder / CONTACT_FRAME).read_bytes())["gaps"][0][:4]
        self.refused(f"frame 1: triangle {s} of body {a} and triangle {t} of body {b}",
                     "the plane does not separate them")

    def move_plane(self, offset_of):
        """Gives a plane another offset: what `offset_of` makes of the heights of the corners of the
        second triangle over its normal, as an exact text."""
        truth = json.loads((self.folder / CONTACT_FRAME).read_bytes())
        _, b, _, t, plane = truth["gaps"][0]
        ply = (self.folder / self.index()["bodies"][b]["folder"] / "frame_0001.ply").read_bytes()
        data = ply[ply.index(b"end_header\n") + 11:]
        face = 24 * self.index()["bodies"][b]["vertices"] + 13 * t
        corners = [struct.unpack_from("<3d", data, 24 * v)
                   for v in struct.unpack_from("<3i", data, face + 1)]
        offset = offset_of([sum(Fraction(n) * Fraction(x) for n, x in zip(plane, corner))
                            for corner in corners])
        plane[3] = f"{offset.numerator:x}/{offset.denominator:x}"
        self.write(CONTACT_FRAME, json.dumps(truth).encode())

    def test_refuses_a_plane_that_touches_the_second(self):
        self.move_plane(lambda heights: min(heights) - Fraction(1, 2**60))
        self.assertEqual(self.check().returncode, 0)
        self.move_plane(min)
        self.refused("the plane does not separate them")

    def test_refuses_a_plane_below_the_first(self):
        self.move_plane(lambda heights: min(heights) - 100)
        self.refused("the plane does not separate them")

    def test_refuses_boxes_that_touch_as_apart(self):
        # In frame 0 the other five pairs of bodies are apart.
        def change(truth):
            self.assertEqual({c[0] for c in truth["contacts"]}, {2})
            truth.update(decisions=truth["decisions"][:5] + "y", contacts=[], gaps=[], body_pairs=[])
        self.change_truth(change, "truth/frame_0000.json")
        self.change_index(lambda index: index["frames"][0].update(contacts=0, gaps=0, body_pairs=0))
        self.refused("frame 0: decision 6 (\"y\": ", "the boxes are not apart")

    def test_refuses_a_plane_for_more_than_one_pair(self):
        # The first two bodies are apart along x in frame 0, and so are all their triangles.
        orders = [json.loads((self.folder / b["folder"] / "order.json").read_bytes())
                  for b in self.index()["bodies"][:2]]

        def change(truth):
            truth["decisions"] = "s" + truth["decisions"][1:]
            truth["gaps"].insert(0, [0, 1, orders[0][0], orders[1][0], [1, 0, 0, 0.7]])
        self.change_truth(change, "truth/frame_0000.json")

        def recount(index):
            index["frames"][0]["gaps"] += 1
        self.change_index(recount)
        self.refused("frame 0: decision 1 (\"s\": ", "cannot be decided so")

    def test_refuses_a_gap_that_nothing_decided(self):
        self.change_truth(lambda truth: truth["gaps"].insert(0, [0, 1, 0, 0, [1, 0, 0, 0.7]]),
                          "truth/frame_0000.json")

        def recount(index):
            index["frames"][0]["gaps"] += 1
        self.change_index(recount)
        self.refused("frame 0: gaps list (0, 1, 0, 0), which nothing decided to be one")

    def test_refuses_contacts_out_of_order(self):
        self.change_truth(lambda truth: truth["contacts"].reverse())
        self.refused("frame 1: contacts are not in order, each once")

    def test_refuses_a_forgotten_pair_of_bodies(self):
        self.change_truth(lambda truth: truth["body_pairs"].pop())
        self.change_index(lambda index: index["frames"][1].update(body_pairs=1))
        self.refused("frame 1: body_pairs are not those of the contacts")

    def test_refuses_a_surface_that_is_none(self):
        name = "bodies/2-cube/frame_0000.ply"
        data = (self.folder / name).read_bytes()
        start = data.index(b"end_header\n") + 11
        nan = struct.pack("<d", float("nan"))
        self.write(name, data[:start] + nan + data[start + 8:])
        self.refused(f"frame 0: {name}: not finite")
        self.write(name, data[:-13] + b"\4" + data[-12:])
        self.refused(f"frame 0: {name}: faces that are no triangles")
        self.write(name, data.replace(b"property double x", b"property double w"))
        self.refused(f"frame 0: {name}: another header")

    def test_refuses_another_schema(self):
        self.change_index(lambda index: index.update(schema="contactcheck-certificates/2"))
        self.refused("scene.json: another schema")

    def test_refuses_what_is_no_number(self):
        def change(truth):
            truth["gaps"][0][4][3] = "1/0"
        self.change_truth(change)
        self.refused("not as exports are written: ZeroDivisionError")

    def test_refuses_a_skipped_subtree(self):
        # The first split after which the lower halves are claimed to be apart, with all below.
        def skip(truth):
            decisions = truth["decisions"]
            end, open_ranges = 1, 1
            while open_ranges > 0:
                open_ranges += {"a": 1, "b": 1}.get(decisions[end], -1)
                end += 1
            truth["decisions"] = decisions[0] + "x" + decisions[end:]
        self.change_truth(skip)
        self.refused("frame 1: decision 2 (\"x\": ", "the boxes are not apart")

    def test_refuses_decisions_that_end_early(self):
        self.change_truth(lambda truth: truth.update(decisions=truth["decisions"][:-1]))
        self.refused("frame 1", "the decisions end before all pairs are covered")

    def test_refuses_decisions_that_go_on(self):
        self.change_truth(lambda truth: truth.update(decisions=truth["decisions"] + "x"))
        self.refused("frame 1: the decisions go on when all pairs are covered")

    def test_refuses_a_wrong_axis(self):
        # In frame 0 all bodies are apart; the first two along x alone.
        def change(truth):
            self.assertEqual(truth["decisions"][0], "x")
            truth["decisions"] = "z" + truth["decisions"][1:]
        self.change_truth(change, "truth/frame_0000.json")
        self.refused("frame 0: decision 1 (\"z\": ", "the boxes are not apart")

    def test_refuses_a_contact_called_a_gap(self):
        # With all else made right: every 't' becomes an 's', and has some plane.
        def change(truth):
            planes = [contact[:4] + [[1, 2, 3, 0.5]] for contact in truth["contacts"]]
            truth["gaps"] = sorted(truth["gaps"] + planes, key=lambda gap: gap[:4])
            truth["decisions"] = truth["decisions"].replace("t", "s")
            truth["contacts"], truth["body_pairs"] = [], []
        self.change_truth(change)

        def recount(index):
            frame = index["frames"][1]
            frame["gaps"] += frame["contacts"]
            frame["contacts"] = frame["body_pairs"] = 0
        self.change_index(recount)
        self.refused("frame 1: triangle ", "the plane does not separate them")

    def test_refuses_a_missing_frame(self):
        self.change_index(lambda index: index["frames"].pop(1))
        self.refused("scene.json: not every frame out of 1 is there")

    def test_refuses_a_missing_file(self):
        (self.folder / "bodies/0-left_box/frame_0002.ply").unlink()
        self.refused("frame 2: bodies/0-left_box/frame_0002.ply is missing")

    def test_refuses_a_truncated_file(self):
        name = "bodies/0-left_box/frame_0002.ply"
        data = (self.folder / name).read_bytes()[:-5]
        (self.folder / name).write_bytes(data)
        self.refused(f"frame 2: {name} ({len(data)} bytes) is not the file that was exported")
        self.write(name, data)
        self.refused(f"frame 2: {name}: another length")

    def test_refuses_an_order_that_forgets_a_triangle(self):
        name = "bodies/1-right/order.json"
        order = json.loads((self.folder / name).read_bytes())
        order[0] = order[1]
        self.write(name, json.dumps(order).encode())
        self.refused(f"{name} is no permutation of the triangles")

    def test_refuses_other_triangles_in_a_later_frame(self):
        name = "bodies/2-cube/frame_0001.ply"
        data = (self.folder / name).read_bytes()
        self.write(name, data[:-13] + data[-26:-13])
        self.refused(f"frame 1: {name}: other triangles than in earlier frames")

    def test_refuses_a_wrong_hash(self):
        self.change_index(lambda index: index.update(contact_hash="0x0123456789abcdef"))
        self.refused("scene.json: another contact_hash")

    def test_refuses_an_unfinished_export(self):
        (self.folder / "scene.json").unlink()
        self.refused("scene.json is missing")


class CheckSelfExport(Exported):
    scene = SELF_SCENE
    first = "truth/frame_0000.json"

    def truth(self):
        return json.loads((self.folder / self.first).read_bytes())

    def decide(self, was, becomes):
        """Replaces the first decision of a kind."""
        def change(truth):
            self.assertIn(was, truth["decisions"])
            truth["decisions"] = truth["decisions"].replace(was, becomes, 1)
        self.change_truth(change, self.first)

    def without(self, kind, pair):
        def drop(truth):
            truth[kind] = [entry for entry in truth[kind] if entry[2:4] != pair]
        self.change_truth(drop, self.first)
        self.change_index(lambda index: index["frames"][0].update(
            {kind: index["frames"][0][kind] - 1}))

    def test_accepts_an_export(self):
        done = self.check()
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("neighbours: 2 frames proven: ", done.stdout)
        truth = self.truth()
        self.assertEqual(truth["body_pairs"], [])
        pairs = [entry[2:4] for entry in truth["contacts"]]
        for pair in ([0, 1], [0, 2], [1, 2]):  # by two, one and no shared vertices
            self.assertIn(pair, pairs)
        self.assertTrue({"t", "s", "e", "d"} <= set(truth["decisions"]), truth["decisions"])

    def test_hash_is_that_of_results(self):
        self.expect_hash_of_results("full-refit", "ffd-lazy")

    def test_refuses_a_witness_on_what_is_shared(self):
        for pair, shared in (([0, 1], 0), ([0, 2], 2)):
            def change(truth):
                entry = next(e for e in truth["contacts"] if e[2:4] == pair)
                faces = {0: [0, 1, 2], 1: [0, 1, 3], 2: [2, 4, 5]}
                for weights, t in zip(entry[4:], pair):
                    weights[:] = ["1" if v == shared else "0" for v in faces[t]]
            self.setUp()
            self.change_truth(change, self.first)
            self.refused(f"triangles {pair[0]} and {pair[1]} of body 0: the witness is no further")

    def test_refuses_a_contact_said_to_be_none(self):
        self.decide("t", "e")
        self.refused("share more than their vertices")

    def test_refuses_a_dropped_contact(self):
        self.without("contacts", [0, 1])
        self.refused("triangles 0 and 1 of body 0: \"t\" was decided, but nothing is listed")

    def test_refuses_a_plane_past_the_corner(self):
        def change(truth):
            *_, plane = truth["gaps"][0]
            plane[3] = "1/1000"
        self.change_truth(change, self.first)
        self.refused("the plane does not separate them")

    def test_refuses_neighbours_called_duplicates(self):
        self.decide("e", "d")
        self.refused('"d" was decided, but nothing is listed')

    def test_refuses_a_weld_of_vertices_apart(self):
        name = "bodies/0-all/welded.json"
        welded = json.loads((self.folder / name).read_bytes())
        welded[6][0] = 1
        self.write(name, json.dumps(welded).encode())
        self.refused("welded vertices are not at one place")

    def test_refuses_bodies_without_themselves(self):
        self.change_index(lambda index: index.update(self=False))
        self.refused("frame 0: the decisions go on when all pairs are covered")


class StepsExported(Exported):
    words, last = ("--between",), "steps.json"

    def truth(self, step=0):
        return json.loads((self.folder / f"truth/step_{step:04}.json").read_bytes())

    def change_pair(self, bodies, change, step=0):
        def change_one(truth):
            change(next(entry for entry in truth["pairs"] if entry["bodies"] == bodies))
        self.change_truth(change_one, f"truth/step_{step:04}.json")

    def pair(self, bodies, step=0):
        return next(entry for entry in self.truth(step)["pairs"] if entry["bodies"] == bodies)

    def refused_pair(self, bodies, change, *pieces, step=0):
        """A change of a fresh copy's pair is refused with these words."""
        name = f"truth/step_{step:04}.json"
        kept = (self.folder / name).read_bytes()
        self.change_pair(bodies, change, step)
        self.refused(f"step {step} to {step + 1}: bodies {bodies[0]} and {bodies[1]}: ", *pieces)
        self.write(name, kept)


class CheckStepExport(StepsExported):
    scene = MOVING_SCENE
    PAIRS = [[0, 1], [0, 2], [1, 2], [0, 0], [1, 1], [2, 2]]

    def test_accepts_an_export(self):
        done = self.check()
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("moving: 3 steps, on straight paths between these frames: ", done.stdout)
        self.assertIn(", 0 without proof", done.stdout)
        self.assertEqual([entry["bodies"] for entry in self.truth()["pairs"]], self.PAIRS)
        self.assertEqual([(s["apart"], s["contacts"]) for s in self.index()["steps"]],
                         [(6, 0), (5, 1), (5, 1)])
        self.assertIn("meet", self.pair([0, 1], 1))
        self.assertIn("touch", self.pair([0, 1], 2))
        self.assertTrue({*"abs"} <= {*self.pair([0, 1])["decisions"]}, self.pair([0, 1]))
        self.assertEqual(self.pair([0, 2])["decisions"], "hxy")
        self.assertIn("n", self.pair([0, 0])["decisions"])
        self.assertTrue(self.pair([2, 2])["elements"])

    def test_refuses_every_direction_turned_round(self):
        for n in range(len(self.pair([0, 1])["directions"])):
            def turn(entry, n=n):
                entry["directions"][n] = [-x for x in entry["directions"][n]]
            self.refused_pair([0, 1], turn, "the direction does not separate them")

    def test_refuses_a_direction_of_fractions(self):
        def change(entry):
            entry["directions"][0][0] += 0.5
        self.refused_pair([0, 1], change, "directions are not of integers")

    def test_refuses_boxes_that_are_not_apart(self):
        decisions = self.pair([0, 1])["decisions"]
        for letter in "abs":
            def change(entry, at=decisions.index(letter)):
                entry["decisions"] = decisions[:at] + "z" + decisions[at + 1:]
            self.refused_pair([0, 1], change, '("z": ', "the boxes are not apart")

    def test_refuses_half_a_step_for_a_whole_one(self):
        for letter in "xy":
            def change(entry, letter=letter):
                entry["decisions"] = letter
            self.refused_pair([0, 2], change, "the boxes are not apart")

    def test_refuses_halves_in_another_order(self):
        def change(entry):
            entry["decisions"] = "hyx"
        self.refused_pair([0, 2], change, "part 0 of 2): the boxes are not apart")

    def test_refuses_decisions_that_end_early_or_go_on(self):
        def cut(entry):
            entry["decisions"] = entry["decisions"][:-1]

        def extend(entry):
            entry["decisions"] += "x"
        self.refused_pair([0, 2], cut, "the decisions end before all pairs are covered")
        self.refused_pair([0, 2], extend, "the decisions go on when all pairs are covered")

    def test_refuses_proofs_that_are_missing_or_too_many(self):
        def drop(entry):
            entry["directions"].pop()

        def add(entry):
            entry["directions"].append([1, 0, 0])
        self.refused_pair([0, 1], drop, '("s"): it has no proof')
        self.refused_pair([0, 1], add, "there are more proofs than decisions")

    def test_refuses_neighbours_that_are_none(self):
        def change(entry):
            at = entry["decisions"].rindex("s")
            entry["decisions"] = entry["decisions"][:at] + "n" + entry["decisions"][at + 1:]
        for bodies in ([0, 1], [0, 0]):
            # The last "s" may be of ranges.
            self.refused_pair(bodies, change, '("n": ')

    def test_refuses_forgotten_elements_of_a_body(self):
        def drop(entry):
            entry["elements"].pop()

        def cut(entry):
            entry["elements"][0]["apart"][-1][0] = 0.5
        self.refused_pair([2, 2], drop, "loose pairs of elements")
        self.refused_pair([2, 2], cut, "the pieces end at t = 0.5")

    def test_refuses_a_contact_said_to_be_none(self):
        apart = self.pair([0, 1])
        for step in (1, 2):
            def change(entry):
                entry.clear()
                entry.update(apart)
            self.refused_pair([0, 1], change, 'decision ', step=step)

    def test_refuses_a_contact_of_other_elements(self):
        def other(entry):
            entry["meet"][1][1] = 0 if entry["meet"][1][1] else 1
        self.refused_pair([0, 1], other, step=1)

        def swapped(entry):
            entry["meet"][1][0] = 2
        self.refused_pair([0, 1], swapped, "they are not of these bodies", step=1)

    def test_refuses_a_contact_at_another_time(self):
        def later(entry):
            proof = entry["meet"][3]
            key = "crosses" if "crosses" in proof else "meets"
            proof[key][0] = 0.999
        self.refused_pair([0, 1], later, "the elements are not proven to", step=1)

    def test_refuses_a_witness_that_is_none(self):
        def change(entry):
            entry["touch"][2] = ["1", "0", "0"]
        self.refused_pair([0, 1], change, "the witness is no point of both", step=2)

    def test_refuses_a_pair_in_the_place_of_another(self):
        def swap(truth):
            truth["pairs"][0], truth["pairs"][1] = truth["pairs"][1], truth["pairs"][0]
        self.change_truth(swap, "truth/step_0000.json")
        self.refused("step 0 to 1: bodies 0 and 1: this pair of bodies is not in its place")

    def test_refuses_a_forgotten_pair(self):
        self.change_truth(lambda truth: truth["pairs"].pop(), "truth/step_0000.json")
        self.refused("step 0 to 1: not one proof for every pair of bodies")

    def test_refuses_a_proof_that_is_not_counted_as_missing(self):
        def forget(entry):
            del entry["decisions"]
            entry["unproved"] = "apart"
        self.change_pair([0, 1], forget)
        self.refused("steps.json has other counts of pairs of bodies")
        self.change_index(lambda index: index["steps"][0].update(apart=5, unproved=1))
        self.assertIn(", 1 without proof", self.check().stdout)

    def test_refuses_a_missing_step(self):
        self.change_index(lambda index: index["steps"].pop())
        self.refused("steps.json: not every step is there")

    def test_refuses_bodies_without_themselves(self):
        self.change_index(lambda index: index.update(self=False))
        self.refused("step 0 to 1: not one proof for every pair of bodies")

    def test_refuses_a_vertex_that_is_moved_at_either_end(self):
        for frame in (0, 1):
            name = f"bodies/1-moves/frame_{frame:04}.ply"
            kept = (self.folder / name).read_bytes()
            start = kept.index(b"end_header\n") + 11
            x, y, z = struct.unpack_from("<3d", kept, start)
            moved = kept[:start] + struct.pack("<3d", x - 1, y - 1, z) + kept[start + 24:]
            (self.folder / name).write_bytes(moved)
            self.refused(name, "another CRC-32")
            self.write(name, moved)
            self.refused("step 0 to 1: bodies 0 and 1: decision ")
            self.write(name, kept)

    def test_refuses_another_schema(self):
        self.change_index(lambda index: index.update(schema="contactcheck-certificates/1"))
        self.refused("steps.json: another schema")


class CheckCloseTriangles(StepsExported):
    """Elements prove them apart, where no direction of few bits does."""
    scene = CLOSE_SCENE

    def test_accepts_an_export(self):
        self.assertEqual(self.check().returncode, 0, self.check().stderr)
        self.assertEqual(self.pair([0, 1])["decisions"], "f")

    def test_refuses_a_plane_that_does_not_separate(self):
        def turn(entry):
            plane = entry["triangles"][0][0]
            plane[:3] = [x[1:] if x[0] == "-" else "-" + x for x in map(str, plane[:3])]
        self.refused_pair([0, 1], turn, "the plane does not separate them")

    def test_refuses_fewer_elements(self):
        def drop(entry):
            entry["triangles"][0][1].pop()
        self.refused_pair([0, 1], drop, "not a proof for each of the fifteen pairs of elements")

    def test_refuses_each_of_the_elements_without_its_proof(self):
        for n in range(15):
            def turn(entry, n=n):
                entry["triangles"][0][1][n] = {"apart": [[1, "direction", 0, 0, 0]]}
            self.refused_pair([0, 1], turn, "the elements are not proven apart up to t = 1.0")

    def test_refuses_half_a_step(self):
        def halve(entry):
            entry["decisions"] = "hff"
            entry["triangles"] *= 2
        self.refused_pair([0, 1], halve, "not in the whole step")


if __name__ == "__main__":
    unittest.main()
