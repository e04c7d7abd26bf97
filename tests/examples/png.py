"""Writes PNG files, in true colour or with a palette. Rows are bytes of RGB, 3 per pixel."""

import collections
import struct
import zlib

BYTES_PER_PIXEL = 3
TRUE_COLOUR, PALETTE = 2, 3  # colour types of PNG


def chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def encoded(width: int, height: int, colour_type: int, palette: bytes, image: bytes) -> bytes:
    header = struct.pack(">2I5B", width, height, 8, colour_type, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header)
            + (chunk(b"PLTE", palette) if palette else b"")
            + chunk(b"IDAT", zlib.compress(image, 9)) + chunk(b"IEND", b""))


def filtered(row: bytes, above: bytes) -> bytes:
    """The row as PNG stores it: of the filters none, Sub and Up the one with the least to say."""
    left = bytes(BYTES_PER_PIXEL) + row
    choices = [b"\0" + row,
               b"\1" + bytes([(x - a) & 255 for x, a in zip(row, left)]),
               b"\2" + bytes([(x - b) & 255 for x, b in zip(row, above)])]
    return min(choices, key=lambda choice: sum([min(x, 256 - x) for x in choice[1:]]))


def true_colour(rows: list[bytes]) -> bytes:
    """@pre rows of equal length, at least one"""
    above = [bytes(len(rows[0]))] + rows[:-1]
    image = b"".join(map(filtered, rows, above))
    return encoded(len(rows[0]) // BYTES_PER_PIXEL, len(rows), TRUE_COLOUR, b"", image)


def pixels_of(row: bytes) -> zip:
    return zip(*[iter(row)] * BYTES_PER_PIXEL)


def spread(box: list) -> tuple[int, int]:
    """The channel in which the colours of a box differ most, after by how much."""
    return max((max(c[k] for c, _ in box) - min(c[k] for c, _ in box), k) for k in range(3))


def halves(box: list) -> tuple[list, list]:
    """Two boxes of about as many pixels each. @pre two colours or more"""
    _, channel = spread(box)
    box = sorted(box, key=lambda entry: entry[0][channel])
    half, seen = sum(count for _, count in box) / 2, 0
    for at, (_, count) in enumerate(box[:-1]):
        seen += count
        if seen >= half:
            break
    return box[:at + 1], box[at + 1:]


def mean_colour(box: list) -> bytes:
    total = sum(count for _, count in box)
    return bytes([round(sum(c[k] * count for c, count in box) / total) for k in range(3)])


def boxes_of(counts: collections.Counter, size: int) -> list[list]:
    """Median cut (Heckbert 1982). The most frequent colour, the background, has its own box."""
    entries = counts.most_common()
    boxes = [entries[:1], entries[1:]] if len(entries) > 1 else [entries]
    while len(boxes) < size:
        worst = max(boxes, key=lambda box: spread(box)[0] ** 2 * sum(count for _, count in box))
        if len(worst) == 1:
            break
        boxes.remove(worst)
        boxes.extend(halves(worst))
    return boxes


def with_palette(rows: list[bytes], size: int) -> bytes:
    """At most `size` colours, each the mean of those it stands for. @pre 2 <= size <= 256"""
    counts = collections.Counter(colour for row in rows for colour in pixels_of(row))
    boxes = boxes_of(counts, size)
    number = {colour: n for n, box in enumerate(boxes) for colour, _ in box}
    image = b"".join(b"\0" + bytes([number[colour] for colour in pixels_of(row)]) for row in rows)
    palette = b"".join(map(mean_colour, boxes))
    return encoded(len(rows[0]) // BYTES_PER_PIXEL, len(rows), PALETTE, palette, image)
