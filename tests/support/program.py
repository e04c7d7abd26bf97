"""What tests of the program's commands share: they run it as a child process and read what it says and
writes. CONTACTCHECK_PROGRAM names the program.
"""

import dataclasses
import functools
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
FIXTURES = ROOT / "fixtures"
EXAMPLE_RESULTS = ROOT / "tests" / "reference" / "schema" / "example_results.json"
PROGRAM = os.environ["CONTACTCHECK_PROGRAM"]
INTERRUPTS = (signal.SIGINT, signal.SIGQUIT, signal.SIGTERM, signal.SIGHUP)
LONGEST_RUN = 300  # seconds until a program counts as hanging

sys.path.append(str(ROOT / "tests" / "reference" / "schema"))
import validate_results  # noqa: E402


@dataclasses.dataclass(frozen=True)
class Outcome:
    """Of a program that has ended. `exit_code` is 128 + signal where it died of one."""

    exit_code: int
    out: str
    err: str


class RunningProgram:
    """A program that runs beside the test. Its standard input is empty. As a context manager it is
    killed at the end, unless it has ended by itself."""

    def __init__(self, program, words, *, cwd=None, env=None):
        self._out, self._err = tempfile.TemporaryFile(), tempfile.TemporaryFile()
        self.process = subprocess.Popen(
            [os.fspath(program), *map(os.fspath, words)], cwd=cwd, stdin=subprocess.DEVNULL,
            stdout=self._out, stderr=self._err, env={**os.environ, **(env or {})},
            preexec_fn=self._hear_interrupts)

    @staticmethod
    def _hear_interrupts():
        # A test that was started in the background may ignore interrupts; its programs must not.
        for number in INTERRUPTS:
            signal.signal(number, signal.SIG_DFL)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()
        self._out.close()
        self._err.close()

    def has_ended(self):
        return self.process.poll() is not None

    def wait_for(self, condition):
        """Whether `condition` came true before the program ended or counted as hanging."""
        end = time.monotonic() + LONGEST_RUN
        while not self.has_ended() and time.monotonic() < end:
            if condition():
                return True
            time.sleep(0.002)
        return condition()

    def send(self, number):
        self.process.send_signal(number)

    def outcome(self):
        """Waits for the end."""
        code = self.process.wait(LONGEST_RUN)
        texts = []
        for stream in (self._out, self._err):
            stream.seek(0)
            texts.append(stream.read().decode("utf-8", "surrogateescape"))
        return Outcome(code if code >= 0 else 128 - code, *texts)


def run_program(program, words, *, cwd=None, env=None):
    """Runs `program` to its end; `env` is added to this process's environment."""
    with RunningProgram(program, words, cwd=cwd, env=env) as running:
        return running.outcome()


def contactcheck(*words, cwd=None, env=None):
    """The Outcome of the contactcheck of this build. A word is a string, a path or bytes."""
    return run_program(PROGRAM, words, cwd=cwd, env=env)


def successful(*words, cwd=None, env=None):
    """As `contactcheck`; a test in which it does not exit with 0 has failed."""
    outcome = contactcheck(*words, cwd=cwd, env=env)
    assert outcome.exit_code == 0, outcome.err
    return outcome


@functools.cache
def _closed_schema():
    return validate_results.closed(validate_results.load(validate_results.SCHEMA_FILE))


def valid_results(file):
    """The parsed results file, which must satisfy the schema and have no field that it leaves out."""
    results = validate_results.load(file)
    errors = validate_results.errors_of(results, _closed_schema())
    assert not errors, errors[:5]
    return results


@functools.cache
def has_html_report():
    """Whether this build of the program can make report.html (it needs npm)."""
    with tempfile.TemporaryDirectory() as out:
        successful("report", EXAMPLE_RESULTS, "--out", out)
        return "report.html" in names_in(out)


def run_files(*further):
    """Names of what a run leaves in its folder; "plots" is among `further` where a detector errs or is
    timed."""
    page = ["report.html"] if has_html_report() else []
    return {"cases", "contacts", "recordings", "report.csv", "report.md", "results.json", *page, *further}


def place_at(document, pointer):
    """The container in a JSON document, and the key or index in it, that a JSON pointer such as
    "/runs/2/message" names; "-" is a new item at the end of a list."""
    *steps, last = [step.replace("~1", "/").replace("~0", "~") for step in pointer.split("/")[1:]]
    place = document
    for step in steps:
        place = place[int(step) if isinstance(place, list) else step]
    if not isinstance(place, list):
        return place, last
    if last == "-":
        place.append(None)
        last = -1
    return place, int(last)


def names_in(folder):
    return {entry.name for entry in pathlib.Path(folder).iterdir()}


def tree(folder):
    """Sizes of all files below `folder` by path, None for what is no file."""
    return {str(path.relative_to(folder)): path.stat().st_size if path.is_file() else None
            for path in pathlib.Path(folder).rglob("*")}


def refused(*words, named, folder, env=None):
    """The sentence with which the program refuses these words: exit code 2, one line on standard
    error that has every piece of `named`, nothing on standard output, nothing written below `folder`."""
    before = tree(folder)
    outcome = contactcheck(*words, cwd=folder, env=env)
    assert outcome.exit_code == 2, outcome.err
    assert outcome.err.count("\n") == 1 and outcome.err.startswith("contactcheck: "), outcome.err
    assert outcome.out == ""
    for piece in named:
        assert piece in outcome.err, f"\"{piece}\" is not in: {outcome.err}"
    assert tree(folder) == before, "nothing may be written"
    return outcome.err


def tiny_scene(name="tiny", frames=5):
    """The text of a scene small enough to be run many times: two boxes in lattices of 3 x 3 x 3 cells;
    one comes, enters the other and leaves again."""
    scene = json.loads((ROOT / "tests" / "support" / "tiny_scene.json").read_text(encoding="utf-8"))
    return json.dumps({**scene, "id": name, "frames": frames})
