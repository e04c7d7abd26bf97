"""Whole runs: own detectors in processes of their own, results, the gate."""

import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import textwrap
import threading
import time
import types

import contactcheck
import numpy as np
import pytest

V = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)
F = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
APPROACH = contactcheck.Scene.from_frames(
    [([V] * 4, F), ([V + [x, 0.1, 0.1] for x in (3, 2, 0.7, 0.2)], F)], id="approach"
)


class Exact:
    """Answers with the oracle of the module."""

    declares = {"id": "exact", "levels": ["body", "triangle"], "questions": ["triangles", "body"]}

    def prepare(self, bodies):
        self.faces = [body.faces for body in bodies]

    def update(self, frame):
        self.frame = frame

    def query(self, question):
        pairs = []
        for b in range(len(self.faces)):
            for a in range(b):
                V = self.frame.vertices
                found = contactcheck.contacts(V[a], self.faces[a].astype(int), V[b], self.faces[b].astype(int))
                pairs += [(a, b, s, t) for s, t in found]
        return {"triangles": pairs}


class Forgetful(Exact):
    declares = dict(Exact.declares, id="forgetful")

    def query(self, question):
        return {"triangles": super().query(question)["triangles"][1:]}


class Dying(Exact):
    declares = dict(Exact.declares, id="dying")

    def query(self, question):
        if self.frame.index == 2:
            os.kill(os.getpid(), signal.SIGSEGV)
        return super().query(question)


class Raising(Exact):
    declares = dict(Exact.declares, id="raising")

    def update(self, frame):
        if frame.index == 2:
            raise KeyError("no such luck")
        super().update(frame)


class Hanging(Exact):
    declares = dict(Exact.declares, id="hanging")

    def update(self, frame):
        if frame.index == 2:
            time.sleep(1000)
        super().update(frame)


class Refusing(Exact):
    declares = dict(Exact.declares, id="refusing")

    def update(self, frame):
        raise contactcheck.RefusedInput("not today")


class Printing(Exact):
    declares = dict(Exact.declares, id="printing")

    def query(self, question):
        print("found something")
        return super().query(question)


class Odd(Exact):
    declares = dict(Exact.declares, id="odd")

    def query(self, question):
        return {"triangels": []}


class Mapping(Exact):
    """Maps the vertices itself, from the nodes: the order of operations is core/deform/mapping.h's."""

    declares = dict(Exact.declares, id="mapping", needs=["nodes", "vertices"])

    def prepare(self, bodies):
        super().prepare(bodies)
        self.lattices = [body.lattice for body in bodies]
        for body in bodies:
            begin, cells = body.lattice.label_begin, body.lattice.label_cells
            assert len(begin) == len(body.faces) + 1 and begin[-1] == len(cells)
            assert (np.diff(begin.astype(int)) > 0).all() and cells.max() < len(body.lattice.cell_nodes)
            assert np.array_equal(self.mapped(body.lattice, body.lattice.nodes).round(9), body.vertices.round(9))

    @staticmethod
    def mapped(lattice, nodes):
        corners = nodes[lattice.cell_nodes[lattice.home_cell]]  # vertex, corner, axis
        for k in range(3):
            w = lattice.local[:, k, None, None]
            corners = corners[:, 0::2] * (1 - w) + corners[:, 1::2] * w
        return corners[:, 0]

    def update(self, frame):
        for lattice, nodes, vertices in zip(self.lattices, frame.nodes, frame.vertices):
            assert self.mapped(lattice, nodes).tobytes() == vertices.tobytes()
        super().update(frame)


class Measuring(Exact):
    """Answers as a detector of the module does, depths and normals too."""

    declares = dict(Exact.declares, id="measuring", questions=["triangles", "body", "contacts"], depth_kind="convex-pair")

    def prepare(self, bodies):
        self.detector = contactcheck.Detector("fcl-aabb")
        self.detector.prepare([(body.vertices, body.faces) for body in bodies])

    def update(self, frame):
        self.detector.update(frame.vertices)

    def query(self, question):
        return self.detector.query(question)


class Wide(Exact):
    declares = dict(Exact.declares, id="wide")

    def query(self, question):
        return {"triangles": np.array([[2**32, 1, 0, 0]])}


class Leaving(Exact):
    """Starts a process that would outlive it."""

    declares = dict(Exact.declares, id="leaving", summary="leaves something", version="7")

    def prepare(self, bodies):
        super().prepare(bodies)
        subprocess.Popen(["sleep", "1234.5"])


class Attached(Exact):
    """Lives in this process alone, as a context of a GPU does."""

    declares = dict(Exact.declares, id="attached", unisolated=True)

    def update(self, frame):
        assert os.getpid() == HERE
        super().update(frame)


class Greedy(Exact):
    declares = dict(Exact.declares, id="greedy")

    def query(self, question):
        if self.frame.index == 2:
            self.all = np.ones((150 << 20) // 8)
            time.sleep(1)
        return super().query(question)


HERE = os.getpid()
NOTHING_MISSED = {
    "schema": "contactcheck-policy/1", "id": "mine", "title": "mine",
    "rules": [{"rule": "nothing is missed", "scenes": ["*"], "detectors": ["*"], "measure": "missed",
               "level": "triangle", "at_most": 0}],
}


def row(results, detector):
    (found,) = [r for r in results.rows() if r["detector"] == detector]
    return found


def test_a_detector_on_bunny_touch_has_the_contacts_of_the_command_line(bunny_run):
    results = contactcheck.run("bunny-touch", [Exact(), "ffd-lazy"], frames=12, timing=False)
    hashes = {r["detector"]: r["contact_hash"] for r in contactcheck.Results(bunny_run / "results.json").rows()}
    assert row(results, "exact")["contact_hash"] == hashes["ffd-lazy"] == row(results, "ffd-lazy")["contact_hash"]
    assert row(results, "exact")["triangle_missed"] == row(results, "exact")["triangle_spurious"] == 0
    assert row(results, "exact")["triangle_truth"] > 100


def test_a_class_of_its_own_for_every_process():
    results = contactcheck.run(APPROACH, [Exact, "fcl-aabb"], processes=2)
    assert row(results, "exact")["status"] == "ok" and row(results, "exact")["passes"] == 2
    assert row(results, "exact")["playback_frame_ms"] > 0
    assert "<svg" in results.plot() and "exact" in results.plot()
    assert "<table>" in results._repr_html_() and "<svg" in results._repr_html_()


def test_bodies_come_with_their_lattices():
    results = contactcheck.run("bunny-touch", [Mapping()], frames=4, timing=False)
    assert row(results, "mapping")["status"] == "ok", row(results, "mapping")["message"]


def test_depths_and_normals_reach_the_judge(bunny_run):
    results = contactcheck.run("bunny-touch", [Measuring(), "fcl-aabb"], frames=12, timing=False)
    measuring, fcl = row(results, "measuring"), row(results, "fcl-aabb")
    assert measuring["status"] == "ok", measuring["message"]
    assert fcl["depth_error_max_m"] > 0
    for column in ("contact_hash", "depth_error_max_m", "normal_error_max_deg"):
        assert measuring[column] == fcl[column], column


def test_wrong_answers_are_found_with_their_triangles():
    results = contactcheck.run(APPROACH, [Forgetful()], timing=False)
    assert row(results, "forgetful")["triangle_missed"] == 2
    assert results.per_frame("forgetful")["missed"].tolist() == [0, 0, 1, 1]
    missed = results.contacts("forgetful")
    assert sorted(missed) == [2, 3] and missed[2]["missed"].shape == (1, 4) and len(missed[2]["spurious"]) == 0
    a, b, s, t = missed[2]["missed"][0]
    first = [d for d in results.disagreements() if d["level"] == "triangle"][0]
    assert (first["first"]["body"], first["first"]["triangle"]) == (f"body{a}", s)
    expected = [V, V + [0.7, 0.1, 0.1]]
    assert np.array_equal(first["second"]["vertices"], expected[b][F[t]])


@pytest.mark.parametrize("detector, status, message", [
    (Dying, "error", "signal 11"), (Raising, "error", "KeyError: 'no such luck'"), (Hanging, "error", "no progress"),
    (Refusing, "refused", "not today"), (Odd, "error", "unknown lists: triangels"),
    (Wide, "error", '"triangles" must be (k, 4) indices'),
])
def test_a_failing_detector_is_a_row(detector, status, message):
    results = contactcheck.run(APPROACH, [detector(), Exact()], timing=False, options=["--call-limit", "2"])
    failed = row(results, detector.declares["id"])
    assert failed["status"] == status and message in failed["message"]
    assert row(results, "exact")["status"] == "ok"


def test_a_detector_is_held_to_the_memory_limit():
    results = contactcheck.run(APPROACH, [Greedy()], timing=False, options=["--memory-limit=100"])
    assert "took more than 100 MiB (memory limit)" in row(results, "greedy")["message"]
    results = contactcheck.run(APPROACH, [Greedy()], timing=False, options=["--memory-limit", "300"])
    assert row(results, "greedy")["status"] == "ok", row(results, "greedy")["message"]


@pytest.mark.parametrize("levels", [("body",), ("body", "triangle"), ("body", "containment")])
def test_a_detector_of_solids_is_judged_by_containment(levels):
    class Solids(Exact):
        declares = {"id": "solids", "levels": ["body"], "questions": ["body"], "body": "solid"}

        def query(self, question):
            return {"bodies": [(0, 1)]}

    V, F = np.array([[0, 0, 0], [9, 0, 0], [0, 9, 0], [0, 0, 9]], float), np.array(
        [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    scene = contactcheck.Scene.from_frames([([V], F), ([1 + V / 90], F)], levels=levels)
    row, = contactcheck.run(scene, [Solids()], timing=False).rows()
    assert (row["body_missed"], row["body_spurious"]) == (0, 0)


def test_memory_of_the_interpreter_is_not_the_detectors():
    many = np.ones((300 << 20) // 8)

    class Forking(Exact):
        declares = dict(Exact.declares, id="forking")

        def prepare(self, bodies):
            super().prepare(bodies)
            self.child = os.fork()
            if self.child == 0:
                time.sleep(60)
            time.sleep(0.5)

    class Copying(Exact):
        declares = dict(Exact.declares, id="copying")

        def prepare(self, bodies):
            super().prepare(bodies)
            many.__iadd__(1)
            time.sleep(1)

    results = contactcheck.run(APPROACH, [Forking, Copying], timing=False, options=["--memory-limit=200"])
    assert row(results, "forking")["status"] == "ok", row(results, "forking")["message"]
    assert "took more than 200 MiB (memory limit)" in row(results, "copying")["message"]


@pytest.mark.parametrize("detector", [Attached(), Attached])
def test_a_detector_may_stay_in_this_process_and_is_never_gated(detector):
    results = contactcheck.run(APPROACH, [detector, Exact(), "fcl-aabb"], processes=2)
    attached, exact = row(results, "attached"), row(results, "exact")
    assert attached["status"] == "ok", attached["message"]
    assert attached["contact_hash"] == exact["contact_hash"] and attached["passes"] == 2
    assert [plugin.get("unisolated") for plugin in results.data["plugins"]] == [True, None]
    (run,) = [run for run in results.data["runs"] if run["detector"] == "attached"]
    assert "unisolated" in str(run["notes"])
    verdict = contactcheck.gate(results, NOTHING_MISSED)
    assert verdict.passed and re.search("cannot judge.*\n.*attached.*\n?.*unisolated", verdict.text), verdict.text


def test_where_no_process_can_be_had_a_thread_is_asked(monkeypatch):
    def no_fork():
        raise BlockingIOError(11, "Resource temporarily unavailable")

    monkeypatch.setattr(os, "fork", no_fork)
    results = contactcheck.run(APPROACH, [Forgetful()], timing=False)
    assert row(results, "forgetful")["triangle_missed"] == 2
    assert results.data["plugins"][0]["unisolated"] is True
    assert contactcheck.gate(results, NOTHING_MISSED).passed


def test_where_neither_process_nor_thread_can_be_had_nothing_stays(monkeypatch):
    def none(*_):
        raise BlockingIOError(11, "Resource temporarily unavailable")

    def no_thread(_):
        raise RuntimeError("can't start new thread")

    before = sorted(os.listdir("/proc/self/fd"))
    monkeypatch.setattr(os, "fork", none)
    monkeypatch.setattr("threading.Thread.start", no_thread)
    with pytest.raises(contactcheck.InputError, match="neither process nor thread"):
        contactcheck.run(APPROACH, [Exact()], timing=False)
    assert sorted(os.listdir("/proc/self/fd")) == before


def test_no_fork_keeps_the_end_of_another_detector():
    class Late(Exact):
        declares = types.MappingProxyType(dict(Exact.declares, id="late", unisolated=True))

        def query(self, question):
            child = os.fork()
            if child == 0:
                time.sleep(30)
                os._exit(0)
            raise ValueError("too late")

    results = contactcheck.run(APPROACH, [Late()], timing=False, options=["--call-limit", "20"])
    assert "ValueError: too late" in row(results, "late")["message"]


def test_an_interrupt_during_a_fork_leaves_no_process(monkeypatch):
    fork, children = os.fork, []

    def interrupted():
        child = fork()
        if child != 0:
            children.append(child)
            os.kill(os.getpid(), signal.SIGINT)
        return child

    before = sorted(os.listdir("/proc/self/fd"))
    monkeypatch.setattr(os, "fork", interrupted)
    over = threading.Event()
    threading.Thread(target=over.wait).start()  # may take the signal, too
    with pytest.raises(KeyboardInterrupt):
        contactcheck.run(APPROACH, [Exact()], timing=False)
    over.set()
    assert sorted(os.listdir("/proc/self/fd")) == before
    with pytest.raises(ChildProcessError):
        os.waitpid(children[0], 0)


def test_a_process_that_is_not_to_be_had_later_is_an_error(monkeypatch):
    fork, forks = os.fork, []

    def fork_once():
        forks.append(1)
        if len(forks) > 1:
            raise BlockingIOError(11, "Resource temporarily unavailable")
        return fork()

    monkeypatch.setattr(os, "fork", fork_once)
    results = contactcheck.run(APPROACH, [Exact()], timing=False)
    assert "no process can be had" in row(results, "exact")["message"]
    assert "unisolated" not in results.data["plugins"][0]


@pytest.mark.parametrize("failing, message", [
    (Raising, "KeyError: 'no such luck'"), (Hanging, "no progress"), (Odd, "unknown lists: triangels")])
def test_a_detector_that_fails_in_this_process_is_a_row(failing, message):
    class InHere(failing):
        declares = dict(Exact.declares, id="in-here", unisolated=True)

    detector = InHere()
    results = contactcheck.run(APPROACH, [detector, Exact()], timing=False, options=["--call-limit", "2"])
    failed = row(results, "in-here")
    assert failed["status"] == "error" and message in failed["message"]
    assert row(results, "exact")["status"] == "ok"


def test_no_command_is_proposed_that_needs_this_interpreter(capfd):
    contactcheck.run(APPROACH, [Forgetful()], timing=False, quiet=False)
    printed = capfd.readouterr().out
    assert "forgetful" in printed and "next:" not in printed
    relay = [sys.executable, pathlib.Path(contactcheck.__file__).parent / "_relay.py", "0"]
    alone = subprocess.run(relay, capture_output=True, text=True, env={})
    assert alone.returncode == 1 and "contactcheck.run()" in alone.stderr


def test_what_a_detector_prints_is_a_note():
    results = contactcheck.run(APPROACH, [Printing()], timing=False)
    assert row(results, "printing")["status"] == "ok"
    assert "found something" in str(results.data["runs"][0]["notes"])


def test_what_a_detector_has_started_ends_with_it():
    results = contactcheck.run(APPROACH, Leaving(), timing=False)
    assert row(results, "leaving")["status"] == "ok"
    assert results.data["plugins"][0]["version"] == "7"
    assert not any("sleep 1234.5" in command for command in commands())


def test_detectors_of_the_program_by_name_or_as_they_are():
    for detectors in ("ffd-lazy", contactcheck.Detector("ffd-lazy"), ("ffd-lazy",)):
        assert [r["detector"] for r in contactcheck.run(APPROACH, detectors, timing=False).rows()] == ["ffd-lazy"]


def test_a_run_may_print_much():
    results = contactcheck.run(APPROACH, Exact(), timing=False, quiet=True,
                               options=["--json-lines", *["--detector", "fcl-aabb", "--detector", "embree"]])
    assert row(results, "exact")["status"] == "ok"


def test_a_folder_may_be_used_again(tmp_path):
    touching = contactcheck.Scene.from_frames([([V] * 5, F), ([V + 0.1] * 5, F)])
    apart = contactcheck.Scene.from_frames([([V] * 2, F), ([V + 9] * 2, F)])
    for scene, expected in ((touching, 5), (apart, 0)):
        results = contactcheck.run(scene, ["fcl-aabb"], timing=False, out=tmp_path)
        assert row(results, "fcl-aabb")["contact_frames"] == expected


@pytest.mark.parametrize("program, error", [("/bin/false", RuntimeError), ("/no/such", contactcheck.Unavailable)])
def test_a_program_that_fails_leaves_no_results(program, error, tmp_path, monkeypatch):
    contactcheck.run(APPROACH, ["fcl-aabb"], timing=False, out=tmp_path)
    # What /bin/false ends with is the code of a check that fails, too.
    monkeypatch.setenv("CONTACTCHECK_PROGRAM", program)
    with pytest.raises((error, contactcheck.InputError)):
        contactcheck.run(APPROACH, ["fcl-aabb"], timing=False, out=tmp_path)


def test_temporary_folders_go_with_their_results(tmp_path, monkeypatch):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    results = contactcheck.run(APPROACH, ["fcl-aabb"], timing=False)
    assert len(list(tmp_path.iterdir())) == 1
    del results
    with pytest.raises(contactcheck.InputError):
        contactcheck.run(APPROACH, ["no-such"], timing=False)
    assert list(tmp_path.iterdir()) == []


def test_a_scene_may_be_a_dictionary(tmp_path, monkeypatch):
    def scene(mesh):
        bodies = [{"name": name, "mesh": mesh, "motion": {"position": [[0, [x, 0, 0]], [1, [0, 0, 0]]]}}
                  for name, x in (("a", np.float64(1.5)), ("b", 0))]
        return {"id": "mine", "frames": 3, "duration": 1, "levels": ["body", "triangle"], "bodies": bodies}

    results = contactcheck.run(scene({"shape": "box"}), ["fcl-aabb"], timing=False)
    assert row(results, "fcl-aabb")["contact_frames"] == 2
    monkeypatch.chdir(tmp_path)  # paths are relative to it, and not to the folder of the results
    with pytest.raises(contactcheck.InputError, match=re.escape(str(tmp_path / "no.ply"))):
        contactcheck.run(scene({"file": "no.ply"}), ["fcl-aabb"], timing=False)


def test_scenes_of_arrays_keep_every_bit(tmp_path):
    random = np.random.default_rng(5)
    frames = [V + random.normal(size=3) * 1e-9 for _ in range(3)]
    file = contactcheck.Scene.from_frames([(frames, F)], levels=["body", "self"]).save(tmp_path)
    assert json.loads(file.read_text())["bodies"][0]["recording"]
    for f, expected in enumerate(frames):
        data = (tmp_path / f"body0_{f:06d}.ply").read_bytes().split(b"end_header\n")[1]
        assert data[:96] == expected.tobytes()


def test_the_gate_says_why(bunny_run):
    results = contactcheck.Results(bunny_run / "results.json")
    verdict = contactcheck.gate(results, policy=NOTHING_MISSED)
    assert verdict.passed and verdict.failures == [] and "gate: green" in verdict.text
    broken = contactcheck.run(APPROACH, [Forgetful()], timing=False)
    verdict = contactcheck.gate(broken, policy=NOTHING_MISSED)
    assert not verdict.passed
    assert verdict.failures[0]["rule"] == "nothing is missed" and "forgetful" in verdict.failures[0]["row"]
    assert contactcheck.gate(results, baseline=results).passed
    with pytest.raises(contactcheck.InputError, match="rules"):
        contactcheck.gate(results, {"schema": "contactcheck-policy/1", "id": "mine", "title": "mine"})


def test_advisory_times_do_not_decide(bunny_run):
    results = contactcheck.Results(bunny_run / "results.json")  # it has no timings
    on_times = {"rule": "fast", "scenes": ["*"], "detectors": ["ffd-lazy"], "measure": "speedup",
                "question": "triangles", "reference": "fcl-aabb", "at_least": 1, "unjudged": "fail"}
    policy = {**NOTHING_MISSED, "rules": [*NOTHING_MISSED["rules"], on_times]}
    assert not contactcheck.gate(results, policy).passed
    verdict = contactcheck.gate(results, policy, advisory_times=True)
    assert verdict.passed and "fast: bunny-touch" in verdict.text
    broken = contactcheck.run(APPROACH, [Forgetful()], timing=False)
    assert not contactcheck.gate(broken, NOTHING_MISSED, advisory_times=True).passed


def test_the_report_is_written(bunny_run, tmp_path):
    contactcheck.Results(bunny_run / "results.json").report(tmp_path / "report.html")
    page = (tmp_path / "report.html").read_text()
    assert page.startswith("<!doctype html>") and len(page) > 200_000


@pytest.mark.parametrize("call, sentence", [
    (lambda: contactcheck.run("no-such-scene"), '"no-such-scene" is no suite, scene'),
    (lambda: contactcheck.run("bunny-touch", ["no-such"]), "no-such"),
    (lambda: contactcheck.run("bunny-touch", [3]), "detectors: 3 has no prepare"),
    (lambda: contactcheck.run("bunny-touch", ["fcl-aabb"], frames=0), "--frames"),
    (lambda: contactcheck.run(APPROACH, [type("Bad", (Exact,), {"declares": {"levels": ["faces"]}})]), "faces"),
    (lambda: contactcheck.Scene.from_frames([([], F)]), "bodies[0] has no frame"),
    (lambda: contactcheck.Scene.from_frames([([V], F), ([V, V], F)]), "bodies[1] has 2 frames, bodies[0] 1"),
    (lambda: contactcheck.run("no-such-scene", quiet=False), '"no-such-scene" is no suite, scene'),
    (lambda: contactcheck.Scene.from_frames([([V, V * np.nan], F)]), "V of bodies[0], frame 1[0, 0] is nan"),
    (lambda: contactcheck.Results("no/such.json"), "no/such.json"),
    (lambda: contactcheck.gate("no/such.json", policy="default"), "no/such.json"),
])
def test_bad_arguments_are_refused_in_the_words_of_the_command_line(call, sentence):
    with pytest.raises(contactcheck.InputError) as caught:
        call()
    assert sentence in str(caught.value)


@pytest.mark.parametrize("how, code", [(signal.SIGINT, 42), (signal.SIGKILL, -signal.SIGKILL)])
def test_an_interpreter_that_ends_leaves_no_process_behind(how, code, tmp_path):
    script = tmp_path / "script.py"
    script.write_text(textwrap.dedent("""
        import contactcheck, pathlib, sys, time
        class Slow:
            declares = {"id": "slow", "levels": ["body"], "questions": ["body"]}
            def prepare(self, bodies): pathlib.Path(sys.argv[1]).touch()
            def update(self, frame): time.sleep(100)
            def query(self, question): return {}
        try:
            contactcheck.run("bunny-touch", [Slow()], timing=False, out=sys.argv[2])
        except KeyboardInterrupt:
            sys.exit(42)
    """))
    started, out = tmp_path / "started", tmp_path / "out"
    process = subprocess.Popen([sys.executable, "-B", script, started, out], start_new_session=True,
                               stderr=subprocess.DEVNULL)
    while not started.exists():
        assert process.poll() is None
        time.sleep(0.02)
    process.send_signal(how)
    assert process.wait(30) == code
    deadline = time.monotonic() + 10
    while any(str(tmp_path) in command for command in commands()):
        assert time.monotonic() < deadline, "a process was left behind"
        time.sleep(0.05)


def commands():
    for entry in pathlib.Path("/proc").iterdir():
        if entry.name.isdigit():
            try:
                yield (entry / "cmdline").read_bytes().replace(b"\0", b" ").decode(errors="replace")
            except OSError:
                pass


SHEET = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], float), [[0, 1, 2]]


def falling(*heights):
    return [V * 0.1 + [0.2, 0.2, height] for height in heights], F


def test_check_finds_what_passes_between_frames():
    bodies = [falling(2, 1, -1, -2), ([SHEET[0]], SHEET[1])]
    assert contactcheck.check(bodies) == (True, [], [], {
        "bad_frames": 0, "first": None, "not_judged": [
            {"body": "body1", "level": "containment", "reason": "open (frame 0, edge of vertices 0 and 1)"}], "exit_code": 0})
    found = contactcheck.check(bodies, between=True)
    assert (found.clean, found.frames, [step["step"] for step in found.steps]) == (False, [], [1])
    (contact,) = found.steps[0]["contacts"]
    assert (contact["bodies"], contact["start"], contact["end"]) == (["body0", "body1"], "apart", "apart")
    assert contact["first"]["time"]["lower"] <= 0.5 <= contact["first"]["time"]["upper"]
    assert found.summary["between"]["with_impacts"] == 1
    allowed = contactcheck.check(bodies, between=True, allow="impact")
    assert allowed.clean and allowed.steps[0]["contacts"][0]["allowed"]


def test_check_finds_contacts_of_frames_and_of_a_body_with_itself():
    folded = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0.2, 0.2, -1], [0.2, 0.2, 1], [2, 2, 0]], float)
    found = contactcheck.check([([folded + 9, folded + 9], [[0, 1, 2], [3, 4, 5]]), falling(1, 1)])
    assert [frame["frame"] for frame in found.frames] == [0, 1] and found.frames[0]["self"][0]["body"] == "body0"
    assert contactcheck.check([([folded], [[0, 1, 2], [3, 4, 5]]), falling(5, 4)], allow=["self"]).clean


def test_check_takes_files_and_leaves_a_page(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    pathlib.Path("ball_0.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    pathlib.Path("wall.obj").write_text("v 0.2 0.2 -1\nv 0.2 0.2 1\nv 3 3 0\nf 1 2 3\n")
    found = contactcheck.check(["ball_0.obj", pathlib.Path("wall.obj")], out="page")
    assert not found.clean and found.frames[0]["contacts"][0]["bodies"] == ["ball_0", "wall"]
    assert (tmp_path / "page" / "check.csv").is_file() and found.summary["out"] == str(tmp_path / "page")


@pytest.mark.parametrize("arguments,sentence", (
    ({"bodies": [falling(1)], "between": True}, "here is one frame"),
    ({"bodies": [([], F)]}, r"bodies\[0\] has no frame"),
    ({"bodies": [falling(1), "wall.obj"]}, "not both"),
    ({"bodies": [falling(1, 2)], "allow": "everything"}, "is not one of contact, self"),
    ({"bodies": [([V, V[:2]], F)]}, "frame 1"),
))
def test_check_refuses_with_one_sentence(arguments, sentence):
    with pytest.raises(contactcheck.InputError, match=sentence):
        contactcheck.check(**arguments)


class Steps:
    """Answers about steps alone."""

    declares = {"id": "steps", "levels": ["impact"], "questions": ["impacts"]}

    def prepare(self, bodies):
        pass

    def update_step(self, start, end):
        self.ends = start, end

    def query(self, question):
        return {"impacts": [(0, 1)], "impact_times": [0.5]}


def test_class_of_steps_needs_no_update():
    scene = contactcheck.Scene.from_frames([falling(1, -1), ([SHEET[0]] * 2, SHEET[1])], levels=["impact"])
    (row,) = contactcheck.run(scene, Steps(), timing=False).rows()
    assert (row["status"], row["impact_truth"], row["impact_missed"]) == ("ok", 1, 0)


# A class may be another one under the same name.
def test_rows_of_a_class_are_never_taken_over(tmp_path):
    def resumed(detector):
        contactcheck.run(APPROACH, detector, out=tmp_path, timing=False, options=["--resume"])
        return json.loads((tmp_path / "results.json").read_text(encoding="utf-8"))["resumed"]

    assert resumed("ffd-lazy") == []
    assert len(resumed("ffd-lazy")) == 1
    assert resumed(Exact()) == []
    assert resumed(Exact()) == []
