#!/usr/bin/env python3
"""Tests of the worked example, on a recording that was just run.

The environment names it: CONTACTCHECK_RECORDING, and CONTACTCHECK_PRINT_VERTICES, the program that
maps as core does.
"""

import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest

import recording as ccr
from read_png import png_pixels

HERE = pathlib.Path(__file__).resolve().parent
RECORDING = os.environ["CONTACTCHECK_RECORDING"]
PRINT_VERTICES = os.environ["CONTACTCHECK_PRINT_VERTICES"]
WIDTH, HEIGHT = 240, 100


def render(*arguments):
    command = [sys.executable, "-B", HERE / "render_recording.py", *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def coloured_share(pixels):
    return sum(pixel != b"\xff\xff\xff" for pixel in pixels) / len(pixels)


def nearly_white_share(pixels):
    return sum(pixel != b"\xff\xff\xff" and min(pixel) > 200 for pixel in pixels) / len(pixels)


def with_hash(content):
    return content + struct.pack("<Q", ccr.fnv1a(content))


class RenderRecording(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def picture(self, *arguments):
        file = self.folder / "picture.png"
        run = render(RECORDING, "--out", file, "--size", f"{WIDTH}x{HEIGHT}", *arguments)
        self.assertEqual((run.returncode, run.stdout, run.stderr), (0, "", ""))
        self.assertEqual([entry.name for entry in self.folder.iterdir()], ["picture.png"])
        width, height, pixels = png_pixels(file)
        self.assertEqual((width, height), (WIDTH, HEIGHT))
        return pixels

    def test_vertices_have_the_bits_of_the_program(self):
        recording = ccr.read(RECORDING)
        self.assertEqual([body.name for body in recording.bodies], ["left", "right"])
        for frame in (0, recording.frame_count // 2, recording.frame_count - 1):
            told = subprocess.run([PRINT_VERTICES, RECORDING, str(frame)], capture_output=True,
                                  text=True, check=True).stdout.split()
            vertices = [x for body, nodes in zip(recording.bodies, recording.nodes(frame))
                        for vertex in ccr.deformed_vertices(body.shape, nodes) for x in vertex]
            self.assertEqual(len(vertices), 2 * 3 * 2959)
            self.assertEqual([x.hex() for x in vertices], [float.fromhex(x).hex() for x in told])

    def test_picture_is_neither_blank_nor_full(self):
        share = coloured_share(self.picture("--frame", "3"))
        self.assertGreaterEqual(share, 0.03)
        self.assertLessEqual(share, 0.80)

    def test_both_bodies_are_seen_in_their_colours(self):
        pixels = self.picture("--frame=3", "--no-lattice")
        for first, last in ((2, 0), (0, 2)):  # bluish, orange
            share = sum(p[first] > p[last] + 30 for p in pixels) / len(pixels)
            self.assertGreater(share, 0.05)

    def test_frames_and_views_differ(self):
        pictures = {b"".join(self.picture(*arguments)) for arguments in
                    (["--frame=3"], ["--frame=4"], ["--frame=3", "--view=-40,30"])}
        self.assertEqual(len(pictures), 3)

    def test_lattice_adds_lines_outside_the_bodies(self):
        plain, lines = self.picture("--frame=3", "--no-lattice"), self.picture("--frame=3")
        # Surfaces alone have a sharp outline, so few pixels are nearly white; lines add many.
        self.assertLess(nearly_white_share(plain), 0.01)
        self.assertGreater(nearly_white_share(lines), 0.03)

    def test_palette_keeps_the_picture(self):
        exact = self.picture("--frame=3")
        palette = self.picture("--frame=3", "--colours=64")
        self.assertLessEqual(len(set(palette)), 64)
        errors = [abs(a - b) for p, q in zip(exact, palette) for a, b in zip(p, q)]
        self.assertGreater(max(errors), 0)
        self.assertLess(sum(errors) / len(errors), 2.0)
        background = [q for p, q in zip(exact, palette) if p == b"\xff\xff\xff"]
        self.assertEqual(set(background), {b"\xff\xff\xff"})

    def assert_refused(self, expected, *arguments):
        run = render(*arguments)
        self.assertEqual((run.returncode, run.stdout), (2, ""))
        self.assertIn(expected, run.stderr)
        self.assertRegex(run.stderr, r"\Arender_recording: [^\n]*[^.]\.\n\Z")
        self.assertEqual(list(self.folder.glob("*.png*")), [])

    def test_refuses_bad_options_with_one_sentence(self):
        out = ["--out", self.folder / "picture.png"]
        for expected, *arguments in (
                ("has no frame 6: it has 6 frames", RECORDING, "--frame=6", *out),
                ("has no frame -1", RECORDING, "--frame=-1", *out),
                ("argument --frame: invalid int value", RECORDING, "--frame=x", *out),
                ('"5x5" is not WIDTHxHEIGHT', RECORDING, "--size=5x5", *out),
                ('"9999x9999" is not WIDTHxHEIGHT', RECORDING, "--size=9999x9999", *out),
                ('"10" is not AZIMUTH,ELEVATION', RECORDING, "--view=10", *out),
                ('"0,nan" is not AZIMUTH,ELEVATION', RECORDING, "--view=0,nan", *out),
                ('"257" is not a whole number from 2 to 256', RECORDING, "--colours=257", *out),
                ("required: --out", RECORDING),
                ("required: RECORDING", *out),
                ("cannot write", RECORDING, "--size=16x16", "--out",
                 self.folder / "none" / "picture.png")):
            with self.subTest(expected):
                self.assert_refused(expected, *arguments)

    def test_refuses_files_that_are_no_recording(self):
        good = pathlib.Path(RECORDING).read_bytes()
        place = self.folder / "bad.ccr"
        flipped = bytearray(good)
        flipped[len(good) // 2] ^= 1
        # What the file cannot hold or doubles cannot measure, under hashes that hold.
        huge_count = good[:24 + 8 + 24] + b"\xff" * 8
        huge_count = with_hash(good[:16] + struct.pack("<Q", len(huge_count) + 8) + huge_count[24:])
        far_nodes = with_hash(good[:-8 - 48] + struct.pack("<6d", *[1.7e308, -1.7e308] * 3))
        for expected, data in (("does not start as a .ccr file does", b"solid cube\n"),
                               ("does not start as a .ccr file does", b""),
                               ("version 3", good[:8] + b"\3" + good[9:]),
                               ("was written with", good[:-1]),
                               ("is damaged", bytes(flipped)),
                               ("ends before", huge_count),
                               ("cannot be drawn", far_nodes)):
            with self.subTest(expected):
                place.write_bytes(data)
                self.assert_refused(expected, place, "--frame=5", "--out",
                                    self.folder / "picture.png")
        place.unlink()
        self.assert_refused("cannot read", place, "--out", self.folder / "picture.png")

    def test_help_has_an_example(self):
        run = render("--help")
        self.assertEqual(run.returncode, 0)
        self.assertIn("render_recording.py out/recordings/bunny-touch.ccr", run.stdout)


if __name__ == "__main__":
    unittest.main()
