"""Plug-ins that answer queries of moving elements, and what `contactcheck queries` makes of them."""

import json
import os
import pathlib
import shlex
import sys

import pytest

from program import contactcheck, refused, successful

LIBRARY = os.environ["CONTACTCHECK_IMPACT_LIBRARY"]
COMMAND_FILE = pathlib.Path(__file__).with_name("impact_command.py")

TRIANGLE = "0,1,0,1,0,1\n4,1,0,1,0,1\n0,1,4,1,0,1\n"


def falls(start, end):
    """A vertex over a resting triangle, from a height to another."""
    return f"1,1,1,1,{start},1\n{TRIANGLE}1,1,1,1,{end},1\n{TRIANGLE}"


# Contact at half the step; the third query has none: it stays 2 m away.
QUERIES = falls(1, -1) + falls(1, -1) + falls(4, 2) + falls(1, -1)


def command(fault):
    return shlex.join([sys.executable, "-B", str(COMMAND_FILE), fault])


def queries_file(folder):
    file = folder / "vf.csv"
    file.write_text(QUERIES, encoding="utf-8")
    return file


class Judged:
    """`contactcheck queries` on QUERIES with one detector and `exact` behind it."""

    def __init__(self, folder, *words):
        out = folder / "out"
        self.outcome = contactcheck("queries", queries_file(folder), *words, "--detector", "exact",
                                    "--out", out)
        assert (out / "queries.json").exists(), self.outcome.err
        document = json.loads((out / "queries.json").read_text(encoding="utf-8"))
        self.rows = {row["detector"]: row for row in document["files"][0]["detectors"]}
        exact = self.rows.pop("exact")
        assert exact["queries"] == 4 and exact["score"]["missed"] == exact["score"]["spurious"] == 0

    @property
    def row(self):
        row, = self.rows.values()
        return row


def words_of(way, fault):
    if way == "library":
        return ("--detector", f"{LIBRARY}:fault={fault}")
    return ("--detector-cmd", command(fault))


WAYS = ["library", "command"]


@pytest.mark.parametrize("way", WAYS)
def test_answers_are_judged(way, tmp_path):
    judged = Judged(tmp_path, *words_of(way, "none"))
    assert judged.outcome.exit_code == 0, judged.outcome.err
    row = judged.row
    assert row["queries"] == 4 and row["errors"] == 0
    assert (row["score"]["hit"], row["score"]["spurious"]) == (3, 1)
    assert row["score"]["first_spurious"] == 17
    assert row["time_of_contact"]["timed"] == 3
    assert row["time_of_contact"]["early_max"] == row["time_of_contact"]["late_max"] == 0
    assert row["microseconds"]["worst"] > 0


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("fault, near", [("of-start", 1), ("own-tolerance", 1), ("none", 0)])
def test_tolerances_are_those_that_it_declares_or_returns(way, fault, near, tmp_path):
    score = Judged(tmp_path, *words_of(way, fault)).row["score"]
    assert (score["near"], score["spurious"]) == (near, 1 - near)


def test_cap_limits_what_tolerances_excuse(tmp_path):
    for cap, near in (("--cap=2", 1), ("--cap=1.9", 0)):
        score = Judged(tmp_path, *words_of("library", "own-tolerance"), cap).row["score"]
        assert score["near"] == near, cap
    for cap, near in (("--cap-of-start=0.5", 1), ("--cap-of-start=0.49", 0)):
        score = Judged(tmp_path, *words_of("library", "of-start"), cap).row["score"]
        assert score["near"] == near, cap


@pytest.mark.parametrize("way, fault", [
    ("library", "nan-time"),  # JSON has no NaN
    *((way, fault) for way in WAYS for fault in ("late-time", "bad-tolerance"))])
def test_impossible_numbers_are_errors(way, fault, tmp_path):
    judged = Judged(tmp_path, *words_of(way, fault))
    assert judged.outcome.exit_code == 3
    assert judged.row["errors"] == 1 and judged.row["first_error"] == 17
    assert judged.row["score"]["hit"] == 3


def test_a_command_is_warmed_up_by_other_queries(tmp_path):
    score = Judged(tmp_path, "--detector-cmd", command("warm")).row["score"]
    assert (score["hit"], score["spurious"], score["reported"]) == (3, 1, 4)


@pytest.mark.parametrize("way", WAYS)
def test_refused_query_is_neither_hit_nor_missed(way, tmp_path):
    judged = Judged(tmp_path, *words_of(way, "refuses"))
    assert judged.outcome.exit_code == 0, judged.outcome.err
    assert judged.row["refused"] == 1
    assert judged.row["score"]["reported"] == 3


@pytest.mark.parametrize("way, fault, pieces, flags", [
    ("library", "crash", ["signal 11"], []),
    ("library", "exit", ["exit code 0"], []),
    ("library", "hang", ["no answer for 1.5 s (time limit of one call)"], ["--call-limit", "1.5"]),
    ("library", "memory", ["more than 400 MiB resident (memory limit)"], ["--memory-limit", "400"]),
    ("library", "floods", ["wrote without end (output limit)"], []),
    ("library", "fails", ["impact failed: not today"], []),
    ("library", "flushes-to-zero", ["changed the floating-point environment: flush-to-zero"], []),
    ("command", "crash", ["signal 11"], []),
    ("command", "exit", ["exit code 0"], []),
    ("command", "hang", ["no answer for 1.5 s (time limit of one call)"], ["--call-limit", "1.5"]),
    ("command", "fails", ["not today"], []),
    ("command", "prints", ["standard output is for messages alone"], []),
    ("command", "no-contact", ["contact"], []),
    ("command", "other-kinds", ["answers other kinds of queries with these options"], []),
    ("library", "other-kinds", ["answers other kinds of queries with these options"], []),
    ("library", "other-precision", ["computes in another precision with these options"], []),
])
def test_failure_ends_its_row_alone(way, fault, pieces, flags, tmp_path):
    judged = Judged(tmp_path, *words_of(way, fault), *flags)
    assert judged.outcome.exit_code == 3
    row = judged.row
    at_start = fault.startswith("other-")
    assert row["failed_at"] == (1 if at_start else 17)
    assert row["queries"] == (0 if at_start else 2), "those before it are judged"
    for piece in pieces:
        assert piece in row["failure"]
    assert row["failure"] in judged.outcome.out


def by_default(fault):
    return {"CONTACTCHECK_PLUGIN_FAULT": "default", "CONTACTCHECK_DEFAULT_FAULT": fault}


def test_kinds_that_it_does_not_declare_are_not_asked(tmp_path):
    edges = tmp_path / "ee.csv"
    edges.write_text(QUERIES, encoding="utf-8")
    for fault, rows in (("none", []), ("both-kinds", ["impacts"])):
        successful("queries", edges, "--detector", LIBRARY, "--out", tmp_path, env=by_default(fault))
        document = json.loads((tmp_path / "queries.json").read_text(encoding="utf-8"))
        assert [row["detector"] for row in document["files"][0]["detectors"]] == rows


@pytest.mark.parametrize("way", WAYS)
def test_single_precision_is_judged_on_the_floats(way, tmp_path, monkeypatch):
    assert "score_fed" not in Judged(tmp_path, *words_of(way, "none")).row
    for name, value in by_default("single").items():
        monkeypatch.setenv(name, value)
    row = Judged(tmp_path, *words_of(way, "single")).row
    assert row["precision"] == "single" and row["score_fed"]["hit"] == 3


# ---- refused before anything is judged


@pytest.mark.parametrize("fault, pieces", [
    ("size", ["gives contactcheck_impact_query a size of 201 bytes; here it has 200"]),
    ("no-impact", ["declares kinds of queries and has no function impact"]),
    ("no-impact-no-step", ["lacks one of its functions"]),
    ("no-declare", ["lacks one of its functions"]),
])
def test_incomplete_library_is_refused(fault, pieces, tmp_path):
    file = queries_file(tmp_path)
    refused("queries", file, "--detector", LIBRARY, folder=tmp_path, named=pieces,
            env={"CONTACTCHECK_PLUGIN_FAULT": fault})


@pytest.mark.parametrize("fault, pieces", [
    ("unknown-kind", ["declares kinds of queries that do not exist"]),
    ("unknown-level", ["declares levels within a step that do not exist"]),
    ("unknown-precision", ["declares precision 2, which does not exist"]),
    ("nan-tolerance", ["a tolerance is no number from 0 on"]),
    ("negative-tolerance", ["a tolerance is no number from 0 on"]),
    ("declares-nothing", ["answers neither frames nor queries"]),
    ("declare-fails", ["declare_impacts failed: no licence"]),
])
def test_impossible_claim_is_refused(fault, pieces, tmp_path):
    file = queries_file(tmp_path)
    refused("queries", file, "--detector", LIBRARY, folder=tmp_path, named=pieces,
            env=by_default(fault))


def test_highest_level_is_known(tmp_path):
    assert Judged(tmp_path, *words_of("library", "last-level")).outcome.exit_code == 0


def test_detector_of_queries_alone_runs_on_no_scene(tmp_path):
    for words in (("--detector", LIBRARY), ("--detector", "exact")):
        refused("run", "bunny-touch", *words, folder=tmp_path,
                named=["answers queries of moving elements alone", "contactcheck queries"])


def test_detector_of_frames_answers_no_queries(tmp_path):
    refused("queries", queries_file(tmp_path), "--detector", "fcl-aabb", folder=tmp_path,
            named=["no detector of queries is named \"fcl-aabb\"; there are exact, root-finder"])


def test_detector_of_frames_may_be_called_as_one_of_queries_is(tmp_path):
    command_of_frames = shlex.join([sys.executable, "-B", str(COMMAND_FILE), "frames-named-exact"])
    assert "\nexact\n" in successful("list", "--detector-cmd", command_of_frames).out
    refused("queries", queries_file(tmp_path), "--detector-cmd", command_of_frames, folder=tmp_path,
            named=["answers no queries of moving elements"])
    taken = shlex.join([sys.executable, "-B", str(COMMAND_FILE), "named-exact"])
    refused("queries", queries_file(tmp_path), "--detector-cmd", taken, folder=tmp_path,
            named=["calls itself \"exact\", which is another detector's name"])


def test_list_shows_what_it_declares():
    out = successful("list", "--detector", LIBRARY, "--detector", "bullet-bernstein").out
    assert "  queries     vertex-face, in double precision\n  tolerance   0.25 m\n" in out
    assert "  queries     vertex-face, in single precision\n  tolerance   none\n" in out
    assert "claims" not in out
    assert "Detectors of queries" in successful("list").out
