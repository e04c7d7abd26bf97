"""Recorded deformation through the whole program: a scene's own frames, as files, give its answers."""

import json
import struct

import meshes
from point_caches import mdd_bytes
from program import successful, tiny_scene, valid_results

FRAMES = 9


def run(folder, scene, *detectors):
    successful("run", folder / scene, "--no-timing", "--out", folder / "out",
               *(word for name in detectors for word in ("--detector", name)))
    return valid_results(folder / "out/results.json")


def write_tiny(folder):
    (folder / "tiny.json").write_text(tiny_scene("tiny", FRAMES))


def write_frames(folder):
    """The deformed surfaces of the tiny scene, one OBJ file per body and frame."""
    successful("export", folder / "tiny.json", "--out", folder / "export")
    for number, body in enumerate(("left", "right")):
        for frame in range(FRAMES):
            ply = folder / f"export/tiny/bodies/{number}-{body}/frame_{frame:04}.ply"
            (folder / f"{body}_{frame}.obj").write_text(meshes.obj_text(exported_mesh(ply.read_bytes())))


def exported_mesh(ply):
    head, _, data = ply.partition(b"end_header\n")
    counts = dict(line.split()[1:] for line in head.decode().splitlines() if line.startswith("element "))
    corners = 24 * int(counts["vertex"])
    triangles = [face[1:] for face in struct.iter_unpack("<B3i", data[corners:])]
    assert len(triangles) == int(counts["face"])
    return list(struct.iter_unpack("<3d", data[:corners])), triangles


def write_recorded(folder, **more):
    (folder / "recorded.json").write_text(json.dumps({
        "id": "recorded", "duration": 1, "levels": ["body", "cell", "triangle", "vertex"],
        "bodies": [{"name": name, "recording": {"frames": f"{name}_%d.obj"}, **more}
                   for name in ("left", "right")]}))


def test_frames_of_a_scene_give_its_contact_hash(tmp_path):
    write_tiny(tmp_path)
    scripted = run(tmp_path, "tiny.json", "fcl-aabb", "aabb-tree", "spatial-hash")
    write_frames(tmp_path)
    write_recorded(tmp_path)
    replayed = run(tmp_path, "recorded.json", "fcl-aabb", "aabb-tree", "spatial-hash", "ffd-aabb-sphere2+tri")
    scene = replayed["scenes"][0]
    assert scripted["scenes"][0]["truth"]["triangle"] > 0
    assert scene["frames"] == FRAMES
    assert scene["truth_hash"] == scripted["scenes"][0]["truth_hash"]
    *without_lattice, with_lattice = replayed["runs"]
    assert [row["status"] for row in without_lattice] == ["ok"] * 3
    assert [row["contact_hash"] for row in without_lattice] == [
        row["contact_hash"] for row in scripted["runs"]]
    # A detector that needs a lattice says so, and is judged nowhere.
    assert with_lattice["status"] == "refused"
    assert ('needs a lattice for every body; a body of a scene file gets one by "lattice": {"kept": 150, '
            '"fit": true}') in with_lattice["message"]
    assert "fits" not in scene


# What lattices of the same cells made, they can make again; then every detector answers.
def test_fitted_lattice_admits_ffd_detectors_and_its_error_is_reported(tmp_path):
    write_tiny(tmp_path)
    write_frames(tmp_path)
    write_recorded(tmp_path, lattice={"cells": [3, 3, 3], "fit": True})
    fitted = run(tmp_path, "recorded.json", "fcl-aabb", "ffd-aabb-sphere2+tri", "ffd-lazy")
    scene = fitted["scenes"][0]
    assert [fit["body"] for fit in scene["fits"]] == ["left", "right"]
    assert len(scene["fits"][1]["max"]) == FRAMES
    assert max(scene["fits"][1]["max"]) < 1e-4
    assert scene["truth"]["triangle"] > 0
    for row in fitted["runs"]:
        assert row["status"] == "ok", row["message"]
        assert row["contact_hash"] == scene["truth_hash"], "all are given the fitted surface"
    assert "Lattices fitted to recordings" in (tmp_path / "out/report.md").read_text()


# A cache that changes is another scene, though no scene file has changed.
def test_changed_cache_is_another_scene(tmp_path):
    here = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
    away = [[5, 0, 0], [6, 0, 0], [5, 1, 0]]
    (tmp_path / "rest.obj").write_text(meshes.obj_text((here, [[0, 1, 2]])))
    (tmp_path / "s.json").write_text(json.dumps({
        "id": "s", "duration": 1, "levels": ["triangle"],
        "bodies": [{"name": "sheet", "mesh": {"file": "rest.obj"}, "recording": {"cache": "a.mdd"}},
                   {"name": "box", "mesh": {"shape": "box"}}]}))
    for points, contact_frames in ((here, 2), (away, 0)):
        (tmp_path / "a.mdd").write_bytes(mdd_bytes([points, points]))
        assert run(tmp_path, "s.json", "fcl-aabb")["scenes"][0]["contact_frames"] == contact_frames
