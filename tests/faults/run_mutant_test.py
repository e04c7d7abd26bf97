#!/usr/bin/env python3
"""The driver of the mutants on patches that end in each of its verdicts."""

import argparse
import contextlib
import io
import pathlib
import tempfile
import unittest

import run_mutant
from mutant_build import (CAUGHT, DOES_NOT_APPLY, DOES_NOT_COMPILE, ROOT, SURVIVED, Mutant,
                          Workers)
from mutant_verdict import require_clean, unchanged_build, verdict

BUILD = ROOT / "build" / "mutants"
ABOUT = "# A change for the test of the driver.\n"
UNIT = "core/types/check.cpp"
# Both core and the judge include it.
HEADER = "core/narrow/segments.h"


def head_of(name):
    return f"--- a/{name}\n+++ b/{name}\n"


def patch_after_first_line(name, new):
    with open(ROOT / name, encoding="utf-8") as file:
        lines = [next(file) for _ in range(3)]
    first, second, third = lines
    return head_of(name) + f"@@ -1,3 +1,4 @@\n {first}+{new}\n {second} {third}"


class Driver(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.workers = Workers(2)
        cls.build = unchanged_build(BUILD, cls.workers.jobs)
        require_clean(cls.build, cls.workers)

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def mutant(self, patch, name="change"):
        path = self.folder / f"{name}.patch"
        path.write_text(patch, encoding="utf-8")
        return Mutant(path)

    def expect(self, code, patch):
        """The words of the verdict."""
        found = verdict(self.mutant(patch), self.build, self.workers)
        self.assertEqual(found.code, code, found.by)
        return found.by

    def test_wrong_answer_is_caught(self):
        patch = (run_mutant.kept_verdicts.FOLDER / "mutants" / "body-pair-order.patch")
        self.assertIn("find_candidate_bodies", self.expect(CAUGHT, patch.read_text("utf-8")))

    def test_harmless_change_of_a_header_survives(self):
        self.expect(SURVIVED, ABOUT + patch_after_first_line(HEADER, "// No mistake."))

    def test_detector_that_is_slower_alone_survives(self):
        patches = sorted((run_mutant.kept_verdicts.FOLDER / "slow").glob("*.patch"))
        self.assertTrue(patches)
        for patch in patches:
            with self.subTest(patch=patch.name):
                self.expect(SURVIVED, patch.read_text(encoding="utf-8"))

    def test_change_of_lines_that_are_not_there_does_not_apply(self):
        hunk = head_of(UNIT) + "@@ -1,1 +1,1 @@\n-no such line\n+another\n"
        self.expect(DOES_NOT_APPLY, ABOUT + hunk)

    def test_change_that_is_no_cpp_does_not_compile(self):
        self.expect(DOES_NOT_COMPILE,
                    ABOUT + patch_after_first_line(UNIT, "this is no declaration;"))

    def test_header_changes_for_core_the_oracle_and_the_judge(self):
        users = {self.build.name_of(unit.source)
                 for unit in self.build.users(["core/types/vec3.h"])}
        for unit in ("core/types/mesh.cpp", "core/lazy/kernels.cpp", "reference/oracle/oracle.cpp",
                     "reference/oracle/rational_geometry.cpp", "tests/faults/mutant_parts.cpp"):
            self.assertIn(unit, users)

    def test_deadline_leaves_mutants_but_for_those_that_are_to_be_judged(self):
        patch = ABOUT + patch_after_first_line(UNIT, "// No mistake.")
        mutants = [self.mutant(patch, name) for name in ("first", "second", "third")]
        options = argparse.Namespace(at_least=1, minutes=0.0, jobs=2, build=BUILD, write=False)
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
            found = run_mutant.run(mutants, options)
        self.assertEqual({name: its.code for name, its in found.items()}, {"first": SURVIVED})


if __name__ == "__main__":
    unittest.main()
