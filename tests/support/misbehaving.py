"""Detectors from outside that are made to do something wrong, and what must become of their runs."""

import os
import pathlib
import shlex
import sys

import pytest

import program
import tiny_run

LIBRARY = os.environ["CONTACTCHECK_MISBEHAVING_LIBRARY"]
COMMAND_FILE = program.ROOT / "tests" / "reference" / "plugin" / "misbehaving_command.py"

# Limits that a test can wait for, of a call and of memory.
SHORT_CALLS = ("--no-timing", "--call-limit", "1.5")
LITTLE_MEMORY = ("--no-timing", "--memory-limit", "400")
# A leak of 16 MiB in each of these frames passes the limit early, and would take 3 GiB in all.
LEAKING_LONG = (*LITTLE_MEMORY, "--frames", "200")


def library(fault):
    return f"{LIBRARY}:fault={fault}"


def command(fault):
    return shlex.join([sys.executable, "-B", str(COMMAND_FILE), fault])


def fault(name, *pieces, status="error", flags=tiny_run.UNTIMED):
    """Parameters of a test: the fault, pieces of the sentence about it, status of its row, flags."""
    return pytest.param(name, pieces, status, flags, id=name)


def refused_on_tiny_scene(*words, named, folder):
    """As program.refused, for a run on the tiny scene."""
    scene = pathlib.Path(folder) / "tiny.json"
    scene.write_text(program.tiny_scene(), encoding="utf-8")
    return program.refused("run", scene, "--out", pathlib.Path(folder) / "out", *words,
                           named=named, folder=folder)


def assert_only_its_row(run, detector, pieces, status="error"):
    """The row of `detector` has this status and the pieces in its message; that of fcl-aabb, which ran
    after it, is as without it."""
    row = run.row(detector)
    assert row["status"] == status, row["message"]
    assert run.outcome.exit_code == (3 if status == "error" else 0), run.outcome.err
    for piece in pieces:
        assert piece in row["message"]
    assert run.row("fcl-aabb")["status"] == "ok"
    assert run.row("fcl-aabb")["levels"]["triangle"]["missed"] == 0
