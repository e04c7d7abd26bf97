"""run drawn: whole runs of small drawn scenes, in one piece and in shards."""

import json
import os
import re

import pytest

import meshes
from program import contactcheck, successful, validate_results

SMALL_RULES = {
    "id": "small", "detectors": ["full-refit"], "meshes": ["box", "letter", "sphere", "torus"],
    "shares": {"apart": 4, "near-miss": 4, "graze": 2, "touch": 3, "deep": 3, "pile": 2, "nested": 2},
    "most_triangles": 4000, "triangles": [80, 600], "cells": [8, 60], "bodies": [2, 4],
    "size_ratio": [1, 4], "frames": [6, 10], "speed": [0, 0.05], "contact_share": [0.34, 1],
    "deformers": [0, 2], "twist": [-60, 60], "bend": [-60, 60], "taper": [-0.3, 0.3],
    "stretch": [-0.25, 0.4], "apart_gap": [0.1, 1], "near_gap": [1e-5, 0.01],
    "graze_depth": [1e-6, 0.0001], "touch_depth": [0.001, 0.02], "deep_depth": [0.03, 0.2],
}
needs_memory_limits = pytest.mark.skipif(
    re.search("address|thread|memory", os.environ.get("CONTACTCHECK_SANITIZE", "")) is not None,
    reason="a sanitizer needs memory of its own")


def command(folder, out, *more, triangles=None):
    """A run of small rules. `triangles`: of one pair of bodies that touch, per body, from and to."""
    rules = SMALL_RULES
    if triangles:
        rules = {**SMALL_RULES, "shares": {"touch": 1}, "most_triangles": 400000, "bodies": [2, 2],
                 "triangles": triangles}
    (folder / "rules.json").write_text(json.dumps(rules))
    return ["run", folder / "rules.json", "--no-timing", "--quiet", "--out", folder / out, *more]


def run_again(folder, scene):
    successful("run", folder / scene, "--no-timing", "--quiet", "--detector", "full-refit",
               "--out", folder / "again")
    return scenes(folder, "again")


def scenes(folder, out):
    return validate_results.load(folder / out / "results.json")["scenes"]


def reported(folder, out):
    """The section of drawn scenes."""
    return (folder / out / "report.md").read_text().partition("## Drawn scenes\n")[2].partition("\n## ")[0]


def test_shards_are_the_whole_run(tmp_path):
    three = ["--seed", "7", "--count", "3"]
    successful(*command(tmp_path, "whole", *three))
    for k in ("1", "2"):
        successful(*command(tmp_path, k, *three, "--shard", f"{k}/2"))
    successful("merge", tmp_path / "1/results.json", tmp_path / "2/results.json",
               "--out", tmp_path / "merged")
    whole = scenes(tmp_path, "whole")
    assert scenes(tmp_path, "merged") == whole
    assert "3 scenes drawn from seed 7" in reported(tmp_path, "whole")
    assert reported(tmp_path, "merged") == reported(tmp_path, "whole")
    assert len(whole) == 3
    for number, scene in enumerate(whole, 1):
        assert scene["id"] == f"drawn-7-{number}"
        drawn = scene["drawn"]
        assert (drawn["seed"], drawn["number"], drawn["redrawn"]) == (7, number, 0)
        assert "separation" not in scene


def test_saved_scene_runs_again_with_the_same_truth(tmp_path):
    successful(*command(tmp_path, "drawn", "--seed", "3", "--count", "2", "--save-scene", tmp_path / "kept"))
    assert run_again(tmp_path, "kept/drawn-3-2.json")[0] == scenes(tmp_path, "drawn")[1]


def test_saved_scene_names_its_meshes_from_its_own_folder(tmp_path):
    (tmp_path / "meshes").mkdir()
    (tmp_path / "meshes/box.obj").write_text(meshes.obj_text(meshes.box(3)))
    (tmp_path / "meshes/ball.obj").write_text(meshes.obj_text(meshes.sphere(2, 2)))
    successful(*command(tmp_path, "drawn", "--seed", "3", "--count", "2",
                        "--save-scene", tmp_path / "first/kept",
                        "--mesh", tmp_path / "meshes/box.obj", "--mesh", tmp_path / "meshes/ball.obj"))
    assert str(tmp_path) not in (tmp_path / "first/kept/drawn-3-1.json").read_text()
    # Moved together, they are found all the same.
    (tmp_path / "moved").mkdir()
    (tmp_path / "first").rename(tmp_path / "moved/first")
    (tmp_path / "meshes").rename(tmp_path / "moved/meshes")
    again = run_again(tmp_path, "moved/first/kept/drawn-3-1.json")
    assert again[0]["truth_hash"] == scenes(tmp_path, "drawn")[0]["truth_hash"]


def test_steps_are_judged_between_frames(tmp_path):
    steps = {**SMALL_RULES, "id": "small-steps", "detectors": ["fcl-ccd", "swept-aabb", "ffd-lazy"],
             "shares": {**SMALL_RULES["shares"], "pass": 4}, "frames": [2, 4], "speed": [0.001, 1],
             "steps": {"most_swept": 300, "self_share": 0.5, "self_twist": [10, 270]}}
    (tmp_path / "rules.json").write_text(json.dumps(steps))
    successful("run", tmp_path / "rules.json", "--steps", "--seed", "5", "--count", "8", "--no-timing",
               "--quiet", "--out", tmp_path / "out")
    drawn = scenes(tmp_path, "out")
    assert [scene["id"] for scene in drawn] == [f"drawn-steps-5-{i}" for i in range(1, 9)]
    for scene in drawn:
        assert len(scene["impacts"]["motion"]) == scene["frames"] - 1
        assert {"impact-vf", "impact-ee", "impact-triangle", "impact"} <= set(scene["truth"])
    impacts = [scene for scene in drawn if any(scene["truth"].values())]
    assert 0 < len(impacts) < len(drawn)
    assert 0 < sum("impact-self-vf" in scene["truth"] for scene in drawn) < len(drawn)
    text = reported(tmp_path, "out")
    assert f"8 scenes drawn from seed 5, {len(impacts)} with impacts; " in text
    for kind, count in ("with", len(impacts)), ("without", len(drawn) - len(impacts)):
        title = f"### Missed and spurious in {count} scene{'s' if count > 1 else ''} {kind} impacts"
        assert title in text
    for detector in "swept-aabb", "ffd-lazy":
        assert text.count(f"\n| {detector} | ") == 2
    # fcl-ccd lacks what the policy demands of exact ones, which are not all here.
    outcome = contactcheck("gate", tmp_path / "out/results.json", "--policy", "drawn-steps")
    assert outcome.exit_code == 1
    assert "embree-swept" in outcome.out and "missed" not in outcome.out


# Of this seed the first scene has 135,784 triangles a body, far too many for the limit, and the
# one drawn in its place 137.
@needs_memory_limits
def test_scene_that_passes_a_limit_is_drawn_again_and_counted(tmp_path):
    successful(*command(tmp_path, "limited", "--seed", "1", "--count", "1", "--memory-limit", "64",
                        "--save-scene", tmp_path / "kept.json", triangles=[100, 200000]))
    scene = scenes(tmp_path, "limited")[0]
    assert scene["drawn"]["redrawn"] >= 1
    assert "unjudged" not in scene
    assert "1 of them was drawn again because a limit" in reported(tmp_path, "limited")
    assert run_again(tmp_path, "kept.json")[0] == scene


@needs_memory_limits
def test_scene_that_passes_a_limit_each_time_is_not_judged_and_the_run_continues(tmp_path):
    outcome = contactcheck(*command(tmp_path, "limited", "contact", "--detector", "full-refit", "--seed", "1",
                                    "--count", "1", "--memory-limit", "64", triangles=[199000, 200000]))
    assert outcome.exit_code == 3, outcome.err
    drawn, contact = scenes(tmp_path, "limited")
    assert drawn["drawn"]["redrawn"] == 5
    assert ("phase scene: more than 64 MiB resident (memory limit), before any detector: this scene "
            "cannot be made, like the 5 drawn in its place") in drawn["unjudged"]
    assert contact["truth"]["body"] > 0
    assert "1 could not be judged within the limits" in reported(tmp_path, "limited")
