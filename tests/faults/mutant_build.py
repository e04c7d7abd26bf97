"""Builds a program with a patch in it, next to a Ninja build that stays as it is.

The files that a patch changes are copied and patched, and the copy is searched before the sources.
Every unit of the program that depends on a changed file is compiled again, with the build's own
command line, and linked before the libraries that contain the unchanged units. What depends on what
is what the compiler recorded when the build compiled it.

The patch is against the repository's root. Its first line is a comment that says what it does.
"""

import collections
import concurrent.futures
import os
import pathlib
import platform
import re
import shlex
import subprocess
import threading
import time

CAUGHT, SURVIVED, DOES_NOT_APPLY, DOES_NOT_COMPILE = range(4)
ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
# Quick to compile. Every optimisation level and every instruction set gives the same bits, as
# nothing is contracted. Kernels for all instruction sets take minutes; without any, Highway's vectors
# on x86 have one lane, and a fault in the last lanes would not show.
QUICK_FLAGS = ["-O1", "-w", "-DHWY_COMPILE_ONLY_STATIC"]
if platform.machine() in ("x86_64", "AMD64"):
    QUICK_FLAGS.append("-march=x86-64-v2")


class Failure(Exception):
    """Why there is no verdict, with the exit code that says so."""

    def __init__(self, code, text):
        super().__init__(text)
        self.code = code


class OutOfTime(Exception):
    """The deadline has passed."""


class Workers:
    """Runs commands, at most `jobs` at a time, and begins none after the deadline."""

    def __init__(self, jobs):
        self.jobs = jobs
        self.deadline = None  # of time.monotonic()
        self._free = threading.Semaphore(jobs)

    def run(self, command, **options):
        with self._free:
            if self.deadline is not None and time.monotonic() > self.deadline:
                raise OutOfTime
            return subprocess.run(command, capture_output=True, text=True, check=False, **options)

    def map(self, function, items):
        """The results, in the order of the items."""
        with concurrent.futures.ThreadPoolExecutor(self.jobs) as pool:
            yield from pool.map(function, items)


class Mutant:
    def __init__(self, path):
        self.path = path
        self.name = path.stem
        try:
            self.text = path.read_text(encoding="utf-8")
        except (OSError, UnicodeDecodeError) as error:
            raise Failure(DOES_NOT_APPLY, f"{path}: cannot be read: {error}") from error
        first_line = self.text.partition("\n")[0]
        if not first_line.startswith("# "):
            raise Failure(DOES_NOT_APPLY, f"{path}: the first line does not say what is wrong")
        self.about = first_line[len("# "):]
        second_line = self.text.split("\n", 2)[1]
        # Of mutants of the whole product: the command of product_verdict.py that is tried first.
        self.caught_by = (second_line[len("# Caught-by: "):].strip()
                          if second_line.startswith("# Caught-by: ") else "")
        self.files = sorted(set(re.findall(r"^\+\+\+ b/(\S+)", self.text, re.MULTILINE)))
        if not self.files:
            raise Failure(DOES_NOT_APPLY, f"{path}: no file is changed")


Unit = collections.namedtuple("Unit", "object source command")


class Build:
    """A program of a build folder: its units, what they depend on and how it is linked."""

    def __init__(self, folder, target):
        self.folder, self.target = folder, target
        cache = (folder / "CMakeCache.txt").read_text(encoding="utf-8")
        self.source = re.search(r"^CMAKE_HOME_DIRECTORY:\w+=(.*)$", cache, re.MULTILINE).group(1)
        self._ninja = re.search(r"^CMAKE_MAKE_PROGRAM:\w+=(.*)$", cache, re.MULTILINE).group(1)
        commands = [shlex.split(line) for line in self._tool("commands", target).splitlines()]
        compiled = [words for words in commands if "-c" in words and "-o" in words]
        units = [Unit(words[words.index("-o") + 1], words[words.index("-c") + 1], words)
                 for words in compiled]
        self.units = [unit for unit in units if unit.object.endswith(".o")]
        # Ninja's rule for a program is ": && command && :".
        last = commands[-1]
        self.link = last[last.index("&&") + 1:len(last) - 1 - last[::-1].index("&&")]
        self._dependencies = self._recorded_dependencies()

    def _tool(self, *arguments):
        done = subprocess.run([self._ninja, "-C", str(self.folder), "-t", *arguments],
                              capture_output=True, text=True, check=False)
        if done.returncode != 0 or not done.stdout.strip():
            raise Failure(DOES_NOT_COMPILE, f"{self.folder} has no {self.target}: {done.stderr}")
        return done.stdout

    def name_of(self, path):
        """Relative to the sources, where the file is one of them."""
        return os.path.relpath(os.path.normpath(self.folder / path), self.source)

    def _recorded_dependencies(self):
        found, names = {}, set()
        # "OBJECT: #deps 152, deps mtime 17954195 (VALID)", then a line for every file, indented.
        for line in self._tool("deps").splitlines():
            if line.startswith("    "):
                if not line.startswith("    /usr/"):
                    names.add(self.name_of(line.strip()))
            elif line:
                names = found.setdefault(line.partition(": #deps")[0], set())
        return found

    def users(self, files):
        """The units that depend on one of the files."""
        return [unit for unit in self.units
                if not self._dependencies.get(unit.object, set()).isdisjoint(files)]


def patched_copy(mutant, scratch):
    """The changed files under `scratch`, which is to be searched before the sources."""
    for name in mutant.files:
        source, copy = ROOT / name, scratch / name
        if not source.is_file():
            raise Failure(DOES_NOT_APPLY, f"there is no {name}")
        copy.parent.mkdir(parents=True, exist_ok=True)
        copy.write_bytes(source.read_bytes())
    done = subprocess.run(
        ["patch", "-p1", "--fuzz=0", "--forward", "--batch", "-i", str(mutant.path)],
        cwd=scratch, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise Failure(DOES_NOT_APPLY, done.stdout + done.stderr)


def patched_unity(unit, mutant, build, scratch):
    """A copy of a unity file that names the patched sources, or None where the unit is none: CMake
    writes unity files into the build folder, and they name their contents by path."""
    if "/Unity/unity_" not in unit.source:
        return None
    text = (build.folder / unit.source).read_text(encoding="utf-8")
    for name in mutant.files:
        text = text.replace(f'#include "{build.source}/{name}"', f'#include "{scratch / name}"')
    copy = scratch / (unit.object.replace("/", "-") + ".cxx")
    copy.write_text(text, encoding="utf-8")
    return copy


def unpatched(make_rule, mutant, build):
    """The changed files that a compiler read as they were, by the make rule that it wrote."""
    read = shlex.split(make_rule.partition(":")[2].replace("\\\n", " "))
    return sorted(set(mutant.files).intersection(build.name_of(path) for path in read))


def compile_unit(unit, mutant, build, scratch, flags, workers):
    """The unit's new object. @pre patched_copy()"""
    target = scratch / unit.object.replace("/", "-")
    make_rule = target.with_suffix(".d")
    words = list(unit.command)
    words[words.index("-o") + 1] = str(target)
    words[words.index("-MF") + 1] = str(make_rule)
    patched = (patched_unity(unit, mutant, build, scratch)
               or scratch / build.name_of(unit.source))
    if patched.is_file():
        words[words.index("-c") + 1] = str(patched)
    words.insert(words.index(f"-I{build.source}"), f"-I{scratch}")
    done = workers.run(words + flags, cwd=build.folder)
    if done.returncode != 0:
        raise Failure(DOES_NOT_COMPILE, done.stderr)
    # A fault that only some of its users see is another one. Precompiled headers name their contents
    # by path.
    missed = unpatched(make_rule.read_text(encoding="utf-8"), mutant, build)
    if missed:
        raise Failure(DOES_NOT_COMPILE, f"{unit.source} reads {missed[0]} without the patch")
    return target


def link_program(build, objects, program, workers):
    """`objects`: new by old. A library's member stays out when nothing of it is missing any more,
    so new objects come before the libraries."""
    words = [objects.get(word, word) for word in build.link]
    words[words.index("-o") + 1] = str(program)
    of_libraries = [new for old, new in objects.items() if old not in build.link]
    first = next(i for i, word in enumerate(words) if word.endswith(".o"))
    words[first:first] = of_libraries
    done = workers.run(words, cwd=build.folder)
    if done.returncode != 0:
        raise Failure(DOES_NOT_COMPILE, done.stderr)


def build_program(mutant, build, program, scratch, workers, flags=()):
    """Writes the program with the patch in it. `flags` come after the build's own."""
    patched_copy(mutant, scratch)
    units = build.users(mutant.files)
    if not units:
        raise Failure(DOES_NOT_COMPILE,
                      f"no unit of {build.target} depends on {' or '.join(mutant.files)}")

    def compiled(unit):
        return str(compile_unit(unit, mutant, build, scratch, list(flags), workers))

    objects = dict(zip([unit.object for unit in units], workers.map(compiled, units)))
    link_program(build, objects, program, workers)
