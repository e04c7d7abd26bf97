"""A small z-buffer in plain Python: shaded triangles, depth-tested translucent lines.

Samples are on a grid SUPERSAMPLING times finer than the pixels, y down, z towards the viewer.
Triangles first (they fill the z-buffer), then resolve(), then lines, then pixels().
"""

import math

SUPERSAMPLING = 2  # samples per pixel along each axis
LEVELS = 256  # brightnesses of a ramp
LINE_WIDTH = 2  # samples, so that a line is one pixel wide
WHITE = (255, 255, 255)

Colour = tuple[int, int, int]


class Canvas:
    def __init__(self, width: int, height: int):
        """@pre sizes in pixels, positive"""
        self.width = width * SUPERSAMPLING
        self.height = height * SUPERSAMPLING
        self.depth = [-math.inf] * (self.width * self.height)
        self.code = [0] * (self.width * self.height)  # 0 is background; else a place in `ramps`
        self.ramps = [bytes(WHITE)]
        self.rgb = bytearray()

    def add_ramp(self, colours: list[Colour]) -> int:
        """Colours of the levels 0 to LEVELS - 1; gives the number that draw_triangle wants."""
        self.ramps.extend(map(bytes, colours))
        return len(self.ramps) - LEVELS

    def draw_triangle(self, a, b, c, ramp: int):
        """Corners (x, y, z, level), 0 <= level < LEVELS; all but x and y go linearly between them.

        A sample is covered when its centre is inside; neighbours leave no gap and never overlap.
        """
        a, b, c = sorted((a, b, c), key=lambda corner: corner[1])
        first = max(math.ceil(a[1] - 0.5), 0)
        last = min(math.ceil(c[1] - 0.5), self.height)
        for row in range(first, last):
            y = row + 0.5
            upper = y < b[1]
            one = on_edge(a, c, y)
            other = on_edge(a, b, y) if upper else on_edge(b, c, y)
            self._draw_span(row, *sorted((one, other)), ramp)

    def _draw_span(self, row: int, left, right, ramp: int):
        first = max(math.ceil(left[0] - 0.5), 0)
        last = min(math.ceil(right[0] - 0.5), self.width)
        if first >= last:
            return
        per_sample = 1.0 / (right[0] - left[0])
        z_step = (right[1] - left[1]) * per_sample
        level_step = (right[2] - left[2]) * per_sample
        offset = first + 0.5 - left[0]
        z = left[1] + offset * z_step
        level = left[2] + offset * level_step + ramp
        depth, code = self.depth, self.code
        for at in range(row * self.width + first, row * self.width + last):
            if z > depth[at]:
                depth[at] = z
                code[at] = int(level)
            z += z_step
            level += level_step

    def resolve(self):
        """From codes to colours; lines come after."""
        ramps = self.ramps
        self.rgb = bytearray(b"".join([ramps[code] for code in self.code]))

    def draw_line(self, p, q, colour: Colour, alpha_p: float, alpha_q: float):
        """From (x, y, z) to (x, y, z) where nothing nearer is; opacity from alpha_p to alpha_q."""
        steep = abs(q[1] - p[1]) > abs(q[0] - p[0])
        major, minor = (1, 0) if steep else (0, 1)
        if p[major] > q[major]:
            p, q, alpha_p, alpha_q = q, p, alpha_q, alpha_p
        first, last = math.ceil(p[major] - 0.5), math.ceil(q[major] - 0.5)
        for step in range(max(first, 0), min(last, (self.width, self.height)[major])):
            w = (step + 0.5 - p[major]) / (q[major] - p[major])
            z = p[2] + w * (q[2] - p[2])
            alpha = alpha_p + w * (alpha_q - alpha_p)
            side = math.floor(p[minor] + w * (q[minor] - p[minor]) + 0.5) - LINE_WIDTH // 2
            for across in range(side, side + LINE_WIDTH):
                x, y = (across, step) if steep else (step, across)
                self._blend(x, y, z, colour, alpha)

    def _blend(self, x: int, y: int, z: float, colour: Colour, alpha: float):
        at = y * self.width + x
        if not (0 <= x < self.width and 0 <= y < self.height) or z <= self.depth[at]:
            return
        for k in range(3):
            old = self.rgb[3 * at + k]
            self.rgb[3 * at + k] = round(old + alpha * (colour[k] - old))

    def pixels(self) -> list[bytes]:
        """Rows of RGB, each pixel the mean of its samples. @pre SUPERSAMPLING is 2"""
        stride = 3 * self.width
        return [mean_row(self.rgb[y * stride:(y + 1) * stride],
                         self.rgb[(y + 1) * stride:(y + 2) * stride])
                for y in range(0, self.height, SUPERSAMPLING)]


def on_edge(a, b, y: float) -> tuple[float, float, float]:
    """(x, z, level) of the edge at height y. @pre a[1] < b[1], y between them"""
    w = (y - a[1]) / (b[1] - a[1])
    return tuple(a[k] + w * (b[k] - a[k]) for k in (0, 2, 3))


def mean_row(upper: bytes, lower: bytes) -> bytes:
    out = bytearray(len(upper) // 2)
    for k in range(3):
        samples = zip(upper[k::6], upper[k + 3::6], lower[k::6], lower[k + 3::6])
        out[k::3] = bytes([(a + b + c + d + 2) >> 2 for a, b, c, d in samples])
    return bytes(out)
