#!/usr/bin/env python3
"""Runs one of N parts of a GoogleTest program: sampled.py N PROGRAM [WORD...]

Which part, the commit says, so that every change tries another one and a commit always the same; the
first where there is no repository. Prints the command that repeats it. All parts are run by the entry
of ctest NAME.All (label slow).
"""

import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]


def main():
    parts, words = int(sys.argv[1]), sys.argv[2:]
    head = subprocess.run(["git", "--git-dir", ROOT / ".git", "rev-parse", "HEAD"], capture_output=True,
                          text=True, check=False)
    part = int(head.stdout[:8], 16) % parts if head.returncode == 0 else 0
    shard = {"GTEST_TOTAL_SHARDS": str(parts), "GTEST_SHARD_INDEX": str(part)}
    print(f"part {part + 1} of {parts}: " + " ".join(f"{name}={value}" for name, value in shard.items()), *words,
          flush=True)
    os.execve(words[0], words, {**os.environ, **shard})


if __name__ == "__main__":
    main()
