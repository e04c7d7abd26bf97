import pytest


@pytest.fixture
def sweep(sample):
    """Three orientations at each of three separations; "fcl-aabb" alone."""
    sample["scenes"][0].update(size=2.0, frames=9)
    sample["scenes"][0]["sweep"] = {
        "separations": [-0.05, 0.0, 0.5], "orientations": 3, "seed": 1, "tolerance": 1e-9}
    run = sample["runs"][0]
    run.update(frames=9, contact_frames=0, speedup={})
    run["time_ms"].update(timed_frames=9, timed_contact_frames=0, passes=3)
    run["per_frame"].update(truth=[4] * 9, missed=[1, 2, 3, 0, 4, 0, 0, 0, 0],
                            spurious=[0, 0, 0, 0, 0, 0, 5, 0, 6],
                            frame_ms=[3.0, 1.0, 2.0, None, 0.5, None, None, None, None])
    sample["runs"] = [run]
    return sample


def test_have_medians_of_times_and_sums_of_errors_by_separation(markdown, sweep):
    text = markdown(sweep)
    assert "3 orientations at each separation, given in % of the size (2" in text
    assert "| detector | -5 % | 0 % | 50 % | passes |" in text
    assert "| fcl-aabb | 2.00 | 0.500 | - | 3 |" in text
    assert "| fcl-aabb | 6 / 0 | 4 / 0 | 0 / 11 |" in text


def test_leave_out_what_was_not_timed_or_did_not_run(markdown, table_below, sweep):
    run = sweep["runs"][0]
    untimed = {**run, "detector": "a", "time_ms": {"prepare": 12.0},
               "per_frame": {name: value for name, value in run["per_frame"].items() if name != "frame_ms"}}
    refused = {**run, "detector": "b", "status": "refused", "message": "flat"}
    text = markdown({**sweep, "runs": [untimed, refused]})
    assert "Time of a frame" not in text
    assert table_below(text, "Missed / spurious against separation") == [["a", "6 / 0", "4 / 0", "0 / 11"]]


def test_are_left_out_without_a_sweep(markdown, sweep):
    assert "against separation" in markdown(sweep)
    del sweep["scenes"][0]["sweep"]
    assert "against separation" not in markdown(sweep)
