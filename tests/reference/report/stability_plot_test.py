import pytest

DOWN = 'd="M-3.5 -2.5h7l-3.5 5Z" class="mark"'
UP = 'd="M-3.5 2.5h7l-3.5 -5Z" class="mark"'


@pytest.fixture
def plot_of(report):
    return lambda family, results: report(results)[f"plots/{family}.svg"]


def test_has_a_square_for_every_case_of_detectors_that_err(plot_of, hard):
    plot = plot_of("one", hard)
    assert "skin at 0: 0 missed of 4, 0 spurious" in plot
    assert "skin at 1e-9: 0 missed of 0, 3 spurious" in plot
    assert "crash at 1e-3: signal 11" in plot
    assert "exact" not in plot
    assert "crash at 0: no answer" in plot
    assert plot.count('class="error"') == 2, "the legend, and the case with the error"
    assert plot.count('class="unknown"') == 2


def test_squares_say_which_case_they_are(plot_of, hard):
    plot = plot_of("one", hard)
    assert plot.count('<g data-detector="skin" data-frame=') == 3
    assert '<g data-detector="skin" data-frame="1"><title>skin at 1e-9: ' in plot
    assert '<g data-detector="crash" data-frame="2"><title>crash at 1e-3: ' in plot


def test_tells_missed_from_spurious_without_colour(report, hard):
    plots = report(hard)
    one, two = plots["plots/one.svg"], plots["plots/two.svg"]
    assert one.count(UP) == 3, "the legend, and two cases with spurious contacts"
    assert one.count(DOWN) == 1, "the legend"
    assert two.count(DOWN) == 2, "the legend, and one case"
    assert two.count(UP) == 1, "the legend"


def test_takes_the_colours_of_the_page_around_it(plot_of, hard):
    plot = plot_of("one", hard)
    _, query, dark = plot.partition("@media(prefers-color-scheme:dark)")
    assert query
    assert ".missed{fill:#0b62c4;fill:var(--missed,#0b62c4)}" in plot
    assert ".paper{fill:#fff;fill:var(--surface,#fff)}" in plot
    # A light page on a dark system is light.
    assert ".missed{fill:#58a6ff;fill:var(--missed,#58a6ff)}" in dark


def test_shades_by_share(plot_of, hard):
    before = plot_of("two", hard)
    assert before.count('class="missed"') == 2, "the legend, and 1 of 4"
    assert 'class="missed" fill-opacity="0.47"' in before, "0.3 + 0.7 / 4"
    assert "skin at 0: 1 missed of 4, 0 spurious" in before
    hard["runs"][4]["per_frame"]["missed"][0] = 4
    assert 'class="missed" fill-opacity' not in plot_of("two", hard)


def test_is_left_out_where_no_detector_errs(report, hard):
    hard["runs"][4]["per_frame"]["missed"][0] = 0
    files = report(hard)
    assert "plots/one.svg" in files
    assert "plots/two.svg" not in files


def test_takes_no_markup_from_results(plot_of, hard):
    hard["scenes"][0]["title"] = "<script>&\"\n"
    plot = plot_of("one", hard)
    assert "&lt;script&gt;&amp;&quot; " in plot
    assert "<script" not in plot
    hard["scenes"][0]["title"] = "a\x01<b>"
    assert "a &lt;b&gt;" in plot_of("one", hard)
    hard["runs"][1]["detector"] = "a\" onclick=\"b<"
    assert 'data-detector="a&quot; onclick=&quot;b&lt;" data-frame="0"' in plot_of("one", hard)


def test_files_are_the_report_and_its_pictures(report, hard):
    files = report(hard)
    assert set(files) == {
        "report.md", "report.csv", "plots/one.svg", "plots/two.svg", "plots/speed_error.svg"}
    assert "](plots/one.svg)" in files["report.md"]


def test_files_stay_in_their_folder(report, hard):
    hard["scenes"][0]["id"] = "../../one"
    for run in hard["runs"][:3]:
        run["scene"] = "../../one"
    assert "plots/------one.svg" in report(hard)
