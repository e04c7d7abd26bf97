"""The verdict on a mutant: its program is built and judges itself (mutant_judge.cpp).

Programs are built without unity files, in a build folder of their own, so that a changed header
changes all its users and nothing more is compiled. Precompiled headers hold no file of this
repository.
"""

import collections
import fcntl
import pathlib
import subprocess
import tempfile

from mutant_build import (CAUGHT, DOES_NOT_APPLY, DOES_NOT_COMPILE, QUICK_FLAGS, ROOT, SURVIVED,
                          Build, Failure, build_program)

WORDS = {CAUGHT: "caught", SURVIVED: "survived", DOES_NOT_APPLY: "does not apply",
         DOES_NOT_COMPILE: "does not compile"}
PROGRAM = "mutant_judge"
JUDGE_SECONDS = 1800
CONFIGURATION = ["-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                 f"-DCMAKE_CXX_FLAGS_RELEASE=-DNDEBUG {' '.join(QUICK_FLAGS)}",
                 "-DCONTACTCHECK_UNITY=OFF", "-DCONTACTCHECK_PCH=ON", "-DCONTACTCHECK_WEB=OFF",
                 "-DCONTACTCHECK_BENCH=OFF"]

# `by`: what caught it, or why it was not caught.
Verdict = collections.namedtuple("Verdict", "code by")


def unchanged_build(folder, jobs):
    """The judge without a patch, up to date, in the build folder."""
    folder.mkdir(parents=True, exist_ok=True)
    with open(folder / "lock", "w", encoding="utf-8") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        for command in (["cmake", "-S", str(ROOT), "-B", str(folder), *CONFIGURATION],
                        ["cmake", "--build", str(folder), "--target", PROGRAM, "-j", str(jobs)]):
            done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                  text=True, check=False)
            if done.returncode != 0:
                raise Failure(DOES_NOT_COMPILE, f"the unchanged program: {done.stdout}")
        build = Build(folder, PROGRAM)
    return build


def judge(program, workers):
    """The faults that were found, one line each. The judge ends by itself; the limit is for one
    that waits for ever and takes no time of the processor."""
    try:
        done = workers.run([str(program)], timeout=JUDGE_SECONDS)
    except subprocess.TimeoutExpired:
        return ["no answer: the judge does not end"]
    faults = [line[len("FAULT "):] for line in done.stdout.splitlines() if line.startswith("FAULT")]
    if done.returncode not in (0, 1) or (done.returncode == 1) != bool(faults):
        raise Failure(DOES_NOT_COMPILE, f"the judge ended with {done.returncode}: {done.stderr}")
    return faults


def require_clean(build, workers):
    """Faults of the unchanged program would be booked on every mutant."""
    faults = judge(build.folder / build.link[build.link.index("-o") + 1], workers)
    if faults:
        raise Failure(SURVIVED, f"the unchanged program does not pass: {faults[0]}")


def verdict(mutant, build, workers):
    try:
        with tempfile.TemporaryDirectory(prefix="mutant-") as folder:
            scratch = pathlib.Path(folder)
            build_program(mutant, build, scratch / PROGRAM, scratch, workers)
            faults = judge(scratch / PROGRAM, workers)
    except Failure as failure:
        return Verdict(failure.code, str(failure))
    if not faults:
        return Verdict(SURVIVED, "no check of the judge finds it")
    return Verdict(CAUGHT, faults[0])
