import csv
import io

import pytest


@pytest.fixture
def csv_of(report):
    return lambda results: report(results)["report.csv"]


@pytest.fixture
def row_of(csv_of):
    """A function: the cells of a row that are not empty, by title."""

    def cells(results, number):
        titles, *rows = csv.reader(io.StringIO(csv_of(results), newline=""), strict=True)
        row = dict(zip(titles, rows[number], strict=True))
        return {title: cell for title, cell in row.items() if cell}

    return cells


def test_row_has_what_was_measured_and_empty_cells_for_the_rest(row_of, sample):
    assert row_of(sample, 1) == {
        "scene": "hello",
        "detector": "ffd-aabb-sphere2+tri",
        "status": "ok",
        "frames": "60",
        "contact_frames": "13",
        "finest_level": "triangle",
        "body_truth": "13",
        "body_reported": "15",
        "body_hit": "13",
        "body_missed": "0",
        "body_spurious": "2",
        "body_recall": "1.0",
        "body_spurious_rate": "0.13333333333333333",
        "triangle_truth": "200000",
        "triangle_reported": "200001",
        "triangle_hit": "199999",
        "triangle_missed": "1",
        "triangle_spurious": "2",
        "triangle_recall": "0.999995",
        "triangle_spurious_rate": "9.99995e-06",
        "hover_gap_max_m": "0.0021",
        "late_frames": "-1",
        "question": "triangles",
        "timed_frames": "60",
        "passes": "5",
        "prepare_ms": "8.0",
        "playback_update_ms": "0.125",
        "playback_query_ms": "0.375",
        "playback_frame_ms": "0.5",
        "playback_first_frame_ms": "1.0",
        "playback_cpu_ms": "0.5",
        "cold_update_ms": "0.25",
        "cold_query_ms": "0.5",
        "cold_frame_ms": "0.75",
        "cold_cpu_ms": "0.75",
        "vs_fcl-aabb_playback_ratio": "4.0",
        "vs_fcl-aabb_playback_low": "3.5",
        "vs_fcl-aabb_playback_high": "4.25",
        "vs_fcl-aabb_cold_ratio": "4.0",
        "vs_fcl-aabb_cold_low": "3.0",
        "vs_fcl-aabb_cold_high": "5.0",
        "vs_fcl-aabb_passes": "5",
        "prepared_bytes": "262144",
        "memory_bytes": "524288",
        "contact_hash": "0x2"}


def test_spreads_have_the_largest_error_the_percentile_and_the_mean(row_of, bullet):
    cells = row_of(bullet, 0)
    assert [cells[f"depth_error_{part}_m"] for part in ("max", "p95", "mean")] == ["0.004", "0.003", "0.001"]


def test_has_a_detectors_own_clock(row_of, sample):
    sample["runs"][1]["time_ms"]["playback"]["self_reported"] = 0.125
    assert row_of(sample, 1)["playback_self_reported_ms"] == "0.125"


# A time and the speed-ups in the same row are of one question.
def test_times_are_of_the_question_of_the_speedups(row_of, sample):
    run = sample["runs"][1]
    run["semantics"]["questions"] = ["cells", "body"]
    run["time_ms"]["question"] = "cells"
    body = {**run["time_ms"], "question": "body", "playback": {**run["time_ms"]["playback"], "frame": 0.625}}
    del body["cold"]
    run["time_ms_other_questions"] = [body]
    cells = row_of(sample, 1)
    assert cells["question"] == "body"
    assert cells["playback_frame_ms"] == "0.625"
    assert "cold_frame_ms" not in cells, "only its own question is timed cold"
    del run["time_ms_other_questions"]
    cells = row_of(sample, 1)
    assert cells["question"] == "cells"
    assert cells["playback_frame_ms"] == "0.5"


def test_row_that_is_not_ok_has_status_and_message(row_of, sample):
    assert row_of(sample, 3) == {
        "scene": "hello", "detector": "embree", "status": "absent", "message": "not built"}


def test_options_are_one_cell(csv_of, row_of, sample):
    sample["runs"][0]["options"] = {"margin": "0.001"}
    assert row_of(sample, 0)["options"] == "margin=0.001"
    sample["runs"][0]["options"]["scale"] = "100"
    assert "\r\nhello,fcl-aabb,ok,,\"margin=0.001, scale=100\",60," in csv_of(sample)


def test_commas_quotes_and_line_ends_are_quoted(csv_of, sample):
    sample["runs"][3]["message"] = "a, \"b\"\nc"
    assert "\r\nhello,embree,absent,\"a, \"\"b\"\"\nc\",," in csv_of(sample)


def test_lines_end_in_cr_lf_and_start_with_the_titles(csv_of, sample):
    sample["runs"] = []
    titles = csv_of(sample)
    assert titles.startswith("scene,detector,status,message,options,frames,contact_frames,finest_level,"
                             "body_truth,body_reported,")
    assert titles.endswith(",cold_cpu_ms,prepared_bytes,memory_bytes,contact_hash,recording\r\n")
    assert titles.count("\n") == 1
