#!/usr/bin/env python3
"""Kept verdicts of a made-up repository: what makes them stale, and what is wrong with them."""

import contextlib
import io
import json
import pathlib
import tempfile
import unittest
from unittest import mock

import kept_verdicts
import mutant_build
import run_mutant
from kept_verdicts import CORE, PRODUCT
from mutant_verdict import CAUGHT, SURVIVED, Verdict

PATCH = """# A mistake.
--- a/core/a.cpp
+++ b/core/a.cpp
@@ -1,1 +1,1 @@
-right
+wrong
"""
FILES = {
    "core/a.cpp": "right\n",
    "core/b.cpp": "other\n",
    "tests/faults/mutants/mistake.patch": PATCH,
    "tests/faults/mutant_judge.cpp": '#include "core/b.h"\n#include "tests/support/shapes.h"\n',
    "tests/support/shapes.h": '#include "tests/support/wide.h"\n',
    "tests/support/shapes.cpp": "shapes\n",
    "tests/support/wide.h": "wide\n",
    "tests/support/unused.h": "unused\n",
    "tests/faults/mutant_build.py": "build\n",
    "tests/faults/mutant_verdict.py": "verdict\n",
    "tests/faults/run_mutant.py": "run\n",
}


class KeptVerdicts(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        faults = self.root / "tests" / "faults"
        self.file = faults / "verdicts.json"
        for module, name, value in ((kept_verdicts, "ROOT", self.root),
                                    (mutant_build, "ROOT", self.root),
                                    (kept_verdicts, "FOLDER", faults)):
            patch = mock.patch.object(module, name, value)
            patch.start()
            self.addCleanup(patch.stop)
        for name, text in FILES.items():
            self.fill(name, text)
        self.keep("mistake", Verdict(CAUGHT, "a check"))

    def fill(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def keep(self, name, verdict):
        kept_verdicts.write({name: (self.key(), verdict)}, CORE)

    @staticmethod
    def key():
        return kept_verdicts.keys_of(kept_verdicts.mutants(CORE))["mistake"]

    @staticmethod
    def stale():
        return [mutant.name for mutant in run_mutant.stale_and_held(CORE)[0]]

    def expect_fault(self, text):
        faults = kept_verdicts.faults(CORE)
        self.assertEqual(len(faults), 1, faults)
        self.assertIn(text, faults[0])

    def test_one_line_per_mutant_without_faults(self):
        text = self.file.read_text(encoding="utf-8")
        self.assertEqual(text.count("\n"), 3)
        self.assertEqual(json.loads(text), {
            "mistake": {"key": self.key(), "verdict": "caught", "by": "a check"}})
        self.assertEqual(kept_verdicts.faults(CORE), [])
        self.assertEqual(self.stale(), [])

    def test_stale_when_something_changes_that_it_rests_on(self):
        for name in ("core/a.cpp", "tests/faults/mutants/mistake.patch",
                     "tests/faults/mutant_judge.cpp", "tests/support/shapes.h",
                     "tests/support/shapes.cpp", "tests/support/wide.h",
                     "tests/faults/mutant_build.py", "tests/faults/mutant_verdict.py"):
            with self.subTest(name=name):
                self.fill(name, FILES[name] + "more\n")
                self.assertEqual(self.stale(), ["mistake"])
                self.assertEqual(kept_verdicts.faults(CORE), [])
                self.fill(name, FILES[name])
                self.assertEqual(self.stale(), [])

    def test_holds_when_another_file_changes(self):
        for name in ("core/b.cpp", "tests/support/unused.h", "tests/faults/run_mutant.py"):
            self.fill(name, "changed\n")
        self.assertEqual(self.stale(), [])

    def test_stale_verdict_that_survived_is_judged_again(self):
        self.keep("mistake", Verdict(SURVIVED, "no check"))
        self.assertEqual(self.stale(), [])
        self.fill("core/a.cpp", "right\nmore\n")
        self.assertEqual(self.stale(), ["mistake"])

    def test_kept_verdict_that_survived_is_red(self):
        self.keep("mistake", Verdict(SURVIVED, "no check"))
        self.expect_fault("mistake: survived: no check")
        options = mock.Mock(at_least=0, steady=False)
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
            self.assertEqual(run_mutant.run_stale(options, CORE), SURVIVED)

    def test_mutant_without_a_verdict(self):
        self.fill("tests/faults/mutants/second.patch", PATCH)
        self.expect_fault("second: no verdict is kept")
        self.assertEqual(self.stale(), ["second"])

    def test_verdict_without_a_mutant(self):
        lines = {name: (self.key(), Verdict(CAUGHT, "a check")) for name in ("gone", "mistake")}
        self.file.write_text(kept_verdicts.text_of(lines), encoding="utf-8")
        self.expect_fault("gone: a verdict is kept, but there is no such mutant")
        kept_verdicts.write(kept_verdicts.read(CORE), CORE)
        self.assertEqual(kept_verdicts.faults(CORE), [])

    def test_patch_that_does_not_apply(self):
        self.fill("core/a.cpp", "neither\n")
        self.expect_fault("mistake: does not apply")

    def test_key_that_is_none(self):
        text = self.file.read_text(encoding="utf-8").replace(self.key(), "0123")
        self.file.write_text(text, encoding="utf-8")
        self.expect_fault('mistake: "0123" is no key')

    def test_folders_of_one_machine_are_not_kept(self):
        said = "ab: ab /a/b/contactcheck '/tmp/c d': All/Tests.A/b, 1/2: bunny-touch/results.json"
        kept = {"mistake": ("0" * 64, Verdict(CAUGHT, said))}
        kept_verdicts.write(kept, kept_verdicts.CORE)
        self.assertEqual(kept_verdicts.read(kept_verdicts.CORE)["mistake"][1].by,
                         "ab: ab contactcheck 'c d': All/Tests.A/b, 1/2: bunny-touch/results.json")
        self.assertEqual(kept_verdicts.faults(kept_verdicts.CORE), [])
        self.file.write_text(kept_verdicts.text_of(kept), encoding="utf-8")
        self.assertIn("names a folder of one machine",
                      "\n".join(kept_verdicts.faults(kept_verdicts.CORE)))

    def test_file_in_another_form(self):
        text = self.file.read_text(encoding="utf-8")
        self.file.write_text(text + "\n", encoding="utf-8")
        self.expect_fault("as --write writes it")

    def test_file_that_is_no_verdicts_is_refused(self):
        for text in ("", "[]", '{"mistake": 1}', '{"mistake": {"key": "0", "by": ""}}',
                     '{"mistake": {"key": "0", "verdict": "guessed", "by": ""}}'):
            with self.subTest(text=text):
                self.file.write_text(text, encoding="utf-8")
                with self.assertRaisesRegex(mutant_build.Failure, "verdicts.json: cannot be read"):
                    kept_verdicts.read(CORE)

    def product_key(self):
        return kept_verdicts.keys_of(kept_verdicts.mutants(PRODUCT))["whole"]

    def test_product_verdict_rests_on_its_scripts_and_on_what_its_command_demands(self):
        first_line, rest = PATCH.split("\n", 1)
        self.fill("tests/faults/product/whole.patch", f"{first_line}\n# Caught-by: hard\n{rest}")
        for name in ("core/a.cpp", "fixtures/hard/known-defects.json",
                     "tests/faults/product_verdict.py", "tests/faults/check_results.py",
                     "tests/faults/mutant_build.py"):
            with self.subTest(name=name):
                before = self.product_key()
                self.fill(name, "changed\n")
                self.assertNotEqual(self.product_key(), before)
        before = self.product_key()
        for name in ("fixtures/policies/default.json", "tests/faults/mutant_judge.cpp"):
            self.fill(name, "changed\n")
        self.assertEqual(self.product_key(), before)

    def test_product_mutant_that_names_no_command(self):
        self.fill("tests/faults/product/whole.patch", PATCH)
        kept_verdicts.write({}, PRODUCT)
        found = kept_verdicts.faults(PRODUCT)
        self.assertEqual(len(found), 1, found)
        self.assertIn('whole: the second line is no "# Caught-by: COMMAND"', found[0])

    def test_draw_depends_on_the_contents_of_core(self):
        names = [f"m{i}" for i in range(50)]
        with mock.patch.object(run_mutant, "ROOT", self.root):
            first = run_mutant.drawn(names, 3)
            self.assertEqual(first, run_mutant.drawn(names, 3))
            self.assertEqual(len(set(first)), 3)
            self.fill("core/b.cpp", "changed\n")
            self.assertNotEqual(first, run_mutant.drawn(names, 3))


if __name__ == "__main__":
    unittest.main()
