#!/usr/bin/env python3
"""Builds the program with a seeded mistake; what judges it must catch the mistake.

A mutant is a patch, of one of two kinds:

    core      tests/faults/mutants/*.patch; the judge is a program made for them (mutant_judge.cpp)
    product   tests/faults/product/*.patch; the judge is what users run: commands of contactcheck,
              those of product_verdict.py, the one that the second line of the patch names first

Its verdict is kept (tests/faults/verdicts.json, product_verdicts.json). The verdict is stale when
the patch, a file that it changes or the judge has changed. The unchanged program is judged first: it
must pass.

    run_mutant.py tests/faults/mutants/hash-truncates.patch    judge one mutant (--write keeps it)
    run_mutant.py --stale --write      judge mutants with stale verdicts and keep the new ones
    run_mutant.py --stale --minutes 6  stop after 6 minutes
    run_mutant.py --all                judge all mutants
    run_mutant.py --list               list mutants with stale verdicts
    run_mutant.py --check              check patches and kept verdicts without building

Exit codes: 0 caught, 1 survived, 2 the patch does not apply or bad input, 3 the mutant does not
compile or link; the largest of all mutants. Stale verdicts alone are no failure.
"""

import argparse
import os
import pathlib
import subprocess
import sys
import time

import kept_verdicts
from mutant_build import (CAUGHT, DOES_NOT_COMPILE, QUICK_FLAGS, ROOT, SURVIVED, Build, Failure, Mutant,
                          OutOfTime, Workers)
from mutant_verdict import PROGRAM, WORDS, require_clean, unchanged_build, verdict
from python_tests import ProductJudge


OWN_BUILD = ROOT / "build" / "mutants"


def beside(folder, jobs):
    """The judge without a patch in a folder that is configured. What is compiled anew for a mutant
    need not be fast."""
    done = subprocess.run(["cmake", "--build", str(folder), "--target", PROGRAM, "-j", str(jobs)],
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    if done.returncode != 0:
        raise Failure(DOES_NOT_COMPILE, f"the unchanged program: {done.stdout}")
    build = Build(folder, PROGRAM)
    build.units = [unit._replace(command=[*unit.command, *QUICK_FLAGS]) for unit in build.units]
    return build


class CoreJudge:
    """The program made for the mutants of core, in a build folder of its own or a configured one."""

    def __init__(self, options, workers):
        if options.build.resolve() == OWN_BUILD:
            self.build = unchanged_build(OWN_BUILD, options.jobs)
        else:
            self.build = beside(options.build.resolve(), options.jobs)
        require_clean(self.build, workers)

    def verdict(self, mutant, workers):
        return verdict(mutant, self.build, workers)


JUDGES = {"core": CoreJudge, "product": ProductJudge}


class Session:
    """Judges mutants of one kind, one row of a table each."""

    def __init__(self, kind, options):
        self.begin = time.monotonic()
        self.workers = Workers(options.jobs)
        self.judge = JUDGES[kind.name](options, self.workers)
        print(f"unchanged program for mutants of {kind.name}: {self.seconds_since(self.begin)} s\n")
        print("| mutant | what is wrong | verdict | by | s |\n|---|---|---|---|---|", flush=True)

    @staticmethod
    def seconds_since(begin):
        return round(time.monotonic() - begin, 1)

    def end_after(self, minutes):
        """Commands that have begun by then run to their end."""
        self.workers.deadline = self.begin + 60 * minutes

    def verdicts(self, mutants):
        """(mutant, verdict) of those that there was time for."""
        for mutant, (found, seconds) in zip(mutants, self.workers.map(self._judge, mutants)):
            if found is None:
                continue
            first_line = (found.by.strip().splitlines() or [""])[0]
            print(f"| {mutant.name} | {mutant.about} | {WORDS[found.code]} | {first_line} "
                  f"| {seconds} |", flush=True)
            yield mutant, found

    def _judge(self, mutant):
        begin = time.monotonic()
        try:
            return self.judge.verdict(mutant, self.workers), self.seconds_since(begin)
        except OutOfTime:
            return None, 0


def run(mutants, options, kind=kept_verdicts.CORE):
    """Judges mutants, the first `at_least` of them whatever the time; their verdicts by name."""
    # Before anything is built: a file may change meanwhile.
    keys = kept_verdicts.keys_of(mutants)
    session = Session(kind, options)
    found = {}
    for some in (mutants[:options.at_least], mutants[options.at_least:]):
        for mutant, its in session.verdicts(some):
            found[mutant.name] = its
            if options.write:
                keep(mutant, keys[mutant.name], its, kind)
        if options.minutes is not None:
            session.end_after(options.minutes)
    for name, its in found.items():
        if its.code != CAUGHT:
            print(f"{name}: {WORDS[its.code]}: {its.by}", file=sys.stderr)
    print(f"\n{len(found)} mutants judged in {session.seconds_since(session.begin)} s, "
          f"{sum(its.code != CAUGHT for its in found.values())} not caught")
    return found


def keep(mutant, key, found, kind):
    if kept_verdicts.keys_of([mutant])[mutant.name] != key:
        print(f"{mutant.name}: not kept, as a file changed meanwhile", file=sys.stderr)
        return
    kept = kept_verdicts.read(kind) if kept_verdicts.file_of(kind).is_file() else {}
    kept_verdicts.write({**kept, mutant.name: (key, found)}, kind)


def worst(verdicts):
    return max((its.code for its in verdicts), default=CAUGHT)


def stale_and_held(kind):
    """The mutants whose verdicts are stale, in an order that contents shuffle, and the verdicts of
    all others by name."""
    mutants = kept_verdicts.mutants(kind)
    keys = kept_verdicts.keys_of(mutants)
    kept = kept_verdicts.read(kind) if kept_verdicts.file_of(kind).is_file() else {}
    held = {name: found for name, (key, found) in kept.items() if keys.get(name) == key}
    stale = sorted((m for m in mutants if m.name not in held), key=lambda m: keys[m.name])
    return stale, held


def drawn(mutants, count, kind=kept_verdicts.CORE):
    """Drawn by the contents of what they change, so that every change tries others."""
    names = sorted(p.relative_to(ROOT).as_posix() for folder in kind.sources
                   for p in (ROOT / folder).rglob("*") if p.is_file())
    first = int(kept_verdicts.digest_of(names), 16) % len(mutants)
    return (mutants[first:] + mutants[:first])[:count]


def is_steady(mutant, kept):
    """Once caught, and by what takes no times: if it is not caught again, a change did that."""
    return (mutant.name in kept and kept[mutant.name][1].code == CAUGHT and
            not kept[mutant.name][1].by.startswith(("timing: ", "ab: ")))


def run_stale(options, kind):
    mutants = kept_verdicts.mutants(kind)
    stale, held = stale_and_held(kind)
    print(f"{len(stale)} of {len(mutants)} verdicts on mutants of {kind.name} are stale", flush=True)
    if options.steady:
        kept = kept_verdicts.read(kind)
        mutants = [mutant for mutant in mutants if is_steady(mutant, kept)]
        stale = [mutant for mutant in stale if is_steady(mutant, kept)]
    chosen = stale or (drawn(mutants, options.at_least, kind) if mutants else [])
    found = run(chosen, options, kind) if chosen else {}
    left = [mutant.name for mutant in stale if mutant.name not in found]
    if left:
        print(f"{len(left)} remain stale: {', '.join(sorted(left))}")
    for name, its in held.items():
        if its.code != CAUGHT:
            print(f"{name}: {WORDS[its.code]} (kept): {its.by}", file=sys.stderr)
    return worst([*held.values(), *found.values()])


def list_stale(_, kind):
    stale, _ = stale_and_held(kind)
    for name in sorted(mutant.name for mutant in stale):
        print(name)
    print(f"{len(stale)} of {len(kept_verdicts.mutants(kind))} verdicts on mutants of {kind.name} "
          "are stale", file=sys.stderr)
    return 0


def check(_, kind):
    found = kept_verdicts.faults(kind)
    for fault in found:
        print(fault, file=sys.stderr)
    return SURVIVED if found else 0


def run_all(options, kind):
    return worst(run(kept_verdicts.mutants(kind), options, kind).values())


def run_patches(options, kind):
    mutants = [Mutant(path.resolve()) for path in options.patch]
    chosen = [mutant for mutant in mutants if kept_verdicts.kind_of(mutant) == kind]
    return worst(run(chosen, options, kind).values()) if chosen else 0


MODES = {"stale": run_stale, "all": run_all, "list": list_stale, "check": check, None: run_patches}


def parsed():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("patch", nargs="*", type=pathlib.Path, help="mutants to judge")
    modes = parser.add_mutually_exclusive_group()
    for mode in ("stale", "all", "list", "check"):
        modes.add_argument(f"--{mode}", dest="mode", action="store_const", const=mode)
    parser.add_argument("--kind", choices=[kind.name for kind in kept_verdicts.KINDS],
                        help="mutants of this kind alone (default: both, one after the other)")
    parser.add_argument("--minutes", type=float,
                        help="start no command after this time, of each kind (default: no limit)")
    parser.add_argument("--at-least", type=int, default=0, metavar="N",
                        help="judge at least N mutants of each kind, even after --minutes; if none "
                             "is stale, choose them by the contents of the sources")
    parser.add_argument("--steady", action="store_true",
                        help="of --stale, only mutants that were caught before, and without times")
    parser.add_argument("--write", action="store_true", help="keep the verdicts")
    parser.add_argument("--build", type=pathlib.Path, default=OWN_BUILD,
                        help="a configured build beside which mutants of core are built (default: "
                             "build/mutants, which is configured for them)")
    parser.add_argument("--product-build", type=pathlib.Path, default=ROOT / "build" / "release",
                        help="whose program mutants of the product are built beside (default: "
                             "build/release)")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(),
                        help="commands at a time (default: one per processor)")
    options = parser.parse_args()
    if bool(options.patch) == bool(options.mode):
        parser.error("give patches, or one of --stale, --all, --list and --check")
    if options.jobs < 1 or options.at_least < 0 or (options.minutes or 0) < 0:
        parser.error("--jobs is at least 1, --at-least and --minutes at least 0")
    return options


def main():
    options = parsed()
    kinds = [kind for kind in kept_verdicts.KINDS if options.kind in (None, kind.name)]
    try:
        return max(MODES[options.mode](options, kind) for kind in kinds)
    except Failure as failure:
        print(failure, file=sys.stderr)
        return failure.code


if __name__ == "__main__":
    sys.exit(main())
