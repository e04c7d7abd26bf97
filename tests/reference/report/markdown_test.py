import copy
import re

import pytest


def test_says_which_scenes_were_taken_over(markdown, sample):
    without = markdown(sample)
    sample["resumed"] = []
    assert markdown(sample) == without
    sample["resumed"] = ["hello", "world"]
    assert ("\n\nTaken over from an earlier run (`--resume`), with the times measured "
            "then: hello, world.\n\n## Summary") in markdown(sample)


def hovering(sample, grid, aabb):
    """The two detectors of the paper's claim about hover, with these gaps."""
    run = sample["runs"][0]
    sample["runs"] = [{**copy.deepcopy(run), "detector": name} for name in ("ffd-grid", "ffd-aabb")]
    for run, gap in zip(sample["runs"], (grid, aabb)):
        run["geometry"]["hover_gap_max"] = gap
    return sample


@pytest.mark.parametrize("grid, aabb, row", [
    (0.02, 0.01, "| hello | 20.0 | 10.0 | holds |"),
    (0.01, 0.02, "| hello | 10.0 | 20.0 | does not hold |"),
    (0.01, 0.01, "| hello | 10.0 | 10.0 | equal |"),
    (0.01, None, "| hello | 10.0 | - | no episode |"),
], ids=["holds", "does_not_hold", "equal", "no_episode"])
def test_says_where_the_claim_about_hover_holds(markdown, sample, grid, aabb, row):
    assert row in markdown(hovering(sample, grid, aabb))


def test_scenes_without_contact_say_nothing_about_hover(markdown, sample):
    sample["scenes"][0]["contact_frames"] = 0
    assert "the paper's claim" not in markdown(hovering(sample, 0.02, 0.01))


def test_never_shows_a_number_that_is_none(markdown, sample):
    assert not re.search("[Nn]a[Nn]|null|[^a-z]inf[^a-z]", markdown(sample))
