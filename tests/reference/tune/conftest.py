"""What the tests of `contactcheck tune` share: a tuning of one scene file, as the program does it."""

import json

import pytest

from program import ROOT, contactcheck, successful

PIPE_EXAMPLE = ROOT / "tests" / "examples" / "python-pipe" / "detector.py"


class Tune:
    def __init__(self, folder):
        self.folder, self.out = folder, folder / "out"
        self.scene = folder / "tiny.json"

    def write(self, name, text):
        """Writes the scene that is tuned from now on."""
        self.scene = self.folder / name
        self.scene.parent.mkdir(parents=True, exist_ok=True)
        self.scene.write_text(text, encoding="utf-8")

    def words(self, *more):
        return ["tune", self.scene, "--out", self.out, "--processes", "1", *more]

    def __call__(self, *more, cwd=None):
        return successful(*self.words(*more), cwd=cwd)

    def outcome(self, *more):
        return contactcheck(*self.words(*more))

    def outside_detector(self):
        """A command that runs the detector "python-sweep" of the examples, of words without quotes."""
        (self.folder / "detector.py").write_bytes(PIPE_EXAMPLE.read_bytes())
        return f"python3 -B {self.folder}/detector.py"

    @property
    def result(self):
        return json.loads((self.out / "tune.json").read_text(encoding="utf-8"))

    @property
    def page(self):
        return (self.out / "tune.md").read_text(encoding="utf-8")


@pytest.fixture
def tune(tmp_path):
    return Tune(tmp_path)


@pytest.fixture
def falling_scene():
    """The text of a simulated scene: two boxes of 0.5 m in lattices of 2 x 2 x 2 cells (a copy each), that
    start just above the ground and one another: 12 frames of 2 steps, the later ones in contact.
    """
    def text(**material):
        material = material or {"model": "mass-spring", "mass": 5, "stiffness": 600, "damping": 1}
        box = {"name": "box", "copies": {"counts": [1, 2, 1], "spacing": [0, 0.55, 0]},
               "mesh": {"shape": "box", "divisions": 2, "scale": 0.5}, "lattice": {"cells": [2, 2, 2]},
               "motion": {"position": [0, 0.3, 0], "spins": [{"axis": "y", "degrees": 20}]},
               "material": material}
        wall = {"name": "wall", "mesh": {"shape": "box", "divisions": 1, "scale": 0.1},
                "lattice": {"cells": [1, 1, 1]}, "motion": {"position": [5, 0, 0]}}
        return json.dumps({"id": "falling", "title": "Two boxes", "frames": 12,
                           "simulation": {"every": 2, "ground": {}}, "levels": ["body", "cell", "triangle"],
                           "bodies": [box, wall]})
    return text
