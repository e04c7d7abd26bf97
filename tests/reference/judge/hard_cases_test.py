"""Exports all families of hard cases and checks every certificate.

Usage: hard_cases_test.py CONTACTCHECK FIXTURES FOLDER
"""

import pathlib
import subprocess
import sys


def main():
    program, fixtures, folder = sys.argv[1:4]
    families = sorted(p.stem for p in pathlib.Path(fixtures, "hard/families").glob("*.json"))
    assert families, "there is no family of hard cases"
    subprocess.run([program, "export", *families, "--out", folder], check=True)
    folders = [pathlib.Path(folder, family) for family in families]
    checker = [sys.executable, "-B", folders[0] / "check.py", *folders]
    said = subprocess.run(checker, check=True, capture_output=True, text=True).stdout
    print(said)
    assert [line.split(":")[0] for line in said.splitlines()] == families


if __name__ == "__main__":
    main()
