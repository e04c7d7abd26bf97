#!/usr/bin/env python3
"""Are the pages easy to read? plain.py [PAGE ...]
What does the program say? plain.py --program PROGRAM

Without arguments it checks PAGES, with --program the help texts of all commands and the reports of
two small runs. Exit code 1 for a paragraph of more than 80 words (README.md: 60),
a sentence of more than 40, or a phrase of PHRASES; a word of WORDS is only a warning. A list item is
a paragraph. Tables are no paragraphs, but their sentences and phrases count. Code is not checked; a
piece of code within a line is one word. What a check cannot see, a reader has to: a text may pass
and be bad.
"""

import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]

PAGES = [
    "README.md", "core/detect/README.md", "core/lazy/README.md", "fixtures/README.md",
    "fixtures/hard/README.md", "fixtures/policies/README.md", "reference/adapters/README.md",
    "reference/README.md", "reference/cli/README.md",
    "reference/packaging/README.md", "reference/plugin/README.md", "reference/reproduce/README.md",
    "reference/suite/sweep/README.md", "reference/queries/README.md", "reference/tune/README.md",
]

PARAGRAPH_WORDS = 80
FRONT_PAGE_WORDS = 60  # of a paragraph of README.md
SENTENCE_WORDS = 40

# Each with what to write instead.
PHRASES = {
    "as it stands": "unchanged, identical",
    "as they stand": "unchanged, identical",
    "asks nothing of": "self-contained, needs no",
    "by whoever": "name the reader or the program",
    "has ended in an error": "status `error`",
    "in one piece": "one run, not sharded",
    "is none": "name what is missing",
    "nobody else": "no other ...",
    "of its own": "own, separate",
    "of one's own": "your own",
    "put together": "assemble, merge",
    "read it so": "how to read the table",
    "reported and none": "spurious",
    "so many": "N, this many",
    "takes down": "records",
    "times aside": "except timings",
    "what is really there": "ground truth",
    "what was accepted": "baseline",
    "who invents": "spurious contacts",
    "who misses": "missed contacts",
}
WORDS = ["beside", "holds", "invented", "invents", "nobody", "parted", "unparted", "who", "whoever"]

FENCE = re.compile(r"^ *```")
ITEM = re.compile(r"^ *(?:[-*+]|\d+\.) +")
COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)
LINK = re.compile(r"!?\[([^\]]*)\]\([^)]*\)")
CODE = re.compile(r"`[^`\n]*`")
WORD = re.compile(r"[^\W_]")
SENTENCE_END = re.compile(r"(?<=[.!?])[)\"*_]*\s+(?=[\"(*_\[]*[A-Z0-9§])")
CELL_END = re.compile(r"(?<=[.!?])[)\"*_]*\s+(?=[\"(*_\[]*[A-Z0-9§])|;\s")


def count(text):
    return sum(1 for word in text.split() if WORD.search(word) or "§" in word)


def blocks(text):
    """(line, kind, text) of every paragraph, list item ("text") and cell of a table ("cell")."""
    text = COMMENT.sub(lambda match: "\n" * match[0].count("\n"), text)
    lines, found, start, fenced, in_list = [], [], 0, False, False

    def end():
        if lines:
            found.append((start, "text", " ".join(lines)))
        lines.clear()

    for number, line in enumerate(text.splitlines(), 1):
        if FENCE.match(line):
            end()
            fenced = not fenced
        elif fenced:
            continue
        elif not line.strip():
            end()
        elif line.startswith("#"):
            end()
            in_list = False
            found.append((number, "text", line.lstrip("# ")))
        elif line.lstrip().startswith("|"):
            end()
            in_list = False
            cells = re.split(r"(?<!\\)\|", line.strip().strip("|"))
            found += [(number, "cell", cell.strip()) for cell in cells]
        elif ITEM.match(line):
            end()
            start, in_list = number, True
            lines.append(ITEM.sub("", line))
        elif not lines and line.startswith("    ") and not in_list:
            continue
        else:
            if not lines:
                start, in_list = number, in_list and line.startswith(" ")
            lines.append(line.strip())
    end()
    # Code becomes one letter: one word, no phrase, no end of a sentence.
    return [(number, kind, CODE.sub("§", LINK.sub(r"\1", block))) for number, kind, block in found]


def help_as_page(text):
    """Each command and option a list item, in its own words; examples are code."""
    lines = []
    for line in text.splitlines():
        entry = re.match(r"^ {2,}\S.*? {2,}(\S.*)$", line)
        if line.startswith("  contactcheck "):
            continue
        if entry:
            lines.append("- " + entry[1])
        elif line.startswith("  ") and lines and lines[-1].startswith("- "):
            lines[-1] += " " + line.strip()
        else:
            lines.append("" if line.endswith(":") else line)
    return "\n".join(lines)


def said_by(program):
    """By name, what the program says as pages."""
    def run(*words):
        done = subprocess.run([program, *words], capture_output=True, text=True, check=True)
        return done.stdout
    top = run("--help")
    commands = re.findall(r"^  ([a-z]+)  ", top.partition("Subcommands:")[2], re.MULTILINE)
    said = {f"{command or 'contactcheck'} --help": help_as_page(run(*command.split(), "--help"))
            for command in ("", *commands)}
    for words in (["bunny-touch", "--frames", "4", "--processes", "1"],
                  ["hard-balls-scale", "--no-timing"]):
        with tempfile.TemporaryDirectory() as out:
            run("run", *words, "--detector", "fcl-aabb", "--detector", "ffd-aabb", "--detector",
                "libccd-gjk", "--quiet", "--out", out)
            report = (pathlib.Path(out) / "report.md").read_text(encoding="utf-8")
            said[f"report.md of {words[0]}"] = report
    return said


def findings(page, text):
    """Errors and warnings, in the order of lines."""
    errors, warnings = [], []
    most = FRONT_PAGE_WORDS if page == "README.md" else PARAGRAPH_WORDS
    for line, kind, block in blocks(text):
        where = f"{page}:{line}"
        if kind == "text" and count(block) > most:
            errors.append(f"{where}: a paragraph of {count(block)} words, at most {most} are "
                          f"allowed: \"{block[:60]}...\"")
        for sentence in (CELL_END if kind == "cell" else SENTENCE_END).split(block):
            if count(sentence) > SENTENCE_WORDS:
                errors.append(f"{where}: a sentence of {count(sentence)} words, at most "
                              f"{SENTENCE_WORDS} are allowed: \"{sentence[:60]}...\"")
        for phrase, better in PHRASES.items():
            if re.search(r"\b" + re.escape(phrase) + r"\b", block, re.IGNORECASE):
                errors.append(f"{where}: the phrase \"{phrase}\"; better: {better}")
        for word in WORDS:
            if re.search(r"\b" + word + r"\b", block, re.IGNORECASE):
                warnings.append(f"{where}: the word \"{word}\"")
    return errors, warnings


def main(arguments):
    failed = False
    if arguments[:1] == ["--program"]:
        texts = said_by(arguments[1])
    else:
        try:
            texts = {page: (ROOT / page).read_text(encoding="utf-8") for page in arguments or PAGES}
        except OSError as error:
            print(f"{error.filename} cannot be read: {error.strerror}", file=sys.stderr)
            return 2
    for page, text in texts.items():
        errors, warnings = findings(page, text)
        for warning in warnings:
            print(f"warning: {warning}")
        for error in errors:
            print(error)
        failed = failed or bool(errors)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
