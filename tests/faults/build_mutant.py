#!/usr/bin/env python3
"""Builds contactcheck with a patch in it (see mutant_build.py), next to the build's own.

    build_mutant.py --build build/release --out /tmp/slowed tests/faults/slow/ffd-lazy.patch

Exit codes: 0 built, 2 the patch does not apply, 3 it does not compile or link.
"""

import argparse
import os
import pathlib
import sys
import tempfile

from mutant_build import QUICK_FLAGS, Build, Failure, Mutant, Workers, build_program


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("patch", type=pathlib.Path, help="what to change")
    parser.add_argument("--build", type=pathlib.Path, required=True,
                        help="a build folder (Ninja) with contactcheck in it")
    parser.add_argument("--out", type=pathlib.Path, required=True, help="the program to write")
    parser.add_argument("--quick", action="store_true",
                        help="compile for its answers alone, not for its times")
    options = parser.parse_args()
    try:
        with tempfile.TemporaryDirectory(prefix="mutant-") as folder:
            build_program(Mutant(options.patch.resolve()),
                          Build(options.build.resolve(), "contactcheck"), options.out.resolve(),
                          pathlib.Path(folder), Workers(os.cpu_count()),
                          QUICK_FLAGS if options.quick else [])
    except Failure as failure:
        print(f"{options.patch}: {failure}", file=sys.stderr)
        return failure.code
    return 0


if __name__ == "__main__":
    sys.exit(main())
