"""A plug-in of pytest that runs cases kept as data: a folder a case, with case.toml in it.

    python3 -m pytest -p cases [--rewrite] FOLDER|CASE.toml...    (PYTHONPATH=tests/support)

A case is a command of the program and what must be in its output:

    about = "Reports sum missed contacts over scenes."       # what is broken when the case fails
    command = ["report", "DIR/results.json", "--out", "DIR/out"]
    exit = 0                                                 # default 0
    before = [["run", "DIR/a.json", "--out", "DIR/old"]]     # commands run first; must exit with 0

    [files]                          # copied into DIR before anything runs: name = source
    "results.json" = "../sample.json"                        # relative to the case's folder

    [[change]]                       # of a JSON file in DIR, in this order
    file = "results.json"
    at = "/runs/2/message"           # JSON pointer; "-" appends to a list
    to = "one | two"                 # or null = true, or remove = true

    [[expect]]
    in = "out/report.md"             # "stdout", "stderr" or a file below DIR
    from = "## Summary"              # from the first line that begins so (default: the first line)
    to = "## Speed"                  # up to, without, the next line that begins so (default: the end)
    only = "ffd-"                    # of these, the lines in which this pattern is found
    lines = "summary.txt"            # are exactly those of this file in the case's folder
    contains = ["| 3 |"]             # all of these are somewhere in `in`
    absent = ["nan"]                 # none of these is

DIR stands for an empty folder, the working directory of the command; in outputs it is written DIR
again. In a file of lines {{PATTERN}} is a regular expression, for what differs from run to run.
Standard error must be empty where no [[expect]] names it.

A file of lines has at most 40; one that is missing, or in the folder and named by no case, fails.
--rewrite writes the files of lines anew, keeps lines whose patterns still hold, and prints each
difference; it refuses where CI is set.

A file whose name ends in _refusals.toml is a table of commands that must be refused (exit code 2, one
sentence on standard error, nothing on standard output, nothing written):

    [files]                                     # as above, for all of the table
    [Frames]                                    # a group; tests are named GROUP.NAME
    Fraction = {words = ["run", "--frames", "1.5"], named = ["--frames", "1.5"]}
    [Suite]
    each = {words = ["run", "DIR/u.json", "..."], named = ["DIR/u.json"]}   # what its cases share
    NoId = {write = {"u.json" = "{}"}, words = ["--quiet"], named = ["id is missing"]}

`words` of a case stand for the "..." of its group's; its other keys are added to those of the group:
`named` (pieces of the sentence), `write` (files by name, with this text), `change` (as above, but a
list) and `env` (variables of the environment). DIR is the folder in `words`, `named` and `env`.
"""

import copy
import difflib
import json
import os
import pathlib
import re
import shutil
import tempfile
import tomllib

import pytest

import program

MOST_LINES = 40
CASE_KEYS = {"about", "command", "exit", "before", "files", "change", "expect"}
REFUSAL_KEYS = {"words", "named", "write", "change", "env"}
EXPECT_KEYS = {"in", "from", "to", "only", "lines", "contains", "absent"}


class Broken(Exception):
    """The case, or what the program made of it, is not as it must be."""


def pytest_addoption(parser):
    parser.addoption("--rewrite", action="store_true", help="write files of expected lines anew")


def pytest_configure(config):
    if config.getoption("--rewrite") and os.environ.get("CI"):
        raise pytest.UsageError("--rewrite is for people, and CI is set")


def pytest_collect_file(parent, file_path):
    if file_path.name == "case.toml":
        return CaseFile.from_parent(parent, path=file_path)
    if file_path.name.endswith("_refusals.toml"):
        return RefusalsFile.from_parent(parent, path=file_path)
    return None


class Item(pytest.Item):
    def repr_failure(self, excinfo, style=None):
        if isinstance(excinfo.value, Broken):
            return str(excinfo.value)
        return super().repr_failure(excinfo, style)

    def reportinfo(self):
        return self.path, None, self.name


class CaseFile(pytest.File):
    def collect(self):
        yield CaseItem.from_parent(self, name=self.path.parent.name)


class RefusalsFile(pytest.File):
    def collect(self):
        table = tomllib.loads(self.path.read_text(encoding="utf-8"))
        files = table.pop("files", {})
        for group, cases in table.items():
            each = cases.pop("each", {})
            for name, case in cases.items():
                yield RefusalItem.from_parent(self, name=f"{group}.{name}", case=joined(each, case),
                                              files=files)


def joined(each, case):
    """A case of a table with what its group shares."""
    unknown = (set(each) | set(case)) - REFUSAL_KEYS
    if unknown:
        raise Broken(f"unknown keys: {sorted(unknown)}")
    shared, words = each.get("words", ["..."]), case.get("words", [])
    if "..." in shared:
        at = shared.index("...")
        words = [*shared[:at], *words, *shared[at + 1:]]
    elif words:
        raise Broken("no \"...\" in the words of the group stands for those of the case")
    else:
        words = shared
    out = {"words": words}
    for key in ("named", "change"):
        out[key] = each.get(key, []) + case.get(key, [])
    for key in ("write", "env"):
        out[key] = {**each.get(key, {}), **case.get(key, {})}
    if not out["named"]:
        raise Broken("a sentence has pieces to be named")
    return out


class RefusalItem(Item):
    def __init__(self, *, case, files, **kwargs):
        super().__init__(**kwargs)
        self.case, self.files = case, files

    def runtest(self):
        with scratch() as folder:
            write_files(self.files, self.path.parent, folder)
            for name, text in self.case["write"].items():
                target_in(folder, name).write_text(text, encoding="utf-8")
            for change in self.case["change"]:
                change_json(folder, change)
            env = dict(zip(self.case["env"], with_folder(self.case["env"].values(), folder)))
            program.refused(*with_folder(self.case["words"], folder),
                            named=with_folder(self.case["named"], folder), folder=folder, env=env)


class CaseItem(Item):
    @property
    def rewrite(self):
        """Writes a file of lines and shows the difference; None without --rewrite."""
        if not self.config.getoption("--rewrite"):
            return None

        def write(file, lines, difference):
            file.write_text("".join(line + "\n" for line in lines), encoding="utf-8")
            # pytest shows what a test prints only where it fails.
            with self.config.pluginmanager.getplugin("capturemanager").global_and_fixture_disabled():
                print(f"\n{file}: written\n{difference}")

        return write

    def runtest(self):
        case = tomllib.loads(self.path.read_text(encoding="utf-8"))
        home = self.path.parent
        check_case(case, home, self.rewrite)
        with scratch() as folder:
            write_files(case.get("files", {}), home, folder)
            for change in case.get("change", []):
                change_json(folder, change)
            for words in case.get("before", []):
                program.successful(*with_folder(words, folder), cwd=folder)
            outcome = program.contactcheck(*with_folder(case["command"], folder), cwd=folder)
            if outcome.exit_code != case.get("exit", 0):
                raise Broken(f"exit code {outcome.exit_code}, not {case.get('exit', 0)}\n{outcome.err}")
            texts = Texts(folder, outcome)
            expectations = case["expect"]
            if not any(expect["in"] == "stderr" for expect in expectations) and outcome.err:
                raise Broken(f"standard error is not empty:\n{outcome.err}")
            faults = [fault for expect in expectations
                      for fault in faults_of(expect, texts[expect["in"]], home, self.rewrite)]
        if faults:
            raise Broken(f"{case['about']}\n" + "\n".join(faults))


def scratch():
    return tempfile.TemporaryDirectory(prefix="contactcheck-")


def with_folder(words, folder):
    return [word.replace("DIR", str(folder)) for word in words]


def write_files(files, home, folder):
    for name, source in files.items():
        shutil.copyfile(home / source, target_in(folder, name))


def target_in(folder, name):
    """The path of a file to be written, whose folder is there."""
    target = pathlib.Path(folder) / name
    target.parent.mkdir(parents=True, exist_ok=True)
    return target


def check_case(case, home, rewrite):
    if not case.get("about") or not case.get("expect"):
        raise Broken("a case has `about` and at least one [[expect]]")
    unknown = set(case) - CASE_KEYS
    for expect in case["expect"]:
        unknown |= set(expect) - EXPECT_KEYS
        if not {"lines", "contains", "absent"} & set(expect):
            raise Broken(f"[[expect]] in {expect.get('in')} demands nothing")
    if unknown:
        raise Broken(f"unknown keys: {sorted(unknown)}")
    lines = {expect["lines"] for expect in case["expect"] if "lines" in expect}
    used = lines | set(case.get("files", {}).values()) | {"case.toml"}
    unused = program.names_in(home) - used
    if unused:
        raise Broken(f"nothing in case.toml names {sorted(unused)}")
    missing = [name for name in lines if not (home / name).is_file()]
    if missing and not rewrite:
        raise Broken(f"missing: {sorted(missing)}; --rewrite writes them")


def change_json(folder, change):
    file = pathlib.Path(folder) / change["file"]
    document = json.loads(file.read_text(encoding="utf-8"))
    place, last = program.place_at(document, change["at"])
    if change.get("remove"):
        del place[last]
    else:
        place[last] = None if change.get("null") else copy.deepcopy(change["to"])
    file.write_text(json.dumps(document), encoding="utf-8")


class Texts:
    """The outputs by name, with DIR for the folder."""

    def __init__(self, folder, outcome):
        self._folder = folder
        self._streams = {"stdout": outcome.out, "stderr": outcome.err}

    def __getitem__(self, name):
        text = self._streams.get(name)
        if text is None:
            file = pathlib.Path(self._folder) / name
            if not file.is_file():
                raise Broken(f"{name} was not written")
            text = file.read_text(encoding="utf-8")
        return text.replace(str(self._folder), "DIR")


def part_of(text, expect):
    """The lines of `text` that an expectation is about."""
    lines = text.splitlines()
    begin, end = 0, len(lines)
    if "from" in expect:
        begin = next((i for i, line in enumerate(lines) if line.startswith(expect["from"])), None)
        if begin is None:
            raise Broken(f"{expect['in']}: no line begins with \"{expect['from']}\":\n{text}")
    if "to" in expect:
        end = next((i for i in range(begin + 1, end) if lines[i].startswith(expect["to"])), None)
        if end is None:
            raise Broken(f"{expect['in']}: no later line begins with \"{expect['to']}\":\n{text}")
    return [line for line in lines[begin:end] if re.search(expect.get("only", ""), line)]


def as_pattern(line):
    parts = re.split(r"\{\{(.*?)\}\}", line)
    return "".join(part if i % 2 else re.escape(part) for i, part in enumerate(parts))


def holds(expected, line):
    return re.fullmatch(as_pattern(expected), line) is not None


def faults_of(expect, text, home, rewrite):
    faults = [f"{expect['in']} does not contain \"{piece}\":\n{text}"
              for piece in expect.get("contains", []) if piece not in text]
    faults += [f"{expect['in']} contains \"{piece}\"" for piece in expect.get("absent", [])
               if piece in text]
    if "lines" not in expect:
        return faults
    file, actual = home / expect["lines"], part_of(text, expect)
    expected = file.read_text(encoding="utf-8").splitlines() if file.is_file() else []
    if len(actual) > MOST_LINES:
        return [*faults, f"{file.name}: {len(actual)} lines; at most {MOST_LINES} show what a case is about"]
    same = len(expected) == len(actual) and all(map(holds, expected, actual))
    if same and actual:
        return faults
    if not actual:
        return [*faults, f"{file.name}: no line of {expect['in']} is asked for"]
    # Lines whose patterns hold are no difference.
    shown = [next((e for e in expected if holds(e, line)), line) for line in actual]
    difference = "\n".join(difflib.unified_diff(expected, shown, file.name, expect["in"], lineterm=""))
    if rewrite:
        rewrite(file, shown, difference)
        return faults
    return [*faults, difference]
