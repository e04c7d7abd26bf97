#!/usr/bin/env python3
"""Tables and figures of the pages are made of results.

    texts.py publish NAME RESULTS --seconds N   fixtures/published/NAME.json from a results.json or
                     [--commit COMMIT]          reproduction.json; N: how long its command took;
                                                COMMIT: of the program
    texts.py write                              all tables and figures of the pages
    texts.py check                              exit code 1 where a page and the files differ

A table stands between `<!-- table: NAME -->` and `<!-- end -->` (TABLES in tables.py). A figure in
a sentence has no mark, for readers of the plain text: tests/texts/figures.json lists, under "made",
pieces of sentences with {figures} (`figures` in tables.py); the page must have each, filled in,
exactly once. The README's picture is headline.py's. Any other number of a page, outside code and links, needs an entry under "fixed": the
words around it, and why they are right. .ci/tools/publish makes the results and does all of this.
"""

import argparse
import pathlib
import re
import sys

from headline import headline_svg
from published import FILES, FOLDER, ROOT, TextError, files_of, published, read_json
from tables import TABLES, figures

LIST = pathlib.Path("tests") / "texts" / "figures.json"
PICTURE = pathlib.Path(".github") / "headline.svg"
MARKED = re.compile(r"(<!-- table: (\S+) -->\n)(.*?)(<!-- end -->|(?=<!-- table:)|\Z)", re.DOTALL)
FIELD = re.compile(r"\{([^{}]+)\}")
# What is no text for a reader: fenced and indented code, code in a line, comments, link targets.
NO_TEXT = re.compile(r"^```.*?^```$|^ {4}.*?$|`[^`\n]+`|<!--.*?-->|\]\([^)\n]*\)|https?://\S+",
                     re.DOTALL | re.MULTILINE)
# A number; not the digits of a name like AVX2 or sphere2.
NUMBER = re.compile(r"(?<![A-Za-z0-9])\d(?:[\d.,]*\d)?")


def read_list(root):
    entries = read_json(root / LIST, LIST)
    made, fixed = entries["made"], entries["fixed"]
    return {page: (made.get(page, []), fixed.get(page, {})) for page in sorted({*made, *fixed})}


def read_page(root, page):
    try:
        return (root / page).read_text(encoding="utf-8")
    except OSError as error:
        raise TextError(f"{page} cannot be read: {error.strerror}") from error


def place(page, text, position):
    return f"{page}:{text.count(chr(10), 0, position) + 1}"


def made_table(name, files):
    if name not in TABLES:
        raise TextError(f"there is no table {name}; there are {', '.join(TABLES)}")
    try:
        return f"\n{TABLES[name](files)}\n\n"
    except KeyError as error:
        raise TextError(f"the results of table {name} have no {error}") from error


def pattern_of(piece):
    """Finds the piece with any figures, which begin with a digit; one group a figure."""
    parts = FIELD.split(piece)
    if not parts[0] or not parts[-1]:
        raise TextError(f"{LIST}: \"{piece}\" begins or ends with a figure; it needs words there")
    return re.compile("".join(re.escape(part) if i % 2 == 0 else r"(\d(?:[^\n|]{0,60}?\S)?)"
                              for i, part in enumerate(parts)))


def made_piece(piece, values):
    def value(match):
        if match[1] not in values:
            raise TextError(f"{LIST}: \"{piece}\" names {match[1]}, which is no figure")
        return values[match[1]]()
    return FIELD.sub(value, piece)


def found_once(page, text, piece):
    found = list(pattern_of(piece).finditer(text))
    if len(found) != 1:
        raise TextError(f"{page} has {len(found)} places for \"{piece}\" of {LIST}; one is needed")
    return found[0]


def written_page(page, text, pieces, files, values):
    def new(match):
        if not match[4]:
            where = place(page, text, match.start())
            raise TextError(f"{where}: table {match[2]} has no <!-- end -->")
        return match[1] + made_table(match[2], files) + match[4]
    text = MARKED.sub(new, text)
    for piece in pieces:
        match = found_once(page, text, piece)
        text = text[:match.start()] + made_piece(piece, values) + text[match.end():]
    return text


def table_errors(page, text, files):
    for match in MARKED.finditer(text):
        where = place(page, text, match.start())
        if not match[4]:
            yield f"{where}: table {match[2]} has no <!-- end -->"
            continue
        try:
            wanted = made_table(match[2], files).splitlines()
        except TextError as error:
            yield f"{where}: {error}"
            continue
        has = match[3].splitlines()
        for i in range(max(len(has), len(wanted))):
            old, new = (lines[i] if i < len(lines) else "no such line" for lines in (has, wanted))
            if old != new:
                line = text.count("\n", 0, match.start(3)) + 1 + i
                yield (f"{page}:{line}: table {match[2]} has\n    {old}\n"
                       f"  the results say\n    {new}")
                break


def piece_errors(page, text, pieces, values):
    for piece in pieces:
        try:
            match = found_once(page, text, piece)
            wanted = made_piece(piece, values)
            if match[0] != wanted:
                yield (f"{place(page, text, match.start())}: the page says\n    {match[0]}\n"
                       f"  the results say\n    {wanted}")
        except TextError as error:
            yield str(error)


def stray_errors(page, text, pieces, fixed):
    """Numbers that stand in no table, piece or entry, and entries that the page does not have."""
    bare = list(text)

    def blank(start, end):
        for i in range(start, end):
            if bare[i] != "\n":
                bare[i] = " "

    for match in [*MARKED.finditer(text), *NO_TEXT.finditer(text)]:
        blank(*match.span())
    for piece in pieces:
        for match in pattern_of(piece).finditer(text):
            blank(*match.span())
    for words, why in fixed.items():
        if not why.strip():
            yield f"{LIST}: \"{words}\" of {page} has no reason"
        found = [match.span() for match in re.finditer(re.escape(words), text)]
        if not found:
            yield f"{page} has no words \"{words}\", an entry of {LIST}"
        elif not any(NUMBER.search("".join(bare[start:end])) for start, end in found):
            yield f"{LIST}: \"{words}\" of {page} has no number that needs an entry"
        for span in found:
            blank(*span)
    bare = "".join(bare)
    for match in NUMBER.finditer(bare):
        around = text[max(0, match.start() - 30):match.end() + 30].replace("\n", " ")
        yield (f"{place(page, text, match.start())}: {match[0]} in \"{around}\" stands in no table "
               f"and in no entry of {LIST}")


def check(root):
    """All errors, in the order of pages."""
    errors, shown = [], set()
    try:
        pages = read_list(root)
        files = files_of(root)
    except TextError as error:
        return [str(error)]
    values = figures(files)
    for path in sorted((root / FOLDER).iterdir()):
        if path.suffix != ".json" or path.stem not in FILES:
            errors.append(f"{FOLDER / path.name} is no published file")
    for page, (pieces, fixed) in pages.items():
        try:
            text = read_page(root, page)
            shown |= {match[2] for match in MARKED.finditer(text)}
            errors += table_errors(page, text, files)
            errors += piece_errors(page, text, pieces, values)
            errors += stray_errors(page, text, pieces, fixed)
        except TextError as error:
            errors.append(str(error))
    try:
        if read_page(root, PICTURE) != headline_svg(files):
            errors.append(f"{PICTURE} is not the picture of {FOLDER / 'default.json'}")
    except TextError as error:
        errors.append(str(error))
    # Its markers are gone: then nothing holds it against the results any more.
    errors += [f"no page has the table {name}" for name in TABLES if name not in shown]
    return errors


def write(root):
    files = files_of(root)
    values = figures(files)
    new = {page: written_page(page, read_page(root, page), pieces, files, values)
           for page, (pieces, _) in read_list(root).items()}
    new[PICTURE] = headline_svg(files)
    for page, text in new.items():
        (root / page).write_text(text, encoding="utf-8")


def main(arguments, root=ROOT):
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    publish = commands.add_parser("publish")
    publish.add_argument("name", metavar="NAME")
    publish.add_argument("results", metavar="RESULTS", type=pathlib.Path)
    publish.add_argument("--seconds", type=float, required=True)
    publish.add_argument("--commit", default="")
    commands.add_parser("write")
    commands.add_parser("check")
    options = parser.parse_args(arguments)
    try:
        if options.command == "publish":
            text = published(options.name, options.results, options.seconds, options.commit)
            (root / FOLDER / f"{options.name}.json").write_text(text, encoding="utf-8")
        elif options.command == "write":
            write(root)
        else:
            errors = check(root)
            print("\n".join(errors) or "all tables and figures are those of fixtures/published")
            return 1 if errors else 0
    except TextError as error:
        print(error, file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
