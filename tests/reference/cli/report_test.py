"""`contactcheck report`: the reports of a run, written again from its results.json."""

import csv
import json
import shutil
import xml.dom.minidom as dom

import pytest

from program import EXAMPLE_RESULTS, contactcheck, has_html_report, names_in, successful, tiny_scene

needs_html_report = pytest.mark.skipif(not has_html_report(),
                                       reason="install nodejs and npm, and build anew")


def run(tmp_path, *more):
    """The folder of a run on the scene tiny."""
    (tmp_path / "tiny.json").write_text(tiny_scene(), encoding="utf-8")
    successful("run", tmp_path / "tiny.json", "--quiet", *more, "--out", tmp_path / "out")
    return tmp_path / "out"


def text_of(file):
    return file.read_text(encoding="utf-8")


def test_writes_the_runs_own_report_again(tmp_path):
    out, again = run(tmp_path, "--no-timing"), tmp_path / "deep" / "again"
    outcome = successful("report", out / "results.json", "--out", again)
    assert str(again / "report.md") in outcome.out
    assert text_of(again / "report.md") == text_of(out / "report.md") != ""
    assert (again / "report.html").exists() == has_html_report()
    if has_html_report():
        assert text_of(again / "report.html") == text_of(out / "report.html")


def test_draws_the_pictures_of_the_run(tmp_path):
    out = run(tmp_path, "--detector", "ffd-grid", "--detector", "ffd-aabb", "--processes", "1")
    again = tmp_path / "again"
    successful("report", out / "results.json", "--format", "md", "--out", again)
    assert names_in(again / "plots") == names_in(out / "plots")
    for name in ("speed_error.svg", "who_errs.svg"):
        picture = text_of(out / "plots" / name)
        assert "ffd-grid" in picture
        assert text_of(again / "plots" / name) == picture
        assert dom.parseString(picture).documentElement.tagName == "svg"


def view_in(page):
    """What the page holds for its 3D view, packed."""
    _, view = text_of(page).split('id="contactcheck-view" type="text/plain">')
    return view[:view.index("<")]


@needs_html_report
def test_shows_the_recordings_beside_the_results(tmp_path):
    out, again = run(tmp_path, "--no-timing"), tmp_path / "again"
    view = view_in(out / "report.html")
    assert len(view) > 1000
    # A scene without its recording is named in the view and not drawn; the report is written.
    shutil.rmtree(out / "recordings")
    successful("report", out / "results.json", "--out", again)
    assert 0 < len(view_in(again / "report.html")) < len(view) / 2


def test_writes_the_formats_asked_for(tmp_path):
    out, again = run(tmp_path, "--no-timing"), tmp_path / "again"
    successful("report", out / "results.json", "--format", "md", "--out", again)
    assert names_in(again) == {"plots", "report.md"}


def expect_same_row(row, run):
    """A row of the table, read by csv, says what results.json says."""
    assert None not in row and None not in row.values()
    for key in ("scene", "detector", "status", "message"):
        assert row[key] == run[key]
    for level, counts in run.get("levels", {}).items():
        for key in ("truth", "reported", "hit", "missed", "spurious"):
            assert int(row[f"{level}_{key}"]) == counts[key], (level, key)
        recall = counts["recall"]
        assert row[f"{level}_recall"] == ("" if recall is None else repr(recall))
    assert row["contact_hash"] == run.get("contact_hash", "")
    for times in [run.get("time_ms", {}), *run.get("time_ms_other_questions", [])]:
        if times.get("question") == row["question"] != "":
            for regime in {"playback", "cold"} & set(times):
                assert float(row[f"{regime}_frame_ms"]) == times[regime]["frame"]
    for reference, ratios in run.get("speedup", {}).get(row["question"], {}).items():
        for key in ("ratio", "low", "high"):
            assert float(row[f"vs_{reference}_playback_{key}"]) == ratios["playback"][key]


def test_csv_is_what_python_reads_back(tmp_path):
    out = run(tmp_path, "--processes", "1", "--detector", "fcl-aabb", "--detector", "ffd-lazy", "--detector",
              "ffd-grid", "--detector", "fcl-obbrss")
    results = json.loads(text_of(out / "results.json"))
    results["runs"][0]["message"] = 'said "no", and\r\nthen ä \n'
    (out / "results.json").write_text(json.dumps(results), encoding="utf-8")
    successful("report", out / "results.json", "--format", "csv,md", "--out", out)
    with open(out / "report.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file, strict=True))
    assert len(rows) == len(results["runs"]) > 3
    for row, one in zip(rows, results["runs"]):
        expect_same_row(row, one)


@pytest.fixture
def alone(tmp_path):
    """The page of the example without a reproduction beside it; the example is copied into tmp_path."""
    successful("report", EXAMPLE_RESULTS, "--format", "html", "--out", tmp_path)
    shutil.copyfile(EXAMPLE_RESULTS, tmp_path / "results.json")
    return text_of(tmp_path / "report.html") if has_html_report() else ""


def report_beside(folder, reproduction):
    (folder / "reproduction.json").write_text(reproduction, encoding="utf-8")
    return contactcheck("report", folder / "results.json", "--format", "html", "--out", folder)


@needs_html_report
def test_html_leaves_out_the_reproduction_of_another_run(tmp_path, alone):
    outcome = report_beside(tmp_path, '{"command": "contactcheck run other"}')
    assert outcome.exit_code == 0, outcome.err
    assert text_of(tmp_path / "report.html") == alone


@needs_html_report
def test_html_takes_the_reproduction_of_the_same_run(tmp_path, alone):
    source = {"authors": [], "title": "", "journal": "", "year": 1, "doi": ""}
    outcome = report_beside(tmp_path, json.dumps(
        {"command": "contactcheck run hello", "scenes": [], "means": None,
         "paper": {"source": source, "findings": []}}))
    assert outcome.exit_code == 0, outcome.err
    assert text_of(tmp_path / "report.html") != alone


@needs_html_report
@pytest.mark.parametrize(("reproduction", "sentence"), [
    ("{", 'reproduction.json" is no JSON object'),
    ('{"command": "contactcheck run hello", "scenes": [{}]}',
     'reproduction.json" is no reproduction as this version'),
    ('{"command": "contactcheck run hello", "scenes": ' + 100_000 * "[" + 100_000 * "]" + "}",
     "reproduction.json: nested 100001 deep")], ids=["no_object", "of_another_version", "deep"])
def test_html_refuses_a_bad_reproduction(tmp_path, alone, reproduction, sentence):
    outcome = report_beside(tmp_path, reproduction)
    assert outcome.exit_code == 2
    assert sentence in outcome.err
