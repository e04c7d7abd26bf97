#!/usr/bin/env python3
"""Holds the times of a run against detectors whose time is known (probe.c).

    check_probes.py build/release [OUT]

A run of the scene far-apart, in which nothing touches. Its results must have: the time that a probe
spins, in the phase in which it spins; the time that it sleeps, which is no CPU time; a phase `map`
for a probe that is fed vertices and none for one that maps them itself; a ratio of 2 between two
probes of which one spins twice as long; and cold frames in which a buffer that stays in the caches
in playback has to be fetched again. On a busy machine a time may be off: what fails is asked again,
three times in all. Exit code 1 when something fails each time.
"""

import json
import pathlib
import statistics
import subprocess
import sys

ATTEMPTS = 3
PASSES = 5
PROBES = {
    "spin": "query_us=200,update_us=400",
    "spin twice": "query_us=400,update_us=800",
    "sleep": "sleep_us=1000",
    "chase": "chase_kib=512",
    "given": "map=given",
    "own": "map=own",
}


def run(build, out):
    """The rows of one run, by their names in PROBES."""
    library = next(build.glob("tests/probes/libprobe.so"))
    command = [build / "contactcheck", "run", "far-apart", "--frames", "24", "--processes",
               str(PASSES), "--quiet", "--out", out]
    for options in PROBES.values():
        command += ["--detector", f"{library.resolve()}:{options}"]
    subprocess.run(command, check=True)
    rows = json.loads((out / "results.json").read_text("utf-8"))["runs"]
    by_options = {row["detector"].removeprefix("probe:"): row for row in rows}
    return {name: by_options[options] for name, options in PROBES.items()}


class Checks:
    """Sentences of what does not hold."""

    def __init__(self):
        self.failed = []

    def within(self, what, value, low, high):
        if not low <= value <= high:
            self.failed.append(f"{what}: {value:.4g}, expected {low:.4g} to {high:.4g}")

    def none(self, what, value):
        if value is not None:
            self.failed.append(f"{what}: {value:.4g}, expected none")


def faults(rows):
    """What does not hold in the rows of a run."""
    checks = Checks()
    played = {name: row["time_ms"]["playback"] for name, row in rows.items()}
    for name, row in rows.items():
        times = row["time_ms"]
        checks.within(f"{name}: passes", len(times["pass_ms"]), PASSES, PASSES)
        for regime in ("playback", "cold"):
            t = times[regime]
            parts = (t["map"] or 0.0) + t["update"] + t["query"]
            checks.within(f"{name}: phases over frame, {regime}", parts / t["frame"], 0.98, 1.02)
    # Milliseconds; a clock's call and the interruptions of a machine on top.
    checks.within("spin: update", played["spin"]["update"], 0.396, 0.46)
    checks.within("spin: query", played["spin"]["query"], 0.198, 0.23)
    checks.within("spin: cold frame", rows["spin"]["time_ms"]["cold"]["frame"], 0.594, 0.75)
    checks.within("sleep: frame", played["sleep"]["frame"], 1.0, 20.0)
    checks.within("sleep: CPU time", played["sleep"]["cpu"], 0.0, 0.3)
    pairs = zip(rows["spin twice"]["time_ms"]["pass_ms"], rows["spin"]["time_ms"]["pass_ms"])
    checks.within("spin twice over spin", statistics.median(a / b for a, b in pairs), 1.94, 2.06)
    # One by one in plain C, no faster than half of the SIMD version and no 100 times slower.
    checks.none("own: phase map", played["own"]["map"])
    if played["given"]["map"] is None:
        checks.failed.append("given: no phase map")
    else:
        checks.within("mapping of the probe over the phase map",
                      played["own"]["update"] / played["given"]["map"], 0.5, 100.0)
    checks.within("chase: cold over playback",
                  rows["chase"]["time_ms"]["cold"]["frame"] / played["chase"]["frame"], 3.0, 1000.0)
    return checks.failed


def main():
    build = pathlib.Path(sys.argv[1])
    out = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else build / "probes")
    for attempt in range(1, ATTEMPTS + 1):
        failed = faults(run(build, out))
        if not failed:
            print(f"probes: the times of {len(PROBES)} detectors are what they take")
            return 0
        print(f"attempt {attempt} of {ATTEMPTS}:", *failed, sep="\n  ")
    return 1


if __name__ == "__main__":
    sys.exit(main())
