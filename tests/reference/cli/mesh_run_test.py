"""run --mesh: a scene without a scene file."""

import signal

import pytest

import meshes
from program import (PROGRAM, RunningProgram, contactcheck, names_in, run_files, successful, tiny_scene,
                     validate_results)


@pytest.fixture
def folder(tmp_path):
    write_ball(tmp_path, levels=1)
    (tmp_path / "cube.obj").write_text(meshes.obj_text(meshes.box(2)))
    return tmp_path


def write_ball(folder, levels):
    (folder / "ball.obj").write_text(meshes.obj_text(meshes.sphere(2, levels)))


def command(folder, *more):
    return ["run", "--mesh", folder / "ball.obj", "--mesh", folder / "cube.obj", "--no-timing",
            "--out", folder / "out", "--detector", "ffd-aabb-sphere2+tri", "--detector", "fcl-aabb", *more]


def run(folder, *more):
    """The outcome of a short run."""
    return contactcheck(*command(folder, "--frames", "12", *more))


def results(folder, out="out"):
    return validate_results.load(folder / out / "results.json")


def detectors(results):
    return [row["detector"] for row in results["runs"]]


def test_judges_the_meshes_as_a_scene(folder):
    assert run(folder).exit_code == 0
    judged = results(folder)
    scene = judged["scenes"][0]
    assert scene["id"] == "ball-cube-approach"
    assert scene["frames"] == 12
    assert scene["bodies"][0]["name"] == "ball"
    assert 0 < scene["contact_frames"] < 12
    for row in judged["runs"]:
        assert row["status"] == "ok"
        assert row["contact_hash"] == scene["truth_hash"]
    assert names_in(folder / "out") == run_files()
    assert (folder / "out/recordings/ball-cube-approach.ccr").exists()
    assert (folder / "out/contacts/ball-cube-approach.json").exists()


def test_saved_scene_is_the_same_scene(folder):
    assert run(folder, "--save-scene", folder / "mine.json", "--motion", "twist").exit_code == 0
    successful("run", folder / "mine.json", "--frames", "12", "--no-timing", "--out", folder / "again",
               "--detector", "ffd-aabb-sphere2+tri", "--detector", "fcl-aabb")
    again = results(folder, "again")
    assert [row["contact_hash"] for row in again["runs"]] == [
        row["contact_hash"] for row in results(folder)["runs"]]
    assert again["scenes"][0]["id"] == "ball-cube-twist"


def test_saved_scene_is_not_written_over(folder):
    mine = folder / "mine.json"
    mine.write_text("my work")
    outcome = run(folder, "--save-scene", mine)
    assert outcome.exit_code == 2
    assert outcome.err == f'contactcheck: --save-scene: "{mine}" is there already and is not written over\n'
    assert mine.read_text() == "my work"


# A kept scene is taken over only while the meshes are unchanged.
def test_resumes_only_with_the_same_meshes(folder):
    (folder / "long.json").write_text(tiny_scene("long", 20000))
    kept = folder / "out/partial/ball-cube-approach.partial.json"

    def interrupt_after_the_meshes():
        with RunningProgram(PROGRAM, command(folder, folder / "long.json")) as program:
            assert program.wait_for(kept.exists)
            program.send(signal.SIGKILL)
            assert program.outcome().exit_code == 128 + signal.SIGKILL

    def resumed(*more):
        successful(*command(folder, "--resume", *more))
        return results(folder)["resumed"]

    interrupt_after_the_meshes()
    assert resumed() == ["ball-cube-approach"]
    interrupt_after_the_meshes()
    write_ball(folder, levels=2)
    assert contactcheck(*command(folder, "--resume")).exit_code == 2
    assert resumed("--overwrite") == []


@pytest.mark.parametrize("size, metres", [("file", 4), ("0.125", 0.125)])
def test_size_is_that_of_the_file_or_the_one_given(folder, size, metres):
    assert run(folder, "--size", size).exit_code == 0
    # But for the rounding of its coordinates.
    assert results(folder)["scenes"][0]["size"] == pytest.approx(metres, rel=8e-16, abs=0)


def test_mesh_files_need_no_flag(folder):
    successful("run", folder / "ball.obj", folder / "cube.obj", "--no-timing", "--motion", "press",
               "--frames", "12", "--out", folder / "bare")
    judged = results(folder, "bare")
    assert judged["scenes"][0]["id"] == "ball-cube-press"
    assert detectors(judged) == ["fcl-aabb", "embree", "bullet-gimpact", "bullet-vf", "ffd-aabb-sphere2",
                                 "ffd-aabb-sphere2+tri", "full-refit", "ffd-lazy"]


def test_says_how_the_meshes_are_scaled(folder):
    assert "ball: 4 m, scaled to 1 m (--size file keeps it)\n" in run(folder).err
    unscaled = run(folder, "--size", "file").err
    assert "ball: 4 m\n" in unscaled
    assert "warning" not in unscaled
    (folder / "cube.obj").write_text(meshes.obj_text(meshes.sphere(0.01, 1)))
    assert ("warning: ball is 200 times as large as cube in its file; do both have one unit of length?\n"
            in run(folder).err)
    assert run(folder, "--quiet").err == ""


def test_says_what_the_mesh_check_found(folder):
    vertices, triangles = meshes.box(1)
    (folder / "cube.obj").write_text(meshes.obj_text((vertices, triangles[:-1])))
    err = run(folder).err
    assert "\ncube: 3 boundary-edge (first: triangle " in err
    assert "\ncube: containment not judged: open (edge of vertices " in err
    assert "\nball: 0 " not in err
    assert "\nball: containment" not in err


def test_takes_the_detectors_of_a_suite(folder):
    successful("run", folder / "ball.obj", folder / "cube.obj", "--no-timing", "--detectors", "scaling",
               "--detector", "fcl-collide", "--frames", "4", "--out", folder / "suite")
    assert detectors(results(folder, "suite")) == ["ffd-lazy", "full-refit", "embree", "fcl-aabb",
                                                   "fcl-collide"]
