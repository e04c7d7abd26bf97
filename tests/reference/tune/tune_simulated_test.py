"""contactcheck tune of simulated scenes, as it is run."""

import shlex

import pytest

from program import successful

SAFE = "ffd-aabb+tri:bounds=safe,cell=1"


@pytest.fixture(autouse=True)
def falling(tune, falling_scene):
    tune.write("falling.json", falling_scene())


def test_tune_simulates_the_scene_and_holds_out_every_other_frame(tune):
    tuned = tune("--detector", "ffd-aabb+tri:cell=1", "--question", "triangles")
    assert (tune.result["frames"], tune.result["held_out_frames"]) == (6, 6)
    assert "deformers" not in tune.result, "the deformer is the scene's, and costs nothing"
    assert f"contactcheck run {shlex.quote(str(tune.scene))} --detector ffd-aabb+tri" in tuned.out
    tune("--detector", "ffd-aabb+tri:cell=1", "--frames", "4")
    assert tune.result["frames"] == 4


def test_tune_tries_every_deformer_and_counts_what_its_step_costs(tune):
    tuned = tune("--deformer", "all", "--detector", "ffd-aabb+tri:bounds=safe,precision=double",
                 "--exhaustive", "--question", "triangles")
    result = tune.result
    step = {deformer["deformer"]: deformer["step_ms"] for deformer in result["deformers"]}
    assert len(step) == 3
    assert len(result["measured"]) == 9, "3 hash cells, 3 deformers"
    for measured in result["measured"]:
        assert measured["step_ms"] == step[measured["deformer"]]
        assert measured["cost_ms"] > measured["step_ms"]
        assert measured["cost_ms_low"] <= measured["cost_ms"]
        assert measured["missed"] == 0
        if measured["deformer"] == "mass-spring":
            assert measured["deviation_max"] == 0
        else:
            assert measured["deviation_max"] > 0
    assert "of it deforming" in tuned.out
    assert "deforming, ms a step: mass-spring " in tuned.out
    assert "Deforming, ms a step: mass-spring " in tune.page


def test_tune_names_a_scene_that_runs_with_the_chosen_deformer(tune):
    tune("--deformer", "shape-matching", "--detector", SAFE, "--exhaustive")
    result = tune.result
    file = result["deformers"][1]["scene"]
    successful("run", file, "--detector", "ffd-aabb+tri", "--no-timing", "--quiet", "--out",
               tune.folder / "run")
    # What is chosen is named by its own file, and the scene's own by the word that was given.
    own = result["chosen"]["deformer"] == "mass-spring"
    assert result["chosen"]["scene"] == (str(tune.scene) if own else file)


def test_tune_limits_how_far_a_deformer_may_deviate(tune):
    tune("--deformer", "all", "--detector", SAFE, "--max-deviation", "0", "--exhaustive")
    assert tune.result["chosen"]["deformer"] == "mass-spring"


def test_tune_says_which_deformer_could_not_be_simulated(tune, falling_scene):
    # Every step is stable for shape matching; 10,000 substeps are too few for finite elements as stiff.
    tune.write("falling.json", falling_scene(model="shape-matching", mass=5, relaxation_time=2e-6, region=1))
    tuned = tune("--deformer", "finite-elements", "--detector", SAFE + ",precision=double", "--exhaustive")
    assert "Not tried: finite-elements: " in tuned.out
    assert "too stiff" in tuned.out
    assert len(tune.result["measured"]) == 1
    assert "too stiff" in tune.result["deformers"][1]["failure"]
