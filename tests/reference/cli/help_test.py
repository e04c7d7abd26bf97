"""What list, --help and --version print."""

import json
import pathlib
import re

import pytest

import program

# The identifiers of all detectors, in the order of `list`. detector_sheet_test.cpp holds them against the
# catalogue.
DETECTORS_OF_QUERIES = ["exact", "root-finder", "fcl-intersect", "bullet-bernstein"]
DETECTORS = (pathlib.Path(__file__).parent / "detectors.txt").read_text().split()


def printed(*words):
    outcome = program.successful(*words)
    assert outcome.err == ""
    return outcome.out


def entries_of(section):
    """The lines of a section of `list` without its head: identifiers and what is said of them."""
    assert all(re.match(r"  \S+ ", line) for line in section.splitlines()[1:])
    return [tuple(line.split(maxsplit=1)) for line in section.splitlines()[1:]]


def fixture_entries(*files):
    documents = [json.loads(file.read_text(encoding="utf-8")) for file in files]
    return sorted((document["id"], document["title"]) for document in documents)


def test_list_names_every_suite_scene_and_detector_with_one_line():
    text = printed("list")
    suites, scenes, detectors, of_queries = text.split("\n\n")
    suite_files, scene_files = ([*(program.FIXTURES / kind).glob("*.json")] for kind in ("suites", "scenes"))
    assert suite_files and scene_files
    assert entries_of(suites) == fixture_entries(
        *suite_files, program.FIXTURES / "drawn.json", program.FIXTURES / "drawn-steps.json")
    assert entries_of(scenes) == fixture_entries(*scene_files)
    assert [entry[0] for entry in entries_of(detectors)] == DETECTORS
    assert [entry[0] for entry in entries_of(of_queries)] == DETECTORS_OF_QUERIES
    assert all(len(entry) == 2 for entry in entries_of(detectors) + entries_of(of_queries))
    assert "questions" not in text


def on_one_line(text):
    """With runs of blanks and line ends as one blank, so that it does not matter where lines break."""
    return " ".join(text.split())


def test_list_of_detectors_gives_the_sheet_of_each_within_a_hundred_columns():
    # That a sheet has all options with their defaults is in detector_sheet_test.cpp.
    summaries = dict(entries_of(printed("list").split("\n\n")[2]))
    text = printed("list", "--detectors")
    assert all(len(line.encode()) <= 100 for line in text.splitlines())
    text, of_queries = text.split("\n\nDetectors of queries (contactcheck queries)\n\n")
    sheets = of_queries.split("\n\n")
    assert [sheet.splitlines()[0] for sheet in sheets] == DETECTORS_OF_QUERIES
    assert all("\n  queries     vertex-face" in sheet for sheet in sheets)
    head, *sheets = text.split("\n\n")
    assert head.startswith("Detectors ")
    assert [sheet.splitlines()[0] for sheet in sheets] == DETECTORS
    for sheet in sheets:
        name, *rest = sheet.splitlines()
        absent = re.search(r" \[absent: (.*)\]$", summaries[name])
        summary = summaries[name][:absent.start()] if absent else summaries[name]
        assert on_one_line("\n".join(rest)).startswith(on_one_line(summary))
        if absent:
            assert f"\n  absent      {absent[1]}" in sheet
        else:
            assert all(f"\n  {part} " in sheet for part in ("questions", "contact", "numbers", "depth"))


def test_list_gives_only_what_is_asked_for():
    scenes, suites = printed("list", "--scenes"), printed("list", "--suites")
    assert "Scenes\n" in scenes and "bunny-touch" in scenes
    assert "Suites" not in scenes and "Detectors" not in scenes
    assert "Suites\n" in suites and "default" in suites
    assert "Scenes" not in suites and "Detectors" not in suites
    assert printed("list", "--suites", "--scenes") == suites + "\n" + scenes


# The first is the program itself.
COMMANDS = ["", "run", "reproduce", "reduce", "export", "list", "report", "truth", "defects", "diff", "gate",
            "accept", "ab", "tune", "merge", "init", "check"]


def help_of(command):
    return printed(*([command] if command else []), "--help")


@pytest.mark.parametrize("command", COMMANDS, ids=lambda command: command or "program")
def test_help_has_an_example(command):
    text = help_of(command)
    assert "Example" in text
    assert "\n  contactcheck " in text


@pytest.mark.parametrize("command", COMMANDS, ids=lambda command: command or "program")
def test_help_has_one_line_an_option_within_a_hundred_columns(command):
    for line in help_of(command).split("\nExample")[0].splitlines():
        assert len(line.encode()) <= 100
        assert not line.startswith(" " * 10), f"goes on: {line}"


def test_help_of_run_names_its_flags():
    text = help_of("run")
    for flag in ("--detector", "--frames", "--processes", "--seed", "--out", "--quiet", "--no-timing",
                 "--closed-loop", "--call-limit SECONDS", "--memory-limit MIB", "--json-lines",
                 "--shard K/N"):
        assert flag in text


def test_help_of_reproduce_names_its_flags_and_its_files():
    text = help_of("reproduce")
    for word in ("--frames", "--repeat", "--out", "--quiet", "reproduction.md", "reproduction.json",
                 "suite paper"):
        assert word in on_one_line(text)
    assert "--closed-loop" not in text, "it always is"


def test_help_of_export_names_its_flags_and_the_checker():
    text = on_one_line(help_of("export"))
    for word in ("--frames", "--every", "--between", "on straight paths between these frames", "--weld",
                 "--queries", "--certificates", "--out", "out/export", "check.py"):
        assert word in text


def test_help_does_not_show_the_workers_command():
    assert "worker" not in help_of("")


def test_version_is_printed():
    assert re.fullmatch(r"[0-9]+\.[0-9]+\.[0-9]+\n", printed("--version"))
