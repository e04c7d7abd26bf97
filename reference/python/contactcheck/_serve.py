"""A detector written in Python, asked by a run: the pipe protocol (reference/plugin/README.md).

The run starts a small command for every detector of its own, as for any detector behind a pipe. The
command hands its pipes over to the interpreter that called run(), which forks: the child has the
detector, also one that is defined in a cell of a notebook, and its crash or hang ends the child
alone. The command lives as long as the child and ends as it does.
"""

from __future__ import annotations

import contextlib
import ctypes
import dataclasses
import faulthandler
import io
import json
import os
import selectors
import shlex
import signal
import socket
import struct
import sys
import traceback
from typing import Any, BinaryIO, Optional

import numpy as np

from ._binding import RefusedInput

PROTOCOL = "contactcheck-pipe/1"
RELAY = os.path.join(os.path.dirname(__file__), "_relay.py")
SOCKET = "CONTACTCHECK_PYTHON_SOCKET"  # of the environment of a run
LIBC = ctypes.CDLL(None)


def end_with_parent(how: int) -> None:
    """The signal that this process gets when the thread that started it has ended."""
    PR_SET_PDEATHSIG = 1
    LIBC.prctl(PR_SET_PDEATHSIG, how)

# The lists of an answer in the order of the protocol, with the integers of a row; those of
# piece_contacts and vertex_contacts have a depth and a normal each.
LISTS = {"bodies": 2, "triangles": 4, "cells": 4, "vertices": 3, "near": 4}
WITH_DEPTH = {"piece_contacts": ("piece_depths", "piece_normals", 4),
              "vertex_contacts": ("vertex_depths", "vertex_normals", 3)}


@dataclasses.dataclass(frozen=True)
class LatticeArrays:
    """The lattice that a body is in."""

    nodes: np.ndarray  #: (n, 3) float64, at rest
    cell_nodes: np.ndarray  #: (c, 8) uint32; bit k of a corner's number: high end of axis k
    home_cell: np.ndarray  #: (v,) uint32, per vertex
    local: np.ndarray  #: (v, 3) float64, coordinates of each vertex in its home cell, 0 to 1
    label_begin: np.ndarray  #: (t + 1,) uint32: the cells that triangle t met at rest are
    label_cells: np.ndarray  #: label_cells[label_begin[t]:label_begin[t + 1]]


@dataclasses.dataclass(frozen=True)
class Body:
    """A body at rest, as prepare() of a detector of one's own is given it."""

    name: str
    vertices: np.ndarray  #: (n, 3) float64, metres
    faces: np.ndarray  #: (m, 3) uint32
    lattice: Optional[LatticeArrays]


@dataclasses.dataclass(frozen=True)
class Frame:
    """A moment of the scene, as update() of a detector of one's own is given it."""

    index: int
    time: float  #: seconds
    vertices: list  #: per body (n, 3) float64; empty unless declared in `needs`
    nodes: list  #: per body (n, 3) float64, of one without a lattice its vertices; likewise


class _Data(io.BytesIO):
    def take(self, kind: str, *shape: int) -> np.ndarray:
        dtype = np.dtype(kind)
        count = int(np.prod(shape))
        return np.frombuffer(self.read(count * dtype.itemsize), dtype, count).reshape(shape)


def _body(line: dict, data: _Data) -> Body:
    v, t, grid = line["vertices"], line["triangles"], line["lattice"]
    vertices, faces, lattice = data.take("<f8", v, 3), data.take("<u4", t, 3), None
    if grid:
        lattice = LatticeArrays(
            data.take("<f8", grid["nodes"], 3), data.take("<u4", grid["cells"], 8),
            data.take("<u4", v), data.take("<f8", v, 3), data.take("<u4", t + 1),
            data.take("<u4", grid["labels"]))
    return Body(line["name"], vertices, faces, lattice)


def _rows(answer: dict, name: str, columns: int) -> np.ndarray:
    out = np.asarray(answer[name])
    if out.size == 0:
        return np.zeros((0, columns), "<u4")
    if out.ndim != 2 or out.shape[1] != columns or out.dtype.kind not in "iu" or (
            out.min() < 0 or out.max() >= 2**32):
        got = f"shape {out.shape} of {out.dtype}"
        raise ValueError(f'"{name}" must be (k, {columns}) indices, got {got}')
    return out.astype("<u4")


def _answer(answer: Any) -> tuple[dict, bytes]:
    if not isinstance(answer, dict):
        answer = {"triangles": answer}
    known = {*LISTS, *WITH_DEPTH, *(name for names in WITH_DEPTH.values() for name in names[:2])}
    unknown = set(answer) - known
    if unknown:
        raise ValueError(f"query() answered with unknown lists: {', '.join(sorted(unknown))}")
    line: dict[str, Any] = {"message": "contacts"}
    data = b""
    for name, columns in LISTS.items():
        if name in answer:
            rows = _rows(answer, name, columns)
            line[name] = len(rows)
            data += rows.tobytes()
    for name, (depths, normals, columns) in WITH_DEPTH.items():
        if name in answer:
            rows = _rows(answer, name, columns)
            record = np.zeros(len(rows), "4<u4, <f8, 3<f8")
            record["f0"][:, :columns] = rows
            record["f1"], record["f2"] = answer[depths], answer[normals]
            line[name] = len(rows)
            data += record.tobytes()
    return line, data


def declaration(detector: Any) -> dict:
    """Its line of `hello`, from its attribute `declares`: what is no key of the line is semantics."""
    declares = dict(detector.declares)
    name = getattr(detector, "__name__", type(detector).__name__)
    line = {"message": "hello", "protocol": PROTOCOL, "id": name, "needs": ["vertices"]}
    line.update({key: declares.pop(key) for key in ("id", "summary", "version", "options", "needs")
                 if key in declares})
    return {**line, "semantics": {**declares.pop("semantics", {}), **declares}}


def serve(detector: Any, source: BinaryIO, to: BinaryIO) -> None:
    """Answers until the input ends."""

    def write(line: dict, data: bytes = b"") -> None:
        line["bytes"] = len(data)
        to.write(json.dumps(line).encode() + b"\n" + data)
        to.flush()

    hello = declaration(detector)
    bodies: list[dict] = []
    for text in iter(source.readline, b""):
        line = json.loads(text)
        data = _Data(source.read(line.get("bytes", 0)))
        try:
            if line["message"] == "hello":
                write(hello)
            elif line["message"] == "prepare":
                bodies = line["bodies"]
                detector.prepare([_body(body, data) for body in bodies])
                write({"message": "ready"})
            elif line["message"] == "frame":
                frame = Frame(line["index"], line["time"], [], [])
                for body in bodies:
                    grid = body["lattice"]
                    if "vertices" in hello["needs"]:
                        frame.vertices.append(data.take("<f8", body["vertices"], 3))
                    if "nodes" in hello["needs"]:
                        count = grid["nodes"] if grid else body["vertices"]
                        frame.nodes.append(data.take("<f8", count, 3))
                detector.update(frame)
                write({"message": "done"})
            elif line["message"] == "query":
                write(*_answer(detector.query(line["question"])))
        except RefusedInput as error:
            write({"message": "refused", "text": str(error)})


def _child(detector: Any, pipes: list[int]) -> None:
    """Of the forked process; does not return."""
    code = 1
    try:
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGINT])
        os.setsid()  # its own processes end with it
        end_with_parent(signal.SIGKILL)
        for target, pipe in enumerate(pipes):
            os.dup2(pipe, target)
        # What the detector prints goes to standard error, not between the messages.
        to = os.fdopen(os.dup(1), "wb")
        os.dup2(2, 1)
        sys.stdin = open(os.devnull)
        sys.stdout = os.fdopen(os.dup(1), "w", buffering=1)
        sys.stderr = os.fdopen(os.dup(2), "w", buffering=1)
        if faulthandler.is_enabled():
            faulthandler.enable(sys.stderr)
        own = detector() if isinstance(detector, type) else detector
        serve(own, os.fdopen(0, "rb", closefd=False), to)
        code = 0
    except BaseException:
        traceback.print_exc(file=sys.stderr)
    finally:
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(code)


class Server:
    """Forks for the commands of a run, which it waits for: all in the thread that called run()."""

    def __init__(self, detectors: list) -> None:
        self._detectors = detectors  # more may be added
        self._children: dict[int, tuple[socket.socket, int]] = {}  # process -> command, its file
        self._selector = selectors.DefaultSelector()
        # In Linux's abstract namespace: no file, and no limit from the length of a folder's name.
        self._socket = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        self._socket.bind("")
        self._socket.listen(64)
        self._selector.register(self._socket, selectors.EVENT_READ, self._connected)

    def command(self, index: int) -> str:
        """For --detector-cmd: the same words in every run."""
        return "exec " + shlex.join([sys.executable or "python3", "-S", "-E", RELAY, str(index)])

    def environment(self) -> dict[str, str]:
        return {**os.environ, SOCKET: self._socket.getsockname()[1:].decode("ascii")}

    def wait(self, process: int) -> None:
        """Until the process of the run has ended."""
        ended = False

        def run_ended() -> None:
            nonlocal ended
            ended = True

        watched = os.pidfd_open(process)
        self._selector.register(watched, selectors.EVENT_READ, run_ended)
        try:
            while not ended:
                for key, _ in self._selector.select():
                    key.data()
        finally:
            self._selector.unregister(watched)
            os.close(watched)

    def close(self) -> None:
        for process in list(self._children):
            self._end(process)
        self._selector.close()
        self._socket.close()

    def _connected(self) -> None:
        connection, _ = self._socket.accept()
        peer = connection.getsockopt(socket.SOL_SOCKET, socket.SO_PEERCRED, struct.calcsize("3i"))
        if struct.unpack("3i", peer)[1] != os.getuid():
            connection.close()  # somebody else's
            return
        word, pipes, _, _ = socket.recv_fds(connection, 16, 3)
        if len(pipes) != 3:
            connection.close()
            return
        # A child must not be interrupted into returning.
        mask = signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])
        process = os.fork()
        if process == 0:
            self._socket.close()
            for other in [connection, *(c for c, _ in self._children.values())]:
                other.close()
            _child(self._detectors[int(word)], pipes)
        signal.pthread_sigmask(signal.SIG_SETMASK, mask)
        for pipe in pipes:
            os.close(pipe)
        file = os.pidfd_open(process)
        self._children[process] = (connection, file)
        # The command sends nothing more: readable means that it was killed. Either ends both.
        for source in (file, connection.fileno()):
            self._selector.register(source, selectors.EVENT_READ, lambda: self._end(process))

    def _end(self, process: int) -> None:
        if process not in self._children:
            return  # both had something to say
        connection, file = self._children.pop(process)
        self._selector.unregister(connection.fileno())
        self._selector.unregister(file)
        with contextlib.suppress(ProcessLookupError):
            signal.pidfd_send_signal(file, signal.SIGKILL)  # nothing to one that has ended
            os.killpg(process, signal.SIGKILL)  # what it has started
        code = 0
        with contextlib.suppress(ChildProcessError):  # a program may have all children taken away
            code = os.waitstatus_to_exitcode(os.waitpid(process, 0)[1])
        with contextlib.suppress(OSError):
            connection.send(str(code).encode())
        os.close(file)
        connection.close()
