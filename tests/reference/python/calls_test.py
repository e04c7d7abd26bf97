"""Threads, memory, the interpreter's lock and the floating-point environment."""

import ctypes
import gc
import os
import pathlib
import platform
import resource
import subprocess
import sys
import threading
import time

import contactcheck
import numpy as np
import pytest


def grid(n, height=0.0):
    """A sheet of 2 n n triangles over the unit square."""
    x = np.linspace(0, 1, n + 1)
    V = np.array([[a, b, height + 0.1 * np.sin(9 * a) * b] for b in x for a in x])
    corner = np.array([i + (n + 1) * j for j in range(n) for i in range(n)])
    lower = np.column_stack([corner, corner + 1, corner + n + 2])
    return V, np.vstack([lower, np.column_stack([corner, corner + n + 2, corner + n + 1])])


def test_threads_get_the_answers_of_one_thread():
    Va, F = grid(20)
    Vb = Va[:, [0, 2, 1]] + [0, 0.02, 0]
    expected = contactcheck.contacts(Va, F, Vb, F)
    detector = contactcheck.Detector()
    detector.prepare([(Va, F), (Vb, F)])
    detector.update([Va, Vb])
    assert len(expected) > 20
    wrong = []

    def ask():
        for _ in range(10):
            if not np.array_equal(contactcheck.contacts(Va, F, Vb, F), expected):
                wrong.append("contacts")
            if not np.array_equal(detector.query()["triangles"][:, 2:], expected):
                wrong.append("one detector of all threads")
            own = contactcheck.Detector()
            own.prepare([(Va, F), (Vb, F)])
            own.update([Va, Vb])
            if not np.array_equal(own.query()["triangles"][:, 2:], expected):
                wrong.append("a detector of its own")

    threads = [threading.Thread(target=ask) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert wrong == []


def test_long_calls_release_the_lock_of_the_interpreter():
    V, F = grid(150)
    seen = []

    def count():
        while not done.is_set():
            seen.append(0)
            time.sleep(0.001)

    done = threading.Event()
    other = threading.Thread(target=count)
    other.start()
    before = len(seen)
    contactcheck.self_contacts(V, F)
    during = len(seen) - before
    done.set()
    other.join()
    assert during > 5


def test_memory_stays_flat():
    V, F = grid(4)
    lattice = contactcheck.Lattice(V, F, cells=(2, 2, 1))
    detector = contactcheck.Detector()
    detector.prepare([lattice, (V, F)])

    def work():
        contactcheck.contacts(V, F, V, F)
        contactcheck.distance(V, F, V + 3, F)
        contactcheck.check_mesh(V, F)
        contactcheck.self_contacts(V, F)
        detector.prepare([lattice, (V, F)])
        detector.update([lattice.nodes, V])
        detector.query()
        shared = contactcheck.Detector(threads=2)  # a new one has threads to itself
        shared.prepare([(V, F), (V, F)])
        shared.update([V, V])
        shared.query()
        try:
            contactcheck.inside(V, V, F)
        except contactcheck.InputError:
            pass

    def resident():
        gc.collect()
        pages = int(pathlib.Path("/proc/self/statm").read_text().split()[1])
        return pages * resource.getpagesize()

    for _ in range(500):
        work()
    before = resident()
    for _ in range(10_000):
        work()
    assert resident() - before < 4 << 20


def test_a_detector_leaves_subnormal_numbers_alone():
    V, F = grid(3)
    for name in contactcheck.detectors():
        detector = contactcheck.Detector(name)
        try:
            detector.prepare([(V, F), (V + 2, F)])
            question = detector.declares["questions"][0]
            if question == "impacts":
                detector.update_step([V, V + 2], [V, V])
            else:
                detector.update([V, V + 2])
            detector.query(question)
        except contactcheck.RefusedInput:
            pass
        assert np.float64(5e-324) * np.float64(1.0) == 5e-324, name


MXCSR = 28  # its place in fenv_t
MODES = {"flush-to-zero": 0x9FC0, "upward": 0x5F80, "downward": 0x3F80}


@pytest.mark.skipif(platform.machine() != "x86_64", reason="knows this processor's fenv_t alone")
@pytest.mark.parametrize("mode", MODES)
def test_answers_do_not_depend_on_the_thread_s_floating_point_environment(mode):
    libm = ctypes.CDLL("libm.so.6")
    V, F = grid(6)
    far, tiny = V + 1 / 3, V * 1e-309
    above = tiny + [0, 0, 5e-324]
    small = V * 1e-305
    moved = [contactcheck.Lattice(X, F, cells=(3, 3, 1)).nodes * 1.1 for X in (small, far)]
    detector = contactcheck.Detector("ffd-lazy")
    detector.prepare([(tiny, F), (above, F)])

    def answers():
        lattices = [contactcheck.Lattice(X, F, cells=(3, 3, 1)) for X in (small, far)]
        detector.update([tiny, above])
        return [contactcheck.contacts(tiny, F, above, F), contactcheck.self_contacts(tiny, F).pairs,
                *contactcheck.distance(far, F, V, F), *contactcheck.distance(tiny, F, above, F),
                detector.query()["triangles"], lattices[1].fit(far), lattices[0].nodes, lattices[1].nodes,
                *(lattice.deform(nodes) for lattice, nodes in zip(lattices, moved)),
                np.frombuffer(str(contactcheck.check_mesh(tiny, F)).encode(), np.uint8)]

    expected = answers()
    before = ctypes.create_string_buffer(64)
    libm.fegetenv(before)
    changed = ctypes.create_string_buffer(before.raw, 64)
    changed[MXCSR:MXCSR + 4] = MODES[mode].to_bytes(4, "little")
    libm.fesetenv(changed)
    try:
        found = answers()
    finally:
        libm.fesetenv(before)
    assert [np.asarray(x).tobytes() for x in found] == [np.asarray(x).tobytes() for x in expected]


def test_it_imports_numpy_and_the_standard_library_alone():
    code = ("import sys; before = set(sys.modules); import numpy; import contactcheck; "
            "print([m for m in set(sys.modules) - before if '.' not in m and m not in sys.stdlib_module_names "
            "and not m.startswith('_')])")
    out = subprocess.run([sys.executable, "-B", "-c", code], check=True, capture_output=True, text=True)
    assert set(eval(out.stdout)) <= {"numpy", "cython_runtime", "contactcheck"}


def test_the_version_is_the_program_s():
    version = subprocess.run([os.environ["CONTACTCHECK_PROGRAM"], "--version"], check=True,
                             capture_output=True, text=True).stdout
    assert contactcheck.__version__ in version
