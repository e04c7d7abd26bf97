#!/usr/bin/env python3
"""Builds core with a seeded mistake and runs the judge, which must catch the mistake.

A mutant is a patch (tests/faults/mutants/*.patch). Its verdict is kept in
tests/faults/verdicts.json. The verdict is stale when the patch, a file that it changes or the judge
has changed. The unchanged program is judged first: it must pass.

    run_mutant.py tests/faults/mutants/hash-truncates.patch    judge one mutant
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
import sys
import time

import kept_verdicts
from mutant_build import CAUGHT, ROOT, SURVIVED, Failure, Mutant, OutOfTime, Workers
from mutant_verdict import WORDS, require_clean, unchanged_build, verdict


class Session:
    """Judges mutants, one row of a table each."""

    def __init__(self, options):
        self.begin = time.monotonic()
        self.workers = Workers(options.jobs)
        self.build = unchanged_build(options.build.resolve(), options.jobs)
        require_clean(self.build, self.workers)
        print(f"unchanged program: built and clean, {self.seconds_since(self.begin)} s\n")
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
            return verdict(mutant, self.build, self.workers), self.seconds_since(begin)
        except OutOfTime:
            return None, 0


def run(mutants, options):
    """Judges mutants, the first `at_least` of them whatever the time; their verdicts by name."""
    # Before anything is built: a file may change meanwhile.
    keys = kept_verdicts.keys_of(mutants)
    session = Session(options)
    found = {}
    for some in (mutants[:options.at_least], mutants[options.at_least:]):
        for mutant, its in session.verdicts(some):
            found[mutant.name] = its
            if options.write:
                keep(mutant, keys[mutant.name], its)
        if options.minutes is not None:
            session.end_after(options.minutes)
    for name, its in found.items():
        if its.code != CAUGHT:
            print(f"{name}: {WORDS[its.code]}: {its.by}", file=sys.stderr)
    print(f"\n{len(found)} mutants judged in {session.seconds_since(session.begin)} s, "
          f"{sum(its.code != CAUGHT for its in found.values())} not caught")
    return found


def keep(mutant, key, found):
    if kept_verdicts.keys_of([mutant])[mutant.name] != key:
        print(f"{mutant.name}: not kept, as a file changed meanwhile", file=sys.stderr)
        return
    kept = kept_verdicts.read() if kept_verdicts.FILE.is_file() else {}
    kept_verdicts.write({**kept, mutant.name: (key, found)})


def worst(verdicts):
    return max((its.code for its in verdicts), default=CAUGHT)


def stale_and_held(mutants):
    """The mutants whose verdicts are stale, in an order that contents shuffle, and the verdicts of
    all others by name."""
    keys = kept_verdicts.keys_of(mutants)
    kept = kept_verdicts.read() if kept_verdicts.FILE.is_file() else {}
    held = {name: found for name, (key, found) in kept.items() if keys.get(name) == key}
    stale = sorted((m for m in mutants if m.name not in held), key=lambda m: keys[m.name])
    return stale, held


def drawn(mutants, count):
    """Drawn by the contents of core, so that every change tries others."""
    names = sorted(p.relative_to(ROOT).as_posix() for p in (ROOT / "core").rglob("*")
                   if p.is_file())
    first = int(kept_verdicts.digest_of(names), 16) % len(mutants)
    return (mutants[first:] + mutants[:first])[:count]


def run_stale(options):
    mutants = kept_verdicts.mutants()
    stale, held = stale_and_held(mutants)
    print(f"{len(stale)} of {len(mutants)} verdicts are stale", flush=True)
    chosen = stale or drawn(mutants, options.at_least)
    found = run(chosen, options) if chosen else {}
    left = [mutant.name for mutant in stale if mutant.name not in found]
    if left:
        print(f"{len(left)} remain stale: {', '.join(sorted(left))}")
    for name, its in held.items():
        if its.code != CAUGHT:
            print(f"{name}: {WORDS[its.code]} (kept): {its.by}", file=sys.stderr)
    return worst([*held.values(), *found.values()])


def list_stale():
    mutants = kept_verdicts.mutants()
    stale, _ = stale_and_held(mutants)
    for name in sorted(mutant.name for mutant in stale):
        print(name)
    print(f"{len(stale)} of {len(mutants)} verdicts are stale", file=sys.stderr)
    return 0


def check():
    found = kept_verdicts.faults()
    for fault in found:
        print(fault, file=sys.stderr)
    return SURVIVED if found else 0


def parsed():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("patch", nargs="*", type=pathlib.Path, help="mutants to judge")
    modes = parser.add_mutually_exclusive_group()
    for mode in ("stale", "all", "list", "check"):
        modes.add_argument(f"--{mode}", dest="mode", action="store_const", const=mode)
    parser.add_argument("--minutes", type=float,
                        help="start no command after this time (default: no limit)")
    parser.add_argument("--at-least", type=int, default=0, metavar="N",
                        help="judge at least N mutants, even after --minutes; if none is stale, "
                             "choose them by the contents of core")
    parser.add_argument("--write", action="store_true", help="keep the verdicts")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build" / "mutants",
                        help="where to build them (default: build/mutants)")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(),
                        help="commands at a time (default: one per processor)")
    options = parser.parse_args()
    if bool(options.patch) == bool(options.mode):
        parser.error("give patches, or one of --stale, --all, --list and --check")
    if options.patch and options.write:
        parser.error("--write keeps verdicts of --stale and --all alone")
    if options.jobs < 1 or options.at_least < 0 or (options.minutes or 0) < 0:
        parser.error("--jobs is at least 1, --at-least and --minutes at least 0")
    return options


def main():
    options = parsed()
    try:
        if options.mode == "stale":
            return run_stale(options)
        if options.mode == "list":
            return list_stale()
        if options.mode == "check":
            return check()
        mutants = [Mutant(path.resolve()) for path in options.patch] or kept_verdicts.mutants()
        return worst(run(mutants, options).values())
    except Failure as failure:
        print(failure, file=sys.stderr)
        return failure.code


if __name__ == "__main__":
    sys.exit(main())
