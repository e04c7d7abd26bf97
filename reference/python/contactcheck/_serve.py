"""A detector written in Python, asked by a run: the pipe protocol (reference/plugin/README.md).

The run starts a small command for every detector of its own, as for any detector behind a pipe. The
command hands its pipes over to the interpreter that called run(), which forks: the child has the
detector, also one that is defined in a cell of a notebook, and its crash or hang ends the child
alone. The command lives as long as the child and ends as it does. What cannot be forked, such as a
context of a GPU, is asked in a thread of the interpreter.
"""

from __future__ import annotations

import collections
import contextlib
import ctypes
import dataclasses
import errno
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
import threading
import traceback
from collections.abc import Iterator, Mapping
from typing import Any, BinaryIO, Optional

import numpy as np

from ._binding import RefusedInput, process_tree

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
# Of answers about a step; those of impacts have a time each, where impact_times gives them.
STEP_LISTS = {"impact_triangles": 4, "impact_vertices": 4, "impact_edges": 6}
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
    vertices: np.ndarray  #: (n, 3) float64, metres; without those that no triangle uses
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


def _frame(index: int, time: float, bodies: list, needs: list, data: _Data) -> Frame:
    frame = Frame(index, time, [], [])
    for body in bodies:
        grid = body["lattice"]
        if "vertices" in needs:
            frame.vertices.append(data.take("<f8", body["vertices"], 3))
        if "nodes" in needs:
            frame.nodes.append(data.take("<f8", grid["nodes"] if grid else body["vertices"], 3))
    return frame


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
    known = {*LISTS, *STEP_LISTS, "impacts", "impact_times", *WITH_DEPTH, *(name for names in WITH_DEPTH.values() for name in names[:2])}
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
    if "impacts" in answer:
        rows = _rows(answer, "impacts", 2)
        record = np.zeros(len(rows), "2<u4, <f8")
        record["f0"] = rows
        record["f1"] = answer.get("impact_times", -1.0)  # below 0: not reported
        line["impacts"] = len(rows)
        data += record.tobytes()
    for name, columns in STEP_LISTS.items():
        if name in answer:
            rows = _rows(answer, name, columns)
            line[name] = len(rows)
            data += rows.tobytes()
    return line, data


def declaration(detector: Any) -> dict:
    """Its line of `hello`, from its attribute `declares`: what is no key of the line is semantics.

    It is transient: it lives in this interpreter, and no later run can start it.
    """
    declares = dict(detector.declares)
    name = getattr(detector, "__name__", type(detector).__name__)
    line = {"message": "hello", "protocol": PROTOCOL, "id": name, "needs": ["vertices"],
            "transient": True}
    line.update({key: declares.pop(key) for key in ("id", "summary", "version", "options", "needs")
                 if key in declares})
    if declares.pop("unisolated", False):
        line["unisolated"] = True
    return {**line, "semantics": {**declares.pop("semantics", {}), **declares}}


def _unisolated(detector: Any) -> bool:
    declares = getattr(detector, "declares", None)
    return isinstance(declares, Mapping) and bool(declares.get("unisolated"))


def _say(errors: int, sentence: str) -> None:
    with contextlib.suppress(OSError):  # nobody reads any more
        os.write(errors, sentence.encode() + b"\n")


def serve(detector: Any, source: BinaryIO, to: BinaryIO, unisolated: bool = False) -> None:
    """Answers until the input ends."""
    if isinstance(detector, type):
        detector = detector()

    def write(line: dict, data: bytes = b"") -> None:
        line["bytes"] = len(data)
        to.write(json.dumps(line).encode() + b"\n" + data)
        to.flush()

    hello = declaration(detector)
    if unisolated:
        hello["unisolated"] = True
    elif hello.get("unisolated"):
        raise ValueError('"unisolated" must be in an attribute of the class, or give an object')
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
                detector.update(_frame(line["index"], line["time"], bodies, hello["needs"], data))
                write({"message": "done"})
            elif line["message"] == "step":
                start, end = (
                    _frame(line["index"] + i, line[time], bodies, hello["needs"], data)
                    for i, time in enumerate(("start_time", "end_time")))
                detector.update_step(start, end)
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
        serve(detector, os.fdopen(0, "rb", closefd=False), to)
        code = 0
    except BaseException:
        traceback.print_exc(file=sys.stderr)
    finally:
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(code)


def _kibibytes(process: int) -> collections.Counter:
    """Of the memory of a process, by the kernel's names; of one that has ended nothing."""
    out: collections.Counter = collections.Counter()
    with contextlib.suppress(OSError), open(f"/proc/{process}/smaps_rollup") as rollup:
        for name, number, *_ in map(str.split, list(rollup)[1:]):
            out[name.rstrip(":")] = int(number)
    return out


# What a fork inherits of this process and must not hold open: whoever reads from it would not see its
# end. All forks, also those of a detector and of another run.
_not_of_forks: set[int] = set()


def _leave() -> None:
    if _not_of_forks:
        nothing = os.open(os.devnull, os.O_RDWR)
        for file in _not_of_forks:
            os.dup2(nothing, file, inheritable=False)  # its number stays taken: objects may close it
        os.close(nothing)
        _not_of_forks.clear()


os.register_at_fork(after_in_child=_leave)


class _Answering:
    """A detector that is asked: by a process, or by a thread of this one."""

    def __init__(self, errors: int) -> None:
        self.errors = os.dup(errors)  # standard error of the command
        self.ended = -1  # readable: a process has ended (its pidfd), or a thread (a pipe)

    def over_limit(self, limit: int) -> bool:
        return False

    def end(self) -> int:
        """Its exit code."""
        raise NotImplementedError


class _Process(_Answering):
    def __init__(self, process: int, pipes: list[int]) -> None:
        try:
            super().__init__(pipes[2])
            self.process, self.ended = process, os.pidfd_open(process)
        except OSError:
            os.kill(process, signal.SIGKILL)
            os.waitpid(process, 0)
            raise
        self.inherited = _kibibytes(os.getpid())["Rss"]

    def over_limit(self, limit: int) -> bool:
        """Of what it has taken: of two numbers, both at most that, the greater. What is its own alone;
        and all, with a share of what it shares, less what it can share with the interpreter."""
        memory: collections.Counter = collections.Counter()
        for each in process_tree(self.process):
            memory += _kibibytes(each)
        own = sum(number for name, number in memory.items() if name.startswith("Private_"))
        return max(own, memory["Pss"] - self.inherited) << 10 > limit

    def end(self) -> int:
        with contextlib.suppress(ProcessLookupError):
            signal.pidfd_send_signal(self.ended, signal.SIGKILL)  # nothing to one that has ended
            os.killpg(self.process, signal.SIGKILL)  # what it has started
        with contextlib.suppress(ChildProcessError):  # a program may have all children taken away
            return os.waitstatus_to_exitcode(os.waitpid(self.process, 0)[1])
        return 0


class _Thread(_Answering):
    def __init__(self, detector: Any, pipes: list[int]) -> None:
        super().__init__(pipes[2])
        self.ended, running = os.pipe()  # closed when the thread is through
        # Its own files: it may still be in a call when the command has been killed.
        self._files = [*map(os.dup, pipes), running]
        _not_of_forks.update(self._files)
        self._code, self._detector = 1, detector
        self.thread = threading.Thread(target=self._serve, daemon=True)
        try:
            self.thread.start()
        except RuntimeError as why:
            _not_of_forks.difference_update(self._files)
            for file in (*self._files, self.ended, self.errors):
                os.close(file)
            raise OSError(errno.EAGAIN, f"neither process nor thread can be had: {why}") from None

    def _serve(self) -> None:
        source, to = open(self._files[0], "rb"), open(self._files[1], "wb")
        errors = open(self._files[2], "w")
        try:
            print("unisolated: asked in the process that called run()", file=errors, flush=True)
            serve(self._detector, source, to, unisolated=True)
            self._code = 0
        except BaseException:
            with contextlib.suppress(OSError):  # nobody reads any more
                traceback.print_exc(file=errors)
        finally:
            _not_of_forks.difference_update(self._files)
            for close in (source.close, to.close, errors.close):
                with contextlib.suppress(OSError):
                    close()
            os.close(self._files[3])

    def end(self) -> int:
        return self._code


@contextlib.contextmanager
def _uninterrupted() -> Iterator[None]:
    """Ctrl-C waits: between a fork and its entry in a list it would leave a process that nobody knows.
    A mask would not do, since another thread of the program can take the signal."""
    handler = signal.getsignal(signal.SIGINT)
    if threading.current_thread() is not threading.main_thread() or not callable(handler):
        yield
        return
    came: list = []
    signal.signal(signal.SIGINT, lambda *arguments: came.append(arguments))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, handler)
        if came:
            handler(*came[0])


class Server:
    """Asks the detectors of a run, for its commands: waits in the thread that called run()."""

    def __init__(self, detectors: list, memory_limit: int) -> None:
        self._detectors = detectors  # more may be added
        self._memory_limit = memory_limit  # bytes
        self._answering: dict[_Answering, socket.socket] = {}  # readable: the command was killed
        self._threads: dict[int, threading.Thread] = {}  # by detector: those that cannot be forked
        self._forked: set[int] = set()  # detectors
        self._selector = selectors.DefaultSelector()
        # In Linux's abstract namespace: no file, and no limit from the length of a folder's name.
        self._socket = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        self._socket.bind("")
        self._socket.listen(64)
        _not_of_forks.add(self._socket.fileno())
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
                for key, _ in self._selector.select(0.1 if self._answering else None):
                    key.data()
                for one in list(self._answering):
                    if one.over_limit(self._memory_limit):
                        _say(one.errors, f"took more than {self._memory_limit >> 20} MiB (memory limit)")
                        self._end(one)
        finally:
            self._selector.unregister(watched)
            os.close(watched)

    def close(self) -> None:
        for one in list(self._answering):
            self._end(one)
        self._selector.close()
        self._close(self._socket)

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
        _not_of_forks.add(connection.fileno())
        try:
            with _uninterrupted():
                one = self._started(int(word), pipes)
                self._answering[one] = connection
                for source in (one.ended, connection.fileno()):
                    self._selector.register(source, selectors.EVENT_READ, lambda: self._end(one))
        except OSError as why:
            _say(pipes[2], str(why.strerror))
            self._close(connection)
        finally:
            for pipe in pipes:
                os.close(pipe)

    def _started(self, index: int, pipes: list[int]) -> _Answering:
        detector = self._detectors[index]
        if index not in self._threads and not _unisolated(detector):
            try:
                process = os.fork()
            except OSError as why:
                # What was declared in a process holds for it: a thread would have to say more.
                if index in self._forked:
                    raise OSError(why.errno, f"no process can be had: {why.strerror}") from None
            else:
                if process == 0:
                    _child(detector, pipes)
                self._forked.add(index)
                return _Process(process, pipes)
        earlier = self._threads.get(index)
        if earlier:
            earlier.join(0.5)
            if earlier.is_alive():
                raise OSError(errno.EBUSY, "it has not returned from an earlier call")
        one = _Thread(detector, pipes)
        self._threads[index] = one.thread
        return one

    def _end(self, one: _Answering) -> None:
        if one not in self._answering:
            return  # both had something to say
        connection = self._answering.pop(one)
        self._selector.unregister(connection.fileno())
        self._selector.unregister(one.ended)
        code = one.end()
        with contextlib.suppress(OSError):
            connection.send(str(code).encode())
        os.close(one.ended)
        os.close(one.errors)
        self._close(connection)

    def _close(self, connection: socket.socket) -> None:
        _not_of_forks.discard(connection.fileno())
        connection.close()
