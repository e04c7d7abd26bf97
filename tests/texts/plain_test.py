#!/usr/bin/env python3
"""plain.py fails where it should, and only there."""

import contextlib
import io
import unittest
import unittest.mock

import plain


def errors(text):
    return plain.findings("page.md", text)[0]


def words(count, word="word"):
    return " ".join([word] * count)


def paragraph(count):
    """In sentences of ten words."""
    sentences = [f"W{words(10)[1:]}."] * (count // 10) + [f"W{words(count % 10)[1:]}."] * (count % 10 > 0)
    return " ".join(sentences)


class Help(unittest.TestCase):
    HELP = ("Runs it\nUsage: x run\n\nOptions:\n  -h,--help                Print {}\n"
            "  --out DIR                folder\n                           for all\n\n"
            "It stops. {}\nExamples:\n  contactcheck run {}")

    def test_options_are_items_and_examples_are_code(self):
        text = plain.help_as_page(self.HELP.format("help", "Then it ends.", words(50)))
        self.assertEqual([block for _, _, block in plain.blocks(text)],
                         ["Runs it Usage: x run", "Print help", "folder for all",
                          "It stops. Then it ends."])
        self.assertEqual(errors(text), [])

    def test_long_options_and_listed_phrases_are_errors(self):
        self.assertEqual(len(errors(plain.help_as_page(self.HELP.format(words(41), "", "")))), 1)
        self.assertEqual(len(errors(plain.help_as_page(
            self.HELP.format("", "It takes down all.", "")))), 1)


class Lengths(unittest.TestCase):
    def test_paragraph_at_and_beyond_the_limit(self):
        self.assertEqual(errors(paragraph(80)), [])
        self.assertRegex(errors("# T\n\n" + paragraph(81))[0], r"^page.md:3: a paragraph of 81 words")

    def test_front_page_has_shorter_paragraphs(self):
        self.assertEqual(plain.findings("README.md", paragraph(60))[0], [])
        self.assertRegex(plain.findings("README.md", paragraph(61))[0][0], "at most 60 are allowed")

    def test_lines_of_a_paragraph_are_one_paragraph_and_a_blank_line_ends_it(self):
        self.assertEqual(len(errors(paragraph(50) + "\n" + paragraph(50))), 1)
        self.assertEqual(errors(paragraph(50) + "\n\n" + paragraph(50)), [])

    def test_sentence_at_and_beyond_the_limit(self):
        self.assertEqual(errors(f"{words(40)}. {words(40).capitalize()}."), [])
        self.assertRegex(errors(words(41))[0], r"^page.md:1: a sentence of 41 words")
        self.assertEqual(len(errors(f"{words(20)} in 1.5 ms of `a. B` {words(18)}.")), 1)

    def test_list_items_are_paragraphs_with_their_further_lines(self):
        item = paragraph(50)
        self.assertEqual(errors(f"- {item}\n- {item}\n"), [])
        self.assertEqual(len(errors(f"1. {item}\n   {item}\n")), 1)
        self.assertEqual(len(errors(f"- {item}\n\n    {words(41)}\n")), 1)

    def test_tables_are_no_paragraphs_but_their_sentences_count(self):
        self.assertEqual(errors(f"| a | b |\n|---|---|\n| {paragraph(90)} | {words(40)} |\n"), [])
        self.assertRegex(errors(f"| a |\n|---|\n| {words(41)} |\n")[0], r"^page.md:3: a sentence of 41")

    def test_code_comments_and_link_targets_are_not_counted(self):
        text = words(90)
        self.assertEqual(errors(f"```\n{text}\n```\n\n    {text}\n\n<!-- {text} -->\n"), [])
        self.assertEqual(errors(f"{words(39)} [a](b.md#{'c'.join('d' * 60)})."), [])
        self.assertEqual(errors(f"`{text}` {words(39)}."), [])


class Phrases(unittest.TestCase):
    def test_phrase_fails_in_text_items_headings_and_cells(self):
        for text in ("It is kept as it\nstands.", "- As it stands.", "## As it stands", "| As it stands |"):
            with self.subTest(text=text):
                self.assertRegex(errors(text)[0], r"^page.md:1: the phrase \"as it stands\"; better: ")

    def test_phrase_in_code_and_part_of_a_word_are_none(self):
        self.assertEqual(errors("`so many`, also manyfold, so manyfold"), [])

    def test_words_only_warn(self):
        found, warnings = plain.findings("page.md", "A library holds a table.")
        self.assertEqual(found, [])
        self.assertEqual(warnings, ["page.md:1: the word \"holds\""])


class Command(unittest.TestCase):
    def test_missing_page_is_an_error(self):
        with contextlib.redirect_stderr(io.StringIO()) as text:
            self.assertEqual(plain.main(["no/such/page.md"]), 2)
        self.assertIn("no/such/page.md cannot be read", text.getvalue())

    def test_exit_code_follows_errors_and_not_warnings(self):
        page = plain.ROOT / "page.md"
        for text, code in ((words(41), 1), ("Nobody.", 0), ("So many.", 1)):
            with self.subTest(text=text), contextlib.redirect_stdout(io.StringIO()):
                with unittest.mock.patch.object(plain.pathlib.Path, "read_text", return_value=text):
                    self.assertEqual(plain.main([str(page)]), code)


if __name__ == "__main__":
    unittest.main()
