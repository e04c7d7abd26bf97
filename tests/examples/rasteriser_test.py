#!/usr/bin/env python3
"""The z-buffer and the PNG writer of the worked example, on pictures small enough to know."""

import pathlib
import tempfile
import unittest

import png
import rasteriser
from read_png import png_pixels


def grey_ramp(canvas, first):
    return canvas.add_ramp([(first + level // 4,) * 3 for level in range(rasteriser.LEVELS)])


class Rasteriser(unittest.TestCase):
    SQUARE = [(2.0, 2.0), (14.0, 2.0), (14.0, 14.0), (2.0, 14.0)]

    def setUp(self):
        self.canvas = rasteriser.Canvas(8, 8)

    def draw_square(self, z, level, ramp):
        corners = [(x, y, z(x), level) for x, y in self.SQUARE]
        for triangle in ((0, 1, 2), (0, 2, 3)):
            self.canvas.draw_triangle(*(corners[c] for c in triangle), ramp)

    def pixels(self):
        return [[row[3 * x] for x in range(8)] for row in self.canvas.pixels()]

    def test_neighbours_leave_no_gap_and_the_outside_is_white(self):
        self.draw_square(lambda x: 0.0, 40.0, grey_ramp(self.canvas, 0))
        self.canvas.resolve()
        inside = [[10 if 1 <= x < 7 and 1 <= y < 7 else 255 for x in range(8)] for y in range(8)]
        self.assertEqual(self.pixels(), inside)

    def test_nearer_surface_wins_in_either_order(self):
        for far_first in (True, False):
            self.canvas = rasteriser.Canvas(8, 8)
            ramps = grey_ramp(self.canvas, 0), grey_ramp(self.canvas, 100)
            surfaces = [(lambda x: x - 8.0, ramps[0]), (lambda x: 8.0 - x, ramps[1])]
            for z, ramp in surfaces if far_first else reversed(surfaces):
                self.draw_square(z, 0.0, ramp)
            self.canvas.resolve()
            self.assertEqual(self.pixels()[4], [255, 100, 100, 100, 0, 0, 0, 255])

    def test_levels_go_linearly(self):
        ramp = self.canvas.add_ramp([(level,) * 3 for level in range(rasteriser.LEVELS)])
        corners = [(0.0, 0.0, 0.0, 0.0), (32.0, 0.0, 0.0, 255.0), (0.0, 32.0, 0.0, 0.0)]
        self.canvas.draw_triangle(*corners, ramp)
        self.canvas.resolve()
        for x, value in enumerate(self.pixels()[0]):
            self.assertAlmostEqual(value, 255.0 * (2 * x + 1) / 32, delta=1.0)

    def test_line_is_translucent_and_hidden_behind_a_surface(self):
        self.draw_square(lambda x: 8.0 - x, 0.0, grey_ramp(self.canvas, 100))
        self.canvas.resolve()
        self.canvas.draw_line((16.0, 8.0, 0.0), (0.0, 8.0, 0.0), (0, 0, 0), 0.5, 0.5)
        row = [(a + b) / 2 for a, b in zip(*self.pixels()[3:5])]
        # It covers half of each of two rows with opacity one half, where the surface is below 0.
        self.assertEqual([round(value) for value in row], [192, 100, 100, 100, 75, 75, 75, 192])

    def test_outside_of_the_canvas_is_cut_off(self):
        ramp = grey_ramp(self.canvas, 0)
        corners = [(-50.0, -60.0, 0.0, 0.0), (90.0, -20.0, 0.0, 0.0), (10.0, 99.0, 0.0, 0.0)]
        self.canvas.draw_triangle(*corners, ramp)
        self.canvas.resolve()
        self.canvas.draw_line((-9.0, -9.0, 1.0), (99.0, 50.0, 1.0), (255, 0, 0), 1.0, 1.0)
        self.assertEqual(len(self.canvas.rgb), 3 * 16 * 16)
        self.assertEqual({value for row in self.canvas.pixels() for value in row[1::3]}, {0})


class Png(unittest.TestCase):
    def read_back(self, data):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "small.png"
            file.write_bytes(data)
            return png_pixels(file)

    def test_true_colour_is_exact(self):
        rows = [bytes((x * x * y + 7 * y) % 256 for x in range(30)) for y in range(1, 9)]
        pixels = self.read_back(png.true_colour(rows))
        self.assertEqual(pixels[:2], (10, 8))
        self.assertEqual(b"".join(pixels[2]), b"".join(rows))

    def test_palette_keeps_the_background_exactly(self):
        rows = [bytes([255] * 9 + [250] * 3 + [10] * 6 + [0] * 6)]
        _, _, pixels = self.read_back(png.with_palette(rows, 2))
        self.assertEqual(pixels[:3], [b"\xff\xff\xff"] * 3)
        self.assertEqual(set(pixels[3:]), {bytes([54] * 3)})

    def test_palette_of_few_colours_is_exact(self):
        rows = [bytes([255] * 3 + [1, 2, 3] + [9] * 3)] * 2
        _, _, pixels = self.read_back(png.with_palette(rows, 256))
        self.assertEqual(b"".join(pixels), b"".join(rows))


if __name__ == "__main__":
    unittest.main()
