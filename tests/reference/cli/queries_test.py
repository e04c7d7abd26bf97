"""What `contactcheck queries` prints and writes. (Whether its scores are right:
tests/reference/queries/by_hand_test.py.)"""

import json
import os
import re
import subprocess

import pytest

from program import FIXTURES, PROGRAM, contactcheck, names_in, successful

FACES, EDGES = (FIXTURES / "queries" / kind / "by_hand.csv" for kind in ("vertex-face", "edge-edge"))
COPIES = 200  # of a hundred queries
MOST_MEMORY, MOST_GROWTH = 150, 12  # MiB


def scores(folder):
    document = json.loads((folder / "out" / "queries.json").read_text(encoding="utf-8"))
    assert set(document) == {"schema", "version", "files"} and document["schema"] == "contactcheck-queries/1"
    return document["files"]


OUTPUTS = {"queries.json", "queries.md", "queries-times.svg", "queries-cost.svg"}


def judged(folder, *words):
    """What is printed, and the files of queries.json. The folder `out` is that of --out by default."""
    outcome = successful("queries", *words, cwd=folder)
    assert outcome.err == ""
    assert {"queries.json", "queries.md"} <= names_in(folder / "out") <= OUTPUTS
    assert outcome.out.endswith("\n\nout/queries.md\n")
    report = (folder / "out" / "queries.md").read_text(encoding="utf-8")
    assert outcome.out.removesuffix("\nout/queries.md\n") in report
    for picture in OUTPUTS & names_in(folder / "out") - {"queries.json", "queries.md"}:
        assert f"]({picture})" in report
    return outcome.out, scores(folder)


def row(text, detector):
    """The cells of a detector's row in the table."""
    line, = re.findall(rf"^  {re.escape(detector)}  .*$", text, re.MULTILINE)
    return line.split()


def test_help_names_every_detector_and_example_files(tmp_path):
    text = successful("queries", "--help").out
    assert text.startswith("Judges tests of moving elements on query files, by exact truth\n")
    for option in ("--families", "--kind KIND", "--truth FILE", "--detector NAME", "--out DIR"):
        assert f"\n  {option} " in text
    assert max(map(len, text.splitlines())) <= 100
    _, (score,) = judged(tmp_path, FACES)
    *names, last = [detector["detector"] for detector in score["detectors"]]
    assert f"{', '.join(names)}, {last} or FILE.so" in " ".join(text.split())


def test_the_general_help_has_the_command():
    assert "\n  queries " in successful("--help").out


def test_missed_contacts_are_findings_and_no_failure(tmp_path):
    text, (score,) = judged(tmp_path, FACES, "--detector", "root-finder")
    found, = score["detectors"]
    assert found["score"]["missed"] > 0
    assert row(text, "root-finder")[1:3] == [str(found["score"][key]) for key in ("missed", "spurious")]
    assert "missed / spurious by longest edge" in text
    assert f"first of root-finder: missed at line {found['score']['first_missed']}" in text


def test_a_right_detector_has_no_table_by_length(tmp_path):
    text, _ = judged(tmp_path, FACES, "--detector", "exact")
    assert row(text, "exact")[1:3] == ["0", "0"]
    assert "longest edge" not in text and "first of" not in text


def test_names_the_line_of_the_slowest_query(tmp_path):
    text, (score,) = judged(tmp_path, EDGES)
    costs = {detector["detector"]: detector["microseconds"] for detector in score["detectors"]}
    costs["(oracle)"] = score["oracle_microseconds"]
    for name, cost in costs.items():
        assert cost["worst_line"] in range(1, 801, 8)
        assert row(text, name)[-1] == str(cost["worst_line"])
        assert 0 <= cost["median"] <= cost["worst"] and 0 < cost["mean"] <= cost["worst"]


def test_judges_files_in_the_order_in_which_they_are_given(tmp_path):
    text, both = judged(tmp_path, EDGES, FACES)
    assert [score["name"] for score in both] == [str(EDGES), str(FACES)]
    assert [score["kind"] for score in both] == ["edge-edge", "vertex-face"]
    first, second = (text.index(f"{file}: {kind}, 100 queries, ")
                     for file, kind in ((EDGES, "edge-edge"), (FACES, "vertex-face")))
    assert first == 0 and text[second - 2:second] == "\n\n"


def test_each_file_has_a_truth_in_their_order(tmp_path):
    truths = []
    for file in (EDGES, FACES):
        lines = file.read_text(encoding="utf-8").splitlines()
        truths += ["--truth", tmp_path / f"{file.parent.name}.json"]
        truths[-1].write_text(json.dumps([line.endswith(",1") for line in lines[::8]]), encoding="utf-8")
    _, both = judged(tmp_path, EDGES, FACES, "--detector", "exact", *truths)
    assert [score["file_wrong"] for score in both] == [0, 0]
    truths[1], truths[3] = truths[3], truths[1]
    _, both = judged(tmp_path, EDGES, FACES, "--detector", "exact", *truths)
    assert min(score["file_wrong"] for score in both) > 0


def test_asks_the_detectors_that_are_named_once_each(tmp_path):
    _, (score,) = judged(tmp_path, EDGES, "--detector", "root-finder", "--detector", "exact",
                         "--detector", "root-finder", "--detector", "bullet-bernstein")
    assert [detector["detector"] for detector in score["detectors"]] == ["root-finder", "exact"]


def test_a_kind_on_the_command_line_stands_before_that_of_the_name(tmp_path):
    _, (score,) = judged(tmp_path, FACES, "--kind", "edge-edge", "--detector", "exact")
    assert score["kind"] == "edge-edge"


def test_what_no_float_can_hold_is_refused_by_a_detector_in_floats(tmp_path):
    """A vertex falls through a triangle of 10^300 metres."""
    e = int(1e300)
    triangle = [(0, 0, 0), (4 * e, 0, 0), (0, 4 * e, 0)]
    rows = [(e, e, e), *triangle, (e, e, -e), *triangle]
    file = tmp_path / "vf.csv"
    file.write_text("".join(f"{x},1,{y},1,{z},1\n" for x, y, z in rows), encoding="utf-8")
    text, (score,) = judged(tmp_path, file, "--detector", "exact", "--detector", "bullet-bernstein")
    assert [(found["refused"], found["score"]["hit"]) for found in score["detectors"]] == [(0, 1), (1, 0)]
    assert "bullet-bernstein (all refused)" in text


def test_families_have_a_table_each_and_the_exact_detector_is_right(tmp_path):
    text, values = judged(tmp_path, "--families")
    families = [re.match(r"(\S+): ", table)[1] for table in text.split("\n\n")[:-2]]
    assert len(families) > 20 and len(set(families)) == len(families)
    assert list(dict.fromkeys(value["name"].rpartition("@")[0] for value in values)) == families
    assert {"vertex-face", "edge-edge"} == {value["kind"] for value in values}
    for value in values:
        exact, *others = value["detectors"]
        assert exact["detector"] == "exact" and len(others) == (3 if value["kind"] == "vertex-face" else 2)
        assert (exact["score"]["missed"], exact["score"]["spurious"], exact["refused"]) == (0, 0, 0)
        assert value["file_truths"] == 0 < value["queries"]
    for other in ("root-finder", "fcl-intersect", "bullet-bernstein"):
        assert any(found["score"]["missed"] > 0 for value in values for found in value["detectors"]
                   if found["detector"] == other), other


def test_families_are_the_same_each_time(tmp_path):
    def answers():
        _, values = judged(tmp_path, "--families", "--detector", "root-finder")
        return [(value["name"], value["queries"], value["contacts"], value["detectors"][0]["score"])
                for value in values]

    assert answers() == answers()


def test_pictures_of_a_run_in_the_same_folder_stay(tmp_path):
    picture = tmp_path / "out" / "plots" / "bunny.svg"
    picture.parent.mkdir(parents=True)
    picture.touch()
    successful("queries", EDGES, "--detector", "exact", cwd=tmp_path)
    assert picture.exists()


def test_a_bad_file_leaves_the_last_report(tmp_path):
    judged(tmp_path, EDGES, "--detector", "exact")
    bad = tmp_path / "vf.csv"
    bad.write_text("0,1,0,1,0,1\n", encoding="utf-8")
    outcome = contactcheck("queries", FACES, bad, "--detector", "exact", cwd=tmp_path)
    assert (outcome.exit_code, outcome.err.count("\n")) == (2, 1)
    assert [score["name"] for score in scores(tmp_path)] == [str(EDGES)]


def peak_memory(folder, *words):
    """MiB of a run that exits with 0."""
    process = subprocess.Popen([PROGRAM, "queries", *words], cwd=folder, stdin=subprocess.DEVNULL,
                               stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    assert process.returncode == 0
    return usage.ru_maxrss / 1024


@pytest.mark.skipif(
    re.search("address|thread|memory", os.environ.get("CONTACTCHECK_SANITIZE", "")) is not None,
    reason="sanitizers keep memory")
def test_memory_does_not_grow_with_the_file(tmp_path):
    queries = FACES.read_bytes()
    few, many = tmp_path / "few-vf.csv", tmp_path / "many-vf.csv"
    few.write_bytes(queries * (COPIES // 4))
    many.write_bytes(queries * COPIES)
    before = peak_memory(tmp_path, few, "--detector", "exact", "--detector", "root-finder")
    memory = peak_memory(tmp_path, many, "--detector", "exact", "--detector", "root-finder")
    assert memory < MOST_MEMORY and memory - before < MOST_GROWTH
    many_score, = scores(tmp_path)
    _, (score,) = judged(tmp_path, FACES, "--detector", "exact", "--detector", "root-finder")
    for key in ("queries", "contacts", "starts_in_contact", "file_truths"):
        assert many_score[key] == COPIES * score[key], key
    for many_detector, detector in zip(many_score["detectors"], score["detectors"]):
        for key in ("truth", "reported", "hit", "missed", "spurious"):
            assert many_detector["score"][key] == COPIES * detector["score"][key], key
        assert many_detector["score"].get("first_missed") == detector["score"].get("first_missed")
        assert many_detector["microseconds"]["worst_line"] % 8 == 1
