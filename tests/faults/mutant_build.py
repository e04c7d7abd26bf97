"""Builds a program with a change of few files in it, next to a build that stays as it is.

Only the units that a patch changes are compiled, with the build's own command lines, and linked
before the libraries that hold the unchanged ones. The patch is against the repository's root. Its
first line is a comment that says what it does; a line "# unit: core/lazy/kernels.cpp" names the
unit to rebuild where the patch changes a header.
"""

import json
import pathlib
import re
import shlex
import subprocess

CAUGHT, SURVIVED, DOES_NOT_APPLY, DOES_NOT_COMPILE = range(4)
ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
# Quick to compile; the same bits as at any other level, as nothing is contracted.
QUICK_FLAGS = ["-O1", "-w"]
# Minutes for every instruction set of the platform; its baseline is enough for bits.
SLOW_UNIT, SLOW_UNIT_FLAGS = "core/lazy/kernels.cpp", ["-DHWY_COMPILE_ONLY_STATIC"]


class Failure(Exception):
    """Why there is no verdict, with the exit code that says so."""

    def __init__(self, code, text):
        super().__init__(text)
        self.code = code


class Mutant:
    def __init__(self, path):
        self.path = path
        self.name = path.stem
        self.text = path.read_text(encoding="utf-8")
        comments = [line[2:] for line in self.text.splitlines() if line.startswith("# ")]
        if not comments or comments[0].startswith("unit:"):
            raise Failure(DOES_NOT_APPLY, f"{path}: the first line does not say what is wrong")
        self.about = comments[0]
        self.files = re.findall(r"^\+\+\+ b/(\S+)", self.text, re.MULTILINE)
        units = [line[len("unit:"):].strip() for line in comments if line.startswith("unit:")]
        self.units = units or [name for name in self.files if name.endswith(".cpp")]
        if not self.units:
            raise Failure(DOES_NOT_APPLY, f"{path}: no unit to rebuild")


def run(command, **options):
    return subprocess.run(command, capture_output=True, text=True, check=False, **options)


def patched_copy(mutant, scratch):
    """The changed files under `scratch`, which is to stand before the sources."""
    for name in mutant.files:
        copy = scratch / name
        copy.parent.mkdir(parents=True, exist_ok=True)
        source = ROOT / name
        if not source.is_file():
            raise Failure(DOES_NOT_APPLY, f"there is no {name}")
        copy.write_bytes(source.read_bytes())
    if not mutant.files:
        return
    done = run(["patch", "-p1", "--fuzz=0", "--forward", "--batch", "-i", str(mutant.path)],
               cwd=scratch)
    if done.returncode != 0:
        raise Failure(DOES_NOT_APPLY, done.stdout + done.stderr)


def compile_arguments(build, unit):
    """How the build compiles the unit, without its input and output."""
    with open(build / "compile_commands.json", encoding="utf-8") as file:
        entries = {pathlib.Path(e["directory"], e["file"]).resolve(): e for e in json.load(file)}
    entry = entries.get((ROOT / unit).resolve())
    if entry is None:
        raise Failure(DOES_NOT_COMPILE, f"{build} does not compile {unit}")
    words = shlex.split(entry["command"])
    keep, skip = [], False
    for word in words:
        if not skip and word not in ("-o", "-c"):
            keep.append(word)
        skip = word in ("-o", "-c")
    return keep, entry["directory"]


def flags_of(unit, quick):
    if not quick:
        return []
    return QUICK_FLAGS + (SLOW_UNIT_FLAGS if unit == SLOW_UNIT else [])


def compile_unit(build, unit, scratch, quick):
    arguments, directory = compile_arguments(build, unit)
    patched = scratch / unit
    source = patched if patched.is_file() else ROOT / unit
    target = scratch / (unit.replace("/", "-") + ".o")
    command = [arguments[0], f"-I{scratch}", *arguments[1:], *flags_of(unit, quick), "-c",
               str(source), "-o", str(target)]
    done = run(command, cwd=directory)
    if done.returncode != 0:
        raise Failure(DOES_NOT_COMPILE, done.stderr)
    return target


def link_command(build, target):
    """The build's own command line for a program."""
    done = run([ninja_of(build), "-C", str(build), "-t", "commands", target])
    lines = done.stdout.strip().splitlines()
    if done.returncode != 0 or not lines:
        raise Failure(DOES_NOT_COMPILE, f"the build has no command for {target}: {done.stderr}")
    words = shlex.split(lines[-1])
    # ninja's rule is ": && command && :".
    return words[words.index("&&") + 1:len(words) - 1 - words[::-1].index("&&")]


def ninja_of(build):
    cache = (build / "CMakeCache.txt").read_text(encoding="utf-8")
    return re.search(r"^CMAKE_MAKE_PROGRAM:\w+=(.*)$", cache, re.MULTILINE).group(1)


def link_program(build, target, objects, program):
    """The target, with the new objects before the libraries that hold the old ones: a library's
    member stays out when nothing of it is missing any more."""
    words = link_command(build, target)
    words[words.index("-o") + 1] = str(program)
    first = next(i for i, word in enumerate(words) if word.endswith(".o"))
    words[first:first] = [str(path) for path in objects]
    done = run(words, cwd=build)
    if done.returncode != 0:
        raise Failure(DOES_NOT_COMPILE, done.stderr)


def build_program(mutant, build, target, program, scratch, quick):
    """`quick`: compiled for its answers; else as the build does, for its times."""
    patched_copy(mutant, scratch)
    objects = [compile_unit(build, unit, scratch, quick) for unit in mutant.units]
    link_program(build, target, objects, program)
