#!/usr/bin/env python3
"""Does the map of the rooms (reference/README.md) name every room and only files that exist?"""

import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
MAP = ROOT / "reference" / "README.md"
CODE = re.compile(r"`([^`\n]+)`")


def rooms():
    """Folders with code of their own, as the map writes them; rooms within rooms are named with them."""
    return {path.parent.relative_to(ROOT).as_posix()
            for top in ("core", "reference") for path in (ROOT / top).glob("*/CMakeLists.txt")}


def named_paths(text):
    return [name for name in CODE.findall(text) if "/" in name and " " not in name]


def missing(text, root=ROOT):
    return [name for name in named_paths(text) if not (root / name).exists()]


def bare_names(text):
    """Files named without their folder, behind one with it."""
    return [name for name in CODE.findall(text) if re.fullmatch(r"\w+\.(?:cpp|h|ts)", name)]


class MapTest(unittest.TestCase):
    text = MAP.read_text("utf-8")

    def test_names_every_room_once(self):
        table = self.text.partition("## Layers")[2].partition("## Three walks")[0]
        listed = re.findall(r"^\| `([^`]+)` \|", table, re.MULTILINE)
        self.assertEqual(sorted(listed), sorted(rooms()))

    def test_names_files_that_exist(self):
        self.assertEqual(missing(self.text), [])
        self.assertGreater(len(named_paths(self.text)), 20)
        paths = [ROOT / name for name in named_paths(self.text)]
        folders = {path if path.is_dir() else path.parent for path in paths}
        lost = [name for name in bare_names(self.text)
                if not any((folder / name).exists() for folder in folders)]
        self.assertEqual(lost, [])

    def test_a_file_that_is_gone_is_named(self):
        gone = self.text.replace("reference/judge/accuracy.cpp", "reference/judge/accurate.cpp")
        self.assertEqual(missing(gone), ["reference/judge/accurate.cpp"])


if __name__ == "__main__":
    unittest.main()
