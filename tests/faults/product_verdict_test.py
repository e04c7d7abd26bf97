#!/usr/bin/env python3
"""What judges mutants of the whole product, on made-up results: every disagreement is named."""

import copy
import unittest

import check_results
import product_verdict
from kept_verdicts import PRODUCT, mutants

COUNTS = {"truth": 4, "reported": 4, "hit": 3, "missed": 1, "spurious": 1, "recall": 0.75,
          "spurious_rate": 0.25}


def times(question, pass_ms):
    frame = pass_ms[0]
    played = {"map": 0.25 * frame, "update": 0.5 * frame, "query": 0.25 * frame, "frame": frame,
              "contact_frame": None, "first_frame": frame, "cpu": frame}
    cold = {key: value if value is None else 2.0 * value for key, value in played.items()}
    return {"question": question, "prepare": 1.0, "passes": len(pass_ms), "pass_ms": pass_ms,
            "timed_frames": 2, "playback": played, "cold": cold}


def run_of(detector, pass_ms, speedup):
    return {"scene": "s", "detector": detector, "status": "ok",
            "per_frame": {"level": "triangle", "truth": [2, 2], "missed": [1, 0],
                          "spurious": [0, 1]},
            "levels": {"triangle": dict(COUNTS)}, "stages": [{"name": "all", "missed": 1}],
            "time_ms": times("triangles", pass_ms), "speedup": speedup}


def made_up():
    # Ratios of 2 in each of five passes: the interval is a point.
    ratio = {"playback": {"ratio": 2.0, "low": 2.0, "high": 2.0}, "passes": 5, "interval": "95 %"}
    return {"scenes": [{"id": "s", "bodies": [{"vertices": 1000}]}],
            "runs": [run_of("slow", [2.0] * 5, {}),
                     run_of("fast", [1.0] * 5, {"triangles": {"slow": ratio}})]}


REPORT = """## s

| detector | level | truth for | truth | reported | missed | spurious | recall | spurious rate |
|---|---|---|--:|--:|--:|--:|--:|--:|
| fast | triangle | doubles | 4 | 4 | 1 | 1 | 0.75000 | 0.25000 |
"""


class Recomputed(unittest.TestCase):
    def expect(self, text, edit):
        results = made_up()
        edit(results["runs"][1])
        found = list(check_results.wrong_results(results))
        self.assertTrue(any(text in line for line in found), (text, found))

    def test_nothing_is_wrong_with_what_agrees(self):
        self.assertEqual(list(check_results.wrong_results(made_up())), [])
        self.assertEqual(list(check_results.wrong_report(made_up(), REPORT)), [])

    def test_counts(self):
        for text, change in (("is not truth", {"hit": 4}), ("is not reported", {"spurious": 0}),
                             ("recall", {"recall": 0.8}), ("spurious rate", {"spurious_rate": 0})):
            with self.subTest(text=text):
                self.expect(text, lambda run: run["levels"]["triangle"].update(change))
        self.expect("add up to", lambda run: run["per_frame"].update(missed=[0, 0]))
        self.expect("the stages lose", lambda run: run["stages"][0].update(missed=2))

    def test_times(self):
        for text, change in (("the phases take", {"update": 0.1}), ("passes' mean", {"frame": 1.1}),
                             ("update 0.0", {"update": 0.0}), ("are mapped in", {"map": 0.0}),
                             ("of CPU time", {"cpu": 0.1})):
            with self.subTest(text=text):
                self.expect(text, lambda run: run["time_ms"]["playback"].update(change))

    def test_cold_frames_as_warm_ones(self):
        results = made_up()
        for run in results["runs"]:
            run["time_ms"]["cold"] = copy.deepcopy(run["time_ms"]["playback"])
        self.assertIn("cold frames take 1.000 times", list(check_results.wrong_results(results))[0])

    def test_speedups(self):
        def speedup(run):
            return run["speedup"]["triangles"]["slow"]
        for text, change in (("ratio over slow", {"ratio": 3.0}), ("low over slow", {"low": 1.9}),
                             ("high over slow", {"high": 2.1})):
            with self.subTest(text=text):
                self.expect(text, lambda run: speedup(run)["playback"].update(change))
        self.expect("4 passes over slow", lambda run: speedup(run).update(passes=4))
        self.expect("not a range", lambda run: speedup(run).update(interval="range"))

    def test_interval_by_hand(self):
        # Logarithms -1, 0, 0, 0, 1: mean 0, deviation sqrt(1/2), half-width 2.776 sqrt(1/10).
        half = 2.776 * 0.1 ** 0.5
        ratio, low, high = check_results.interval([2.718281828459045 ** x for x in (-1, 0, 0, 0, 1)])
        self.assertAlmostEqual(ratio, 1.0)
        self.assertAlmostEqual(low, 2.718281828459045 ** -half)
        self.assertAlmostEqual(high, 2.718281828459045 ** half)
        self.assertEqual(check_results.interval([1.0, 4.0])[1:], (1.0, 4.0))

    def test_shares_are_cut_and_raised(self):
        self.assertEqual(check_results.share(999999, 1000000), "0.99999")
        self.assertEqual(check_results.share(4, 4), "1")
        self.assertEqual(check_results.share(0, 0), "-")

    def test_report(self):
        for cell, other in (("| 1 | 1 |", "| 0 | 1 |"), ("0.75000", "0.75001"), ("## s", "## t")):
            with self.subTest(cell=cell):
                self.assertTrue(list(check_results.wrong_report(made_up(),
                                                                REPORT.replace(cell, other))))


class Commands(unittest.TestCase):
    def test_differences_but_for_what_belongs_to_a_run(self):
        one = made_up()
        other = copy.deepcopy(one)
        other["runs"][0]["time_ms"] = {}
        other["command"] = "another"
        one["command"] = "one"
        one["runs"][0]["stages"][0]["out"] = 5  # a bound that is tighter misses nothing
        self.assertEqual(product_verdict.difference(one, other), "")
        other["runs"][1]["levels"]["triangle"]["missed"] = 2
        found = product_verdict.difference(one, other)
        self.assertIn("fast levels", found)
        self.assertIn("missed: 1, not 2", found)
        del other["runs"][1]
        self.assertIn("runs", product_verdict.difference(one, other))

    def test_what_a_gate_is_red_for(self):
        text = "policy\n2 checks\nFAIL  no misses\n  (because)\n  s  d: missed 1\ngate: red\n"
        self.assertEqual(product_verdict.red_line(text), "no misses: s  d: missed 1")
        self.assertEqual(product_verdict.red_line("gate: green\n"), "")

    def test_every_product_mutant_names_a_command(self):
        found = mutants(PRODUCT)
        self.assertGreaterEqual(len(found), 80)
        for mutant in found:
            with self.subTest(mutant=mutant.name):
                self.assertIn(mutant.caught_by, product_verdict.COMMANDS)


if __name__ == "__main__":
    unittest.main()
