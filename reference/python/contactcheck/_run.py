"""Whole scenes: run(), gate(), and what they leave behind. All by the program `contactcheck`."""

from __future__ import annotations

import csv
import html
import io
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import weakref
import xml.etree.ElementTree as xml
from typing import Any, NamedTuple, Optional, Sequence, Union

import numpy as np

from . import _binding, _serve
from ._binding import InputError, Unavailable

TEXTS = {"scene", "detector", "status", "message", "options", "finest_level", "question",
         "contact_hash", "recording"}  # columns of a table; the others are numbers


def program() -> str:
    """Path of the program: $CONTACTCHECK_PROGRAM, or beside a build's module, or of the PATH."""
    built = pathlib.Path(_binding.__file__).resolve().parents[2] / "contactcheck"
    found = os.environ.get("CONTACTCHECK_PROGRAM")
    found = found or (str(built) if built.is_file() else shutil.which("contactcheck"))
    if not found:
        raise Unavailable("the program contactcheck is not on the PATH; Debian's package contactcheck has it")
    return os.path.abspath(found)


def _call(
    words: Sequence[Any],
    server: Optional[_serve.Server] = None,
    quiet: bool = True,
    folder: Union[str, os.PathLike, None] = None,
) -> subprocess.CompletedProcess:
    """Runs the program; bad usage and bad input raise its sentence. Ctrl-C ends it in its own way.

    Exit code 1 (a check fails) and 3 (a detector's status is error) are results. `folder`: in which
    it runs.
    """
    # Files and no pipes: nobody reads while the server waits.
    with tempfile.TemporaryFile("w+") as out, tempfile.TemporaryFile("w+") as error:
        try:
            process = subprocess.Popen(
                [program(), *map(str, words)], stdin=subprocess.DEVNULL, cwd=folder,
                stdout=out if quiet else None, stderr=error if quiet else None,
                env=server.environment() if server else None,
                start_new_session=True,  # so that Ctrl-C reaches it by us, once
                preexec_fn=lambda: _serve.end_with_parent(signal.SIGINT))
        except OSError as why:
            raise Unavailable(f"{program()} cannot be run: {why.strerror}") from None
        try:
            if server:
                server.wait(process.pid)
            process.wait()
        except BaseException:
            process.send_signal(signal.SIGINT)
            process.wait()
            raise
        out.seek(0)
        error.seek(0)
        printed, sentence = out.read(), error.read().strip()
    if process.returncode == 2 and not quiet:
        return _call(words, server)  # it fails at once, and its sentence is ours then
    if process.returncode == 2:
        raise InputError(sentence.removeprefix("contactcheck: "))
    if process.returncode not in (0, 1, 3):
        last = sentence.rpartition("\n")[2]
        raise RuntimeError(f"contactcheck ended with exit code {process.returncode}: {last}")
    return subprocess.CompletedProcess(words, process.returncode, printed, sentence)


def _memory_limit(options: Sequence[str]) -> int:
    """Bytes; of a bad one the program says what is wrong."""
    limit = str(_binding.MEMORY_LIMIT >> 20)
    for word, following in zip(options, [*options[1:], ""]):
        name, equals, value = str(word).partition("=")
        if name == "--memory-limit":
            limit = value if equals else str(following)
    return int(limit) << 20 if limit.isdecimal() else _binding.MEMORY_LIMIT


def write_ply(file: pathlib.Path, vertices: np.ndarray, faces: np.ndarray) -> None:
    record = np.zeros(len(faces), [("corners", "u1"), ("face", "<i4", 3)])
    record["corners"], record["face"] = 3, faces
    header = ("ply\nformat binary_little_endian 1.0\n"
              f"element vertex {len(vertices)}\nproperty double x\nproperty double y\nproperty double z\n"
              f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n")
    file.write_bytes(header.encode() + np.ascontiguousarray(vertices, "<f8").tobytes() + record.tobytes())


class Scene:
    """A scene of its own: a dictionary of the scene format (fixtures/README.md), or of arrays.

    Paths in the dictionary are relative to the working directory.
    """

    def __init__(self, description: dict) -> None:
        self.description = description
        self._meshes: list[tuple[str, list, np.ndarray]] = []  # name, vertices of frames, faces

    @classmethod
    def from_frames(
        cls,
        bodies: Sequence[Any],
        id: str = "frames",
        time_step: float = 1.0,
        levels: Sequence[str] = ("body", "triangle"),
        lattice: Optional[dict] = None,
    ) -> "Scene":
        """Of bodies (frames, F): frames is (f, n, 3) or a list of (n, 3), the vertices in each.

        `levels`: what is judged, as in a scene file. `lattice`: of every body, for detectors that
        need one, e.g. {"kept": 150, "fit": True}; the fitted surface is judged then.

        >>> V, F = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]]), [[0, 1, 2]]
        >>> Scene.from_frames([([V, V], F), ([V + 1, V], F)])
        <contactcheck.Scene frames: 2 bodies>
        """
        bodies = list(bodies)
        out = cls({"id": id, "time_step": time_step, "levels": list(levels), "bodies": []})
        for i, (frames, F) in enumerate(bodies):
            name, place = f"body{i}", f"V of bodies[{i}], frame "
            if len(frames) == 0:
                raise InputError(f"bodies[{i}] has no frame")
            if len(frames) != len(bodies[0][0]):
                raise InputError(f"bodies[{i}] has {len(frames)} frames, bodies[0] {len(bodies[0][0])}")
            shape = _binding.Shape(frames[0], F, place + "0", f"F of bodies[{i}]")
            positions = [shape.positions(V, f"{place}{f}") for f, V in enumerate(frames)]
            out.description["frames"] = len(positions)
            body: dict = {"name": name, "recording": {"frames": f"{name}_%06d.ply"}}
            if lattice:
                body["lattice"] = lattice
            out.description["bodies"].append(body)
            out._meshes.append((name, positions, shape.faces))
        return out

    def save(self, folder: Union[str, os.PathLike]) -> pathlib.Path:
        """Writes scene file and meshes into a folder, for `contactcheck run`; the file's path."""
        folder = pathlib.Path(folder)
        folder.mkdir(parents=True, exist_ok=True)
        description = self.description if self._meshes else _with_whole_paths(self.description)
        for name, frames, faces in self._meshes:
            for f, vertices in enumerate(frames):
                write_ply(folder / f"{name}_{f:06d}.ply", vertices, faces)
        file = folder / "scene.json"
        file.write_text(json.dumps(description, indent=1, default=_number), encoding="utf-8")
        return file

    def __repr__(self) -> str:
        bodies = self.description.get("bodies", [])
        return f"<contactcheck.Scene {self.description.get('id')}: {len(bodies)} bodies>"


def _number(value: Any) -> Any:
    if isinstance(value, (np.ndarray, np.generic)):
        return value.tolist()
    raise InputError(f"a scene has texts, numbers, lists and dictionaries; {type(value).__name__} is none")


def _with_whole_paths(value: Any, key: str = "") -> Any:
    if isinstance(value, dict):
        return {k: _with_whole_paths(v, k) for k, v in value.items()}
    if isinstance(value, (list, tuple)):
        return [_with_whole_paths(v) for v in value]
    is_path = key in ("file", "frames", "cache") and isinstance(value, str)
    return os.path.abspath(value) if is_path else value


class Verdict(NamedTuple):
    """What gate() answers."""

    passed: bool
    failures: list  #: dictionaries: rule, row (scene and detector), reason
    text: str  #: as the command line prints it


class Results:
    """What a run has found: any results.json, also of the command line.

    `data` is the document itself (fixtures/results.schema.json).

    >>> V, F = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]]), [[0, 1, 2]]
    >>> results = run(Scene.from_frames([([V, V], F), ([V + 2, V], F)]), "ffd-lazy", timing=False)
    >>> results.per_frame("ffd-lazy")["truth"].tolist(), results.contacts("ffd-lazy")
    ([0, 1], {})
    >>> again = Results(results.file)
    >>> [(row["detector"], row["triangle_recall"]) for row in again.rows()], again.disagreements()
    ([('ffd-lazy', 1.0)], [])
    """

    def __init__(self, file: Union[str, os.PathLike]) -> None:
        self.file = pathlib.Path(file)
        self._results = _binding.Results(str(self.file))
        self.data: dict = json.loads(self.file.read_text(encoding="utf-8"))

    def rows(self) -> list[dict[str, Any]]:
        """One dictionary per scene and detector, the columns of report.csv; None: no value.

        pandas.DataFrame(results.rows()) makes a table of them.
        """

        def value(key: str, text: str) -> Any:
            if key in TEXTS or text == "":
                return text if key in TEXTS else None
            number = float(text)
            return int(text) if text.lstrip("-").isdigit() else number

        table = csv.DictReader(io.StringIO(self._results.csv(), newline=""))
        return [{key: value(key, text) for key, text in row.items()} for row in table]

    def _run(self, detector: str, scene: Optional[str]) -> dict:
        found = [run for run in self.data["runs"]
                 if run["detector"] == detector and scene in (None, run["scene"])]
        if len(found) != 1:
            raise InputError(f'{len(found)} rows have the detector "{detector}"' +
                             (f' and the scene "{scene}"' if scene else "; name a scene"))
        return found[0]

    def per_frame(self, detector: str, scene: Optional[str] = None) -> dict[str, np.ndarray]:
        """Of one row: truth, missed, spurious, ... frame by frame; NaN: no value."""
        values = self._run(detector, scene).get("per_frame") or {}
        return {key: np.array(items, float if None in items else None)
                for key, items in values.items() if isinstance(items, list)}

    def contacts(self, detector: str, scene: Optional[str] = None) -> dict[int, dict[str, np.ndarray]]:
        """Of one row, by frame: pairs `missed` and `spurious`, (k, 4): body a, body b, element a, b.

        At the finest level that it claims; what the elements are, and where they are -1, says
        fixtures/README.md, "Contacts". Frames without an error are left out, and so are pairs
        beyond 500 of a frame.
        """
        run = self._run(detector, scene)
        name = next(s.get("contacts") for s in self.data["scenes"] if s["id"] == run["scene"])
        if not name or not (self.file.parent / name).is_file():
            raise InputError(f"no contacts are kept beside {self.file}")
        document = json.loads((self.file.parent / name).read_text(encoding="utf-8"))

        def pairs(of: dict) -> np.ndarray:
            rows = np.array(of.get("pairs", []), np.int64).reshape(-1, 4)
            return rows[:, [0, 2, 1, 3]]  # the file has body a, element a, body b, element b

        return {frame["frame"]: {kind: pairs(frame.get(kind, {})) for kind in ("missed", "spurious")}
                for item in document["detectors"] if item["detector"] == detector
                for frame in item["frames"]}

    def disagreements(self) -> list[dict[str, Any]]:
        """The first wrong answers of each row: scene, frame, detector, level, kind, and the pair.

        `first` and `second`: body, triangle and its vertices, (3, 3); of other levels cell and its
        nodes, or vertex and its position; absent where the cases are not beside the results.
        """

        def part(of: dict) -> dict:
            numbers = np.vectorize(float.fromhex, otypes=[float])
            return {key: numbers(value) if isinstance(value, list) else value
                    for key, value in of.items() if not key.endswith("_decimal")}

        out = []
        for item in self.data["disagreements"]:
            case, item = self.file.parent / item["case"], dict(item)
            if case.is_file():
                document = json.loads(case.read_text(encoding="utf-8"))
                item.update({key: part(document[key]) for key in ("first", "second")})
            out.append(item)
        return out

    def plot(self) -> str:
        """Speed against error as an SVG picture; empty where nothing was timed."""
        return self._results.plot()

    def report(self, file: Union[str, os.PathLike]) -> None:
        """Writes the report: one HTML file with tables, plots and scenes in 3D."""
        with tempfile.TemporaryDirectory() as folder:
            _call(["report", self.file, "--format", "html", "--out", folder])
            shutil.copyfile(os.path.join(folder, "report.html"), file)

    def _repr_html_(self) -> str:
        def line(cells: Sequence[Any], tag: str) -> str:
            texts = ["" if c is None else f"{c:.3g}" if isinstance(c, float) else str(c) for c in cells]
            return "<tr>" + "".join(f"<{tag}>{html.escape(text)}</{tag}>" for text in texts) + "</tr>"

        lines = [line(["scene", "detector", "status", "level", "missed", "spurious", "ms a frame"], "th")]
        for row in self.rows():
            level = row["finest_level"]
            counts = [row.get(f"{level}_{kind}") for kind in ("missed", "spurious")]
            lines.append(line([row["scene"], row["detector"], row["status"], level, *counts,
                               row["playback_frame_ms"]], "td"))
        return "<table>" + "".join(lines) + "</table>" + self.plot()

    def __repr__(self) -> str:
        counts = f"{len(self.data['scenes'])} scenes, {len(self.data['runs'])} rows"
        return f"<contactcheck.Results {self.file}: {counts}>"


def run(
    scene: Union[str, os.PathLike, dict, Scene],
    detectors: Sequence[Any] = (),
    frames: Optional[int] = None,
    processes: int = 3,
    timing: bool = True,
    out: Union[str, os.PathLike, None] = None,
    quiet: Optional[bool] = None,
    options: Sequence[str] = (),
) -> Results:
    """Runs detectors on a scene and judges every answer, as `contactcheck run` does.

    >>> V, F = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]]), [[0, 1, 2]]
    >>> scene = Scene.from_frames([([V, V], F), ([V + 2, V], F)])
    >>> for row in run(scene, ["ffd-lazy", "fcl-aabb"], timing=False).rows():
    ...     print(row["detector"], row["status"], row["triangle_truth"], row["triangle_missed"])
    ffd-lazy ok 1 0
    fcl-aabb ok 1 0

    `scene`: a name of `contactcheck list`, a file, a dictionary of the scene format, or a Scene.
    `detectors`: names, and detectors of one's own: objects or classes with prepare(bodies),
    update(frame), query(question) and an attribute `declares`; none: the scene's own. Each is asked
    in a process of its own, forked from this one; its crash or hang is a row with status error. One
    that declares "unisolated" (reference/python/README.md), or for which no process can be had, is
    asked in a thread of this one, and its rows are never gated.
    `frames`: so many, in the same time. `processes`: timed passes; `timing=False` judges only.
    `out`: the folder of all files; None: one that is removed with the results. `quiet`: neither
    progress nor tables; by default where standard error is no terminal. `options`: of the command
    line, e.g. ["--memory-limit", "512"]: of a detector of one's own that counts what it has taken;
    ["--resume"] or ["--overwrite"] where `out` has scenes that an interrupted run has finished.

    Raises InputError for a bad argument or scene, in the words of the command line. Ctrl-C ends the
    run, and raises KeyboardInterrupt.
    """
    from . import Detector

    folder = pathlib.Path(tempfile.mkdtemp(prefix="contactcheck-") if out is None else out)
    if isinstance(detectors, str) or hasattr(detectors, "query"):
        detectors = [detectors]
    quiet = not (sys.stderr and sys.stderr.isatty()) if quiet is None else quiet
    own: list = []
    server = _serve.Server(own, _memory_limit(options))
    try:
        if isinstance(scene, dict):
            scene = Scene(scene)
        if isinstance(scene, Scene):
            scene = scene.save(folder / "scene")
        words: list = ["run", scene, "--out", folder, "--processes", processes, *options]
        words += ["--frames", frames] if frames is not None else []
        words += [] if timing else ["--no-timing"]
        words += ["--quiet"] if quiet else []
        for detector in detectors:
            if isinstance(detector, (str, Detector)):
                words += ["--detector", str(getattr(detector, "name", detector))]
                continue
            for name in ("prepare", "update", "query", "declares"):
                if not hasattr(detector, name) and not (name == "update" and hasattr(detector, "update_step")):
                    raise InputError(f"detectors: {detector!r} has no {name}; a name is wanted, or "
                                     "an object with prepare, update, query and declares")
            words += ["--detector-cmd", server.command(len(own))]
            own.append(detector)
        file = folder / "results.json"
        before = file.stat() if file.exists() else None
        _call(words, server, quiet)
        # A run replaces the file: what an earlier one has left must not pass for its results.
        if before is not None and os.path.samestat(before, file.stat()):
            raise Unavailable(f"the run has left no results in {folder}")
        results = Results(file)
    except BaseException:
        if out is None:
            shutil.rmtree(folder, ignore_errors=True)
        raise
    finally:
        server.close()
    if out is None:
        weakref.finalize(results, shutil.rmtree, folder, ignore_errors=True)
    return results


def gate(
    results: Union[Results, str, os.PathLike],
    policy: Union[str, os.PathLike, dict, None] = None,
    baseline: Union[Results, str, os.PathLike, None] = None,
    advisory_times: bool = False,
) -> Verdict:
    """Checks results against the rules of a policy, as `contactcheck gate` does.

    `policy`: a file, a name or the dictionary of a policy (fixtures/policies/README.md); with a
    baseline by default `unchanged`. `baseline`: earlier results. `advisory_times`: rules on times are
    in `text`, but only the other rules decide.

    >>> V, F = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]]), [[0, 1, 2]]
    >>> results = run(Scene.from_frames([([V], F), ([V], F)]), "ffd-lazy", timing=False)
    >>> gate(results, baseline=results).passed
    True
    """

    def path(of: Any) -> Any:
        return of.file if isinstance(of, Results) else of

    with tempfile.TemporaryDirectory() as folder:
        if isinstance(policy, dict):
            description, policy = policy, pathlib.Path(folder) / "policy.json"
            policy.write_text(json.dumps(description), encoding="utf-8")
        words = ["gate", path(results)]
        words += ["--policy", policy] if policy is not None else []
        words += ["--baseline", path(baseline)] if baseline is not None else []
        words += ["--advisory-times"] if advisory_times else []
        junit = pathlib.Path(folder) / "gate.xml"
        called = _call([*words, "--junit", junit])
        failures = []
        for case in xml.parse(junit).iter("testcase"):
            for failure in [*case.iter("failure"), *case.iter("error")]:
                failures.append({"rule": case.get("classname"), "row": case.get("name"),
                                 "reason": failure.get("message")})
    return Verdict(called.returncode == 0, failures, called.stdout)


class Check(NamedTuple):
    """What check() answers, in the words of `contactcheck check --json-lines`."""

    clean: bool  #: no frame, and no step, has a contact that is not allowed
    frames: list  #: dictionaries: frame, file, contacts, self; of frames that are not clean
    steps: list  #: dictionaries: step, paths, contacts; of steps with contacts, allowed or not
    summary: dict  #: bad_frames, first, not_judged, between, ...


def check(
    bodies: Sequence[Any],
    between: bool = False,
    allow: Union[str, Sequence[str]] = (),
    weld: bool = False,
    out: Union[str, os.PathLike, None] = None,
    resume: bool = False,
    overwrite: bool = False,
) -> Check:
    """Which frames of a simulation have contacts, as `contactcheck check` says; exact.

    `bodies`: files as on the command line (numbered meshes, a mesh and its point cache, a
    recording), or pairs (frames, F), frames being (f, n, 3) or a list of (n, 3); one frame alone
    is a body at rest. `between`: contact between frames, too, on straight paths from each frame to
    the next. `allow`: "contact", "self", "depth=METRES", "impact". `weld`: vertices at one place in
    the first frame are one. `out`: the folder of a page and tables; None: none is kept. `resume`
    and `overwrite`: as of the command, of files in a folder of one's own.

    >>> V, F = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]]), [[0, 1, 2]]
    >>> found = check([([V + [0, 0, 1], V - [0, 0, 3]], F), ([V], F)], between=True)
    >>> found.clean, found.frames, found.steps[0]["contacts"][0]["first"]["time"]["lower"] <= 0.25
    (False, [], True)
    """
    allowed = [allow] if isinstance(allow, str) else list(allow)
    words: list = ["check", "--json-lines"] + ["--between"] * between + ["--weld"] * weld
    words += ["--resume"] * resume + ["--overwrite"] * overwrite
    for word in allowed:
        words += ["--allow", word]
    bodies = [bodies] if isinstance(bodies, (str, os.PathLike)) else list(bodies)
    with tempfile.TemporaryDirectory(prefix="contactcheck-") as folder:
        words += ["--out", os.path.join(folder, "out") if out is None else os.path.abspath(out)]
        files = [os.path.abspath(body) for body in bodies if isinstance(body, (str, os.PathLike))]
        if not files:
            files = _frame_files(bodies, pathlib.Path(folder))
        elif len(files) != len(bodies):
            raise InputError("bodies: files or pairs (frames, F), not both")
        called = _call([*words, "--", *files], folder=folder)
    events = [json.loads(line) for line in called.stdout.splitlines()]

    def named(name: str) -> list:
        return [{key: value for key, value in event.items() if key != "event"}
                for event in events if event["event"] == name]

    summary = named("end")[0]
    if out is None:
        summary.pop("out", None)
    return Check(called.returncode == 0, named("frame"), named("step"), summary)


def _frame_files(bodies: Sequence[Any], folder: pathlib.Path) -> list[str]:
    """Writes a numbered mesh for each body and frame; their names within the folder."""
    names = []
    for i, (frames, F) in enumerate(bodies):
        if len(frames) == 0:
            raise InputError(f"bodies[{i}] has no frame")
        shape = _binding.Shape(frames[0], F, f"V of bodies[{i}], frame 0", f"F of bodies[{i}]")
        for f, V in enumerate(frames):
            name = f"body{i}.ply" if len(frames) == 1 else f"body{i}_{f:06d}.ply"
            write_ply(folder / name, shape.positions(V, f"V of bodies[{i}], frame {f}"), shape.faces)
            names.append(name)
    return names
