#!/usr/bin/env python3
"""Rebuilds one unit of core with a mistake in it, links it with the judge and expects a verdict.

A mutant is a patch (tests/faults/mutants/*.patch) as mutant_build.py describes it. A patch without
a change is the harness itself: nothing may be found then.

    run_mutant.py --build build/release tests/faults/mutants/hash-truncates.patch
    run_mutant.py --build build/release --all

Exit codes: 0 caught (or clean, without a change), 1 survived, 2 the patch does not apply,
3 it does not compile or link.
"""

import argparse
import concurrent.futures
import pathlib
import subprocess
import sys
import tempfile

from mutant_build import (CAUGHT, DOES_NOT_APPLY, DOES_NOT_COMPILE, ROOT, SURVIVED, Failure, Mutant,
                          build_program, run)

OUTCOMES = {CAUGHT: "caught by", SURVIVED: "survived", DOES_NOT_APPLY: "does not apply",
            DOES_NOT_COMPILE: "does not compile"}
MUTANTS = ROOT / "tests" / "faults" / "mutants"
JUDGE_SECONDS = 200
CLEAN = "nothing, as it should be"
NOT_CLEAN = "the unchanged program does not pass: "


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
            build_program(mutant, build, "mutant_judge", scratch / "judge", scratch, quick=True)
            faults = judge(scratch / "judge")
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
