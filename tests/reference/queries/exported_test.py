"""Queries of a scene's steps that the program writes."""

import json
import zlib

import pytest

from program import refused, successful, tiny_scene


def judged(out, *words):
    outcome = successful("queries", *words, "--out", out)
    return json.loads((out / "queries.json").read_text(encoding="utf-8"))["files"], outcome.out


def of(score, name):
    detector, = (d for d in score["detectors"] if d["detector"] == name)
    return detector["score"]


@pytest.fixture
def scene(tmp_path):
    file = tmp_path / "tiny.json"
    file.write_text(tiny_scene(), encoding="utf-8")
    return file


def exported(out, *words):
    outcome = successful("export", *words, "--queries", "--out", out)
    return json.loads((out / "tiny" / "queries.json").read_text(encoding="utf-8")), outcome.out


def test_queries_of_a_scene_have_their_truth_and_all_are_judged(tmp_path, scene):
    index, text = exported(tmp_path / "out", scene)
    folder = tmp_path / "out" / "tiny"
    assert f"{folder / 'edge-edge.csv'}: {index['edge_edge']['written']} queries" in text
    assert len(index["steps"]) == 4  # of five frames
    for kind in ("vertex_face", "edge_edge"):
        counts = index[kind]
        assert counts["written"] == counts["found"] == sum(step[kind] for step in index["steps"]) > 0
        file = folder / f"{kind.replace('_', '-')}.csv"
        content = file.read_bytes()
        assert content.count(b"\n") == 8 * counts["written"]
        assert f"{zlib.crc32(content):08x}" == index["crc32"][file.name]
    assert index["vertex_face"]["contacts"] + index["edge_edge"]["contacts"] > 0
    scores, _ = judged(tmp_path / "judged", folder / "vertex-face.csv", folder / "edge-edge.csv")
    for score, counts in zip(scores, (index["vertex_face"], index["edge_edge"])):
        assert score["queries"] == score["file_truths"] == counts["written"]
        assert (score["file_wrong"], score["contacts"]) == (0, counts["contacts"])
        assert (of(score, "exact")["missed"], of(score, "exact")["spurious"]) == (0, 0)


def test_a_sample_is_a_part_that_the_seed_chooses(tmp_path, scene):
    whole, _ = exported(tmp_path / "whole", scene)

    def lines(out):
        text = (out / "tiny" / "edge-edge.csv").read_text(encoding="utf-8").splitlines()
        return ["\n".join(text[i:i + 8]) for i in range(0, len(text), 8)]

    everything = lines(tmp_path / "whole")
    samples = {}
    for seed in ("1", "2"):
        index, text = exported(tmp_path / seed, scene, "--sample", "10", "--seed", seed)
        assert index["sample"] == {"most": 10, "seed": int(seed)}
        assert index["edge_edge"]["found"] == whole["edge_edge"]["found"] > 10
        assert f"10 queries of {index['edge_edge']['found']}" in text
        samples[seed] = lines(tmp_path / seed)
        assert len(samples[seed]) == 10
        places = [everything.index(query) for query in samples[seed]]
        assert places == sorted(places)
    assert samples["1"] != samples["2"]
    again, _ = exported(tmp_path / "again", scene, "--sample", "10")
    assert lines(tmp_path / "again") == samples["1"]


def test_words_that_do_not_go_together_are_refused(tmp_path, scene):
    refused("export", scene, "--sample", "10", named=["--sample", "--queries"], folder=tmp_path)
    refused("export", scene, "--queries", "--every", "2", named=["--every"], folder=tmp_path)
    refused("queries", named=["one of both"], folder=tmp_path)
