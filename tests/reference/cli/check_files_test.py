"""What `contactcheck check` writes, frames that are kept, and checks that go on after an interruption."""

import csv
import json
import re
import signal

import pytest

from meshes import box, moved, obj_text
from program import PROGRAM, RunningProgram, contactcheck, refused

FRAMES = 12
BAD = {3: -0.1, 4: -0.3, 9: -0.2}  # frame: gap to the box that rests
INTERRUPTED = ("contactcheck: interrupted; checked frames are kept: repeat the command with --resume to go on\n")


def write_frame(folder, number, gap):
    mesh = moved(box(2), (1 + gap, 0.25, 0.25), 0.5)
    (folder / f"moving_{number:02}.obj").write_text(obj_text(mesh), encoding="utf-8")


@pytest.fixture
def folder(tmp_path):
    for number in range(FRAMES):
        write_frame(tmp_path, number, BAD.get(number, 0.5))
    (tmp_path / "rest.obj").write_text(obj_text(box(2)), encoding="utf-8")
    return tmp_path


def words(folder, *more):
    return ["check", *sorted(folder.glob("*.obj")), "--out", folder / "out", *more]


def check(folder, *more):
    return contactcheck(*words(folder, *more))


def found(folder):
    return json.loads((folder / "out" / "check.json").read_text(encoding="utf-8"))


def log_lines(folder):
    return (folder / "out" / "check.jsonl").read_bytes().splitlines(keepends=True)


def cut_log(folder, lines, rest=b""):
    """As a killed program leaves it: so many whole lines, the first of them the head."""
    (folder / "out" / "check.jsonl").write_bytes(b"".join(log_lines(folder)[:lines]) + rest)


def test_lists_every_contact_for_tables_and_programs(folder):
    outcome = check(folder)
    assert outcome.exit_code == 1, outcome.err
    with open(folder / "out" / "check.csv", encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert [row["frame"] for row in rows] == ["3", "4", "9"]
    assert {row["kind"] for row in rows} == {"frame"}
    for row, gap in zip(rows, BAD.values()):
        assert (row["body_a"], row["body_b"], row["file"]) == ("moving", "rest", f"moving_{int(row['frame']):02}.obj")
        assert float(row["depth_lower_m"]) <= -gap * (1 + 1e-12) and float(row["depth_upper_m"]) >= -gap * (1 - 1e-12)
    json_ = found(folder)
    assert json_["schema"] == "contactcheck-check/1"
    assert [frame["frame"] for frame in json_["frames"]] == list(BAD)
    assert (json_["checked_frames"], json_["summary"]["bad_frames"], json_["summary"]["first"]) == (FRAMES, 3, 3)


def test_clean_frames_replace_what_was_found_before(folder):
    assert check(folder).exit_code == 1
    outcome = check(folder, "--allow", "contact")
    assert outcome.exit_code == 0, outcome.err
    assert (found(folder)["frames"], found(folder)["exit_code"]) == ([], 0)
    assert (folder / "out" / "check.csv").read_text(encoding="utf-8").count("\n") == 1


def test_says_what_it_found_before_a_later_frame_is_read(folder):
    (folder / "moving_11.obj").write_text("f 1 2 3\n", encoding="utf-8")
    outcome = check(folder)
    assert outcome.exit_code == 2
    assert "frame 11" in outcome.err
    assert re.search(r"\nframe 9 \(moving_09\.obj\)\n  moving and rest: ", outcome.out)


def test_keeps_frames_to_judge_detectors_by(folder):
    outcome = check(folder, "--keep", "9", "--keep", "0", "--keep", "4-5")
    assert outcome.exit_code == 1, outcome.err
    assert {file.name for file in (folder / "out").glob("*.ccr")} == {
        "frame-0.ccr", "frame-3.ccr", "frame-9.ccr", "frames-4-5.ccr"}
    again = contactcheck("check", folder / "out" / "frame-9.ccr", "--out", folder / "again")
    assert "moving and rest" in again.out and "200 mm deep" in again.out


@pytest.mark.parametrize("word", ["12", "-1", "3-5", "5-4", "3-", "x", "11-12", "99999999999999999999"])
def test_refuses_to_keep_what_is_no_frame(folder, word):
    refused(*words(folder, f"--keep={word}"), named=["is neither a frame, from 0 to 11, nor two that follow"],
            folder=folder)


def test_goes_on_where_it_was_interrupted(folder):
    whole = check(folder)
    json_before, csv_before = found(folder), (folder / "out" / "check.csv").read_bytes()
    # The head, five frames, and a line of which a part was written.
    cut_log(folder, 6, b'{"frame": 5, "stamp')
    outcome = check(folder, "--resume")
    assert outcome.exit_code == 1
    assert outcome.err == f"resumed: 5 of 12 frames, checked in {folder}/out/check.jsonl\n"
    assert outcome.out == whole.out
    assert (found(folder), (folder / "out" / "check.csv").read_bytes()) == (json_before, csv_before)


def test_steps_go_on_as_if_nothing_had_been(folder):
    whole = check(folder, "--between", "--json-lines")
    before = log_lines(folder)
    for lines in (1, 4, 5, 10, 13):
        cut_log(folder, lines)
        outcome = check(folder, "--between", "--json-lines", "--resume")
        says = [line for line in outcome.out.splitlines() if '"progress"' not in line]
        assert says == [line for line in whole.out.splitlines() if '"progress"' not in line]
        assert log_lines(folder) == before


def test_frames_that_changed_are_checked_again(folder):
    assert check(folder).exit_code == 1
    write_frame(folder, 5, -0.25)
    outcome = check(folder, "--resume")
    assert "resumed: 5 of 12 frames" in outcome.err and "; the files of the next one have changed\n" in outcome.err
    assert [frame["frame"] for frame in found(folder)["frames"]] == [3, 4, 5, 9]


def test_frames_that_were_added_are_checked_alone(folder):
    assert check(folder).exit_code == 1
    write_frame(folder, 12, -0.05)
    outcome = check(folder, "--resume")
    assert outcome.err == f"resumed: 12 of 13 frames, checked in {folder}/out/check.jsonl\n"
    assert [frame["frame"] for frame in found(folder)["frames"]] == [3, 4, 9, 12]


def test_refuses_to_discard_what_was_interrupted(folder):
    check(folder)
    cut_log(folder, 6)
    before = (folder / "out" / "check.jsonl").read_bytes()
    same = check(folder)
    assert same.exit_code == 2
    assert ("a check that did not end has left 5 checked frames there: --resume takes them over, --overwrite "
            "discards them\n") in same.err
    for more in ([], ["--resume"]):
        other = check(folder, "--allow", "self", *more)
        assert other.exit_code == 2
        assert "of another one (other options): contactcheck check " in other.err
        assert "--overwrite discards them, another --out keeps them" in other.err
    assert (folder / "out" / "check.jsonl").read_bytes() == before
    assert check(folder, "--allow", "self", "--overwrite").exit_code == 1
    assert check(folder).exit_code == 1, "a check that has ended leaves nothing to lose"


def test_what_is_no_log_counts_as_none(folder):
    (folder / "out").mkdir()
    for text in (b"", b"\n", b"{}\n", b'{"schema": "other/1"}\n', b"\xff\n", b'{"schema": "contactcheck-checked/1"}\n'):
        (folder / "out" / "check.jsonl").write_bytes(text)
        outcome = check(folder, "--resume")
        assert outcome.exit_code == 1, outcome.err
        assert "resumed: 0 of 12 frames" in outcome.err


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGKILL])
def test_loses_nothing_when_it_is_killed(folder, number):
    """More frames than it can check before the signal comes."""
    text = (folder / "moving_11.obj").read_bytes()
    for frame in range(FRAMES, 100):
        (folder / f"moving_{frame}.obj").write_bytes(text)
    whole = check(folder)
    (folder / "out" / "check.jsonl").unlink()
    with RunningProgram(PROGRAM, words(folder)) as program:
        assert program.wait_for(lambda: (folder / "out" / "check.jsonl").exists() and len(log_lines(folder)) > 3)
        program.send(number)
        outcome = program.outcome()
    assert outcome.exit_code == 128 + number
    assert outcome.err == ("" if number == signal.SIGKILL else INTERRUPTED)
    assert not (folder / "out" / "check.json").exists(), "an earlier one would pass for this one's"
    again = check(folder, "--resume")
    assert again.out == whole.out


def test_refuses_to_drop_frames_that_were_checked(folder):
    check(folder)
    cut_log(folder, 11)
    for number in range(4, FRAMES):
        (folder / f"moving_{number:02}.obj").unlink()
    outcome = check(folder, "--resume")
    assert outcome.exit_code == 2
    assert "has left 10 checked frames there, and here are 4 frames: contactcheck check " in outcome.err
    outcome = check(folder, "--resume", "--overwrite")
    assert outcome.err == f"resumed: 4 of 4 frames, checked in {folder}/out/check.jsonl\n"


def test_a_body_at_rest_that_changed_is_checked_again(folder):
    assert check(folder).exit_code == 1
    (folder / "rest.obj").write_text(obj_text(moved(box(2), (-5, 0, 0), 1)), encoding="utf-8")
    outcome = check(folder, "--resume")
    assert outcome.exit_code == 0, outcome.err
    assert "resumed: 0 of 12 frames" in outcome.err
