"""The kept verdicts on the mutants of both kinds, one line per mutant: tests/faults/verdicts.json for
mutants of core, tests/faults/product_verdicts.json for mutants of the whole product.

A verdict is kept with a key: a hash of the patch, the files that it changes and what judges it.
When any of these changes, the verdict is stale: it says nothing, and the mutant must be judged
again.
"""

import collections
import hashlib
import json
import pathlib
import re
import tempfile

from mutant_build import DOES_NOT_APPLY, ROOT, Failure, Mutant, patched_copy
from mutant_verdict import WORDS, Verdict
from product_verdict import COMMANDS, FIXTURES

FOLDER = ROOT / "tests" / "faults"
SCRIPTS = ["tests/faults/mutant_build.py", "tests/faults/mutant_verdict.py"]
PRODUCT_SCRIPTS = ["tests/faults/check_results.py", "tests/faults/mutant_build.py",
                   "tests/faults/product_verdict.py"]

# `folder` and `file_name`: where the patches and the verdicts are; `sources`: what a change of lets
# other mutants be drawn.
Kind = collections.namedtuple("Kind", "name folder file_name sources")
CORE = Kind("core", "mutants", "verdicts.json", ["core"])
PRODUCT = Kind("product", "product", "product_verdicts.json", ["core", "reference"])
KINDS = [CORE, PRODUCT]


def file_of(kind):
    return FOLDER / kind.file_name


def kind_of(mutant):
    return PRODUCT if mutant.caught_by else CORE


def mutants(kind):
    """All of them, by name."""
    return [Mutant(path) for path in sorted((FOLDER / kind.folder).glob("*.patch"))]


def judging_files():
    """The sources under tests/ of the judge of core, with the scripts that build and run it. It reads
    no fixtures."""
    found = set()
    todo = [path.relative_to(ROOT).as_posix() for path in FOLDER.glob("mutant_*.*")
            if path.suffix in (".h", ".cpp")]
    while todo:
        name = todo.pop()
        if name in found or not (ROOT / name).is_file():
            continue
        found.add(name)
        # A source stands beside its header.
        for header in re.findall(r'^#include "(tests/[^"]*)\.h"',
                                 (ROOT / name).read_text(encoding="utf-8"), re.MULTILINE):
            todo += [header + ".h", header + ".cpp"]
    return sorted(found) + SCRIPTS


def digest_of(names):
    """Of names and contents; a file that is not there has none."""
    digest = hashlib.sha256()
    for name in names:
        path = ROOT / name
        contents = path.read_bytes() if path.is_file() else b""
        digest.update(f"{name}\0{len(contents)}\0".encode() + contents)
    return digest.hexdigest()


def key_of(mutant, judged_by):
    """`judged_by`: the digest of the files that judge this mutant."""
    parts = "\0".join([mutant.text, digest_of(mutant.files), judged_by])
    return hashlib.sha256(parts.encode()).hexdigest()


def keys_of(some_mutants):
    """The product judges its own mutants: of it, only the scripts and the data that say what is
    demanded are in their keys, else every change of the program would make all verdicts stale."""
    core = digest_of(judging_files())
    product = {command: digest_of(PRODUCT_SCRIPTS + FIXTURES.get(command, []))
               for command in {mutant.caught_by for mutant in some_mutants}}
    return {mutant.name: key_of(mutant, product[mutant.caught_by] if mutant.caught_by else core)
            for mutant in some_mutants}


def read(kind):
    """(key, Verdict) by mutant."""
    file = file_of(kind)
    codes = {word: code for code, word in WORDS.items()}
    try:
        lines = json.loads(file.read_text(encoding="utf-8"))
        return {name: (str(line["key"]), Verdict(codes[line["verdict"]], str(line["by"])))
                for name, line in lines.items()}
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        raise Failure(DOES_NOT_APPLY, f"{file}: cannot be read: {error!r}") from error


def text_of(kept):
    lines = [f"  {json.dumps(name)}: " + json.dumps(
        {"key": key, "verdict": WORDS[verdict.code], "by": verdict.by})
        for name, (key, verdict) in sorted(kept.items())]
    return "{\n" + ",\n".join(lines) + "\n}\n"


# Of an absolute path: they are of one machine alone.
FOLDERS = re.compile(r"(?<![^\s\"'=(])/(?:[^/\s]+/)+")


def write(kept, kind):
    """Those of mutants that are there; of absolute paths the last name alone."""
    names = {mutant.name for mutant in mutants(kind)}
    lines = {name: (key, Verdict(verdict.code, FOLDERS.sub("", verdict.by)))
             for name, (key, verdict) in kept.items() if name in names}
    file_of(kind).write_text(text_of(lines), encoding="utf-8")


def faults(kind):
    """What is wrong with patches and kept verdicts, one line each; nothing is built."""
    kept = read(kind)
    found = []
    if file_of(kind).read_text(encoding="utf-8") != text_of(kept):
        found.append(f"{kind.file_name}: not sorted, with one mutant a line, as --write writes it")
    names = set()
    for mutant in mutants(kind):
        names.add(mutant.name)
        if kind == PRODUCT and mutant.caught_by not in COMMANDS:
            found.append(f"{mutant.name}: the second line is no \"# Caught-by: COMMAND\" with one of "
                         f"{', '.join(COMMANDS)}")
        # Judging all of the product's takes hours; one that was not judged is stale.
        if mutant.name not in kept and kind != PRODUCT:
            found.append(f"{mutant.name}: no verdict is kept")
    # Those that are only slower have no verdict; the nightly run and proofs of the gate build them.
    slower = [Mutant(path) for path in sorted((FOLDER / "slow").glob("*.patch"))]
    for mutant in mutants(kind) + (slower if kind != PRODUCT else []):
        try:
            with tempfile.TemporaryDirectory(prefix="mutant-") as scratch:
                patched_copy(mutant, pathlib.Path(scratch))
        except Failure as failure:
            found.append(f"{mutant.name}: does not apply: {failure}")
    for name, (key, verdict) in kept.items():
        if name not in names:
            found.append(f"{name}: a verdict is kept, but there is no such mutant")
        if not re.fullmatch("[0-9a-f]{64}", key):
            found.append(f"{name}: \"{key}\" is no key: 64 hexadecimal digits")
        if FOLDERS.search(verdict.by):
            found.append(f"{name}: \"{verdict.by}\" names a folder of one machine")
        if verdict.code != 0:
            found.append(f"{name}: {WORDS[verdict.code]}: {verdict.by}")
    return found
