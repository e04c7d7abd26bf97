"""Whole runs of the built program on a scene of two boxes."""

import json

import pytest

from program import names_in, refused, run_files, successful, tiny_scene, valid_results
from program import validate_results


@pytest.fixture
def scene(tmp_path):
    file = tmp_path / "tiny.json"
    file.write_text(tiny_scene())
    return file


def run(out, *words):
    """The valid results of a successful run into this folder, and what the program said."""
    outcome = successful("run", *words, "--out", out)
    return valid_results(out / "results.json"), outcome


def named(*detectors):
    return [word for name in detectors for word in ("--detector", name)]


def hashes_by_detector(results):
    return {row["detector"]: row["contact_hash"] for row in results["runs"]}


def sum_of(lists):
    """Of lists of contacts, each of which has as many pairs as it says."""
    for one in lists:
        assert len(one["pairs"]) == 4 * one["count"]
    return sum(one["count"] for one in lists)


@pytest.fixture(scope="module")
def isas(tmp_path_factory):
    """Instruction sets of this machine, the best first. A run that asks for one that it lacks names them:
    no machine has both of these."""
    folder = tmp_path_factory.mktemp("isas")
    (folder / "tiny.json").write_text(tiny_scene())
    results, _ = run(folder / "out", folder / "tiny.json", "--no-timing", "--quiet", *named("ffd-lazy"),
                     "--isa", "AVX3", "--isa", "NEON")
    message = next(row["message"] for row in results["runs"] if row["status"] == "absent")
    best, *names = message.partition("does not run here; there are ")[2].split(", ")
    assert best == "best" and names, message
    return names


# It ran the suite `default`.
def test_explain_alone_says_what_the_columns_mean_and_runs_nothing(tmp_path):
    outcome = successful("run", "--explain", cwd=tmp_path)
    assert "  recall               hit / truth, cut, not rounded\n" in outcome.out
    assert "  slowest family       ms a case of" in outcome.out
    assert outcome.err == ""
    assert names_in(tmp_path) == set()


def test_writes_results_report_recording_and_nothing_else(tmp_path, scene):
    out = tmp_path / "out"
    results, outcome = run(out, scene, "--no-timing")
    assert names_in(out) == run_files("plots")
    assert names_in(out / "recordings") == {"tiny.ccr"}
    assert "## tiny" in (out / "report.md").read_text()
    assert "results.json" in outcome.out
    files = {f"cases/{name}" for name in names_in(out / "cases")}
    assert {d["case"] for d in results["disagreements"]} == files
    for file in files:
        validate_results.load(out / file)


# What the report's 3D view shows is what the judge has counted.
def test_contacts_one_by_one_add_up_to_the_counts_of_the_results(tmp_path, scene):
    out = tmp_path / "out"
    results, _ = run(out, scene, "--no-timing")
    judged = results["scenes"][0]
    assert judged["contacts"] == "contacts/tiny.json"
    contacts = validate_results.load(out / judged["contacts"])
    assert contacts["schema"] == "contactcheck-contacts/1"
    assert sum_of(contacts["truth"]) == judged["truth"]["triangle"]
    assert len(contacts["detectors"]) == len(results["runs"])
    differences = 0
    for row, detector in zip(results["runs"], contacts["detectors"]):
        assert detector["detector"] == row["detector"]
        assert detector["level"] == row["per_frame"]["level"]
        for kind in ("missed", "spurious"):
            counts = [0] * 5
            for frame in detector["frames"]:
                counts[frame["frame"]] = frame[kind]["count"]
            assert counts == row["per_frame"][kind], f"{row['detector']} {kind}"
            differences += sum_of([frame[kind] for frame in detector["frames"]])
    assert differences > 0, "a scene in which no detector errs shows nothing"


# The suites say which detectors run where none is named, and nothing else.
def test_files_and_named_detectors_need_no_fixtures(tmp_path, scene):
    mesh = tmp_path / "t.off"
    mesh.write_text("OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n")
    successful("run", scene, "--mesh", mesh, "--mesh", mesh, "--pairs", "600", "--frames", "5",
               "--no-timing", *named("fcl-aabb"), "--out", tmp_path / "out",
               env={"CONTACTCHECK_FIXTURES": str(tmp_path / "none")})
    results = validate_results.load(tmp_path / "out" / "results.json")
    assert [row["scene"] for row in results["runs"]] == ["t-t-approach", "tiny", "random-pairs"]


def test_families_have_contacts_to_show_and_random_pairs_none(tmp_path):
    out = tmp_path / "out"
    results, _ = run(out, "hard-boxes-gap", "--pairs", "600", "--no-timing", *named("ffd-grid"))
    assert names_in(out / "contacts") == {"hard-boxes-gap.json"}
    contacts = validate_results.load(out / "contacts" / "hard-boxes-gap.json")
    spurious = sum_of([frame["spurious"] for frame in contacts["detectors"][0]["frames"]])
    assert spurious > 0
    assert spurious == results["runs"][0]["levels"]["cell"]["spurious"]
    for judged in results["scenes"]:
        assert ("contacts" in judged) != ("pairs" in judged), judged["id"]


# Episodes, distances and times belong to motions.
def test_separation_is_zero_in_contact_frames_alone(tmp_path, scene):
    results, _ = run(tmp_path / "out", scene, "hard-boxes-gap", "--no-timing", *named("ffd-grid"))
    motion, family = results["scenes"]
    assert len(motion["separation"]) == 5
    assert motion["separation"].count(0) == motion["contact_frames"]
    assert motion["separation"][0] == pytest.approx(0.3, rel=0, abs=1e-8), "the boxes' distance along x"
    assert "separation" not in family


def test_random_pairs_alone_are_one_scene_that_names_count_and_seed(tmp_path):
    out = tmp_path / "out"
    results, outcome = run(out, "--pairs", "700", "--seed", "5", "--no-timing",
                           *named("ffd-lazy", "ffd-aabb-sphere2+tri", "fcl-aabb"))
    [judged] = results["scenes"]
    assert judged["id"] == "random-pairs"
    pairs = judged["pairs"]
    assert (pairs["count"], pairs["seed"]) == (700, 5)
    assert (pairs["rational"]["checked"], pairs["rational"]["oracle_wrong"]) == (700, 0)
    for row in results["runs"][:2]:
        level = row["levels"]["triangle"]
        assert (level["truth"], level["missed"], level["spurious"]) == (pairs["touching"], 0, 0)
    assert names_in(out / "recordings") == set()
    assert "700 pairs, seed 5, " in outcome.out
    assert "| mixed-scale |" in (out / "report.md").read_text()


def test_random_pairs_come_with_the_targets_and_are_timed_on_a_few_frames(tmp_path, scene):
    results, _ = run(tmp_path / "out", scene, "--pairs", "20000", *named("ffd-lazy"))
    assert len(results["scenes"]) == 2
    row = results["runs"][1]
    assert row["scene"] == "random-pairs"
    assert row["frames"] == 35
    assert row["time_ms"]["timed_frames"] > 0
    assert results["scenes"][1]["pairs"]["seed"] == 1


def test_exact_detectors_are_exact_and_the_results_describe_the_scene(tmp_path, scene):
    results, _ = run(tmp_path / "out", scene, "--no-timing")
    judged = results["scenes"][0]
    assert judged["frames"] == 5
    assert judged["contact_frames"] > 0
    assert judged["truth"]["triangle"] > 0
    exact = 0
    for row in results["runs"]:
        assert row["status"] == "ok", f"{row['detector']} {row['message']}"
        assert row["recording"] == "recordings/tiny.ccr"
        if not row["semantics"]["exact"] and row["detector"] != "fcl-aabb":
            continue
        exact += 1
        level = row["levels"]["triangle"]
        assert (level["recall"], level["spurious"]) == (1, 0), row["detector"]
    assert exact >= 6, "fcl-aabb and the five with +tri"


def test_timed_run_has_times_and_speed_ups(tmp_path, scene):
    results, outcome = run(tmp_path / "out", scene, *named("fcl-aabb", "ffd-aabb-sphere2+tri"),
                           "--processes", "1", "--quiet")
    assert outcome.err == ""
    assert len(results["runs"]) == 2
    for row in results["runs"]:
        times = row["time_ms"]
        assert times["question"] == "triangles"
        assert times["passes"] == 1
        assert times["timed_frames"] == row["frames"]
        assert times["playback"]["frame"] > 0 and times["cold"]["frame"] > 0
        assert len(row["per_frame"]["frame_ms"]) == 5
    own, other = (row["speedup"] for row in results["runs"])
    assert other["triangles"]["fcl-aabb"]["playback"]["ratio"] > 0
    assert "body" in other
    assert "fcl-obbrss" not in other["triangles"], "it was not run"
    assert own["triangles"]["fcl-aabb"]["playback"]["low"] == 1
    assert own["triangles"]["fcl-aabb"]["cold"]["high"] == 1
    assert own["triangles"]["fcl-aabb"]["interval"] == "range"
    assert results["timing"]["processes"] == 1
    assert len(results["scenes"][0]["cold_frames"]) == 5


def test_passes_are_as_many_as_processes(tmp_path, scene):
    results, _ = run(tmp_path / "out", scene, *named("fcl-aabb", "embree"),
                     "--processes", "5", "--seed", "7", "--quiet")
    assert len(results["runs"]) == 2
    for row in results["runs"]:
        assert row["time_ms"]["passes"] == 5
        speedup = row["speedup"]["triangles"]["fcl-aabb"]
        assert (speedup["passes"], speedup["interval"]) == (5, "95 %")
    assert results["timing"]["one_pass_beyond"] == 0, "as many as were asked for"
    assert results["timing"]["seed"] == 7


def test_recording_replays_to_the_same_contacts(tmp_path, scene):
    first, _ = run(tmp_path / "out", scene, "--no-timing", "--quiet")
    recording = tmp_path / "out" / "recordings" / "tiny.ccr"
    again, _ = run(tmp_path / "again", recording, "--no-timing", "--quiet")
    assert len(hashes_by_detector(first)) >= 13
    assert hashes_by_detector(first) == hashes_by_detector(again)
    assert recording.read_bytes() == (tmp_path / "again" / "recordings" / "tiny.ccr").read_bytes()


def test_replay_into_its_own_folder_keeps_the_recording(tmp_path, scene):
    options = ["--no-timing", "--quiet", *named("fcl-aabb")]
    run(tmp_path / "out", scene, *options)
    recording = tmp_path / "out" / "recordings" / "tiny.ccr"
    before = recording.read_bytes()
    run(tmp_path / "out", recording, *options)
    assert recording.read_bytes() == before


def test_recording_gives_its_first_frames(tmp_path, scene):
    options = ["--no-timing", "--quiet", *named("fcl-aabb")]
    whole, _ = run(tmp_path / "out", scene, *options)
    recording = tmp_path / "out" / "recordings" / "tiny.ccr"
    first, _ = run(tmp_path / "again", recording, "--frames", "3", *options)
    assert first["scenes"][0]["frames"] == 3
    truth = whole["runs"][0]["per_frame"]["truth"]
    assert first["runs"][0]["per_frame"]["truth"] == truth[:3]
    more = refused("run", recording, "--frames", "6", "--out", tmp_path / "more", named=[], folder=tmp_path)
    assert more == f'contactcheck: --frames: recording "{recording}" has 5 frames\n'
    refused("run", recording, "--frames", "3", "--out", tmp_path / "out",
            named=["would lose its other frames; name another --out"], folder=tmp_path)


def test_twice_gives_the_same_contacts(tmp_path, scene):
    one, _ = run(tmp_path / "one", scene, "--no-timing", "--quiet")
    two, _ = run(tmp_path / "two", scene, "--no-timing", "--quiet")
    assert hashes_by_detector(one) == hashes_by_detector(two)


def test_detector_named_twice_runs_once(tmp_path, scene):
    results, _ = run(tmp_path / "out", scene, "--no-timing", "--quiet",
                     *named("ffd-aabb", "ffd-aabb:bounds=paper", "ffd-aabb"))
    assert [row["detector"] for row in results["runs"]] == ["ffd-aabb"]


def test_threads_and_instruction_sets_change_no_contact(tmp_path, scene, isas):
    results, _ = run(tmp_path / "out", scene, "--no-timing", "--quiet", "--threads", "3",
                     *named("ffd-lazy", "full-refit", "fcl-aabb"),
                     *(word for isa in isas for word in ("--isa", isa)))
    hashes = hashes_by_detector(results)
    assert len(hashes) == 2 * len(isas) + 1
    for detector, contact_hash in hashes.items():
        assert contact_hash == hashes["fcl-aabb"], detector
        assert detector == "fcl-aabb" or detector.endswith(",threads=3")
    counters = results["runs"][0]["counters"]
    assert counters["triangle_tests"] > 0
    assert counters["blocks_bounded"] > 0


def test_options_in_a_name_win_over_threads_and_isa(tmp_path, scene, isas):
    results, _ = run(tmp_path / "out", scene, "--no-timing", "--quiet", "--threads", "3",
                     "--isa", isas[0], *named("ffd-lazy:threads=2"))
    assert results["runs"][0]["detector"] == f"ffd-lazy:isa={isas[0]},threads=2"


def test_instruction_sets_that_no_detector_uses_are_refused(tmp_path, scene):
    refused("run", scene, *named("fcl-aabb"), "--isa", "best", "--out", tmp_path / "o",
            named=["--isa best: no detector of this run"], folder=tmp_path)


def test_instruction_set_of_another_machine_is_absent(tmp_path, scene, isas):
    for isa in {"AVX3", "NEON"} - set(isas):
        results, outcome = run(tmp_path / "out", scene, "--no-timing", *named("ffd-lazy"), "--isa", isa)
        assert results["runs"][0]["status"] == "absent"
        assert isa in results["runs"][0]["message"]
        assert f"absent: ffd-lazy:isa={isa}" in outcome.out


def test_frames_replace_those_of_the_scene(tmp_path, scene):
    results, _ = run(tmp_path / "out", scene, "--no-timing", "--quiet", *named("fcl-aabb"), "--frames", "7")
    judged, row = results["scenes"][0], results["runs"][0]
    assert (judged["frames"], row["frames"], len(row["per_frame"]["truth"])) == (7, 7, 7)
    assert judged["time_step"] == 1 / 7


def test_only_cases_of_earlier_runs_are_removed(tmp_path, scene):
    cases = tmp_path / "out" / "cases"
    (cases / "2024").mkdir(parents=True)
    (cases / "9999.json").write_text("{}")
    (cases / "notes.json").write_text("mine")
    (cases / "2024" / "0001.json").write_text("mine")
    run(tmp_path / "out", scene, "--no-timing", "--quiet", *named("fcl-aabb"))
    assert names_in(cases) == {"2024", "notes.json"}


def test_detector_that_needs_a_lattice_is_refused_without_one(tmp_path):
    bare = tmp_path / "bare.json"
    bare.write_text(json.dumps({
        "id": "bare", "frames": 2, "duration": 1, "levels": ["body", "cell", "triangle"],
        "bodies": [{"name": "a", "mesh": {"shape": "box"}},
                   {"name": "b", "mesh": {"shape": "box", "center": [0.9, 0.1, 0.1]}}]}))
    results, outcome = run(tmp_path / "out", bare, *named("ffd-aabb", "fcl-aabb"))
    without, other = results["runs"]
    assert without["status"] == "refused"
    assert '"a"' in without["message"]
    assert "levels" not in without
    assert other["status"] == "ok"
    assert "refused" in outcome.out.replace(str(tmp_path), "")


def test_open_bodies_are_not_judged_where_inside_is_not_defined(tmp_path):
    (tmp_path / "open.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    (tmp_path / "open.json").write_text(json.dumps({
        "id": "open", "frames": 1, "duration": 1, "levels": ["triangle", "vertex", "containment"],
        "bodies": [{"name": "a", "mesh": {"file": "open.obj"}},
                   {"name": "b", "mesh": {"shape": "box", "center": [0.5, 0.1, 0.1]}}]}))
    results, _ = run(tmp_path / "out", tmp_path / "open.json", "--no-timing", "--quiet", *named("fcl-aabb"))
    truth = results["scenes"][0]["truth"]
    assert truth["vertex"] == 'not judged: open (body "a", frame 0, edge of vertices 0 and 1)'
    assert truth["containment"] == truth["vertex"]
    assert truth["triangle"] > 0


def test_scenes_run_in_the_order_given_with_running_case_numbers(tmp_path, scene):
    second = tmp_path / "second.json"
    second.write_text(tiny_scene("second", 3))
    results, outcome = run(tmp_path / "out", second, scene, "--no-timing", *named("ffd-aabb"))
    assert [judged["id"] for judged in results["scenes"]] == ["second", "tiny"]
    for number, disagreement in enumerate(results["disagreements"], 1):
        assert disagreement["case"] == f"cases/{number:04}.json"
        case = validate_results.load(tmp_path / "out" / disagreement["case"])
        assert case["scene"] == disagreement["scene"]
    assert "scene 1 of 2: second\n" in outcome.err
    assert "all scenes" in outcome.out


# A detector of bodies has nothing to say about a body that touches itself.
def test_families_about_levels_that_nobody_claims_are_not_counted(tmp_path):
    results, outcome = run(tmp_path / "out", "hard-boxes-gap", "hard-self-point", "--no-timing", *named("bullet-cl"))
    sizes = {scene["id"]: len(scene["family"]["values"]) for scene in results["scenes"]}
    assert outcome.out.splitlines()[0].endswith(
        f" in {sizes['hard-boxes-gap']} of {sum(sizes.values())} hard cases")
    rows = [line.split()[:5] for line in outcome.out.splitlines() if line.startswith("  bullet-cl ")]
    assert rows == [["bullet-cl", "1", "body", "5", "1"], ["bullet-cl", "body", "0", "of", "1"]]
