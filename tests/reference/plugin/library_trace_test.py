"""What libraries tell of their work, from their table to results.json; libraries of version 1, which
tell nothing; and what `list` shows of detectors from outside."""

import os
import shutil

import pytest

import misbehaving
from misbehaving import fault, refused_on_tiny_scene
from program import refused, successful
from tiny_run import TinyRun

STAGED = os.environ["CONTACTCHECK_STAGED_LIBRARY"]
EARLIER = {"version-1": os.environ["CONTACTCHECK_VERSION_1_LIBRARY"],
           "version-3": os.environ["CONTACTCHECK_VERSION_3_LIBRARY"]}
TIMED = ("--processes", "1")


def staged(told):
    return f"{STAGED}:told={told}"


def test_library_has_stages_with_their_misses_and_counters(tmp_path):
    row = TinyRun(tmp_path, ["--detector", STAGED]).row("staged")
    assert row["status"] == "ok", row["message"]
    missed = row["levels"]["triangle"]["missed"]
    assert 0 < missed < row["levels"]["triangle"]["truth"]
    everything, even = row["stages"]
    assert everything["name"] == "everything"
    assert everything["unit"] == "body pairs"
    assert everything["missed"] == 0
    assert everything["in"] == row["frames"]
    assert "visited" not in everything
    assert even["missed"] == missed
    assert even["in"] == 2 * even["out"]
    assert even["visited"] == 7 * row["frames"]
    assert even["visited_unit"] == "numbers"
    assert row["counters"] == {"pairs_looked_at": even["out"]}


@pytest.mark.parametrize("told", ["owners", "labels"])
def test_stage_of_cells_is_read_through(told, tmp_path):
    row = TinyRun(tmp_path, ["--detector", staged(told)]).row(f"staged:told={told}")
    assert row["status"] == "ok", row["message"]
    assert len(row["stages"]) == 2


def test_library_has_its_own_clock_beside_ours(tmp_path):
    run = TinyRun(tmp_path, ["--detector", STAGED, "--detector", staged("no-clock")], TIMED)
    for regime in ("playback", "cold"):
        assert run.row("staged")["time_ms"][regime]["self_reported"] == 0.5
        # It did not measure every frame.
        assert "self_reported" not in run.row("staged:told=no-clock")["time_ms"][regime]
    assert " (own 0.500)" in run.outcome.out


@pytest.mark.parametrize("told, pieces, status, flags", [
    fault("trace-fails", "frame 2, phase trace: trace failed: lost the stages"),
    fault("no-name", "a stage's name and units must be one line of ASCII"),
    fault("two-lines", "a stage's name and units must be one line of ASCII"),
    fault("changes", "frame 2, phase trace: trace: the stages or their units are not those"),
    fault("many", "gives more than 64 stages"),
    fault("wrong-triangle", "stage \"even\" names triangle 1000000 of body \"left\""),
    fault("covers-nothing", "stage \"even\" covers what does not exist (99)"),
    fault("no-owners", "owners() gave 0 of them for body \"left\""),
    fault("wrong-owner", "owners() names cell 1000000 of body \"left\""),
    fault("owners-of-nobody", "trace: owners() names body 777 of 2 bodies"),
    fault("owners-far-away", "trace: owners() names body 4294967295 of 2 bodies"),
    fault("huge-in", "stage \"everything\": in is 18446744073709551615; allowed in a frame: up to "
                     "10000000000"),
    fault("huge-out", "stage \"everything\": out is 18446744073709551615"),
    fault("huge-visited", "stage \"even\": visited is 18446744073709551615"),
    fault("huge-counter", "counts: pairs_looked_at is 18446744073709551615"),
    fault("counter-twice", "counts: gives a counter twice"),
    fault("counter-name", "counts: a counter's name must be letters"),
    fault("counter-comes", "counts: the counters are not those of the frame before"),
    fault("clock-nan", "own_ms gave nan ms", flags=TIMED),
    fault("clock-endless", "own_ms gave inf ms", flags=TIMED),
])
def test_impossible_statement_of_a_library_is_its_error(told, pieces, status, flags, tmp_path):
    row = TinyRun(tmp_path, ["--detector", staged(told)], flags).row(f"staged:told={told}")
    assert row["status"] == status
    for piece in pieces:
        assert piece in row["message"]


def test_structure_of_another_size_is_refused(tmp_path, monkeypatch):
    monkeypatch.setenv("CONTACTCHECK_STAGE_SIZE", "1")
    refused_on_tiny_scene("--detector", STAGED, "--no-timing",
                          named=["gives contactcheck_stage a size of", "here it has"], folder=tmp_path)


@pytest.mark.parametrize("version", EARLIER)
def test_library_of_an_earlier_version_runs_as_it_did(version, tmp_path):
    row = TinyRun(tmp_path, ["--detector", EARLIER[version]], TIMED).row(version)
    assert row["status"] == "ok", row["message"]
    assert row["levels"]["triangle"]["reported"] == 0
    assert row["stages"] == []
    assert "self_reported" not in row["time_ms"]["cold"]


# The list of known defects is one of libraries that this program has.
def test_error_of_a_detector_from_outside_is_no_unknown_defect(tmp_path):
    run = TinyRun(tmp_path, ["--detector", staged("many")])
    assert run.outcome.exit_code == 3
    assert "known_defects" not in run.results
    assert "known defects" not in run.outcome.out


# ---- contactcheck list


def test_list_shows_what_a_library_declares():
    out = successful("list", "--detector", STAGED, "--detector", "fcl-aabb").out
    for piece in ("\nstaged\n  tells of its work\n  from        library \"",
                  "  version     2.5\n",
                  "  claims      triangle\n  questions   triangles\n",
                  "  given       deformed vertices and lattice nodes\n",
                  "  options     told=truth\n",
                  "\nfcl-aabb\n"):
        assert piece in out
    assert "Suites" not in out
    assert "\nembree\n" not in out


def test_list_shows_once_what_is_named_twice_and_the_options_given():
    out = successful("list", "--detector", "ffd-aabb:cell=3", "--detector", "fcl-aabb", "--detector",
                     "fcl-aabb", "--detector", staged("owners"), "--detector", staged("owners")).out
    for heading in ("\nfcl-aabb\n", "\nffd-aabb:cell=3\n", "\nstaged:told=owners\n"):
        assert out.count(heading) == 1, heading
    for piece in (" cell=3 (", "; default 1)", " told=owners\n"):
        assert piece in out


# A ':' begins the options, unless the file's own name has it.
def test_list_finds_a_library_whose_name_has_a_colon(tmp_path):
    folder = tmp_path / "lib:1"
    folder.mkdir()
    file = folder / "mine:a=1.so"
    shutil.copyfile(STAGED, file)
    for options in ("", ":told=owners"):
        assert f"\nstaged{options}\n" in successful("list", "--detector", f"{file}{options}").out
    refused("list", "--detector", f"{file}x:told=owners", named=["lib\" does not exist"], folder=tmp_path)


def test_list_shows_what_a_command_declares():
    out = successful("list", "--detector-cmd", misbehaving.command("none")).out
    assert "  from        command \"" in out
    assert "  claims " in out


@pytest.mark.parametrize("words", [
    ("--detector", os.environ["CONTACTCHECK_NO_PLUGIN"]),
    ("--detector", staged("boredom")),
    ("--detector", "no-such-detector"),
    ("--detector-cmd", "exit 3"),
], ids=["no plug-in", "unknown value", "unknown detector", "command that ends"])
def test_list_refuses_what_cannot_be_used_in_one_sentence(words, tmp_path):
    refused("list", *words, named=[], folder=tmp_path)
