import pytest

LINE = "10,000,000 pairs, seed 7, 5,012,345 touch; oracle against rational arithmetic: 0 wrong"


@pytest.fixture
def with_pairs(sample):
    sample["scenes"][0]["pairs"] = {
        "count": 10000000, "seed": 7, "touching": 5012345,
        "per_kind": {"vertex-face": {"pairs": 9999996, "touching": 5012344},
                     "point": {"pairs": 4, "touching": 1},
                     "sliver": {"pairs": 0, "touching": 0}},
        "rational": {"checked": 10000000, "oracle_wrong": 0}}
    return sample


def test_line_and_kinds_are_in_the_report(markdown, with_pairs):
    text = markdown(with_pairs)
    assert f"\n{LINE}.\n" in text
    assert "| vertex-face | 9999996 | 5012344 | 0.501 |" in text
    assert "| point | 4 | 1 | 0.250 |" in text
    assert "| sliver | 0 | 0 | - |" in text


def test_wrong_oracle_is_said_loudly(markdown, with_pairs):
    with_pairs["scenes"][0]["pairs"]["rational"]["oracle_wrong"] = 1234
    assert "1,234 wrong, AN ERROR OF CONTACTCHECK ITSELF" in markdown(with_pairs)


def test_scenes_without_pairs_have_no_line(markdown, sample):
    text = markdown(sample)
    assert "Kinds of pairs" not in text
    assert "rational arithmetic" not in text
