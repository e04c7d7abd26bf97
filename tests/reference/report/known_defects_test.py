import pytest


def group(kind, values, **counts):
    return {"detector": "skin", "scene": "one", "kind": kind, "values": values, **counts}


def defect(listed, shown, changed, other_version):
    return {"library": "fcl", "version": "0.7.0", "where": "overlap()",
            "upstream": "https://example.org/issues/502", "kind": "missed", "sentence": "it | rounds",
            "detectors": ["skin", "hull"], "scenes": ["one"], "listed": listed, "shown": shown,
            "changed": changed, "other_version": other_version}


@pytest.fixture
def as_listed(hard):
    reading = {**defect(9, 9, 2, False), "library": "contactcheck", "where": "section 3"}
    return {**hard, "known_defects": {
        "defects": [defect(4, 3, 1, False), defect(0, 0, 0, True)], "readings": [reading],
        "changed": [], "not_shown": [], "unlisted": []}}


def test_are_counted_in_both_directions(markdown, as_listed):
    as_listed["known_defects"].update(
        changed=[group("missed", ["1e-3"], was=[1], **{"is": [1000000]})],
        not_shown=[group("missed", ["0"], was=[12])],
        unlisted=[group("spurious", ["1e-9", "1e-3"], **{"is": [4, 5]}),
                  group("refused", ["1e-3"], **{"is": [1]})])
    text = markdown(as_listed)
    assert "## Known wrong answers" in text
    assert ("Of 4 listed wrong answers of libraries that this run could show, 2 show as listed, 1 with "
            "another count and 1 do not. Of 9 wrong answers expected of our readings of the paper that this "
            "run could show, 7 show as listed, 2 with another count and 0 do not. 3 show that are not "
            "listed.") in text
    assert ("| fcl 0.7.0 | overlap() | https://example.org/issues/502 | missed | it \\| rounds | skin, hull "
            "| 1 | 3 of 4, 1 with another count |") in text
    assert ("| section 3 | missed | it \\| rounds | skin, hull | 1 | 9 of 9, 2 with another count |") in text
    assert "| 1 | other version |" in text
    assert "| skin | one | missed | 1e-3: 1 -> 1,000,000 |" in text
    assert "| skin | one | missed | 0: 12 |" in text
    assert "| skin | one | spurious | 1e-9: 4; 1e-3: 5 |" in text
    assert "| skin | one | refused | 1e-3 |" in text
    for title in ("Shown with another count", "Listed, and not shown: ", "Shown, and not listed"):
        assert title in text


def test_nothing_is_said_about_what_is_as_listed(markdown, as_listed):
    text = markdown(as_listed)
    assert "## Known wrong answers" in text
    for title in ("Shown with another count", "not shown: ", "Shown, and not listed"):
        assert title not in text


def test_are_left_out_of_results_that_have_none(markdown, hard):
    assert "Known wrong answers" not in markdown(hard)
