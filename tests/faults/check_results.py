#!/usr/bin/env python3
"""Recomputes what results.json and report.md say of one another, without contactcheck's code.

    check_results.py results.json [report.md]

Of the results: counts that must add up, recall and rates, ratios and intervals from the passes, times
that phases, clocks and caches allow. Of the report: cells of its tables against the results. One
line for each disagreement; exit code 1 when there is one.
"""

import json
import math
import pathlib
import re
import sys

# Of Student's distribution, two-sided 95 %, by degrees of freedom.
STUDENT = [12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228, 2.201, 2.179,
           2.160, 2.145, 2.131, 2.120, 2.110, 2.101, 2.093]
FEWEST_FOR_INTERVAL = 5
# A vertex is a few dozen operations on eight nodes: no processor maps one in less.
MAP_NS_PER_VERTEX = 0.1
# How much longer a frame is with cold caches, over all rows of a run; far below what was ever seen.
COLD_OVER_WARM = 1.15


def close(a, b, tolerance=1e-6):
    if a is None or b is None:
        return a is b
    return abs(a - b) <= tolerance * max(abs(a), abs(b), 1e-12)


def interval(ratios):
    """The geometric mean of paired ratios with the interval that it has by the rules."""
    logs = [math.log(ratio) for ratio in ratios]
    n = len(logs)
    mean = sum(logs) / n
    if n < FEWEST_FOR_INTERVAL:
        return math.exp(mean), min(ratios), max(ratios)
    deviation = math.sqrt(sum((log - mean) ** 2 for log in logs) / (n - 1))
    half = STUDENT[min(n - 1, len(STUDENT)) - 1] * deviation / math.sqrt(n)
    return math.exp(mean), math.exp(mean - half), math.exp(mean + half)


def times_of(run):
    """By question."""
    all_times = [run.get("time_ms") or {}, *run.get("time_ms_other_questions", [])]
    return {times["question"]: times for times in all_times if times.get("passes")}


def wrong_counts(run):
    for level, c in run.get("levels", {}).items():
        if c["hit"] + c["missed"] != c["truth"]:
            yield f"{level}: hit {c['hit']} + missed {c['missed']} is not truth {c['truth']}"
        if level != "cell" and c["hit"] + c["spurious"] != c["reported"]:
            yield (f"{level}: hit {c['hit']} + spurious {c['spurious']} is not reported "
                   f"{c['reported']}")
        if not close(c["recall"], c["hit"] / c["truth"] if c["truth"] else None):
            yield f"{level}: recall {c['recall']} is not {c['hit']} / {c['truth']}"
        if not close(c["spurious_rate"], c["spurious"] / c["reported"] if c["reported"] else None):
            yield f"{level}: spurious rate {c['spurious_rate']} is not {c['spurious']} / {c['reported']}"
    frames = run.get("per_frame", {})
    counts = run.get("levels", {}).get(frames.get("level"))
    for key in ("truth", "missed", "spurious"):
        if counts and sum(frames[key]) != counts[key]:
            yield f"{frames['level']}: the frames' {key} add up to {sum(frames[key])}, not {counts[key]}"
    # A cell detector's stages are about what its cells cover, and so is its level.
    stages = run.get("stages", [])
    level = "cell" if "cell" in run.get("levels", {}) else "triangle"
    if stages and level in run.get("levels", {}):
        lost, missed = sum(stage["missed"] for stage in stages), run["levels"][level]["missed"]
        if lost != missed:
            yield f"the stages lose {lost} pairs, and {missed} are missed"


def wrong_times(run, vertices):
    for question, times in times_of(run).items():
        played, passes = times["playback"], times["pass_ms"]
        if len(passes) != times["passes"]:
            yield f"{question}: {len(passes)} times of {times['passes']} passes"
        mean = math.exp(sum(map(math.log, passes)) / len(passes))
        if not close(played["frame"], mean):
            yield f"{question}: {played['frame']} ms per frame, and its passes' mean is {mean}"
        for regime in ("playback", "cold"):
            t = times.get(regime)
            if not t:
                continue
            phases = (t["map"] or 0.0) + t["update"] + t["query"]
            if not close(phases, t["frame"], 1e-4):
                yield f"{question}, {regime}: the phases take {phases} ms, the frame {t['frame']}"
            if t["update"] <= 0.0 or t["query"] <= 0.0:
                yield f"{question}, {regime}: update {t['update']} ms, query {t['query']}"
            if t["map"] is not None and t["map"] * 1e6 < MAP_NS_PER_VERTEX * vertices:
                yield f"{question}, {regime}: {vertices} vertices are mapped in {t['map']} ms"
            if t["cpu"] < 0.5 * t["frame"]:
                yield f"{question}, {regime}: {t['frame']} ms per frame in {t['cpu']} ms of CPU time"


def wrong_speedups(run, by_name):
    for question, references in (run.get("speedup") or {}).items():
        for name, speedup in references.items():
            here = times_of(run).get(question)
            there = times_of(by_name.get((run["scene"], name), {})).get(question)
            if not here or not there:
                yield f"{question}: a speed-up over {name}, and it is not timed in both"
                continue
            ratios = [b / a for a, b in zip(here["pass_ms"], there["pass_ms"])]
            given = [speedup["playback"][key] for key in ("ratio", "low", "high")]
            if len(ratios) != speedup["passes"]:
                yield f"{question}: {speedup['passes']} passes over {name}, {len(ratios)} are there"
            for found, want, what in zip(given, interval(ratios), ("ratio", "low", "high")):
                if not close(found, want, 2e-3):
                    yield f"{question}: {what} over {name} is {found}, of the passes {want}"
            wanted = "95 %" if len(ratios) >= FEWEST_FOR_INTERVAL else "range"
            if speedup["interval"] != wanted:
                yield f"{question}: {len(ratios)} passes give a {wanted}, not a {speedup['interval']}"


def wrong_caches(runs):
    """The sweep of caches before cold frames shows over all rows, if not in each."""
    logs = [math.log(times["cold"]["frame"] / times["playback"]["frame"])
            for run in runs for times in times_of(run).values() if times.get("cold")]
    if logs and math.exp(sum(logs) / len(logs)) < COLD_OVER_WARM:
        yield (f"cold frames take {math.exp(sum(logs) / len(logs)):.3f} times as long as warm ones, "
               f"over {len(logs)} rows; at least {COLD_OVER_WARM}")


def wrong_results(results):
    by_name = {(run["scene"], run["detector"]): run for run in results["runs"]}
    vertices = {scene["id"]: sum(body["vertices"] for body in scene["bodies"])
                for scene in results["scenes"]}
    for run in results["runs"]:
        if run["status"] == "ok":
            for line in [*wrong_counts(run), *wrong_times(run, vertices.get(run["scene"], 0)),
                         *wrong_speedups(run, by_name)]:
                yield f"{run['scene']} {run['detector']}: {line}"
    yield from wrong_caches(results["runs"])


# --- the report

def three_digits(value):
    if value == 0.0:
        return "0"
    if abs(value) >= 1e6 or abs(value) < 1e-4:
        return f"{value:.2e}"
    return f"{value:.{max(0, 2 - math.floor(math.log10(abs(value))))}f}"


def shown(value, factor=1.0):
    return "-" if value is None else three_digits(value * factor)


def share(part, whole, of=math.floor):
    """Five digits, cut for recall and rounded up for rates of errors: 1 and 0 mean all and none."""
    if not whole:
        return "-"
    value = of(part * 100000 / whole) / 100000
    return str(int(value)) if value in (0.0, 1.0) and part in (0, whole) else f"{value:.5f}"


def sections(report):
    """Tables by heading: a list of (column names, rows as dictionaries)."""
    found, heading, columns = {}, "", None
    for line in report.splitlines():
        if line.startswith("## "):
            heading = line[3:]
        if not line.startswith("|"):
            columns = None
            continue
        cells = [cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]]
        if columns is None:
            columns = cells
            found.setdefault(heading, []).append((columns, []))
        elif not set(line) <= set("|-:"):
            found[heading][-1][1].append(list(zip(columns, cells)))
    return found


def tables_with(tables, *columns):
    for names, rows in tables:
        if set(columns) <= set(names):
            yield from rows


FINEST = ["vertex", "triangle", "near", "cell", "box", "body"]


def ratio_shown(run, question, reference):
    if run["detector"] == reference:
        return "1.00x"
    speedup = (run.get("speedup") or {}).get(question, {}).get(reference)
    return three_digits(speedup["playback"]["ratio"]) + "x" if speedup else "-"


def expect(place, row, wanted):
    for column, value in wanted.items():
        if column in row and row[column] != value:
            yield f"report, {place}: {column} is {row[column]}, and should be {value}"


def wrong_scene(scene, tables, runs):
    for cells in tables_with(tables, "detector", "hover mm", "late"):
        row = dict(cells)
        run = runs.get(row["detector"])
        if run is None or run["status"] != "ok" or row["level"] not in run["levels"]:
            continue
        c, body, g = run["levels"][row["level"]], run["levels"].get("body"), run["geometry"]
        wanted = {"truth": str(c["truth"]), "recall": share(c["hit"], c["truth"]),
                  "missed": str(c["missed"]), "spurious": str(c["spurious"]),
                  "hover mm": shown(g["hover_gap_max"], 1000.0),
                  "late": "-" if g["late_frames"] is None else str(g["late_frames"])}
        if body:
            wanted["body m/s"] = f"{body['missed']}/{body['spurious']}"
        if row["level"] != run["per_frame"]["level"]:
            yield f"report, {scene} {row['detector']}: {row['level']} is not the finest level"
        times = times_of(run).get(row.get("question"))
        if times:
            wanted["ms/frame"] = three_digits(times["playback"]["frame"])
            wanted["passes"] = str(times["passes"])
            for column in row:
                if column.startswith("vs "):
                    wanted[column] = ratio_shown(run, row["question"], column[3:])
        yield from expect(f"{scene} {row['detector']}", row, wanted)
    for cells in tables_with(tables, "level", "truth for", "spurious rate"):
        row = dict(cells)
        run = runs.get(row["detector"])
        if run is None or row["truth for"] != "doubles" or row["level"] not in run["levels"]:
            continue
        c = run["levels"][row["level"]]
        yield from expect(f"{scene} {row['detector']} {row['level']}", row, {
            **{key: str(c[key]) for key in ("truth", "reported", "missed", "spurious")},
            "recall": share(c["hit"], c["truth"]),
            "spurious rate": share(c["spurious"], c["reported"], math.ceil)})
    for cells in tables_with(tables, "stage", "in", "out"):
        row = dict(cells)
        for stage in runs.get(row["detector"], {}).get("stages", []):
            if stage["name"] == row["stage"]:
                yield from expect(f"{scene} {row['detector']} {row['stage']}", row,
                                  {key: str(stage[key]) for key in ("in", "out", "missed")})
    yield from wrong_scene_times(scene, tables, runs)
    yield from wrong_scene_errors(scene, tables, runs)


def wrong_scene_times(scene, tables, runs):
    for cells in tables_with(tables, "prepare", "frame, cold"):
        row = dict(cells)
        times = times_of(runs.get(row["detector"], {})).get(row["question"])
        if times:
            played, cold = times["playback"], times.get("cold") or {}
            yield from expect(f"times of {scene} {row['detector']} {row['question']}", row, {
                "prepare": shown(times["prepare"]), "map": shown(played["map"]),
                "update": shown(played["update"]), "query": shown(played["query"]),
                "frame": shown(played["frame"]),
                "contact frame": shown(played.get("contact_frame")),
                "first frame": shown(played["first_frame"]), "CPU time": shown(played["cpu"]),
                "frame, cold": shown(cold.get("frame")), "frames": str(times["timed_frames"]),
                "passes": str(times["passes"])})
    for cells in tables_with(tables, "reference", "playback", "cold"):
        row = dict(cells)
        speedup = (runs.get(row["detector"], {}).get("speedup") or {}).get(
            row["question"], {}).get(row["reference"])
        if speedup is None:
            yield f"report, {scene} {row['detector']}: a speed-up over {row['reference']} is made up"
            continue
        for column, key in (("playback", "playback"), ("cold", "cold"),
                            ("contact frames, playback", "contact_frames"),
                            ("without map, playback", "without_map")):
            value = speedup.get(key)
            low_high = (shown(value["low"]), shown(value["high"])) if value else ()
            if value and speedup["passes"] >= FEWEST_FOR_INTERVAL:
                wanted = f"{shown(value['ratio'])}x [{', '.join(low_high)}]"
            elif value and speedup["passes"] > 1:
                wanted = f"{shown(value['ratio'])}x (range {' to '.join(low_high)})"
            else:
                wanted = f"{shown(value['ratio'])}x (1 pass)" if value else "-"
            yield from expect(f"speed-ups of {scene} {row['detector']} over {row['reference']}", row,
                              {column: wanted})


def wrong_scene_errors(scene, tables, runs):
    for cells in tables_with(tables, "contour missed", "depth error"):
        row = dict(cells)
        run = runs.get(row["detector"])
        if run is None or not run["levels"]:
            continue
        g = run["geometry"]
        three = [shown(g[f"depth_error_{key}"], 1000.0) for key in ("max", "mean", "p95")]
        angles = [shown(g[f"normal_error_deg_{key}"]) for key in ("max", "mean", "p95")]
        covered = g["covered_length_fraction"]
        yield from expect(f"graded errors of {scene} {row['detector']}", row, {
            "contour missed": shown(g["missed_length"], 1000.0),
            "contour covered": "-" if covered is None else share(covered, 1.0),
            "spurious up to": shown(g["spurious_distance_max"], 1000.0),
            "depths judged": str(g["depth_judged"]), "depth error": " / ".join(three),
            "normals judged": str(g["normal_judged"]), "normal error": " / ".join(angles)})


def wrong_summary(tables, runs, failed):
    """`runs`: by detector, one per scene; `failed`: the statuses of its rows that are not
    ok."""
    for cells in tables_with(tables, "scenes", "level", "hover mm"):
        row = dict(cells)
        its = [run for run in runs.get(row["detector"], []) if row["level"] in run["levels"]]
        if not its or len(its) != len(runs[row["detector"]]):
            continue
        counts = [run["levels"][row["level"]] for run in its]
        sums = {key: sum(c[key] for c in counts) for key in counts[0] if key in
                ("truth", "hit", "missed", "spurious")}
        bodies = [run["levels"]["body"] for run in its if "body" in run["levels"]]
        hovers = [run["geometry"]["hover_gap_max"] for run in its
                  if run["geometry"]["hover_gap_max"] is not None]
        statuses = failed.get(row["detector"], [])
        not_ok = ", ".join(f"{statuses.count(status)} {status}"
                           for status in ("error", "absent", "refused") if status in statuses)
        wanted = {"scenes": f"{len(its)}" + (f" ({not_ok})" if not_ok else ""),
                  "truth": str(sums["truth"]),
                  "recall": share(sums["hit"], sums["truth"]), "missed": str(sums["missed"]),
                  "spurious": str(sums["spurious"]),
                  "hover mm": shown(max(hovers) if hovers else None, 1000.0)}
        if bodies:
            wanted["body m/s"] = (f"{sum(b['missed'] for b in bodies)}/"
                                  f"{sum(b['spurious'] for b in bodies)}")
        for column in row:
            ratios = [run["speedup"][row["question"]][column[3:]]["playback"]["ratio"]
                      for run in its if column.startswith("vs ") and
                      column[3:] in (run.get("speedup") or {}).get(row["question"], {})]
            if len(ratios) > 1:
                low, high = three_digits(min(ratios)), three_digits(max(ratios))
                wanted[column] = f"{low}x" if low == high else f"{low} to {high}x"
        yield from expect(f"summary, {row['detector']}", row, wanted)


def wrong_errors(tables, runs):
    for cells in tables_with(tables, "error", "on the front"):
        row = dict(cells)
        counts = [run["levels"][row["level"]] for run in runs.get(row["detector"], [])
                  if row["level"] in run["levels"]]
        truth, missed, reported, spurious = (sum(c[key] for c in counts) for key in
                                             ("truth", "missed", "reported", "spurious"))
        error = max(missed / truth if truth else 0.0, spurious / reported if reported else 0.0)
        yield from expect(f"speed against error, {row['detector']}", row, {
            "truth": str(truth), "missed": str(missed), "reported": str(reported),
            "spurious": str(spurious)})
        if row["error"] != "-" and abs(float(row["error"]) - error) > 2e-5:
            yield f"report, speed against error, {row['detector']}: error {row['error']}, not {error}"


def wrong_report(results, report):
    tables = sections(report)
    by_scene, by_detector, failed = {}, {}, {}
    for run in results["runs"]:
        if run["status"] != "ok":
            failed.setdefault(run["detector"], []).append(run["status"])
        else:
            by_scene.setdefault(run["scene"], {})[run["detector"]] = run
            by_detector.setdefault(run["detector"], []).append(run)
    for scene, runs in by_scene.items():
        # Families of hard cases have tables of their own.
        if scene not in tables and not scene.startswith("hard-"):
            yield f"report: there is no table of {scene}"
        yield from wrong_scene(scene, tables.get(scene, []), runs)
    yield from wrong_summary(tables.get("Summary", []), by_detector, failed)
    yield from wrong_errors(tables.get("Speed against error", []), by_detector)


def main():
    if len(sys.argv) not in (2, 3):
        print(__doc__, file=sys.stderr)
        return 2
    results = json.loads(pathlib.Path(sys.argv[1]).read_text(encoding="utf-8"))
    found = list(wrong_results(results))
    if len(sys.argv) == 3:
        found += wrong_report(results, pathlib.Path(sys.argv[2]).read_text(encoding="utf-8"))
    for line in found:
        print(line)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
