"""The kept verdicts on the mutants: tests/faults/verdicts.json, one line per mutant.

A verdict is kept with a key: a hash of the patch, the files that it changes and what judges it.
When any of these changes, the verdict is stale: it says nothing, and the mutant must be judged
again.
"""

import hashlib
import json
import pathlib
import re
import tempfile

from mutant_build import DOES_NOT_APPLY, ROOT, Failure, Mutant, patched_copy
from mutant_verdict import WORDS, Verdict

FOLDER = ROOT / "tests" / "faults"
FILE = FOLDER / "verdicts.json"
SCRIPTS = ["tests/faults/mutant_build.py", "tests/faults/mutant_verdict.py"]


def mutants():
    """All of them, by name."""
    return [Mutant(path) for path in sorted((FOLDER / "mutants").glob("*.patch"))]


def judging_files():
    """The judge's sources under tests/ with the scripts that build and run it. The judge reads no
    fixtures."""
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
    judged_by = digest_of(judging_files())
    return {mutant.name: key_of(mutant, judged_by) for mutant in some_mutants}


def read():
    """(key, Verdict) by mutant."""
    codes = {word: code for code, word in WORDS.items()}
    try:
        lines = json.loads(FILE.read_text(encoding="utf-8"))
        return {name: (str(line["key"]), Verdict(codes[line["verdict"]], str(line["by"])))
                for name, line in lines.items()}
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        raise Failure(DOES_NOT_APPLY, f"{FILE}: cannot be read: {error!r}") from error


def text_of(kept):
    lines = [f"  {json.dumps(name)}: " + json.dumps(
        {"key": key, "verdict": WORDS[verdict.code], "by": verdict.by})
        for name, (key, verdict) in sorted(kept.items())]
    return "{\n" + ",\n".join(lines) + "\n}\n"


def write(kept):
    """Those of mutants that are there."""
    names = {mutant.name for mutant in mutants()}
    FILE.write_text(text_of({name: line for name, line in kept.items() if name in names}),
                    encoding="utf-8")


def faults():
    """What is wrong with patches and kept verdicts, one line each; nothing is built."""
    kept = read()
    found = []
    if FILE.read_text(encoding="utf-8") != text_of(kept):
        found.append(f"{FILE.name}: not sorted, with one mutant a line, as --write writes it")
    names = set()
    for mutant in mutants():
        names.add(mutant.name)
        if mutant.name not in kept:
            found.append(f"{mutant.name}: no verdict is kept")
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
        if verdict.code != 0:
            found.append(f"{name}: {WORDS[verdict.code]}: {verdict.by}")
    return found
