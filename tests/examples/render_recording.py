#!/usr/bin/env python3
"""Draws one frame of a recording (.ccr) into a PNG.

Seen without perspective, as large as fits: the deformed surfaces, one colour per body, and the
edges of their FFD lattices' kept cells where no surface hides them. Standard library only; about a
quarter of a second per megabyte of recording and a few seconds per picture.
"""

import argparse
import math
import pathlib
import re
import sys

import png
import rasteriser
import recording as ccr

EXAMPLE = """example:
  contactcheck run bunny-touch --no-timing
  tests/examples/render_recording.py out/recordings/bunny-touch.ccr --frame 34 --out bunny.png
"""

# Canvas axes: x to the right, y down, z towards the viewer, all in samples.

MARGIN = 0.03  # of the picture's smaller side, on each side
LARGEST_PICTURE = 4_000_000  # pixels; a sample takes about 20 bytes, and a pixel has four

BODY_COLOURS = [(92, 143, 205), (238, 158, 84), (116, 181, 112), (200, 116, 160), (150, 132, 206),
                (214, 186, 84), (92, 182, 184), (204, 108, 98)]

# Towards the light (canvas axes; unit length within 1 %) and its strength.
LIGHTS = [((-0.46, -0.64, 0.62), 0.66), ((0.80, -0.10, 0.59), 0.22), ((0.15, -0.85, -0.50), 0.20)]
AMBIENT = 0.10
WRAP = 0.25  # how far light reaches round the edge between day and night: it makes it soft

# Opacity of lattice lines at the near and at the far end of the scene.
NEAR_ALPHA, FAR_ALPHA = 0.42, 0.10


def mixed(a, b, w):
    return tuple(round(x + w * (y - x)) for x, y in zip(a, b))


def ramp_of(colour):
    """From its shadow over the colour itself, at two thirds, to its highlight."""
    shadow = mixed(mixed((0, 0, 0), colour, 0.28), (40, 40, 80), 0.3)
    light = mixed(colour, (255, 252, 244), 0.62)
    levels = [level / (rasteriser.LEVELS - 1) for level in range(rasteriser.LEVELS)]
    return [mixed(shadow, colour, w * 1.5) if w < 2 / 3 else mixed(colour, light, w * 3 - 2)
            for w in levels]


def turned(points, azimuth, elevation):
    """To view axes (x right, y up, z to the viewer; metres): the viewer stands `azimuth` degrees
    from the z axis towards the x axis and `elevation` degrees above the ground."""
    az, el = math.radians(azimuth), math.radians(elevation)
    ca, sa, ce, se = math.cos(az), math.sin(az), math.cos(el), math.sin(el)
    return [(ca * x - sa * z, ce * y - se * (sa * x + ca * z), se * y + ce * (sa * x + ca * z))
            for x, y, z in points]


def fit(points, canvas):
    """The map from view axes to the canvas that centres the points, as large as the margin lets.

    Raises BadRecording where doubles cannot hold it (lengths near 1e308 or 1e-308 metres)."""
    low, high = ([pick(p[k] for p in points) for k in range(3)] for pick in (min, max))
    extent = [h - l for l, h in zip(low, high)]
    room = [size - 2 * MARGIN * min(canvas.width, canvas.height)
            for size in (canvas.width, canvas.height)]
    scale = min(size / (length or 1.0) for size, length in zip(room, extent))
    if not all(map(math.isfinite, extent)) or not 0.0 < scale < math.inf:
        raise ccr.BadRecording(f"a scene of {extent[0]:g} x {extent[1]:g} m cannot be drawn.")
    x0, y0, z0 = (l + length / 2 for l, length in zip(low, extent))
    x1, y1 = canvas.width / 2, canvas.height / 2
    return lambda seen: [(x1 + scale * (x - x0), y1 - scale * (y - y0), scale * (z - z0))
                         for x, y, z in seen]


def face_normal(a, b, c):
    """Of a triangle whose front is counter-clockwise with y up; as long as twice the area."""
    ux, uy, uz = c[0] - a[0], c[1] - a[1], c[2] - a[2]
    vx, vy, vz = b[0] - a[0], b[1] - a[1], b[2] - a[2]
    return uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx


def level_of(normal, side):
    """Brightness of a surface that shows the side +1 (outside) or -1 (inside) of its normal."""
    length = math.hypot(*normal)
    if length == 0.0:
        return 0.0
    light = AMBIENT
    for towards, strength in LIGHTS:
        cosine = side * sum(n * t for n, t in zip(normal, towards)) / length
        light += strength * max(0.0, (cosine + WRAP) / (1.0 + WRAP))
    return min(light, 1.0) * (rasteriser.LEVELS - 1)


def draw_surface(canvas, places, triangles, ramp):
    """Smooth shading by the area-weighted mean of the normals around a vertex, on both sides."""
    faces = [face_normal(*(places[v] for v in triangle)) for triangle in triangles]
    normals = [(0.0, 0.0, 0.0)] * len(places)
    for triangle, face in zip(triangles, faces):
        for v in triangle:
            normals[v] = tuple(n + f for n, f in zip(normals[v], face))
    sides = {side: [(*place, level_of(normal, side)) for place, normal in zip(places, normals)]
             for side in (1, -1)}
    for triangle, face in zip(triangles, faces):
        corners = sides[1 if face[2] >= 0.0 else -1]
        canvas.draw_triangle(*(corners[v] for v in triangle), ramp)


def draw_lattice(canvas, places, edges, colour, far, near):
    depth = near - far or 1.0
    alphas = [FAR_ALPHA + (NEAR_ALPHA - FAR_ALPHA) * (z - far) / depth for _, _, z in places]
    line_colour = mixed((0, 0, 0), colour, 0.55)
    for a, b in edges:
        canvas.draw_line(places[a], places[b], line_colour, alphas[a], alphas[b])


def render(recording, frame, size, view, with_lattice):
    """Rows of RGB pixels."""
    canvas = rasteriser.Canvas(*size)
    shapes = [body.shape for body in recording.bodies]
    nodes = recording.nodes(frame)
    surfaces = [turned(ccr.deformed_vertices(*pair), *view) for pair in zip(shapes, nodes)]
    nodes = [turned(points, *view) for points in nodes]
    seen = [p for points in (nodes if with_lattice else surfaces) for p in points]
    placed = fit(seen, canvas)
    colours = [BODY_COLOURS[b % len(BODY_COLOURS)] for b in range(len(shapes))]
    for shape, points, colour in zip(shapes, surfaces, colours):
        draw_surface(canvas, placed(points), shape.triangles, canvas.add_ramp(ramp_of(colour)))
    canvas.resolve()
    if with_lattice:
        depths = [z for _, _, z in placed(seen)]
        for shape, points, colour in zip(shapes, nodes, colours):
            draw_lattice(canvas, placed(points), ccr.lattice_edges(shape), colour, min(depths),
                         max(depths))
    return canvas.pixels()


def size_option(text):
    match = re.fullmatch(r"(\d{1,5})x(\d{1,5})", text)
    width, height = map(int, match.groups()) if match else (0, 0)
    if min(width, height) < 16 or width * height > LARGEST_PICTURE:
        raise argparse.ArgumentTypeError(
            f'"{text}" is not WIDTHxHEIGHT in pixels, each at least 16, together at most 4 million')
    return width, height


def colours_option(text):
    if not re.fullmatch(r"\d{1,3}", text) or not 2 <= int(text) <= 256:
        raise argparse.ArgumentTypeError(f'"{text}" is not a whole number from 2 to 256')
    return int(text)


def view_option(text):
    try:
        azimuth, elevation = map(float, text.split(","))
    except ValueError:
        azimuth = elevation = math.nan
    if not (abs(azimuth) <= 360.0 and abs(elevation) <= 90.0):
        raise argparse.ArgumentTypeError(
            f'"{text}" is not AZIMUTH,ELEVATION in degrees, within 360 and 90')
    return azimuth, elevation


class Parser(argparse.ArgumentParser):
    def error(self, message):
        fail(message)


def fail(message):
    """One sentence, and the exit code of bad usage and bad input."""
    print(f"render_recording: {message.rstrip('.')}.", file=sys.stderr)
    sys.exit(2)


def options():
    parser = Parser(description=__doc__, epilog=EXAMPLE,
                    formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("recording", metavar="RECORDING", help="a .ccr file")
    parser.add_argument("--frame", type=int, default=0, metavar="N", help="from 0 (default 0)")
    parser.add_argument("--out", required=True, metavar="FILE.png", help="the picture")
    parser.add_argument("--size", type=size_option, default="1200x600", metavar="WxH",
                        help="pixels (default 1200x600)")
    parser.add_argument("--view", type=view_option, default="15,20", metavar="AZIMUTH,ELEVATION",
                        help="degrees: round the y axis from the z axis towards the x axis, and "
                             "above the ground (default 15,20); --view=-30,10 when negative")
    parser.add_argument("--colours", type=colours_option, metavar="N",
                        help="a palette of at most N colours, 2 to 256: a smaller file")
    parser.add_argument("--no-lattice", action="store_true", help="surfaces alone")
    return parser.parse_args()


def write(file, data):
    """Under a temporary name, then renamed: no one ever sees half a picture."""
    part = pathlib.Path(f"{file}.part")
    try:
        part.write_bytes(data)
        part.replace(file)
    except OSError as error:
        fail(f'cannot write "{file}": {error.strerror}')
    finally:
        part.unlink(missing_ok=True)


def picture(chosen):
    """The PNG that the options ask for, as bytes."""
    recording = ccr.read(chosen.recording)
    if not 0 <= chosen.frame < recording.frame_count:
        fail(f'"{chosen.recording}" has no frame {chosen.frame}: it has '
             f"{recording.frame_count} frames, counted from 0")
    rows = render(recording, chosen.frame, chosen.size, chosen.view, not chosen.no_lattice)
    return png.with_palette(rows, chosen.colours) if chosen.colours else png.true_colour(rows)


def main():
    chosen = options()
    try:
        data = picture(chosen)
    except ccr.BadRecording as error:
        fail(str(error))
    except OSError as error:
        fail(f'cannot read "{chosen.recording}": {error.strerror}')
    write(chosen.out, data)


if __name__ == "__main__":
    main()
