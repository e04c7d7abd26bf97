"""Standard output that cannot be written, and disks that are full: one sentence, and nothing
half-written stays. (Places that take no files are in unwritable_refusals.toml.)
"""

import contextlib
import ctypes
import json
import os

import pytest

import program

MNT_DETACH = 2


@pytest.fixture
def scene(tmp_path):
    file = tmp_path / "tiny.json"
    file.write_text(program.tiny_scene())
    return file


def test_run_into_a_long_name_is_refused(tmp_path, scene):
    program.refused("run", scene, "--out", tmp_path / ("n" * 300), named=["--out", "File name too long"],
                    folder=tmp_path)


def with_shell(line, *words, cwd):
    """The program under what a line of shell has set."""
    return program.run_program("/bin/sh", ["-c", line, program.PROGRAM, *words], cwd=cwd)


PRINTING = {
    "help": ["--help"],
    "version": ["--version"],
    "help_of_run": ["run", "--help"],
    "list": ["list"],
    "list_of_detectors": ["list", "--detectors"],
    "truth": ["truth", "hard-boxes-gap"],
    "diff": ["diff", program.EXAMPLE_RESULTS, program.EXAMPLE_RESULTS],
    "gate": ["gate", program.EXAMPLE_RESULTS, "--policy", program.FIXTURES / "policies" / "default.json"],
    "report": ["report", program.EXAMPLE_RESULTS, "--out", "report"],
    "export": ["export", "tiny.json", "--out", "export"],
}
REDIRECTIONS = {
    "full_device": ("> /dev/full", "No space left on device"),
    "closed_stream": (">&-", "Bad file descriptor"),
    "closed_streams": ("<&- >&-", "Bad file descriptor"),
}


@pytest.mark.usefixtures("scene")
@pytest.mark.parametrize("words", PRINTING.values(), ids=PRINTING)
@pytest.mark.parametrize("redirections, reason", REDIRECTIONS.values(), ids=REDIRECTIONS)
def test_output_that_does_not_arrive_is_no_success(tmp_path, redirections, reason, words):
    outcome = with_shell('exec "$0" "$@" ' + redirections, *words, cwd=tmp_path)
    assert outcome.exit_code == 2
    assert outcome.err == f"contactcheck: cannot write to standard output: {reason}\n"


def test_run_with_closed_streams_writes_its_files_all_the_same(tmp_path, scene):
    # No file that the run opens takes a closed stream's number: what is printed spoils none.
    words = ["run", scene, "--quiet", "--no-timing", "--detector", "fcl-aabb", "--out"]
    program.successful(*words, tmp_path / "open")
    outcome = with_shell('exec "$0" "$@" <&- >&-', *words, tmp_path / "closed", "--json-lines", cwd=tmp_path)
    assert outcome.exit_code == 2
    assert outcome.err.startswith("contactcheck: cannot write to standard output")
    for file in ("contacts/tiny.json", "recordings/tiny.ccr"):
        written = (tmp_path / "open" / file).read_bytes()
        assert written
        assert (tmp_path / "closed" / file).read_bytes() == written
    json.loads((tmp_path / "closed" / "results.json").read_text())


def state_of(out):
    """The bytes of the results, their cases and contacts, which must be JSON."""
    if not (out / "results.json").is_file():
        return b""
    state = (out / "results.json").read_bytes()
    if not state:
        return b""
    results = json.loads(state)
    for name in [*(d["case"] for d in results["disagreements"]), *(s["contacts"] for s in results["scenes"])]:
        data = (out / name).read_bytes()
        json.loads(data)
        state += data
    return state


def is_whole(outcome, out, before):
    """Whether the run has written everything. If not, a sentence must say why, and what was there
    before must still be there."""
    assert program.names_in(out) <= program.run_files("partial", "plots")
    assert not list(out.rglob("*.tmp"))
    if outcome.exit_code == 0:
        assert state_of(out)
        return True
    assert outcome.exit_code == 2, outcome.err
    assert outcome.err.startswith("contactcheck: ")
    assert "File too large" in outcome.err or "No space left" in outcome.err
    assert str(out) in outcome.err or "shared memory" in outcome.err
    # The last files of all are the reports: before them, new results may be complete.
    if state_of(out) != before:
        assert "/report." in outcome.err
    return False


RUN = ["run", "tiny.json", "--quiet", "--no-timing", "--detector", "ffd-aabb", "--out"]


@pytest.mark.usefixtures("scene")
def test_limit_of_a_file_leaves_all_or_nothing(tmp_path):
    # Files may not grow beyond some size: every file of a run in turn is the one that meets it.
    out = tmp_path / "out"
    whole = []
    for blocks in (2 ** i for i in range(13)):
        before = state_of(out)
        outcome = with_shell(f'ulimit -f {blocks}; exec "$0" "$@"', *RUN, out, cwd=tmp_path)
        whole.append(is_whole(outcome, out, before))
    assert whole.count(False) > 2
    assert whole.count(True) > 0


@contextlib.contextmanager
def small_disk(folder, kib):
    """A file system in memory of this many KiB; skips the test where mounting is not allowed."""
    folder.mkdir()
    libc = ctypes.CDLL(None, use_errno=True)
    if libc.mount(b"contactcheck", os.fsencode(folder), b"tmpfs", ctypes.c_ulong(0), b"size=%dk" % kib) != 0:
        pytest.skip("run as root, in a container with CAP_SYS_ADMIN: a small disk is mounted "
                    f"({os.strerror(ctypes.get_errno())})")
    try:
        yield
    finally:
        libc.umount2(os.fsencode(folder), MNT_DETACH)


@pytest.mark.usefixtures("scene")
def test_disk_that_is_too_small_leaves_all_or_nothing(tmp_path):
    whole = []
    for kib in (2 ** i for i in range(4, 13)):
        folder = tmp_path / f"disk{kib}"
        with small_disk(folder, kib):
            out = folder / "out"
            out.mkdir()
            whole.append(is_whole(program.contactcheck(*RUN, out, cwd=tmp_path), out, b""))
    assert whole.count(False) > 0
    assert whole.count(True) > 0
