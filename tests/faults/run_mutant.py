#!/usr/bin/env python3
"""Rebuilds one unit of core with a mistake in it, links it with the judge and expects a verdict.

A mutant is a patch against the repository's root (tests/faults/mutants/*.patch). Its first line is
a comment that says what is wrong; a line "# unit: core/lazy/kernels.cpp" names the unit to rebuild
where the patch changes a header. A patch without a change is the harness itself: nothing may be
found then.

    run_mutant.py --build build/release tests/faults/mutants/hash-truncates.patch
    run_mutant.py --build build/release --all

Exit codes: 0 caught (or clean, without a change), 1 survived, 2 the patch does not apply,
3 it does not compile or link.
"""

import argparse
import concurrent.futures
import json
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

CAUGHT, SURVIVED, DOES_NOT_APPLY, DOES_NOT_COMPILE = range(4)
OUTCOMES = {CAUGHT: "caught by", SURVIVED: "survived", DOES_NOT_APPLY: "does not apply",
            DOES_NOT_COMPILE: "does not compile"}
ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
MUTANTS = ROOT / "tests" / "faults" / "mutants"
JUDGE_SECONDS = 200
CLEAN = "nothing, as it should be"
NOT_CLEAN = "the unchanged program does not pass: "
# Quick to compile; the same bits as at any other level, as nothing is contracted.
FLAGS = ["-O1", "-w"]
# Minutes for every instruction set of the platform; its baseline is enough here.
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


def compile_unit(build, unit, scratch):
    arguments, directory = compile_arguments(build, unit)
    patched = scratch / unit
    source = patched if patched.is_file() else ROOT / unit
    target = scratch / (unit.replace("/", "-") + ".o")
    flags = FLAGS + (SLOW_UNIT_FLAGS if unit == SLOW_UNIT else [])
    command = [arguments[0], f"-I{scratch}", *arguments[1:], *flags, "-c", str(source), "-o",
               str(target)]
    done = run(command, cwd=directory)
    if done.returncode != 0:
        raise Failure(DOES_NOT_COMPILE, done.stderr)
    return target


def link_command(build):
    """The build's own command line for the judge."""
    done = run([ninja_of(build), "-C", str(build), "-t", "commands", "mutant_judge"])
    lines = done.stdout.strip().splitlines()
    if done.returncode != 0 or not lines:
        raise Failure(DOES_NOT_COMPILE, "the build has no command for mutant_judge: " + done.stderr)
    words = shlex.split(lines[-1])
    # ninja's rule is ": && command && :".
    return words[words.index("&&") + 1:len(words) - 1 - words[::-1].index("&&")]


def ninja_of(build):
    cache = (build / "CMakeCache.txt").read_text(encoding="utf-8")
    return re.search(r"^CMAKE_MAKE_PROGRAM:\w+=(.*)$", cache, re.MULTILINE).group(1)


def link_judge(build, objects, scratch):
    """The judge, with the new objects before the libraries that hold the old ones: a library's
    member stays out when nothing of it is missing any more."""
    words = link_command(build)
    program = scratch / "judge"
    words[words.index("-o") + 1] = str(program)
    first = next(i for i, word in enumerate(words) if word.endswith(".o"))
    words[first:first] = [str(path) for path in objects]
    done = run(words, cwd=build)
    if done.returncode != 0:
        raise Failure(DOES_NOT_COMPILE, done.stderr)
    return program


def judge(program):
    """The faults that were found, one line each. The judge ends by itself; the limit is for one
    that does not even come to its own alarm."""
    try:
        done = run([str(program)], timeout=JUDGE_SECONDS)
    except subprocess.TimeoutExpired:
        return ["no answer: the judge does not end"]
    faults = [line[len("FAULT "):] for line in done.stdout.splitlines() if line.startswith("FAULT")]
    if done.returncode not in (0, 1) or (done.returncode == 1) != bool(faults):
        raise Failure(DOES_NOT_COMPILE, f"the judge ended with {done.returncode}: {done.stderr}")
    return faults


def verdict(path, build):
    """(exit code, what the mutant does, what caught it)"""
    try:
        mutant = Mutant(path)
    except Failure as failure:
        return failure.code, path.stem, str(failure)
    try:
        with tempfile.TemporaryDirectory(prefix="mutant-") as folder:
            scratch = pathlib.Path(folder)
            patched_copy(mutant, scratch)
            objects = [compile_unit(build, unit, scratch) for unit in mutant.units]
            faults = judge(link_judge(build, objects, scratch))
    except Failure as failure:
        return failure.code, mutant.about, str(failure)
    if not mutant.files:
        return (SURVIVED, mutant.about, NOT_CLEAN + faults[0]) if faults else (
            CAUGHT, mutant.about, CLEAN)
    if not faults:
        return SURVIVED, mutant.about, "no check of the judge finds it"
    return CAUGHT, mutant.about, faults[0]


def run_all(build, jobs):
    """A table of all mutants; the largest exit code."""
    paths = sorted(MUTANTS.glob("*.patch"))
    worst = SURVIVED if not paths else CAUGHT
    print("| mutant | what is wrong | caught by |\n|---|---|---|")
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        for path, found in zip(paths, pool.map(lambda p: verdict(p, build), paths)):
            code, about, by = found
            worst = max(worst, code)
            first_line = by.strip().splitlines()[0] if by.strip() else ""
            print(f"| {path.stem} | {about} | {first_line} |", flush=True)
    return worst


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("patch", nargs="?", type=pathlib.Path, help="the mutant")
    parser.add_argument("--build", type=pathlib.Path, required=True,
                        help="a build folder (Ninja) with mutant_judge in it")
    parser.add_argument("--all", action="store_true", help="a table of all mutants")
    parser.add_argument("--jobs", type=int, default=2, help="at a time, with --all (default: 2)")
    options = parser.parse_args()
    build = options.build.resolve()
    if options.all == (options.patch is not None):
        parser.error("give one patch, or --all")
    if options.all:
        return run_all(build, options.jobs)
    code, about, by = verdict(options.patch.resolve(), build)
    print(f"{options.patch.stem}: {about}\n{OUTCOMES[code]}: {by}")
    return code


if __name__ == "__main__":
    sys.exit(main())
