"""Runs of a program on the tiny scene, with the detectors that a test names."""

import functools
import pathlib
import re
import time

import program

UNTIMED = ("--no-timing",)


class TinyRun:
    """One run on the tiny scene (5 frames) below `folder`, without timings unless `flags` differ."""

    def __init__(self, folder, words, flags=UNTIMED, *, of=program.PROGRAM):
        scene = folder / "tiny.json"
        scene.write_text(program.tiny_scene(), encoding="utf-8")
        self.out = folder / "out"
        self.outcome = program.run_program(of, ["run", scene, "--out", self.out, *words, *flags])

    @functools.cached_property
    def results(self):
        """Parsed; they must satisfy the schema."""
        file = self.out / "results.json"
        assert file.is_file(), self.outcome.err
        return program.valid_results(file)

    def row(self, detector):
        rows = [row for row in self.results["runs"] if row["detector"] == detector]
        assert len(rows) == 1, f"{len(rows)} rows of {detector}: {self.outcome.err}"
        return rows[0]


def child_dies(row):
    """Whether the child process whose number the detector of this row has printed ends within 10 s. A
    zombie has ended."""
    number = re.search(r"child (\d+)", " ".join(row["notes"]))
    assert number, row["notes"]
    stat = pathlib.Path("/proc") / number[1] / "stat"
    for _ in range(1000):
        try:
            if stat.read_text().rpartition(")")[2].split()[0] == "Z":
                return True
        except (FileNotFoundError, ProcessLookupError):
            return True
        time.sleep(0.01)
    return False
