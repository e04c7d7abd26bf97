"""Whole runs in closed loop: `run --closed-loop` on two falling boxes, `reproduce` on a scene of the
paper.
"""

import json
import os
import pathlib

import pytest

from program import names_in, run_files, successful, valid_results


def valid_run(folder, *words):
    """The results, which must satisfy schema and sums, and the outcome."""
    outcome = successful(*words, "--quiet", "--out", folder / "out")
    return valid_results(folder / "out" / "results.json"), outcome


def runs_of_boxes(folder, *words):
    """One box rests on the ground, the other falls on it: in contact from frame 5 on. Two detectors."""
    bodies = [{"name": name, "mesh": {"shape": "box", "divisions": 2}, "lattice": {"cells": [2, 2, 2]},
               "motion": {"position": position},
               "material": {"model": "mass-spring", "mass": 10, "stiffness": 2000, "damping": 3}}
              for name, position in (("lower", [0, 0.52, 0]), ("upper", [0.1, 1.7, 0.1]))]
    (folder / "boxes.json").write_text(json.dumps(
        {"id": "falling-boxes", "title": "Two boxes", "frames": 8, "simulation": {"every": 2, "ground": {}},
         "levels": ["body", "cell", "triangle", "vertex"], "bodies": bodies}), encoding="utf-8")
    results, _ = valid_run(folder, "run", folder / "boxes.json", "--detector", "ffd-aabb-sphere2+tri",
                           "--detector", "fcl-collide", *words)
    assert len(results["runs"]) == 2
    assert results["scenes"][0]["simulation"]["every"] == 2
    return results["runs"]


def test_every_detector_drives_and_is_timed_in_whole_steps(tmp_path):
    for run in runs_of_boxes(tmp_path, "--closed-loop", "--processes", "1"):
        loop, step = run["closed_loop"], run["step_ms"]
        assert (loop["error"], loop["steps"], loop["tunnelling_events"]) == ("", 16, 0), run["detector"]
        assert loop["levels"]["triangle"]["truth"] > 0, run["detector"]
        assert loop["levels"]["triangle"]["recall"] == 1, run["detector"]
        # The motion has no more steps.
        assert (step["steps"], step["repeats"]) == (16, 5), run["detector"]
        assert step["total"] > 0, run["detector"]


def test_without_timing_no_step_is_timed(tmp_path):
    for run in runs_of_boxes(tmp_path, "--closed-loop", "--no-timing"):
        assert "closed_loop" in run and "step_ms" not in run, run["detector"]


def test_without_the_flag_there_is_no_closed_loop(tmp_path):
    for run in runs_of_boxes(tmp_path, "--no-timing"):
        assert not {"closed_loop", "step_ms"} & set(run), run["detector"]


def data_installed():
    """Whether the Debian packages with the meshes of the paper's scenes are where the program looks."""
    cache = pathlib.Path(os.environ.get("XDG_CACHE_HOME") or pathlib.Path.home() / ".cache")
    roots = [os.environ["CONTACTCHECK_DATA"]] if os.environ.get("CONTACTCHECK_DATA") else [
        "/", cache / "contactcheck"]
    return all(any((pathlib.Path(root) / "usr/share/doc" / name).is_file() for root in roots)
               for name in ("libcgal-demo/data.tar.gz", "povray/examples/advanced/teapot/teapot.inc"))


def expect_teapot(scene):
    assert (scene["scene"], scene["frames"]) == ("teapot", 4)
    assert scene["counts"]["triangles"]["ours"] == scene["counts"]["triangles"]["paper"] == 12800
    row = scene["ratios"][1]
    assert row["paper_reports"]["table"] == "Table 3"
    for reading in ("safe", "paper", "exact"):
        assert row[reading]["test"]["ratio"] > 0, reading
    assert row["safe"]["same_contacts"] is True


@pytest.mark.skipif(not data_installed(), reason="install libcgal-demo and povray-examples")
def test_reproduction_of_one_scene_writes_its_tables_beside_the_papers(tmp_path):
    results, outcome = valid_run(tmp_path, "reproduce", "paper-teapot", "--frames", "4", "--repeat", "1")
    out = tmp_path / "out"
    assert names_in(out) == run_files("reproduction.json", "reproduction.md")
    assert len(results["runs"]) == 13, "the detectors of the suite paper"
    for run in results["runs"]:
        assert run["status"] == "ok", run["message"]
        # Two steps per frame.
        assert (run["closed_loop"]["error"], run["closed_loop"]["steps"]) == ("", 8), run["detector"]
        assert (run["step_ms"]["steps"], run["step_ms"]["repeats"]) == (8, 1), run["detector"]

    reproduction = json.loads((out / "reproduction.json").read_text(encoding="utf-8"))
    assert reproduction["schema"] == "contactcheck-reproduction/1"
    teapot, = reproduction["scenes"]  # the others were not run
    expect_teapot(teapot)
    assert reproduction["means"]["scenes"] == 1
    assert len(reproduction["paper"]["findings"]) > 20

    markdown = (out / "reproduction.md").read_text(encoding="utf-8")
    assert "\n## teapot\n" in markdown
    assert "| triangles | 12800 | 12800 | +0.00 % |\n" in markdown
    assert "\n## What the paper's own numbers say\n" in markdown
    assert "## paper-teapot" in (out / "report.md").read_text(encoding="utf-8")
    assert outcome.err == ""
    for name in ("reproduction.md", "reproduction.json", "report.md"):
        assert str(out / name) in outcome.out
