"""Runs in shards: what merge makes of them, and what it refuses."""

import json
import os
import shutil
import signal

import pytest

from cases import with_folder
from program import (PROGRAM, RunningProgram, names_in, refused, run_files, successful,
                     tiny_scene, valid_results)

SCENES = ("one", "two", "three", "four", "five")
# Everything that depends on a clock or an address.
VARYING = {"time_ms", "time_ms_other_questions", "speedup", "frame_ms", "memory_bytes", "prepared_bytes",
           "measured", "low", "high", "met"}


@pytest.fixture
def folder(tmp_path):
    for scene in SCENES:
        (tmp_path / f"{scene}.json").write_text(tiny_scene(scene))
    return tmp_path


def command(folder, out, *more):
    return ["run", "--detector", "fcl-aabb", "--detector", "ffd-grid", "--detector", "ffd-aabb",
            *(folder / f"{scene}.json" for scene in SCENES), "--pairs", "300", "--quiet",
            "--out", folder / out, *more]


def run(folder, out, *more):
    successful(*command(folder, out, *more))
    return valid_results(folder / out / "results.json")


def merge(folder, parts, out="out"):
    outcome = successful("merge", *(folder / part / "results.json" for part in parts), "--out", folder / out)
    results = valid_results(folder / out / "results.json")
    assert outcome.out.startswith(f"merged {len(parts)} shards, {len(results['scenes'])} scenes\n")
    return results


def without_times(results):
    """As text: the order of members is part of it."""
    def kept(node):
        if isinstance(node, list):
            return [kept(member) for member in node]
        if isinstance(node, dict):
            return {key: kept(member) for key, member in node.items() if key not in VARYING}
        return node

    return json.dumps({key: member for key, member in kept(results).items()
                       if key not in ("command", "merged")}, indent=1)


def expect_same_folders(folder, a, b):
    for name in ("cases", "contacts", "plots", "recordings"):
        files = names_in(folder / a / name)
        assert files == names_in(folder / b / name)
        for file in files:
            assert (folder / a / name / file).read_bytes() == (folder / b / name / file).read_bytes(), file


def test_merged_shards_are_the_results_of_one_run(folder):
    whole = run(folder, "whole", "--no-timing")
    for k in (1, 2, 3):
        run(folder, f"part{k}", "--no-timing", "--shard", f"{k}/3")
    merged = merge(folder, ["part3", "part1", "part2"])
    assert without_times(merged) == without_times(whole)
    assert len(merged["runs"]) == 6 * 3
    assert len(merged["disagreements"]) > 5, "there are cases to number"
    expect_same_folders(folder, "out", "whole")
    assert "Put together from 3 shards" in (folder / "out/report.md").read_text()
    assert names_in(folder / "out") == run_files("plots")


def test_shard_is_no_baseline(folder):
    run(folder, "part1", "--no-timing", "--shard", "1/2")
    refused("accept", folder / "part1/results.json", "--as", folder / "base.json",
            named=["is a shard of a run"], folder=folder)


def test_merged_cases_can_be_reduced(folder):
    run(folder, "part1", "--no-timing", "--shard", "1/2")
    run(folder, "part2", "--no-timing", "--shard", "2/2")
    merge(folder, ["part1", "part2"])
    successful("reduce", folder / "out/cases/0001.json", "--budget", "200")


def test_merged_shards_with_times_are_equal_except_timings(folder):
    whole = run(folder, "whole", "--processes", "1")
    run(folder, "part1", "--processes", "1", "--shard", "1/2")
    run(folder, "part2", "--processes", "1", "--shard=2/2")
    merged = merge(folder, ["part1", "part2"])
    assert without_times(merged) == without_times(whole)
    assert "cold" in merged["runs"][0]["time_ms"]
    assert names_in(folder / "out") == names_in(folder / "whole")


# A goal may compare scenes of two shards.
def test_goals_are_measured_when_shards_are_merged(tmp_path):
    suite = tmp_path / "goals.json"
    suite.write_text(json.dumps({
        "id": "goals", "title": "Goals", "scenes": ["small-pair", "bunny-touch"], "detectors": ["ffd-lazy"],
        "goals": [{"goal": "one to the other", "scene": "small-pair", "detector": "ffd-lazy",
                   "part": "cold", "over_scene": "bunny-touch", "at_most": 1e9}]}))
    for k in (1, 2):
        out = tmp_path / f"part{k}"
        successful("run", suite, "--frames", "3", "--processes", "1", "--quiet", "--shard", f"{k}/2",
                   "--out", out)
        assert "goals" not in valid_results(out / "results.json")
    goal = merge(tmp_path, ["part1", "part2"])["goals"][0]
    assert goal["goal"] == "one to the other"
    assert goal["over_scene"] == "bunny-touch"
    assert goal["at_most"] == 1e9
    assert goal["met"] is True, goal


def test_shard_says_which_part_it_is(folder):
    results = run(folder, "part2", "--no-timing", "--shard", "2/3")
    assert (results["shard"]["index"], results["shard"]["of"]) == (2, 3)
    assert [scene["id"] for scene in results["scenes"]] == ["two", "five"]
    assert "Shard 2 of 3: 2 of the 6 scenes" in (folder / "part2/report.md").read_text()


def test_killed_shard_is_run_again(folder):
    whole = run(folder, "whole", "--no-timing")
    run(folder, "part1", "--no-timing", "--shard", "1/2")
    with RunningProgram(PROGRAM, command(folder, "part2", "--no-timing", "--shard", "2/2")) as program:
        program.wait_for((folder / "part2/partial/two.partial.json").exists)
        program.send(signal.SIGKILL)
        assert program.outcome().exit_code == 128 + signal.SIGKILL, "it had not ended"
    assert not (folder / "part2/results.json").exists()
    part = run(folder, "part2", "--no-timing", "--shard", "2/2", "--resume")
    assert "two" in part["resumed"]
    merged = merge(folder, ["part1", "part2"])
    assert merged.pop("resumed") == part["resumed"]
    assert without_times(merged) == without_times(whole)
    expect_same_folders(folder, "out", "whole")


def test_more_shards_than_scenes_are_refused(folder):
    refused(*command(folder, "out", "--shard", "1/7"), named=["--shard 1/7: this run has 6 scenes"],
            folder=folder)


@pytest.fixture(scope="module")
def good_shards(tmp_path_factory):
    """Two shards that belong together, in folders 1 and 2."""
    folder = tmp_path_factory.mktemp("shards")
    for scene in ("one", "two"):
        (folder / f"{scene}.json").write_text(tiny_scene(scene))
    for k in ("1", "2"):
        successful("run", folder / "one.json", folder / "two.json", "--detector", "fcl-aabb",
                   "--detector", "ffd-grid", "--quiet", "--processes", "1", "--shard", f"{k}/2",
                   "--out", folder / k)
    return folder


@pytest.fixture
def shards(good_shards, tmp_path):
    for k in ("1", "2"):
        shutil.copytree(good_shards / k, tmp_path / k)
    return tmp_path


def expect_refused(shards, named, files=("DIR/1/results.json", "DIR/2/results.json"), out="DIR/out"):
    refused(*with_folder(["merge", *files, "--out", out], shards), named=with_folder(named, shards),
            folder=shards)


# What is done to the results of the second shard, and what the refusal names besides their file.
CHANGES = {
    "other_version": (lambda r: r.update(version="0.0.1"), ["version", '"0.0.1"']),
    "other_build": (lambda r: r["shard"].update(program="0x1"), ["program", '"0x1"']),
    "other_compiler": (lambda r: r["machine"].update(compiler="other"), ["machine compiler", '"other"']),
    "other_machine": (lambda r: r["machine"].update(cpu="other"), ["machine cpu"]),
    "other_library": (lambda r: r["libraries"].update(fcl="9"), ["library fcl", '"9"']),
    "other_setting": (lambda r: r["shard"]["settings"].update(processes=77),
                      ["setting processes is 77", "it is 1"]),
    "setting_that_the_others_lack": (lambda r: r["shard"]["settings"].update(more=1), ["setting more is 1"]),
    "other_scene": (lambda r: r["shard"]["scenes"][0].update(id="other"), ['scene 1 is "other"', '"one"']),
    "more_scenes": (lambda r: r["shard"]["scenes"].append(r["shard"]["scenes"][0]),
                    ["number of scenes is 3"]),
    "other_content": (lambda r: r["shard"]["scenes"][1].update(content="0x2"),
                      ['scene "two"', "file or meshes"]),
    "other_detectors": (lambda r: r["shard"]["scenes"][1]["detectors"].pop(0), ['scene "two"', "detectors"]),
    "other_number_of_shards": (lambda r: r["shard"].update(of=3), ["shard.of is 3"]),
    "no_shard": (lambda r: r.pop("shard"), ["is no shard of a run"]),
    "beyond_the_last": (lambda r: r["shard"].update(index=3), ["shard 3/2"]),
    "lacks_a_scene": (lambda r: r.update(scenes=[]), ['scene "two"']),
    "lacks_a_detector": (lambda r: r["runs"].pop(1), ['detector "ffd-grid" on scene "two"']),
    "run_twice": (lambda r: r["runs"].append(r["runs"][0]), ["does not hold"]),
    "field_missing": (lambda r: r["shard"].pop("files"), ["files"]),
    "field_of_another_kind": (lambda r: r["shard"].update(of="two"), ["of"]),
    "case_elsewhere": (lambda r: r["disagreements"][0].update(case="cases/../../1/results.json"),
                       ["no name of a case file"]),
    "recording_elsewhere": (lambda r: r["runs"][0].update(recording="../1/recordings/one.ccr"),
                            ["no name of a recording"]),
}


@pytest.mark.parametrize("change, named", CHANGES.values(), ids=CHANGES)
def test_changed_results_are_refused(shards, change, named):
    file = shards / "2" / "results.json"
    results = json.loads(file.read_text())
    change(results)
    file.write_text(json.dumps(results, indent=1))
    expect_refused(shards, [*named, "DIR/2/results.json"])


def cut(file):
    os.truncate(file, file.stat().st_size // 2)


def append_to(file):
    with file.open("a") as stream:
        stream.write("x")


def remove(file):
    file.unlink()


DAMAGES = {
    "recording": (cut, "recordings/two.ccr", ["DIR/2/recordings/two.ccr: is damaged", "shard 2/2"]),
    "contacts": (append_to, "contacts/two.json", ["DIR/2/contacts/two.json: is damaged"]),
    "case": (append_to, "cases/0001.json", ["DIR/2/cases/0001.json: is damaged"]),
    "no_recording": (remove, "recordings/two.ccr", ["DIR/2/recordings/two.ccr: is missing"]),
    "no_case": (remove, "cases/0001.json", ["DIR/2/cases/0001.json: is missing"]),
    "results_cut_short": (cut, "results.json", ["DIR/2/results.json: not JSON at byte"]),
    "no_results": (remove, "results.json", ["DIR/2/results.json"]),
}


@pytest.mark.parametrize("damage, name, named", DAMAGES.values(), ids=DAMAGES)
def test_damaged_shards_are_refused(shards, damage, name, named):
    damage(shards / "2" / name)
    expect_refused(shards, named)


@pytest.mark.parametrize("files, sentence", [
    ([1], "shard 2/2 is missing"),
    ([2], "shard 1/2 is missing"),
    ([2, 1, 2], "DIR/2/results.json and DIR/2/results.json are both shard 2/2"),
], ids=["missing", "first_missing", "doubled"])
def test_shards_that_are_not_all_or_doubled_are_refused(shards, files, sentence):
    expect_refused(shards, [sentence], [f"DIR/{k}/results.json" for k in files])


def test_merge_does_not_write_over_a_shard(shards):
    expect_refused(shards, ["shard 1/2"], out="DIR/1")
