"""What `contactcheck diff` calls worse, better, slower, new and gone, on results written by hand."""

import copy
import json

import pytest

from program import ROOT, successful

SAMPLE = json.loads((ROOT / "tests/reference/gate/sample_results.json").read_text(encoding="utf-8"))
NO_TIMES = "0 differ clearly in time.\n"


def row(detector="d", scene="s", **changes):
    """A row that found 10 of 10 true triangle pairs and no others."""
    perfect = copy.deepcopy(SAMPLE["runs"][-1])
    perfect["levels"] = {"triangle": level()}
    return {**perfect, "scene": scene, "detector": detector, "contact_hash": "0x1", **changes}


def level(truth=10, missed=0, spurious=0, **changes):
    return {"truth": truth, "reported": truth - missed + spurious, "hit": truth - missed, "missed": missed,
            "spurious": spurious, "recall": 1 - missed / truth, "spurious_rate": 0, **changes}


def triangles(**counts):
    return {"levels": {"triangle": level(**counts)}}


def geometry(**errors):
    return {"geometry": {**row()["geometry"], **errors}}


def failed(status="error", message="signal 11", detector="d"):
    return {"scene": "s", "detector": detector, "status": status, "message": message}


def speedup(value, low, high, passes=5, reference="fcl-aabb", question="triangles"):
    parts = SAMPLE["runs"][0]["speedup"]["triangles"]["ref"]
    return {"speedup": {question: {reference: {
        **parts, "playback": {"ratio": value, "low": low, "high": high}, "passes": passes,
        "interval": "95 %" if passes >= 5 else "range"}}}}


def scene(name, truth_hash="0x1"):
    return {**SAMPLE["scenes"][0], "id": name, "truth_hash": truth_hash}


@pytest.fixture
def diff(tmp_path):
    """What the program prints of these rows, after the names of the files."""
    def text(before, after, heads=({}, {})):
        for name, rows, head in zip(("before", "after"), (before, after), heads, strict=True):
            results = {**SAMPLE, "scenes": [], "disagreements": [], "runs": rows, **head}
            (tmp_path / f"{name}.json").write_text(json.dumps(results), encoding="utf-8")
        return successful("diff", "before.json", "after.json", cwd=tmp_path).out.split("\n\n")[1]
    return text


@pytest.fixture
def change(diff):
    """The section and line of the only row, which differs."""
    def lines(before, after):
        title, line, end = diff([before], [after]).splitlines()
        assert title.endswith(" (1)") and line.startswith("  s  d  ")
        assert end == "0 of 1 common rows have the same answers; " + NO_TIMES.strip()
        return title.removesuffix(" (1)"), line.removeprefix("  s  d  ")
    return lines


OTHER = "Other answers, neither better nor worse"


def test_equal_results_are_one_line(diff):
    rows = [row("d"), row("e")]
    assert diff(rows, rows) == f"2 of 2 common rows have the same answers; {NO_TIMES}"


def test_every_kind_of_difference_has_a_section(diff):
    before = [row("worse"), row("better", **triangles(spurious=3)), row("hash", **speedup(2, 2, 2)),
              row("gone"), row("worse", "old"), row("better", "old")]
    after = [row("worse", **triangles(missed=1)), row("better"),
             row("hash", contact_hash="0x2", **speedup(1, 1, 1)), row("new")]
    heads = [{"scenes": [scene("s"), scene("moved", truth)], "machine": {**SAMPLE["machine"], "cpu": cpu}}
             for truth, cpu in (("0x1", "A"), ("0x2", "B"))]
    assert diff(before, after, heads) == """\
Another machine: times compare ratios, but caches and instructions differ (1)
  cpu "A" -> "B"
Another scene of the same name: its exact truth differs (1)
  moved
Worse (1)
  s  worse  triangle missed 0 -> 1
Better (1)
  s  better  triangle spurious 3 -> 0
Other answers, neither better nor worse (1)
  s  hash  contact hash 0x1 -> 0x2
Slower (1)
  s  hash  2.00x [2.00, 2.00] slower, measured against fcl-aabb
New (1)
  detector new (in 1 scene)
Gone (2)
  scene old (2 detectors)
  detector gone (in 1 scene)
0 of 3 common rows have the same answers; 1 differ clearly in time.
"""


@pytest.mark.parametrize("passes, now, ratio", [
    (5, (3, 2, 4.5), "3.00x [2.00, 4.50]"), (3, (3, 2, 4.5), "3.00x (range 2.00 to 4.50)"),
    (1, (3, 3, 3), "3.00x (1 pass)")])
def test_ends_of_a_ratio_are_said(diff, passes, now, ratio):
    out = diff([row(**speedup(1, 1, 1))], [row(**speedup(*now, passes=passes))])
    assert out.startswith(f"Faster (1)\n  s  d  {ratio} faster, measured against fcl-aabb\n")


def test_ends_of_a_slowdown_are_those_of_a_ratio_above_1(diff):
    out = diff([row(**speedup(1, 1, 1))], [row(**speedup(0.5, 0.25, 0.8))])
    assert out.startswith("Slower (1)\n  s  d  2.00x [1.25, 4.00] slower, measured against fcl-aabb\n")


def test_many_differences_fit_on_a_screen_that_says_what_it_leaves_out(diff):
    before, after = [], []
    for i in range(300):
        name, ratio = f"d{i}", i % 2 + 0.5
        before += [row(name, **speedup(1, 1, 1)), row(f"gone{i}")]
        changes = [triangles(missed=1), {"contact_hash": "0x2"}, {}][i % 3]
        after += [row(name, **changes, **speedup(ratio, ratio, ratio)), row("d", f"new{i}")]
    out = diff(before, after)
    assert out.count("\n") <= 45
    assert "Worse (100)\n" in out
    assert "  ... and 95 more\n" in out
    assert "100 of 300 common rows have the same answers" in out


def test_line_of_a_row_names_three_differences_and_counts_the_rest(change):
    worse = {**triangles(missed=1, spurious=2), **geometry(missed_length=0.5, spurious_distance_max=0.5)}
    assert change(row(), row(**worse, contact_hash="0x2"))[1] == (
        "triangle missed 0 -> 1, triangle spurious 0 -> 2, missed_length 0 -> 0.5, and 2 more")


@pytest.mark.parametrize("worse, what", [
    (triangles(missed=1), ("triangle missed 0 -> 1", "triangle missed 1 -> 0")),
    (triangles(spurious=1), ("triangle spurious 0 -> 1", "triangle spurious 1 -> 0")),
    (geometry(covered_length_fraction=0.5),
     ("covered_length_fraction 1 -> 0.5", "covered_length_fraction 0.5 -> 1")),
    # Too early is an error, too.
    (geometry(late_frames=-2), ("late_frames 0 -> -2", "late_frames -2 -> 0"))])
def test_more_errors_are_worse_and_fewer_are_better(change, worse, what):
    assert change(row(), row(**worse)) == ("Worse", what[0])
    assert change(row(**worse), row()) == ("Better", what[1])


def test_worse_anywhere_is_worse(change):
    assert change(row(**triangles(spurious=5)), row(**triangles(missed=1))) == (
        "Worse", "triangle missed 0 -> 1, triangle spurious 5 -> 0, mixed: better in some of these")


def test_what_is_not_claimed_is_named_and_not_held_against_a_detector(change):
    def levels(missed):
        return {"levels": {**row()["levels"], "vertex": level(truth=4, missed=missed, informative=True)}}
    assert change(row(**levels(0)), row(**levels(4))) == (OTHER, "vertex (informative) missed 0 -> 4")


def test_other_contacts_in_the_same_number_are_neither_better_nor_worse(change):
    assert change(row(), row(contact_hash="0x2")) == (OTHER, "contact hash 0x1 -> 0x2")


def test_as_many_frames_early_as_late_is_neither_better_nor_worse(change):
    early, late = row(**geometry(late_frames=-2)), row(**geometry(late_frames=2))
    assert change(early, late) == (OTHER, "late_frames -2 -> 2")
    assert change(late, early)[0] == OTHER
    assert change(early, row(**geometry(late_frames=1)))[0] == "Better"


def test_error_that_is_measured_for_the_first_time_is_neither(change):
    assert change(row(), row(**geometry(missed_length=None))) == (OTHER, "missed_length 0 -> none")


def test_status_stands_for_the_whole_row(change):
    assert change(row(), failed()) == ("Worse", "ok -> error: signal 11")
    assert change(failed(), row())[0] == "Better"
    assert change(failed("absent"), failed())[0] == "Worse"


def test_level_that_is_no_longer_judged_is_named(change):
    more = {"levels": {**row()["levels"], "body": level(truth=1)}}
    assert change(row(), row(**more)) == (OTHER, "level body is judged only after")
    assert change(row(**more), row()) == (OTHER, "level body is judged only before")


def test_answers_to_another_truth_are_neither_better_nor_worse(diff):
    after = row(**triangles(truth=20, missed=2))
    was = {"scenes": [scene("s")]}
    other = [was, {"scenes": [scene("s", "0x2")]}]
    line = "  s  d  triangle truth 10 -> 20, triangle missed 0 -> 2\n"
    assert diff([row()], [after], [was, was]).startswith(f"Worse (1)\n{line}")
    assert f"{OTHER} (1)\n{line}" in diff([row()], [after], other)
    assert "Worse (1)\n" in diff([row()], [failed()], other)


def test_most_important_comes_first(diff):
    before = [row("hash"), row("one"), row("many"), row("dead"), row("gone")]
    after = [row("hash", contact_hash="0x2"), row("one", **triangles(missed=1)),
             row("many", **triangles(missed=9)), failed(detector="dead")]
    assert diff(before, after).startswith("""\
Worse (3)
  s  dead  ok -> error: signal 11
  s  many  triangle missed 0 -> 9
  s  one  triangle missed 0 -> 1
Other answers, neither better nor worse (1)
  s  hash  contact hash 0x1 -> 0x2
""")


def test_rounded_truth_is_a_level_of_its_own(change):
    def rounded(missed):
        return row(levels_rounded={"triangle": level(missed=missed)})
    assert change(rounded(0), rounded(1)) == ("Worse", "triangle rounded missed 0 -> 1")


@pytest.mark.parametrize("then, now, passes, section", [
    ((4, 3.9, 4.1), (3, 2.9, 3.1), 5, "Slower (1)\n  s  d  1.33x ["),
    # The interval of the factor holds 1.
    ((4, 2.5, 5), (3, 2.9, 3.1), 5, None),
    # Small changes are not worth a line.
    ((4, 4, 4), (4.1, 4.1, 4.1), 5, None),
    ((4, 4, 4), (4.3, 4.3, 4.3), 5, "Faster (1)\n  s  d  1.07x ["),
    # A range of few passes must be beyond a factor of 1.5.
    ((1, 1, 1), (1.6, 1.4, 1.9), 3, None),
    ((1, 1, 1), (0.7, 0.68, 0.72), 3, None),
    ((1, 1, 1), (1.7, 1.6, 1.8), 3, "Faster (1)\n  s  d  1.70x (range 1.60 to 1.80) faster"),
    ((1, 1, 1), (0.5, 0.4, 0.6), 3, "Slower (1)\n  s  d  2.00x (range ")])
def test_change_of_a_speedup_is_a_line_where_it_is_clear(diff, then, now, passes, section):
    out = diff([row(**speedup(*then))], [row(**speedup(*now, passes=passes))])
    if section is None:
        assert out == f"1 of 1 common rows have the same answers; {NO_TIMES}"
    else:
        assert out.startswith(section)
        assert ", measured against fcl-aabb\n" in out
        assert out.endswith("1 of 1 common rows have the same answers; 1 differ clearly in time.\n")


def test_detector_is_not_compared_with_itself_nor_without_a_common_reference(diff):
    same = f"1 of 1 common rows have the same answers; {NO_TIMES}"
    assert diff([row("fcl-aabb", **speedup(1, 1, 1))], [row("fcl-aabb", **speedup(4, 4, 4))]) == same
    assert diff([row(**speedup(1, 1, 1))], [row(**speedup(4, 4, 4, reference="embree"))]) == same


def test_largest_change_comes_first(diff):
    before = [row("slow", **speedup(4, 4, 4)), row("slower", **speedup(4, 4, 4))]
    after = [row("slow", **speedup(2, 2, 2)), row("slower", **speedup(1, 1, 1))]
    assert diff(before, after).startswith("Slower (2)\n  s  slower  4.00x [4.00, 4.00] slower, measured "
                                          "against fcl-aabb\n  s  slow  2.00x [")


@pytest.mark.parametrize("question", ["body", "cells", "contacts", "self"])
def test_times_are_compared_in_one_question(diff, question):
    # Of two runs that were timed in different questions, the ratios were set against each other.
    before, after = speedup(1, 1, 1), speedup(3, 2, 4.5, question=question)
    assert diff([row(**before)], [row(**after)]) == f"1 of 1 common rows have the same answers; {NO_TIMES}"
    both = {"speedup": {**before["speedup"], **after["speedup"]}}
    same = speedup(1, 1, 1, question=question)
    assert "3.00x [2.00, 4.50] faster" in diff([row(**same)], [row(**after)])
    assert "faster" not in diff([row(**both)], [row(**before)])
