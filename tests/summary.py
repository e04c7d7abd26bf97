#!/usr/bin/env python3
"""What the last run of the tests ran, and what it skipped for want of a package.

    summary.py BUILD [--no-skips]     --no-skips: exit code 1 where a test was skipped

Reads BUILD/tests/ran: junit.xml, which ctest writes (presets name it), and the files of the
GoogleTest programs and of pytest that it ran.
"""

import argparse
import pathlib
import re
import sys
import xml.etree.ElementTree as xml


def of_junit(file):
    """(tests that ran, [(test, why it was skipped)]) of GoogleTest's or pytest's file. GoogleTest also
    lists tests that were not asked for."""
    ran, skipped = 0, []
    for case in xml.parse(file).iter("testcase"):
        why = case.find("skipped")
        if why is not None:
            skipped.append((f"{case.get('classname')}.{case.get('name')}",
                            why.get("message", "").strip().splitlines()[-1]))
        elif case.get("status", "run") == "run":
            ran += 1
    return ran, skipped


def of_output(text):
    """Tests that unittest, pytest or node counted; any other entry is one test."""
    counted = re.findall(r"^Ran (\d+) tests? in|^(\d+) passed|^# tests (\d+)$", text, re.MULTILINE)
    return sum(int("".join(count)) for count in counted) or 1


def summary(build):
    ran, entries, skipped, empty = 0, 0, [], []
    for entry in xml.parse(build / "tests" / "ran" / "junit.xml").iter("testcase"):
        name, output = entry.get("name"), entry.findtext("system-out") or ""
        details = build / "tests" / "ran" / f"{name}.xml"
        if entry.get("status") == "notrun":
            why = re.search(r"skipped: (.*)", output)
            skipped.append((name, why.group(1) if why else "not run"))
            continue
        entries += 1
        if not details.exists():
            ran += of_output(output)
            continue
        of_entry, of_entry_skipped = of_junit(details)
        skipped += of_entry_skipped
        ran += of_entry
        if of_entry + len(of_entry_skipped) == 0:
            empty.append(name)
    return ran, entries, skipped, empty


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--no-skips", action="store_true")
    options = parser.parse_args()
    ran, entries, skipped, empty = summary(options.build)
    print(f"{ran} tests in {entries} entries of ctest ran, {len(skipped)} were skipped")
    for name, why in skipped:
        print(f"skipped: {name}: {why}")
    for name in empty:
        print(f"{name} has no test")
    return 1 if empty or (skipped and options.no_skips) else 0


if __name__ == "__main__":
    sys.exit(main())
