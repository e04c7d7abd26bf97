"""What `contactcheck accept` writes of results as a baseline, and what it says of the one in its place."""

import json

import pytest

from program import successful


@pytest.fixture
def accept(tmp_path):
    """What accept prints of these results, after the name of the baseline."""
    def said(results):
        (tmp_path / "results.json").write_text(json.dumps(results), encoding="utf-8")
        return successful("accept", "results.json", "--as", "baseline.json", cwd=tmp_path).out
    return said


@pytest.fixture
def baseline_text(accept, tmp_path):
    def text(results):
        accept(results)
        return (tmp_path / "baseline.json").read_text(encoding="utf-8")
    return text


def row_of(results, detector):
    return next(row for row in results["runs"] if row["detector"] == detector)


def test_baseline_keeps_what_a_gate_compares_and_points_at_no_file(baseline_text, results):
    results["resumed"] = ["touch"]
    baseline = json.loads(baseline_text(results))
    assert baseline["disagreements"] == []
    assert "resumed" not in baseline
    for key in ("machine", "scenes", "libraries", "command"):
        assert baseline[key] == results[key], key
    assert len(baseline["runs"]) == 8
    row, old = row_of(baseline, "exact"), row_of(results, "exact")
    assert row["recording"] == ""
    assert row["per_frame"]["frame_ms"] == []
    assert len(row["per_frame"]["truth"]) == 8
    for key in ("levels", "stages", "time_ms", "speedup", "memory_bytes", "contact_hash"):
        assert row[key] == old[key], key
    assert row_of(results, "lost").items() <= row_of(baseline, "lost").items()


def test_baseline_leaves_out_what_only_charts_show(baseline_text, results):
    without = baseline_text(results)
    results["scenes"][0]["separation"] = [0.5, 0.0, 0, 0, 0, 0, 0, 0]
    bins = [{"from": 0.0, "below": 1.0, "count": 1}]
    geometry = results.row("exact")["geometry"]
    for key in ("spurious_distance_histogram", "depth_error_histogram", "normal_error_deg_histogram"):
        geometry[key] = bins
    geometry["episodes"] = [{"bodies": [0, 1], "first_true": 3, "first_reported": 3, "hover_gap": 0.0,
                             "late_frames": 0}]
    assert baseline_text(results) == without


def test_baseline_is_written_with_a_line_per_row(baseline_text, results):
    text = baseline_text(results)
    assert baseline_text(json.loads(text)) == text
    assert "histogram" not in text
    assert '\n  {"scene":"touch","detector":"lost","status":"absent","message":"not built"' in text


def test_changes_of_the_same_are_none(accept, results):
    assert accept(results) == "baseline.json: 8 rows of " + results["command"] + "\n"
    assert accept(results).endswith("\nno row, count or contact changed\n")


def test_changes_name_what_is_new_gone_and_other(accept, results):
    accept(results)
    results["machine"]["cpu"] = "B CPU"
    del results["libraries"]["fcl"]
    results.row("paper")["levels"]["cell"]["missed"] = 4
    results.row("paper")["contact_hash"] = "0xdd"
    results.row("exact")["detector"] = "renamed"
    results.row("broken")["status"] = "refused"
    assert accept(results).split("changed:\n")[1] == (
        "  machine cpu A CPU -> B CPU\n"
        "  library fcl 0.7.0 -> null\n"
        "  touch  renamed: new\n"
        "  touch  paper: missed 3 -> 4, contact_hash 0xd -> 0xdd\n"
        "  touch  broken: status error -> refused\n"
        "  touch  exact: gone\n")


def test_changes_name_what_is_not_judged_any_more(accept, results):
    accept(results)
    row = results.row("paper")
    row["semantics"].update(levels=["body"], margin=0.01)
    del row["levels"]["cell"]
    assert accept(results).split("changed:\n")[1] == (
        "  touch  paper: truth 40 -> null, missed 3 -> null, spurious 2 -> null, level cell was judged in the baseline; "
        "now the detector does not claim it, it declares margin (metres) 0 in the baseline, 0.01 now\n")


def test_changes_leave_times_out(accept, results):
    accept(results)
    results.row("exact")["time_ms"]["playback"]["frame"] = 9.0
    assert accept(results).endswith("\nno row, count or contact changed\n")
