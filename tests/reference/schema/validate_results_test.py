#!/usr/bin/env python3
"""The example is valid; every single mutation of it is refused, at the place that was changed."""

import copy
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

import validate_results

HERE = pathlib.Path(__file__).resolve().parent
EXAMPLE = HERE / "example_results.json"

REMOVED = object()

# Place in the example, what is put there, and a part of the line that must be printed.
MUTATIONS = [
    ("schema", "contactcheck-results/1", "was expected"),
    ("schema", REMOVED, "'schema' is a required property"),
    ("command", 7, "is not of type 'string'"),
    ("machine/cores", "2", "is not of type 'integer'"),
    ("machine/isa", REMOVED, "'isa' is a required property"),
    ("libraries/fcl", 0.7, "is not of type 'string'"),
    ("timing/processes", 0, "less than the minimum"),
    ("timing/sweep_bytes", REMOVED, "'sweep_bytes' is a required property"),
    ("runs", {}, "is not of type 'array'"),
    ("runs/0/scene", "", "'' "),
    ("runs/0/detector", REMOVED, "'detector' is a required property"),
    ("runs/0/status", "crashed", "'crashed' is not one of"),
    ("runs/0/status", REMOVED, "'status' is a required property"),
    ("runs/0/frames", -1, "less than the minimum"),
    ("runs/0/frames", 3.5, "is not of type 'integer'"),
    ("runs/0/contact_frames", 4, "4 contact frames of 3 frames"),
    ("runs/0/semantics/levels/0", "bodies", "is not one of"),
    ("runs/0/semantics/questions/0", "all", "is not one of"),
    ("runs/0/options", REMOVED, "'options' is a required property"),
    ("runs/0/recording", REMOVED, "'recording' is a required property"),
    ("runs/0/per_frame", REMOVED, "'per_frame' is a required property"),
    ("runs/0/per_frame/frame_ms", REMOVED, "'frame_ms' is a required property"),
    ("runs/0/per_frame/frame_ms/0", -0.5, "is not valid"),
    ("runs/0/per_frame/frame_ms", [0.5, 0.25], "has 2 entries for 3 frames"),
    ("runs/0/per_frame/missed/1", None, "is not of type 'integer'"),
    ("runs/0/per_frame/missed/1", 2, "adds up to 2, not 1"),
    ("runs/0/per_frame/truth", [4, 6], "has 2 entries for 3 frames"),
    ("runs/0/per_frame/level", "cells", "is not valid"),
    ("runs/0/per_frame/level", "triangle", "triangle is not among the levels"),
    ("runs/0/not_judged/cell", "open", "is among the levels"),
    ("runs/0/not_judged/vertex", "", "'' "),
    ("runs/0/not_judged/edge", "open", "is not one of"),
    ("runs/0/levels", REMOVED, "'levels' is a required property"),
    ("runs/0/levels/triangles", {}, "is not one of"),
    ("runs/0/levels/body/recall", 1.5, "greater than the maximum"),
    ("runs/0/levels/body/recall", REMOVED, "'recall' is a required property"),
    ("runs/0/levels/body/recall", "1", "is not of type"),
    ("runs/0/levels/body/recall", 0.99, "but 2 / 2 is 1.0"),
    ("runs/0/levels/body/recall", None, "is None, but 2 / 2 is 1.0"),
    ("runs/0/levels/body/hit", 1, "hit 1 + missed 0 is not truth 2"),
    ("runs/0/levels/body/spurious", 4, "spurious 4 exceeds reported 3"),
    ("runs/0/levels/containment/recall", 0, "must be null"),
    ("runs/0/levels/containment/spurious_rate", 0, "must be null"),
    ("runs/1/levels/near/margin", REMOVED, "'margin' is a required property"),
    ("runs/1/levels_rounded/near/truth", 1, "is not truth 1"),
    ("runs/0/geometry/late_frames", 0.5, "is not of type"),
    ("runs/0/geometry/episodes/0/late_frames", REMOVED, "'late_frames' is a required property"),
    ("runs/0/geometry/episodes/0/hover_gap", -0.002, "is not valid"),
    ("runs/0/geometry/depth_kind", "deep", "is not one of"),
    ("runs/0/geometry/covered_length_fraction", 1.01, "greater than the maximum"),
    ("runs/0/geometry/hover_gap_max", REMOVED, "'hover_gap_max' is a required property"),
    ("runs/0/stages/1/missed", REMOVED, "'missed' is a required property"),
    ("runs/0/stages/1/out", -8, "less than the minimum"),
    ("runs/0/time_ms/prepare", REMOVED, "'prepare' is a required property"),
    ("runs/0/time_ms/question", "pairs", "is not one of"),
    ("runs/0/time_ms/question", REMOVED, "'question' is a dependency of"),
    ("runs/0/time_ms/playback", REMOVED, "'playback' is a dependency of"),
    ("runs/0/time_ms/playback/update", None, "is not of type 'number'"),
    ("runs/0/time_ms/playback/map", REMOVED, "'map' is a required property"),
    ("runs/0/time_ms/playback/first_frame", REMOVED, "'first_frame' is a required property"),
    ("runs/0/time_ms/playback/cpu", REMOVED, "'cpu' is a required property"),
    ("runs/0/time_ms/playback/frame", 0.4, "is 0.4, but its phases add up to 0.5"),
    ("runs/0/time_ms/cold/query", 0.6, "is 0.9, but its phases add up to 0.8"),
    ("runs/0/time_ms/cold/cpu", -1, "less than the minimum"),
    ("runs/0/time_ms/passes", REMOVED, "'passes' is a dependency of"),
    ("runs/0/time_ms/passes", 0, "less than the minimum"),
    ("runs/0/time_ms/playback/taken", -0.1, "less than the minimum"),
    ("runs/0/time_ms/pass_ms", [], "[] "),
    ("runs/0/time_ms/pass_ms", [0.5], "has 1 entries for 5 passes"),
    ("runs/0/time_ms/pass_ms/1", 0, "less than or equal to the minimum"),
    ("runs/0/time_ms/pass_ms/1", 0.5, "have the geometric mean 0.57"),
    ("runs/0/time_ms/timed_frames", 4, "exceeds the run's 3 frames"),
    ("runs/0/time_ms/timed_contact_frames", 4, "exceeds the 3 timed frames"),
    ("runs/0/time_ms_other_questions/0/question", REMOVED, "'question' is a required property"),
    ("runs/0/time_ms_other_questions/0/question", "cells", "cells is timed twice"),
    ("runs/0/time_ms_other_questions/0/timed_frames", 4, "exceeds the run's 3 frames"),
    ("runs/0/time_ms_other_questions/0/playback/update", -1, "less than the minimum"),
    ("runs/0/time_ms_other_questions/0/playback/map", None, "its phases add up to 0.3"),
    ("runs/0/time_ms_other_questions/0/passes", 4, "exceeds the row's 4 passes"),
    ("runs/0/speedup", REMOVED, "'speedup' is a required property"),
    ("runs/0/speedup/pairs", {}, "is not one of"),
    ("runs/0/speedup/body/fcl-aabb/playback/low", REMOVED, "'low' is a required property"),
    ("runs/0/speedup/body/fcl-aabb/playback/low", 12.5, "lies outside its interval"),
    ("runs/0/speedup/body/fcl-aabb/playback", None, "is not of type 'object'"),
    ("runs/0/speedup/body/fcl-aabb/cold", REMOVED, "'cold' is a required property"),
    ("runs/0/speedup/body/fcl-aabb/passes", 6, "exceeds the row's 5 passes"),
    ("runs/0/speedup/body/fcl-aabb/passes", 4, "'range' was expected"),
    ("runs/0/speedup/body/fcl-aabb/interval", "range", "'95 %' was expected"),
    ("runs/0/speedup/body/fcl-aabb/interval", "99 %", "is not one of"),
    ("runs/0/speedup/triangles", {"fcl-aabb": {
        "playback": {"ratio": 1, "low": 1, "high": 1}, "cold": None, "contact_frames": None,
        "without_map": None, "passes": 1, "interval": "range", "reference_options": {}}},
     "exceeds the row's 0 passes"),
    ("runs/0/speedup/body/fcl-aabb/reference_options", REMOVED, "is a required property"),
    ("runs/0/memory_bytes", -1, "less than the minimum"),
    ("runs/0/prepared_bytes", REMOVED, "'prepared_bytes' is a required property"),
    ("runs/0/contact_hash", REMOVED, "'contact_hash' is a required property"),
    ("runs/1/detector", "ffd-aabb-sphere2", "stands twice"),
    ("runs/0/semantics/questions/2", "depths", "is not one of"),
    ("runs/1/semantics/informative/0", "vertices", "is not one of"),
    ("runs/1/semantics/scale", 0, "less than or equal to the minimum"),
    ("runs/1/levels/vertex/informative", REMOVED, "informative exactly when not claimed"),
    ("runs/1/levels/near/informative", True, "informative exactly when not claimed"),
    ("runs/0/per_frame/covered_length_fraction", [1.0], "has 1 entries for 3 frames"),
    ("runs/0/per_frame/covered_length_fraction/1", 1.5, "greater than the maximum"),
    ("runs/0/stages/0/visited_unit", REMOVED, "is a dependency of"),
    ("runs/0/geometry/depth_error_mean", 0.5, "has values though nothing was judged"),
    ("runs/1/geometry/depth_error_max", None, "is null though 9 were judged"),
    ("runs/1/geometry/depth_error_max", 0.0001, "below the mean or the 95th percentile"),
    ("runs/1/geometry/normal_error_deg_mean", 181, "greater than the maximum"),
    ("runs/0/semantics/exact", "no", "is not of type 'boolean'"),
    ("runs/1/float_environment/0", "", "'' "),
    ("runs/1/notes/0", 7, "is not of type 'string'"),
    ("runs/0/closed_loop/error", REMOVED, "'error' is a required property"),
    ("runs/0/closed_loop/error", "diverged", "exactly when error is empty"),
    ("runs/1/closed_loop/error", "", "exactly when error is empty"),
    ("runs/0/closed_loop/steps", 1.5, "is not of type 'integer'"),
    ("runs/0/closed_loop/tunnelling_events", -1, "less than the minimum"),
    ("runs/0/closed_loop/tunnelling_events", REMOVED, "exactly when error is empty"),
    ("runs/0/closed_loop/levels/edge", {}, "is not one of"),
    ("runs/0/closed_loop/levels/body/missed", 1, "hit 4 + missed 1 is not truth 4"),
    ("runs/0/closed_loop/levels/body/recall", 0.5, "but 4 / 4 is 1.0"),
    ("runs/0/closed_loop/levels/cell/spurious_rate", 0, "must be null"),
    ("runs/0/closed_loop/hover_at_rest_mean", 0.005, "exceeds the largest, 0.004"),
    ("runs/0/closed_loop/hover_at_rest_mean", None, "null exactly when the largest is"),
    ("runs/0/closed_loop/deepest_penetration", -0.001, "is not valid"),
    ("runs/0/step_ms/total", 2.5, "its four parts add up to 2.375"),
    ("runs/0/step_ms/mss", -1.5, "less than the minimum"),
    ("runs/0/step_ms/response", REMOVED, "'response' is a required property"),
    ("runs/0/step_ms/repeats", 0, "less than the minimum"),
    ("runs/0/step_ms/repeats", 4, "has 3 entries for 4 repeats"),
    ("runs/0/step_ms/test_by_repeat", [0.25, 0.5], "has 2 entries for 3 repeats"),
    ("runs/0/step_ms/total_by_repeat", [], "has 0 entries for 3 repeats"),
    ("runs/0/step_ms/test_by_repeat/1", 3.5, "exceeds the whole step's 2.25"),
    ("runs/2/message", "", "'' "),
    ("runs/3/message", REMOVED, "'message' is a required property"),
    ("runs/3/status", "ok", "is a required property"),
    ("runs/1/geometry/depth_error_histogram/0/count", 7, "adds up to 8, not 9"),
    ("runs/1/geometry/depth_error_histogram/0/count", 0, "less than the minimum"),
    ("runs/1/geometry/depth_error_histogram/0/below", REMOVED, "is a required property"),
    ("runs/1/geometry/depth_error_histogram/0/from", 0.0005, "has bins out of order"),
    ("runs/1/geometry/depth_error_histogram/1/from", 0.0001, "has bins out of order"),
    ("runs/0/geometry/depth_error_histogram", [{"from": 0, "below": 1, "count": 1}],
     "adds up to 1, not 0"),
    ("scenes/0/cold_frames", [2, 0], "are not ascending numbers of 3 frames"),
    ("scenes/0/cold_frames", [0, 0], "are not ascending numbers of 3 frames"),
    ("scenes/0/cold_frames", [3], "are not ascending numbers of 3 frames"),
    ("scenes/0/cold_frames/0", -1, "less than the minimum"),
    ("scenes/2/separation/0", -0.5, "less than the minimum"),
    ("scenes/2/separation", [0.125], "has 1 entries for 2 frames"),
    ("scenes/2/separation", [0.125, 0.25], "is 0 in 0 of 1 contact frames"),
    ("scenes/0/separation", [0.125, 0, 0], "have no separation"),
    ("disagreements", REMOVED, "'disagreements' is a required property"),
    ("disagreements/0/level", "edge", "is not one of"),
    ("disagreements/0/kind", "wrong", "is not one of"),
    ("disagreements/0/case", REMOVED, "'case' is a required property"),
    ("disagreements/0/scene", "elsewhere", "belongs to no run"),
    ("disagreements/0/frame", 3, "is 3 of 3 frames"),
    ("disagreements/1/scene", "hello", "belongs to no run"),
    ("disagreements/1/detector", "fcl-aabb", "belongs to no run"),
    ("scenes/1/pairs/rational/oracle_wrong", 0, "belongs to no run"),
    ("scenes/1/pairs/rational/checked", 1151, "is 1151 of 1152 pairs"),
    ("scenes/1/pairs/rational", REMOVED, "'rational' is a required property"),
    ("scenes/1/pairs/seed", REMOVED, "'seed' is a required property"),
    ("scenes/1/pairs/count", 0, "less than the minimum"),
    ("scenes/1/pairs/touching", 501, "touching adds up to 500, not 501"),
    ("scenes/1/pairs/per_kind/point/pairs", 575, "pairs adds up to 1151, not 1152"),
    ("scenes/1/pairs/per_kind/point/touching", 577, "exceeds the 576 pairs"),
    ("scenes/1/pairs/per_kind/point/touching", -1, "less than the minimum"),
    ("scenes", REMOVED, "'scenes' is a required property"),
    ("scenes/0/bodies", REMOVED, "'bodies' is a required property"),
    ("scenes/0/truth/edge", 3, "is not one of"),
    ("scenes/0/truth/cell", -1, "is not valid"),
    ("scenes/0/family/values/1", 1e-9, "is not of type 'string'"),
    ("scenes/0/family/true_pairs", REMOVED, "'true_pairs' is a required property"),
    ("scenes/1/contacts", "contacts/random-pairs.json", "random pairs have no file"),
    ("scenes/2/contacts", "contacts/hello.json", "not contacts/touch.json"),
    ("scenes/2/contacts", "", "'' "),
    ("scenes/2/fits/0/rms", [0], "has no error for each of 2 frames"),
    ("scenes/2/fits/0/max/1", 0.0005, "exceeds the largest distance"),
    ("scenes/2/fits/0/max/0", -1, "less than the minimum"),
    ("scenes/3/sweep/orientations", 3, "has other poses than the scene's 4 frames"),
    ("scenes/3/sweep/tolerance", REMOVED, "'tolerance' is a required property"),
    ("scenes/0/simulation/every", 0, "less than the minimum"),
    ("goals/0/high", REMOVED, "is a dependency of"),
    ("known_defects/unlisted", REMOVED, "'unlisted' is a required property"),
    ("known_defects/changed", REMOVED, "'changed' is a required property"),
    ("known_defects/changed/0/is/0", -1, "less than the minimum"),
    ("known_defects/readings/0/where", REMOVED, "'where' is a required property"),
    ("known_defects/not_shown/0/kind", "late", "is not one of"),
    ("known_defects/defects/0/shown", -1, "less than the minimum"),
    ("known_defects/defects/0/sentence", REMOVED, "'sentence' is a required property"),
    ("resumed", "hello", "is not of type 'array'"),
    ("resumed", [""], "'' "),
    ("resumed", ["elsewhere"], "elsewhere is no scene of the runs"),
    ("resumed", ["hello", "hello"], "has non-unique elements"),
]


def mutated(example, place, value):
    results = copy.deepcopy(example)
    *parents, last = [int(s) if s.isdigit() else s for s in place.split("/")]
    node = results
    for step in parents:
        node = node[step]
    if value is REMOVED:
        del node[last]
    else:
        node[last] = value
    return results


def run_program(*arguments):
    command = [sys.executable, "-B", str(HERE / "validate_results.py"), *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, check=False)


class ResultsSchema(unittest.TestCase):
    def setUp(self):
        self.schema = validate_results.load(validate_results.SCHEMA_FILE)
        self.example = validate_results.load(EXAMPLE)

    def test_schema_itself_is_valid(self):
        validate_results.Draft202012Validator.check_schema(self.schema)

    def test_example_is_accepted(self):
        self.assertEqual(validate_results.errors_of(self.example, self.schema), [])

    def test_added_fields_are_accepted(self):
        for place in ("extra", "machine/extra", "runs/0/extra", "runs/0/levels/body/extra",
                      "runs/0/time_ms/extra", "disagreements/0/extra"):
            with self.subTest(place=place):
                results = mutated(self.example, place, {"any": 1})
                self.assertEqual(validate_results.errors_of(results, self.schema), [])

    def test_every_mutation_is_refused(self):
        for place, value, expected in MUTATIONS:
            with self.subTest(place=place, value="removed" if value is REMOVED else value):
                results = mutated(self.example, place, value)
                errors = validate_results.errors_of(results, self.schema)
                self.assertTrue(any(expected in message for _, message in errors), errors)
                # Whose scene no longer contradicts the oracle, a disagreement is left alone.
                step = "/" + ("disagreements" if place.endswith("oracle_wrong")
                              else place.split("/")[0])
                self.assertTrue(any(p.startswith(step) or p == "/" for p, _ in errors), errors)


class Program(unittest.TestCase):
    def test_valid_file_exits_0_without_a_word(self):
        done = run_program(EXAMPLE)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))

    def test_fields_that_no_schema_describes_are_found_where_that_is_asked(self):
        self.assertEqual(run_program("--described", EXAMPLE).stdout, "")
        results = mutated(validate_results.load(EXAMPLE), "runs/0/geometry/depth", 1)
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "results.json"
            file.write_text(json.dumps(results), encoding="utf-8")
            self.assertEqual(run_program(file).returncode, 0)
            done = run_program("--described", file)
        self.assertEqual(done.returncode, 1)
        self.assertIn(f"{file}: /runs/0/geometry: ", done.stdout)
        self.assertIn("'depth'", done.stdout)

    def test_errors_are_one_line_each_and_exit_1(self):
        results = mutated(validate_results.load(EXAMPLE), "runs/0/levels/body/recall", 1.5)
        results["runs"][0]["status"] = "crashed"
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "results.json"
            file.write_text(json.dumps(results), encoding="utf-8")
            done = run_program(EXAMPLE, file)
        self.assertEqual(done.returncode, 1)
        lines = done.stdout.splitlines()
        self.assertEqual(len(lines), 2, done.stdout)
        self.assertIn(f"{file}: /runs/0/levels/body/recall: 1.5", done.stdout)

    def test_unreadable_files_exit_2(self):
        broken = {"none": None, "cut": '{"schema": ', "nan": '{"version": NaN}',
                  "twice": '{"a": 1, "a": 2}', "binary": b"\xff\xfe"}
        with tempfile.TemporaryDirectory() as folder:
            for name, content in broken.items():
                with self.subTest(name=name):
                    file = pathlib.Path(folder) / name
                    if content is not None:
                        data = content if isinstance(content, bytes) else content.encode()
                        file.write_bytes(data)
                    done = run_program(file)
                    self.assertEqual(done.returncode, 2)
                    self.assertIn(str(file), done.stderr)

    def test_no_file_is_bad_usage(self):
        self.assertEqual(run_program().returncode, 2)


if __name__ == "__main__":
    unittest.main()
