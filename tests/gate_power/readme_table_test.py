#!/usr/bin/env python3
"""Is the table in the README what the program prints? readme_table_test.py PROGRAM README

Prints the program's table where the README has another. Exit code: 0 it is, 1 it is not.
"""

import pathlib
import subprocess
import sys


def main():
    program, readme = sys.argv[1:]
    table = subprocess.run([program], check=True, capture_output=True, text=True).stdout
    if len(table.splitlines()) < 10:
        sys.exit(f"{program} prints no table:\n{table}")
    if table in pathlib.Path(readme).read_text(encoding="utf-8"):
        return
    sys.exit(f"{readme} does not hold this table, which {program} prints:\n{table}")


if __name__ == "__main__":
    main()
