#!/usr/bin/env python3
"""The driver of the mutants on patches that end in each of its other verdicts."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

import run_mutant

BUILD = None
ABOUT = "# A change for the test of the driver.\n"
HEAD = "--- a/core/types/check.cpp\n+++ b/core/types/check.cpp\n"


def patch_of_first_line(new):
    """Replaces the first line of a small unit."""
    with open(run_mutant.ROOT / "core/types/check.cpp", encoding="utf-8") as file:
        lines = [next(file) for _ in range(3)]
    return f"{HEAD}@@ -1,3 +1,4 @@\n-{lines[0]}+{lines[0]}+{new}\n {lines[1]} {lines[2]}"


class Driver(unittest.TestCase):
    def exit_code_and_text(self, patch):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "change.patch"
            path.write_text(patch, encoding="utf-8")
            script = pathlib.Path(run_mutant.__file__)
            done = subprocess.run([sys.executable, "-B", script, "--build", BUILD, path],
                                  capture_output=True, text=True, check=False)
            return done.returncode, done.stdout

    def test_harmless_change_survives(self):
        code, text = self.exit_code_and_text(ABOUT + patch_of_first_line("// No mistake."))
        self.assertEqual(code, run_mutant.SURVIVED, text)
        self.assertIn("survived", text)

    def test_detector_that_is_slower_alone_survives(self):
        patches = sorted((run_mutant.MUTANTS.parent / "slow").glob("*.patch"))
        self.assertTrue(patches)
        for patch in patches:
            with self.subTest(patch=patch.name):
                code, text = self.exit_code_and_text(patch.read_text(encoding="utf-8"))
                self.assertEqual(code, run_mutant.SURVIVED, text)

    def test_change_of_lines_that_are_not_there_does_not_apply(self):
        hunk = HEAD + "@@ -1,1 +1,1 @@\n-no such line\n+another\n"
        code, text = self.exit_code_and_text(ABOUT + hunk)
        self.assertEqual(code, run_mutant.DOES_NOT_APPLY, text)

    def test_change_of_a_file_that_is_not_there_does_not_apply(self):
        hunk = "--- a/core/none.cpp\n+++ b/core/none.cpp\n@@ -1,1 +1,1 @@\n-one\n+other\n"
        code, text = self.exit_code_and_text(ABOUT + hunk)
        self.assertEqual(code, run_mutant.DOES_NOT_APPLY, text)

    def test_change_that_is_no_cpp_does_not_compile(self):
        code, text = self.exit_code_and_text(ABOUT + patch_of_first_line("this is no declaration;"))
        self.assertEqual(code, run_mutant.DOES_NOT_COMPILE, text)

    def test_patch_that_does_not_say_what_is_wrong_is_refused(self):
        code, text = self.exit_code_and_text(patch_of_first_line("// No mistake."))
        self.assertEqual(code, run_mutant.DOES_NOT_APPLY, text)
        self.assertIn("does not say what is wrong", text)


if __name__ == "__main__":
    BUILD = sys.argv.pop(1)
    unittest.main()
