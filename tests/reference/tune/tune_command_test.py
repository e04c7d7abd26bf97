"""contactcheck tune, as it is run."""

import json
import re
import shlex
import signal

import pytest

from program import PROGRAM, RunningProgram, contactcheck, successful, tiny_scene

CELL_3 = "ffd-aabb+tri:cell=3,bounds=paper,precision=double"


@pytest.fixture(autouse=True)
def tiny(tune):
    tune.write("tiny.json", tiny_scene("tiny", 9))


def spheres():
    # Boxes round the pieces of spheres touch before the spheres do: bodies hover.
    return tiny_scene("tiny", 9).replace('"box", "divisions"', '"sphere", "divisions"')


def test_tune_chooses_a_configuration_that_run_confirms(tune):
    tuned = tune("--detector", "ffd-aabb+tri:precision=double", "--detector", "ffd-aabb:precision=double")
    result = tune.result
    assert result["schema"] == "contactcheck-tune/1"
    assert (result["candidates"], result["frames"], result["held_out_frames"]) == (12, 9, 8)
    assert result["chosen"]["missed"] == 0
    chosen = result["chosen"]["detector"]
    command = f"contactcheck run {shlex.quote(str(tune.scene))} --detector {chosen}"
    assert command in tuned.out
    assert command in tune.page
    successful("run", tune.scene, "--detector", chosen, "--no-timing", "--quiet", "--out", tune.out)
    [row] = json.loads((tune.out / "results.json").read_text(encoding="utf-8"))["runs"]
    assert row["levels"]["body"]["missed"] == 0


def test_tune_says_how_sure_a_cost_is_and_what_is_as_cheap(tune):
    tuned = tune("--detector", "ffd-aabb:precision=double")
    result = tune.result
    for measured in result["measured"]:
        assert measured["cost_ms_low"] <= measured["cost_ms"] <= measured["cost_ms_high"]
    assert result["measurements"] == sum(measured["times"] for measured in result["measured"])
    assert "  interval  " in tuned.out
    assert "95 %" not in tuned.out, "of few passes"
    words = ("As cheap within noise: " + result["as_cheap"][0]["detector"] if result["as_cheap"] else
             "Nothing else that was measured and meets the limits is as cheap within noise.")
    assert words in tuned.out
    assert words in tune.page


def test_tune_tells_on_the_way_how_many_configurations_were_measured(tune):
    # What is measured again is not another configuration.
    told = re.findall(r"^(\d+) of \d+ configurations measured",
                      tune("--detector", "ffd-aabb:precision=double").err, re.MULTILINE)
    assert int(told[-1]) == len(tune.result["measured"])


def test_tune_measures_every_configuration_when_told(tune):
    tune("--detector", "ffd-aabb:precision=double", "--exhaustive")
    assert len(tune.result["measured"]) == 6


def test_tune_says_that_nothing_meets_the_limits(tune):
    tune.write("tiny.json", spheres())
    tuned = tune.outcome("--detector", "ffd-aabb", "--max-hover", "0")
    assert tuned.exit_code == 1
    assert "No configuration meets the limits." in tuned.out
    assert tune.result["chosen"] is None


def test_tune_says_in_which_sizes_the_chosen_one_is_known_to_be_right(tune):
    # With all of its options named, it is the only candidate.
    tuned = tune("--detector", "fcl-collide:prefilter=none,refit=bottom-up,split=mean", "--question",
                 "triangles")
    assert "In the suite scales it is right for edges of 1e-12 to 1e12 m; here " in tuned.out
    assert "outside" not in tuned.out
    by_size, by_distance = tune.result["chosen"]["known_ranges"]
    assert (by_size["by"], by_size["from"], by_distance["by"]) == ("size", "1e-12", "distance")


def test_tune_says_that_the_chosen_one_is_beyond_the_budget(tune):
    tuned = tune.outcome("--detector", "ffd-aabb+tri:cell=3", "--budget-ms", "0.000001")
    assert tuned.exit_code == 1
    assert "more than the 1e-06 ms that are allowed" in tuned.out
    assert tune.result["within_budget"] is False


def test_tune_tries_other_lattices(tune):
    tune("--detector", CELL_3, "--lattice", "0.04", "--exhaustive", "--max-missed", "1000")
    own, other = tune.result["measured"]
    assert own["deviation_max"] == 0
    assert other["deviation_max"] > 1e-4


def test_tune_keeps_lattices_apart_that_differ_by_less_than_a_percent(tune):
    tune("--detector", CELL_3, "--lattice", "0.041", "--lattice", "0.044", "--lattice", "0.044",
         "--exhaustive", "--max-missed", "1000")
    assert len(tune.result["measured"]) == 3


def test_tune_names_a_command_that_runs_a_detector_from_outside(tune):
    own = tune.outside_detector()
    tuned = tune("--detector-cmd", own, "--question", "triangles", "--frames", "4")
    assert f"--detector-cmd '{own}' --detector python-sweep" in tuned.out


def test_tune_takes_a_recording_every_other_frame_of_which_is_held_out(tune):
    successful("run", tune.scene, "--detector", "ffd-lazy", "--no-timing", "--quiet", "--out", tune.out)
    tune.scene = tune.out / "recordings" / "tiny.ccr"
    tune("--detector", "ffd-lazy", "--question", "triangles")
    assert (tune.result["frames"], tune.result["held_out_frames"]) == (5, 4)
    assert "has recorded frames" in tune.outcome("--frames", "4").err


@pytest.mark.parametrize("words, named", [
    (["--repeat", "3"], "--repeat"),
    (["--processes", "0"], "--processes"),
    (["--max-hover", "nan"], '"nan" is not a number from 0 on'),
    (["--budget-ms", "-1"], '"-1" is not a number from 0 on'),
    (["--max-missed", "-1"], "--max-missed"),
    (["--lattice", "0"], '"0" is not a number from 0.01 to 100'),
    (["--question", "contacts"], "contacts"),
    (["--frames", "3"], "3"),
    (["--most", "1", "--exhaustive"], "--exhaustive"),
    (["--deformer", "jelly"], "jelly"),
    (["--deformer", "all"], "is not simulated"),
    (["--detector", "no-such"], 'unknown detector "no-such"'),
    (["--detector", "ffd-aabb", "--question", "triangles"], "does not answer the question")])
def test_tune_refuses_bad_words_with_one_sentence(tune, words, named):
    refused = tune.outcome(*words)
    assert refused.exit_code == 2
    assert named in refused.err
    assert refused.err.count("\n") == 1


@pytest.mark.parametrize("scene, words, named", [
    ("default", [], '"default" is a suite'), ("paper-rabbit", ["--lattice", "2"], "is simulated"),
    ("hard-vertex-face", [], "its frames are cases")])
def test_tune_refuses_scenes_that_it_cannot_vary(tune, scene, words, named):
    refused = contactcheck("tune", scene, "--out", tune.out, *words)
    assert refused.exit_code == 2
    assert named in refused.err


def test_tune_goes_on_after_an_interruption(tune):
    words = tune.words("--detector", "ffd-aabb+tri:precision=double", "--exhaustive")
    kept = tune.out / "kept-runs"
    with RunningProgram(PROGRAM, words) as program:
        assert program.wait_for((kept / "1.json").exists)
        program.send(signal.SIGKILL)
        program.outcome()
    parts = {file.name: file.read_bytes() for file in kept.glob("[0-9]*.json")}
    refused = contactcheck(*words)
    assert refused.exit_code == 2
    assert re.search(r"a search that did not end has left \d+ measured runs? there: --resume takes them over, "
                     r"--overwrite discards them\n", refused.err)
    other = contactcheck(*words, "--max-spurious", "3", "--resume")
    assert other.exit_code == 2
    assert "of another one (other words): contactcheck tune " in other.err
    scene = tune.scene.read_text(encoding="utf-8")
    tune.write("tiny.json", scene.replace('"title": "', '"title": "another '))
    assert "of another one (other scene): " in contactcheck(*words, "--resume").err
    tune.write("tiny.json", scene)
    assert {file.name: file.read_bytes() for file in kept.glob("[0-9]*.json")} == parts
    resumed = contactcheck(*words, "--resume")
    assert resumed.exit_code == 0, resumed.err
    assert re.match(r"resumed: [1-9]\d* measured runs?\n", resumed.err)
    assert not kept.exists()
    assert len(tune.result["measured"]) == tune.result["candidates"]
