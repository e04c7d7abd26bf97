"""run --json-lines: a run's standard output is its events, one a line."""

import itertools
import json
import shlex
import sys

import pytest

from program import contactcheck, refused, successful, tiny_scene, validate_results


def events_of(out):
    """Standard output has nothing else."""
    return [json.loads(line, parse_constant=validate_results.refuse_constant) for line in out.splitlines()]


@pytest.fixture
def command(tmp_path):
    (tmp_path / "first.json").write_text(tiny_scene("first"))
    (tmp_path / "second.json").write_text(tiny_scene("second", 7))
    return ["run", tmp_path / "first.json", tmp_path / "second.json", "--no-timing", "--json-lines",
            "--detector", "ffd-grid", "--detector", "fcl-aabb", "--out", tmp_path / "out"]


def test_events_of_start_scenes_and_end_are_in_their_order(tmp_path, command):
    outcome = successful(*command, "--quiet")
    assert outcome.err == ""
    events = events_of(outcome.out)
    assert [kind for kind, _ in itertools.groupby(event["event"] for event in events)] == [
        "start", "progress", "scene", "progress", "scene", "end"]
    detectors = ["ffd-grid", "fcl-aabb"]
    assert events[0]["schema"] == "contactcheck-events/1"
    # As text: the order of members is part of it.
    assert json.dumps(events[0]["scenes"]) == json.dumps(
        [{"scene": "first", "frames": 5, "detectors": detectors},
         {"scene": "second", "frames": 7, "detectors": detectors}])
    out = str(tmp_path / "out")
    assert json.dumps(events[-1]) == json.dumps(
        {"event": "end", "out": out, "results": f"{out}/results.json", "exit_code": 0})


def test_progress_stays_within_its_scene_and_never_goes_back(command):
    progress = [event for event in events_of(successful(*command).out) if event["event"] == "progress"]
    for event in progress:
        assert event["of"] == (5 if event["scene"] == "first" else 7)
        assert event["frame"] is None or event["frame"] < event["of"]
    shares = [event["share"] for event in progress]
    assert shares == sorted(shares) and shares[0] >= 0


def test_scene_event_has_its_rows_also_where_a_detector_is_refused(tmp_path):
    (tmp_path / "plain.json").write_text(json.dumps({
        "id": "plain", "frames": 2, "duration": 1, "levels": ["triangle"],
        "bodies": [{"name": "a", "mesh": {"shape": "box"}},
                   {"name": "b", "mesh": {"shape": "box", "center": [0.9, 0.1, 0.1]}}]}))
    outcome = contactcheck("run", tmp_path / "plain.json", "--no-timing", "--json-lines",
                           "--detector", "ffd-grid", "--out", tmp_path / "out")
    scene = events_of(outcome.out)[-2]
    assert scene["event"] == "scene"
    assert scene["runs"][0]["detector"] == "ffd-grid"
    assert scene["runs"][0]["status"] == "refused"
    assert scene["runs"][0]["message"] != ""


def test_end_event_has_the_exit_code_of_the_program(tmp_path, command):
    broken = tmp_path / "broken.py"
    broken.write_text("""\
import json
print(json.dumps({"message": "hello", "protocol": "contactcheck-pipe/1", "id": "broken",
                  "semantics": {"levels": ["triangle"], "questions": ["triangles"]}}))
""")
    outcome = contactcheck(*command, "--detector-cmd", shlex.join([sys.executable, str(broken)]))
    assert outcome.exit_code == 3, outcome.err
    assert events_of(outcome.out)[-1]["exit_code"] == 3


def test_refused_input_gives_no_event(tmp_path, command):
    refused(*command, "--detector", "nobody", named=["nobody"], folder=tmp_path)
