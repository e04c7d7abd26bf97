import re

import pytest

FILE = "plots/speed_error.svg"


@pytest.fixture
def picture(report):
    return lambda results: report(results)[FILE]


def test_says_of_every_point_what_the_results_say(picture, sample):
    svg = picture(sample)
    assert ("ffd-aabb-sphere2+tri: 0.500 ms per frame (question triangles), missed 1 of 200000, spurious 2 "
            "of 200001 (level triangle)") in svg
    assert "Measured on A CPU, AVX2." in svg
    assert "time per frame, ms" in svg
    markers = re.findall(r'</title>\n<path transform="translate\([0-9.]+ [0-9.]+\)" [^\n]*dot g', svg)
    assert len(markers) == 2


def test_takes_no_markup_from_results(picture, sample):
    sample["runs"][0]["detector"] = "<script>&\""
    sample["machine"]["cpu"] = "<b>"
    svg = picture(sample)
    assert "<script" not in svg
    assert "<b>" not in svg
    assert "&lt;script&gt;&amp;&quot;" in svg


def test_is_the_same_text_every_time(picture, sample):
    assert picture(sample) == picture(sample)


def test_lies_on_paper_that_follows_the_reader(picture, sample):
    svg = picture(sample)
    assert 'class="paper"' in svg
    assert "@media(prefers-color-scheme:dark)" in svg


def test_is_a_file_of_the_report(report, sample):
    files = report(sample)
    assert FILE in files
    assert f"]({FILE})" in files["report.md"]
    for run in sample["runs"][:2]:
        run["time_ms"] = {"prepare": 1.0}
    untimed = report(sample)
    assert FILE not in untimed
    assert "Speed against error" not in untimed["report.md"]
