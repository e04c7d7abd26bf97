"""Bytes of point caches, written apart from the program's reader: samples of points of three coordinates."""

import struct


def _floats(order, samples):
    values = [value for sample in samples for point in sample for value in point]
    return struct.pack(f"{order}{len(values)}f", *values)


def pc2_bytes(samples):
    return struct.pack("<12siiffi", b"POINTCACHE2", 1, len(samples[0]), 0, 1, len(samples)) + _floats("<", samples)


def mdd_bytes(samples):
    """MDD has a time for each sample."""
    times = [number / 24 for number in range(len(samples))]
    return (struct.pack(f">ii{len(times)}f", len(samples), len(samples[0]), *times) + _floats(">", samples))
