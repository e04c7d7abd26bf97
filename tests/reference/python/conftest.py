"""The command line's answers, to hold the module's against."""

import dataclasses
import json
import os
import pathlib
import subprocess
import sys

import numpy as np
import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "examples"))
PROGRAM = os.environ["CONTACTCHECK_PROGRAM"]
os.environ.pop("LD_PRELOAD", None)  # of the interpreter alone, in a build with sanitizers


def read_ply(file):
    """(V, F) as `contactcheck export` writes them."""
    data = file.read_bytes()
    header, body = data.split(b"end_header\n", 1)
    counts = [int(line.split()[2]) for line in header.splitlines() if line.startswith(b"element")]
    vertices = np.frombuffer(body, "<f8", 3 * counts[0]).reshape(-1, 3)
    faces = np.frombuffer(body, [("corners", "u1"), ("face", "<i4", 3)], counts[1], 24 * counts[0])
    return vertices, faces["face"]


@dataclasses.dataclass
class Frame:
    bodies: list  # (V, F)
    contacts: np.ndarray  # (k, 4): body a, body b, triangle of a, of b; of one body a = b


def exported(folder, scene, frames):
    subprocess.run([PROGRAM, "export", scene, "--frames", str(frames), "--out", folder], check=True,
                   capture_output=True)
    out = []
    for truth in sorted((folder / scene / "truth").glob("*.json")):
        bodies = [read_ply(body / f"{truth.stem}.ply") for body in sorted((folder / scene / "bodies").iterdir())]
        rows = [contact[:4] for contact in json.loads(truth.read_text())["contacts"]]
        out.append(Frame(bodies, np.array(rows, np.int32).reshape(-1, 4)))
    assert len(out) == frames
    return out


@pytest.fixture(scope="session")
def bunnies(tmp_path_factory):
    frames = exported(tmp_path_factory.mktemp("bunnies"), "bunny-touch", 12)
    assert sum(len(frame.contacts) for frame in frames) > 100
    return frames


@pytest.fixture(scope="session")
def letter(tmp_path_factory):
    frame = exported(tmp_path_factory.mktemp("letter"), "self-letter", 4)[-1]
    assert len(frame.contacts) > 1000
    return frame


@pytest.fixture(scope="session")
def bunny_run(tmp_path_factory):
    """The folder of a run of bunny-touch with its recording: the frames of `bunnies`."""
    out = tmp_path_factory.mktemp("run")
    subprocess.run([PROGRAM, "run", "bunny-touch", "--frames", "12", "--no-timing", "--quiet", "--detector",
                    "ffd-lazy", "--detector", "fcl-aabb", "--out", out], check=True, capture_output=True)
    return out
