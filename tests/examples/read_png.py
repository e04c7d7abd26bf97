"""Reads what png.py writes, for the tests: its own reading of the format."""

import pathlib
import struct
import zlib


def png_chunks(data):
    at = 8
    while at < len(data):
        size, kind = struct.unpack_from(">I4s", data, at)
        body = data[at + 8:at + 8 + size]
        told, = struct.unpack_from(">I", data, at + 8 + size)
        assert zlib.crc32(kind + body) == told, f"checksum of {kind}"
        yield kind, body
        at += 12 + size


def unfiltered(image, stride, width):
    """Rows of a PNG whose pixels have `width` bytes; knows the filters none, Sub and Up."""
    above = bytes(stride)
    for at in range(0, len(image), stride + 1):
        kind, row = image[at], bytearray(image[at + 1:at + 1 + stride])
        for x in range(stride if kind else 0):
            before = above[x] if kind == 2 else row[x - width] if x >= width else 0
            row[x] = (row[x] + before) & 255
        assert kind <= 2, f"filter {kind}"
        yield bytes(row)
        above = row


def png_pixels(file):
    """(width, height, pixels as bytes of RGB)."""
    data = pathlib.Path(file).read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    chunks = dict(png_chunks(data))
    width, height, depth, colour_type = struct.unpack_from(">2I2B", chunks[b"IHDR"])
    assert depth == 8 and b"IEND" in chunks
    size = {2: 3, 3: 1}[colour_type]
    rows = list(unfiltered(zlib.decompress(chunks[b"IDAT"]), size * width, size))
    assert len(rows) == height and all(len(row) == size * width for row in rows)
    pixels = [row[x:x + size] for row in rows for x in range(0, len(row), size)]
    if colour_type == 3:
        palette = chunks[b"PLTE"]
        pixels = [palette[3 * p[0]:3 * p[0] + 3] for p in pixels]
    return width, height, pixels
