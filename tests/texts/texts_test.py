#!/usr/bin/env python3
"""Every difference between pages and published results is an error with its place."""

import contextlib
import io
import json
import pathlib
import re
import shutil
import tempfile
import unittest

import texts
from published import FILES, FOLDER, LARGEST, RANGES, ROOT, TextError, files_of, published
from tables import ratio, recall, span, three_digits

EXAMPLE = ROOT / "tests" / "reference" / "schema" / "example_results.json"


class OfACopy(unittest.TestCase):
    """The project's own pages and published files, copied, changed and checked."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        shutil.copytree(ROOT / FOLDER, self.root / FOLDER)
        for name in (texts.LIST, texts.PICTURE, RANGES, *texts.read_list(ROOT)):
            (self.root / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, self.root / name)
        self.assertEqual(texts.check(self.root), [])

    def change(self, name, old, new):
        """At its only or first place, which is returned as PAGE:LINE."""
        text = (self.root / name).read_text("utf-8")
        at = text.index(old)
        (self.root / name).write_text(text[:at] + new + text[at + len(old):], "utf-8")
        return texts.place(name, text, at)

    def only_error(self):
        errors = texts.check(self.root)
        self.assertEqual(len(errors), 1, "\n".join(errors))
        return errors[0]

    def entries(self, change):
        path = self.root / texts.LIST
        entries = json.loads(path.read_text("utf-8"))
        change(entries)
        path.write_text(json.dumps(entries), "utf-8")


class Check(OfACopy):
    def test_changed_digit_in_any_table(self):
        tables = 0
        for page in texts.read_list(ROOT):
            text = (ROOT / page).read_text("utf-8")
            for match in texts.MARKED.finditer(text):
                tables += 1
                at = re.compile(r"\d").search(text, match.start(3), match.end(3)).start()
                digit = str(9 - int(text[at]))
                (self.root / page).write_text(text[:at] + digit + text[at + 1:], "utf-8")
                with self.subTest(table=match[2]):
                    error = self.only_error()
                    place = texts.place(page, text, at)
                    self.assertTrue(error.startswith(f"{place}: table {match[2]} has"), error)
                    line = text[text.rindex("\n", 0, at) + 1:text.index("\n", at)]
                    self.assertIn(f"the results say\n    {line}", error)
            shutil.copy(ROOT / page, self.root / page)
        self.assertEqual(tables, len(texts.TABLES))

    def test_changed_digit_in_any_sentence(self):
        files = files_of(ROOT)
        values = texts.figures(files)
        for page, (pieces, _) in texts.read_list(ROOT).items():
            text = (ROOT / page).read_text("utf-8")
            for piece in pieces:
                match = texts.pattern_of(piece).search(text)
                at = re.compile(r"\d").search(text, match.start(1)).start()
                changed = text[:at] + str(9 - int(text[at])) + text[at + 1:]
                (self.root / page).write_text(changed, "utf-8")
                with self.subTest(piece=piece):
                    error = self.only_error()
                    self.assertTrue(error.startswith(texts.place(page, text, match.start())), error)
                    self.assertIn(f"the results say\n    {texts.made_piece(piece, values)}", error)
            (self.root / page).write_text(text, "utf-8")

    def test_changed_number_in_a_published_file(self):
        row = next(line for line in (ROOT / FOLDER / "hard.json").read_text("utf-8").splitlines()
                   if '"libccd-mpr"' in line)
        missed = re.search(r'"missed": (\d+)', row)
        self.change(FOLDER / "hard.json", row,
                    row.replace(missed[0], f'"missed": {int(missed[1]) + 1}'))
        self.assertIn("the results say\n    | libccd-mpr", self.only_error())

    def test_stray_number(self):
        text = (ROOT / "README.md").read_text("utf-8")
        (self.root / "README.md").write_text(text + "\nAnd all in 17.5 ms.\n", "utf-8")
        error = self.only_error()
        self.assertTrue(error.startswith(f"README.md:{text.count(chr(10)) + 2}: 17.5 in \""), error)
        self.assertIn("stands in no table and in no entry of tests/texts/figures.json", error)

    def test_digits_of_names_code_and_links_are_no_numbers(self):
        with open(self.root / "README.md", "a", encoding="utf-8") as page:
            page.write("\nAVX2 and `ffd 17`, [see](a/17.md) https://a.org/17.\n\n    17\n\n"
                       "```\n17\n```\n")
        self.assertEqual(texts.check(self.root), [])

    def test_missing_file(self):
        (self.root / FOLDER / "hard.json").unlink()
        self.assertEqual(self.only_error(),
                         "fixtures/published/hard.json cannot be read: No such file or directory")

    def test_file_that_is_none(self):
        (self.root / FOLDER / "more.json").write_text("{}", "utf-8")
        self.assertEqual(self.only_error(), "fixtures/published/more.json is no published file")

    def test_missing_row(self):
        path = self.root / FOLDER / "performance.json"
        lines = path.read_text("utf-8").splitlines(keepends=True)
        row = '{"scene": "pile", "detector": "full-refit"'
        path.write_text("".join(line for line in lines if row not in line), "utf-8")
        self.assertRegex(self.only_error(),
                         r"^core/lazy/README.md:\d+: fixtures/published/performance.json has 0 rows "
                         r"of runs with scene pile, detector full-refit; one is needed$")

    def test_row_that_is_not_ok(self):
        path = self.root / FOLDER / "single-lazy-times.json"
        text = path.read_text("utf-8")
        path.write_text(re.sub(r'("scene": "pile", "detector": "ffd-lazy"),[^}]*',
                               r'\1, "status": "error"', text), "utf-8")
        self.assertIn("fixtures/published/single-lazy-times.json: ffd-lazy in pile has status error, "
                      "not ok", self.only_error())

    def test_missing_ratio(self):
        path = self.root / FOLDER / "performance.json"
        path.write_text(path.read_text("utf-8").replace('"embree": [', '"other": ['), "utf-8")
        self.assertRegex(self.only_error(), r"^core/lazy/README.md:\d+: table performance has\n")

    def test_values_that_differ_where_the_text_gives_one(self):
        path = self.root / FOLDER / "single-lazy.json"
        text = path.read_text("utf-8")
        row = r'("pile", "detector": "ffd-lazy:precision=single", "missed": )\d+'
        path.write_text(re.sub(row, r"\g<1>77", text), "utf-8")
        errors = "\n".join(texts.check(self.root))
        self.assertIn("missed contacts in pile are 77, ", errors)
        self.assertIn("the text gives one value for all", errors)

    def test_file_that_is_too_large(self):
        path = self.root / FOLDER / "hard.json"
        path.write_text(path.read_text("utf-8") + " " * LARGEST, "utf-8")
        self.assertRegex(self.only_error(), r"hard.json has \d+ bytes; 200000 are allowed")

    def test_picture_of_other_results(self):
        self.change(texts.PICTURE, "<text", "<text ")
        self.assertEqual(self.only_error(),
                         ".github/headline.svg is not the picture of fixtures/published/default.json")

    def test_table_without_markers(self):
        for mark in ("<!-- table: reproduce -->\n", "<!-- end -->\n"):
            self.change("reference/reproduce/README.md", mark, "")
        self.assertIn("no page has the table reproduce", texts.check(self.root))

    def test_table_without_end(self):
        self.change("reference/reproduce/README.md", "<!-- end -->\n", "")
        self.assertRegex("\n".join(texts.check(self.root)),
                         r"reference/reproduce/README.md:\d+: table reproduce has no <!-- end -->")

    def test_sentence_that_was_rewritten(self):
        page = "reference/reproduce/README.md"
        self.change(page, "figures that follow from", "figures following from")
        self.assertIn(f"{page} has 0 places for \"Of {{reproduce.figures}} figures",
                      texts.check(self.root)[0])

    def test_entry_without_words_number_reason_or_figure(self):
        for why, words, entry in (("no words", "one of 99 pages", "made up"),
                                  ("has no number", "collision detector", "made up"),
                                  ("has no reason", "Debian 12", " ")):
            with self.subTest(why=why):
                self.entries(lambda all_of: all_of["fixed"]["README.md"].__setitem__(words, entry))
                self.assertIn(why, self.only_error())
                shutil.copy(ROOT / texts.LIST, self.root / texts.LIST)
        self.entries(lambda all_of: all_of["made"].__setitem__(
            "reference/tune/README.md", ["Exit code {hard.nothing} when"]))
        self.assertIn("names hard.nothing, which is no figure", "\n".join(texts.check(self.root)))

    def test_command_says_what_it_found(self):
        row = "| fcl-aabb | triangle | "
        where = self.change("fixtures/hard/README.md", row, row + "1")
        with contextlib.redirect_stdout(io.StringIO()) as out:
            self.assertEqual(texts.main(["check"], self.root), 1)
        self.assertIn(where, out.getvalue())


class Pieces(unittest.TestCase):
    def test_figure_begins_with_a_digit_and_takes_no_words_with_it(self):
        pattern = texts.pattern_of("of {a.b} pairs in {c} missed")
        found = pattern.search("an option of every kind: of 57,735 pairs in 1 to 2 missed, 3 missed")
        self.assertEqual(found.groups(), ("57,735", "1 to 2"))

    def test_figure_at_an_end_is_refused(self):
        for piece in ("{a} pairs", "of {a}"):
            with self.assertRaisesRegex(TextError, "begins or ends with a figure"):
                texts.pattern_of(piece)


class Write(OfACopy):
    def test_mends_every_page_and_changes_nothing_else(self):
        digits = re.compile(r"\d")
        for page, (pieces, _) in texts.read_list(ROOT).items():
            text = (ROOT / page).read_text("utf-8")
            spans = [match.span(3) for match in texts.MARKED.finditer(text)]
            for piece in pieces:
                match = texts.pattern_of(piece).search(text)
                spans += [match.span(group) for group in range(1, match.re.groups + 1)]
            for start, end in spans:
                text = text[:start] + digits.sub("8", text[start:end]) + text[end:]
            (self.root / page).write_text(text, "utf-8")
        (self.root / texts.PICTURE).write_text("", "utf-8")
        self.assertNotEqual(texts.check(self.root), [])
        self.assertEqual(texts.main(["write"], self.root), 0)
        self.assertEqual((self.root / texts.PICTURE).read_bytes(),
                         (ROOT / texts.PICTURE).read_bytes())
        for page in texts.read_list(ROOT):
            self.assertEqual((self.root / page).read_text("utf-8"),
                             (ROOT / page).read_text("utf-8"), page)


class Publish(OfACopy):
    def test_keeps_what_is_quoted_and_no_place_of_this_machine(self):
        results = json.loads(EXAMPLE.read_text("utf-8"))
        results["command"] = "contactcheck run hello --quiet --out /some/folder --processes 5"
        path = self.root / "results.json"
        path.write_text(json.dumps(results), "utf-8")
        self.assertEqual(
            texts.main(["publish", "hard", str(path), "--seconds", "61"], self.root), 0)
        made = json.loads((self.root / FOLDER / "hard.json").read_text("utf-8"))
        self.assertEqual(made.pop("date")[:2], "20")
        self.assertEqual(made.pop("machine")["cpu"], "example")
        self.assertEqual(made, {
            "command": "contactcheck run hello --processes 5", "version": "0.1.0", "seconds": 61,
            "sums": [{"families": 1, "cases": 3, "known_defects": 3,
                      "known_refusals": 0, "readings": 2}],
            "detectors": [
                {"detector": "ffd-aabb-sphere2", "level": "cell", "families": 1,
                 "families_right": 0, "cases": 3, "right": 1, "truth": 10, "missed": 1,
                 "spurious": 1, "refused": 0, "refused_cases": 0, "errors": 0},
                # Nothing that it claims was judged.
                {"detector": "bullet-vf:margin=0.001", "level": "-", "families": 1,
                 "families_right": 0, "cases": 0, "right": 0, "truth": 0, "missed": 0,
                 "spurious": 0, "refused": 0, "refused_cases": 0, "errors": 0},
                {"detector": "fcl-aabb", "level": "-", "families": 1,
                 "families_right": 0, "cases": 0, "right": 0, "truth": 0, "missed": 0,
                 "spurious": 0, "refused": 0, "refused_cases": 0, "errors": 1}]})

    def test_drawn_scenes_are_summed_and_have_the_rows_of_their_report(self):
        scene = {"drawn": {"seed": 7, "redrawn": 0}, "contact_frames": 3, "frames": 8,
                 "truth": {"triangle": 5}}
        results = {"command": "contactcheck run drawn", "version": "0.1.0", "machine": {},
                   "scenes": [scene, {**scene, "contact_frames": 0, "truth": {"triangle": 0}},
                              {"drawn": {"seed": 7, "redrawn": 5}, "unjudged": "no progress"}]}
        path = self.root / "results.json"
        path.write_text(json.dumps(results), "utf-8")
        report = "\n## Drawn scenes\n\n{}\n## Goals\n\n### Speed-ups\n\n| detector |\n|---|\n| z |\n"
        (self.root / "report.md").write_text(report.format(
            "### Missed and spurious in 1 scene with contact\n\n| detector | missed |\n|---|--:|\n"
            "| x | 1 |\n| y | - |\n\n### Scenes with wrong answers\n\n| detector |\n|---|\n| w |\n"),
            "utf-8")
        made = json.loads(published("drawn", path, 1, "abc"))
        self.assertEqual(made["commit"], "abc")
        self.assertEqual(made["drawn_sums"], [{"seed": 7, "scenes": 3, "judged": 2, "redrawn": 1,
                                               "with_contact": 1, "frames": 16, "true_pairs": 5}])
        table = "Missed and spurious in 1 scene with contact"
        self.assertEqual(made["drawn"], [{"table": table, "detector": "x", "missed": "1"},
                                         {"table": table, "detector": "y", "missed": "-"}])
        (self.root / "report.md").write_text(report.format(""), "utf-8")
        with self.assertRaisesRegex(TextError, 'no rows of drawn scenes below "Missed'):
            published("drawn", path, 1)
        results["scenes"][0]["drawn"] = {"seed": 8, "redrawn": 0}
        path.write_text(json.dumps(results), "utf-8")
        with self.assertRaisesRegex(TextError, "drawn from 2 seeds"):
            published("drawn", path, 1)

    def test_drawn_steps_are_summed_by_level(self):
        scene = {"drawn": {"seed": 7, "redrawn": 0}, "truth": {"impact": 2, "impact-vf": 9},
                 "impacts": {"motion": [0.5, 2.0], "passing": [1, 0]}}
        own = {**scene, "truth": {"impact": 0, "impact-vf": 0, "impact-self-vf": 3},
               "impacts": {"motion": [0.5], "passing": [0]}}
        still = {**own, "truth": {"impact": 0, "impact-vf": 0}}
        results = {"command": "contactcheck run drawn --steps", "version": "0.1.0", "machine": {},
                   "scenes": [scene, own, still,
                              {"drawn": {"seed": 7, "redrawn": 5}, "unjudged": "no progress"}]}
        path = self.root / "results.json"
        path.write_text(json.dumps(results), "utf-8")
        (self.root / "report.md").write_text(
            "\n## Drawn scenes\n\n### Missed and spurious in 2 scenes with impacts\n\n"
            "| detector | bodies |\n|---|--:|\n| x | 1 / 2 |\n", "utf-8")
        made = json.loads(published("drawn-steps", path, 1, "abc"))
        self.assertEqual(made["step_sums"], [{
            "seed": 7, "scenes": 4, "judged": 3, "redrawn": 1, "with_impacts": 2, "with_self": 1,
            "steps": 4, "passing": 1, "true": {"impact": 2, "impact-self-vf": 3, "impact-vf": 9}}])
        self.assertEqual(made["drawn"], [{"table": "Missed and spurious in 2 scenes with impacts",
                                          "detector": "x", "bodies": "1 / 2"}])

    def test_refuses_a_command_with_an_absolute_path(self):
        results = json.loads(EXAMPLE.read_text("utf-8"))
        path = self.root / "results.json"
        for command in ("contactcheck run /a.json", 'contactcheck run --mesh "/a b.obj"'):
            results["command"] = command
            path.write_text(json.dumps(results), "utf-8")
            with self.assertRaisesRegex(TextError, "names an absolute path"):
                published("hard", path, 1)

    def test_refuses_other_names_and_results_without_a_field(self):
        with self.assertRaisesRegex(TextError, "^all is no published file; there are default, "):
            published("all", EXAMPLE, None)
        results = json.loads(EXAMPLE.read_text("utf-8"))
        del results["goals"]
        path = self.root / "results.json"
        path.write_text(json.dumps(results), "utf-8")
        with self.assertRaisesRegex(TextError, "results.json has no field"):
            published("performance", path, None)


class Citation(unittest.TestCase):
    def test_names_the_version_of_the_project(self):
        version = re.search(r"project\(contactcheck VERSION (\S+)",
                            (ROOT / "CMakeLists.txt").read_text("utf-8"))[1]
        self.assertIn(f"\nversion: {version}\n", (ROOT / "CITATION.cff").read_text("utf-8"))


class Numbers(unittest.TestCase):
    """As reference/report/tables/format.cpp writes them."""

    def test_three_digits(self):
        for value, text in ((0, "0"), (461.4, "461"), (26.49, "26.5"), (1.004, "1.00"),
                            (0.0306, "0.0306"), (4699.2, "4699"), (2.6e-8, "2.60e-08"),
                            (None, "-")):
            self.assertEqual(three_digits(value), text)

    def test_ratios_say_what_their_ends_are(self):
        self.assertEqual(ratio(2.5, 2.0, 3.0, 1), "2.50x (1 pass)")
        self.assertEqual(ratio(2.5, 2.0, 3.0, 3), "2.50x (2.00 to 3.00)")
        self.assertEqual(ratio(2.5, 2.0, 3.0, 5), "2.50x [2.00, 3.00]")

    def test_recall_is_cut(self):
        self.assertEqual(recall(12127, 2), "0.99983")
        self.assertEqual(recall(10_000_000, 1), "0.99999")
        self.assertEqual(recall(5, 0), "1")
        self.assertEqual(recall(0, 0), "-")

    def test_span_of_equal_texts_is_one(self):
        self.assertEqual(span([1.0, 1.001]), "1.00")
        self.assertEqual(span([1.0, 2.0]), "1.00 to 2.00")


if __name__ == "__main__":
    unittest.main()
