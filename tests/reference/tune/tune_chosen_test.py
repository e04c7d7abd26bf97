"""The file that contactcheck tune writes of its choice, as contactcheck run takes it."""

import json
import pathlib
import shlex

import pytest

from program import contactcheck, names_in, successful, tiny_scene

DETECTOR = "ffd-aabb+tri:bounds=safe,cell=2"  # whose precision is to be chosen
DOUBLE = DETECTOR + ",precision=double"
# The six sides of a box about the origin, outwards.
BOX_OBJ = """\
v -0.5 -0.5 -0.5
v 0.5 -0.5 -0.5
v -0.5 0.5 -0.5
v 0.5 0.5 -0.5
v -0.5 -0.5 0.5
v 0.5 -0.5 0.5
v -0.5 0.5 0.5
v 0.5 0.5 0.5
f 1 3 4
f 1 4 2
f 5 6 8
f 5 8 7
f 1 2 6
f 1 6 5
f 3 7 8
f 3 8 4
f 1 5 7
f 1 7 3
f 2 4 8
f 2 8 6
"""


@pytest.fixture(autouse=True)
def tiny(tune):
    tune.write("tiny.json", tiny_scene("tiny", 9))


def tiny_of(change):
    """The text of the scene after `change` of each of its bodies."""
    scene = json.loads(tiny_scene("tiny", 9))
    for body in scene["bodies"]:
        change(body)
    return json.dumps(scene)


@pytest.fixture
def project(tune):
    """A folder with a scene whose mesh is a file beside it."""
    folder = tune.folder / "project"
    (folder / "meshes").mkdir(parents=True)
    (folder / "meshes" / "box.obj").write_text(BOX_OBJ, encoding="utf-8")
    tune.write("project/scenes/tiny.json",
               tiny_of(lambda body: body.update(mesh={"file": "../meshes/box.obj"})))
    return folder


def suite_of(tune):
    return json.loads((tune.out / "chosen.json").read_text(encoding="utf-8"))


def row_of(tune, *words, cwd=None):
    """The one row of a run."""
    successful("run", *words, "--no-timing", "--quiet", "--out", tune.folder / "run", cwd=cwd)
    [row] = json.loads((tune.folder / "run" / "results.json").read_text(encoding="utf-8"))["runs"]
    return row


def expect_that_run_takes(tune, file, cwd=None):
    """Running the file and running the words of tune.json are one thing."""
    folder = cwd / "out" if cwd else tune.out
    told = json.loads((folder / "tune.json").read_text(encoding="utf-8"))["chosen"]
    row = row_of(tune, file, cwd=cwd)
    wanted = row_of(tune, told["scene"], "--detector", told["detector"], cwd=cwd)
    assert row["status"] == "ok"
    for key in ("scene", "detector", "options", "contact_hash"):
        assert row[key] == wanted[key], key
    assert row["detector"] == told["detector"]


def test_chosen_is_a_file_that_run_takes_as_it_stands(tune):
    tuned = tune("--detector", DETECTOR)
    assert tune.result["chosen"]["file"] == "chosen.json"
    expect_that_run_takes(tune, tune.out / "chosen.json")
    assert suite_of(tune)["title"] == "Chosen by contactcheck tune for tiny"
    assert "cell=2" in suite_of(tune)["detectors"][0]
    command = f"  contactcheck run {shlex.quote(str(tune.out / 'chosen.json'))}\n"
    assert command in tuned.out
    assert command in tune.page
    assert names_in(tune.out) == {"chosen.json", "tune.json", "tune.md"}, "and no empty folder"


def test_chosen_names_a_scene_that_comes_along_by_its_id(tune):
    tune.scene = "nested"
    tune("--detector", DETECTOR, "--frames", "4")
    assert suite_of(tune)["scenes"] == ["nested"]
    row = row_of(tune, tune.out / "chosen.json", "--frames", "2")
    assert (row["scene"], row["detector"]) == ("nested", tune.result["chosen"]["detector"])


def test_chosen_finds_its_scene_from_any_working_directory_and_when_both_move(tune, project):
    tune.scene, tune.out = pathlib.Path("scenes/tiny.json"), pathlib.Path("out")
    tuned = tune("--detector", DETECTOR, cwd=project)
    suite = json.loads((project / "out" / "chosen.json").read_text(encoding="utf-8"))
    assert suite["scenes"][0]["file"] == "../scenes/tiny.json"
    assert "  contactcheck run out/chosen.json\n" in tuned.out
    expect_that_run_takes(tune, "out/chosen.json", cwd=project)
    assert row_of(tune, project / "out" / "chosen.json", cwd="/")["scene"] == "tiny"
    moved = project.rename(tune.folder / "moved")
    assert row_of(tune, moved / "out" / "chosen.json", cwd="/")["scene"] == "tiny"


def test_chosen_finds_its_scene_through_a_link_to_the_folder(tune, project):
    away = tune.folder / "far" / "away"
    away.mkdir(parents=True)
    tune.out = project / "out"
    tune.out.symlink_to(away)
    tune("--detector", DETECTOR)
    expect_that_run_takes(tune, tune.out / "chosen.json")
    expect_that_run_takes(tune, away / "chosen.json")


def test_chosen_names_the_scene_in_lattices_of_its_own(tune):
    # Some 1,000 cells a body against 27.
    fine = json.loads(tiny_of(lambda body: body["lattice"].update(cells=[14, 14, 14])))
    tune.write("tiny.json", json.dumps({**fine, "frames": 5}))
    tuned = tune("--detector", DOUBLE, "--lattice", "0.01", "--exhaustive", "--max-missed", "1000")
    assert suite_of(tune)["scenes"][0]["file"] == "tune/scenes/tiny-lattice-1.json"
    assert "Within one lattice these ratios are compared" in tuned.out
    expect_that_run_takes(tune, tune.out / "chosen.json")
    moved = tune.out.rename(tune.folder / "moved")
    assert row_of(tune, moved / "chosen.json")["scene"] == "tiny-lattice-1"


def test_chosen_names_the_scene_with_the_chosen_deformer(tune, falling_scene):
    tune.write("falling.json", falling_scene())
    tune("--deformer", "shape-matching", "--detector", DOUBLE, "--exhaustive")
    own = tune.result["chosen"]["deformer"] == "mass-spring"
    assert suite_of(tune)["scenes"][0]["file"] == (
        "../falling.json" if own else "tune/scenes/falling-shape-matching.json")
    expect_that_run_takes(tune, tune.out / "chosen.json")


def test_chosen_names_a_recording(tune):
    assert row_of(tune, tune.scene, "--detector", "ffd-lazy")["status"] == "ok"
    tune.out.mkdir()
    tune.scene = (tune.folder / "run" / "recordings" / "tiny.ccr").rename(tune.out / "tiny.ccr")
    tune("--detector", DETECTOR)
    assert suite_of(tune)["scenes"][0]["file"] == "tiny.ccr"
    expect_that_run_takes(tune, tune.out / "chosen.json")


def test_chosen_says_that_a_detector_from_outside_must_be_brought_along(tune):
    own = tune.outside_detector()
    tuned = tune("--detector-cmd", own, "--question", "triangles", "--frames", "4")
    assert "a file cannot bring in a detector from outside" in tuned.out
    detector = tune.result["chosen"]["detector"]
    chosen = tune.out / "chosen.json"
    assert (f"contactcheck run {shlex.quote(str(chosen))} --detector-cmd '{own}' --detector {detector}\n"
            in tuned.out)
    row = row_of(tune, chosen, "--detector-cmd", own, "--detector", detector)
    assert (row["scene"], row["detector"]) == ("tiny", detector)
    alone = contactcheck("run", chosen, "--out", tune.out)
    assert alone.exit_code == 2
    assert 'unknown detector "python-sweep"' in alone.err


def test_chosen_does_not_stay_from_an_earlier_run(tune):
    tune("--detector", DETECTOR)
    assert (tune.out / "chosen.json").exists()
    # Boxes round the pieces of spheres touch before the spheres do: bodies hover.
    tune.write("tiny.json", tiny_of(lambda body: body["mesh"].update(shape="sphere")))
    tuned = tune.outcome("--detector", "ffd-aabb:precision=double", "--max-hover", "0")
    assert tuned.exit_code == 1
    assert names_in(tune.out) == {"tune.json", "tune.md"}
    assert "chosen.json" not in tuned.out


def test_chosen_leaves_nothing_behind_for_a_scene_that_cannot_be_tuned(tune):
    tune.scene = "hard-vertex-face"
    assert tune.outcome().exit_code == 2
    assert names_in(tune.out) == set()


def test_chosen_is_not_written_over_the_scene_itself(tune):
    text = tiny_scene("chosen", 9)
    tune.write("out/chosen.json", text)
    refused = tune.outcome("--detector", DETECTOR)
    assert refused.exit_code == 2
    assert "lies where the choice is to be written" in refused.err
    assert tune.scene.read_text(encoding="utf-8") == text


def test_tables_mark_the_anchor_that_costs_are_ratios_to(tune):
    tuned = tune("--detector", DOUBLE)
    [measured] = tune.result["measured"]  # which is then the anchor
    assert tune.result["anchor"] == measured["detector"]
    words = f"the anchor: {measured['detector']}.\n"
    assert words in tuned.out
    assert words in tune.page
    assert "the anchor       0" in tuned.out
    assert "| the anchor | 0 |" in tune.page
