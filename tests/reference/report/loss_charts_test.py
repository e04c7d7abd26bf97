import copy

import pytest

ERRORS, STAGES = "plots/who_errs.svg", "plots/stage_losses.svg"


@pytest.fixture
def lossy(sample):
    """The run of the sample that errs."""
    return sample["runs"][1]


def stage(name, missed):
    return {"name": name, "unit": "cell pairs", "in": 0, "out": 0, "missed": missed}


@pytest.fixture
def lossy_twice(sample, lossy):
    """The run that errs, a second time in another scene, with other counts."""
    sample["scenes"].append({**sample["scenes"][0], "id": "second"})
    run = copy.deepcopy(lossy)
    run["scene"] = "second"
    run["levels"]["triangle"]["missed"] = 9
    run["stages"] = [stage("spheres", 5), stage("hash", 4)]
    sample["runs"].append(run)
    return sample


def test_errors_have_a_row_for_every_detector_that_errs(report, sample):
    svg = report(sample)[ERRORS]
    assert "ffd-aabb-sphere2+tri (triangle)" in svg
    assert "missed 1 of 200000; spurious 2 of 200001" in svg
    assert "scene hello" in svg
    assert "fcl" not in svg, "right, or without an answer"


def test_errors_are_summed_over_scenes_and_not_over_levels(report, lossy_twice):
    svg = report(lossy_twice)[ERRORS]
    assert "missed 10 of 400000; spurious 4 of 400002" in svg
    assert "2 scenes" in svg
    lossy_twice["runs"][-1]["per_frame"]["level"] = "body"
    svg = report(lossy_twice)[ERRORS]
    assert "(triangle)" in svg
    assert "(body)" in svg
    assert "spurious 2 of 15" in svg


def test_errors_are_of_families_only_where_there_is_no_other_scene(report, sample, hard):
    hard["runs"][1]["levels"]["triangle"]["missed"] = 3
    svg = report(hard)[ERRORS]
    assert "2 families of hard cases" in svg
    assert "skin (triangle)" in svg
    hard["scenes"].append(sample["scenes"][0])
    assert ERRORS not in report(hard), "that scene has no run"


def test_errors_leave_out_what_is_no_claim(report, sample, lossy):
    assert ERRORS in report(sample)
    lossy["levels"]["triangle"]["informative"] = True
    assert ERRORS not in report(sample)


def test_stages_say_how_many_each_lost(report, sample):
    svg = report(sample)[STAGES]
    assert ">hash 1 of 200000<" in svg
    assert "ffd-aabb-sphere2+tri: 1 of 200000 true pairs lost in hash" in svg


def test_stages_are_summed_over_scenes(report, lossy_twice):
    svg = report(lossy_twice)[STAGES]
    assert ">hash 5, spheres 5 of 400000<" in svg
    assert "2 scenes" in svg


# Stages cover pairs of triangles: how many a run lost that was judged by bodies alone is not known.
def test_stages_leave_out_runs_that_were_not_judged_there(report, lossy_twice):
    lossy_twice["runs"][-1]["per_frame"]["level"] = "body"
    assert ">hash 1 of 200000<" in report(lossy_twice)[STAGES]


def test_stages_are_left_out_where_none_lost_any(report, sample, lossy):
    assert STAGES in report(sample)
    lossy["stages"][0]["missed"] = 0
    assert STAGES not in report(sample)
    lossy["stages"] = []
    assert STAGES not in report(sample)


def test_stages_have_a_colour_for_any_number(report, sample, lossy):
    lossy["stages"] = [stage(f"stage{i}", 1) for i in range(20)]
    svg = report(sample)[STAGES]
    assert ">other stages<" in svg
    assert "lost in stage19" in svg
    assert 'class="s8"' not in svg


def test_charts_are_files_of_the_report(report, sample):
    files = report(sample)
    for file in (ERRORS, STAGES):
        assert file in files
        assert f"]({file})" in files["report.md"]
    del sample["runs"][1]
    files = report(sample)
    assert ERRORS not in files
    assert "Errors by detector and stage" not in files["report.md"]


def test_charts_take_no_markup_from_results(report, sample, lossy):
    lossy["detector"] = "<script>"
    lossy["stages"][0]["name"] = "<b>"
    files = report(sample)
    for file in (ERRORS, STAGES):
        assert "&lt;script&gt;" in files[file]
        assert "<script" not in files[file]
        assert "<b>" not in files[file]
