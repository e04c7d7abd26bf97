#!/usr/bin/env python3
"""Checks results.json files: validate_results.py [--described] RESULTS...

First against fixtures/results.schema.json, then what a schema cannot state: sums, rates, lengths
and references. Fields may be added to results; with --described one that the schema does not
describe is an error. Prints one line per error (file, place, what). Exit code: 0 all valid, 1 any
error, 2 bad usage or a file that cannot be read as JSON.
"""

import json
import math
import pathlib
import sys

try:
    from jsonschema import Draft202012Validator
except ImportError:
    sys.exit("validate_results.py needs jsonschema: apt-get install python3-jsonschema")

SCHEMA_FILE = pathlib.Path(__file__).resolve().parents[3] / "fixtures" / "results.schema.json"

# Rates are written with 17 digits and divided once: what differs by more was computed otherwise.
RATE_TOLERANCE = 1e-12

# A total is written after one addition per part: what differs by more is not their sum.
SUM_TOLERANCE = 1e-12  # of the total

LONGEST_MESSAGE = 200  # characters; a validator quotes whole runs


class UnreadableFile(Exception):
    """The file is not there or not strict JSON."""


def refuse_constant(name):
    raise UnreadableFile(f"{name} is not JSON")


def object_without_repeats(pairs):
    names = [name for name, _ in pairs]
    for name in names:
        if names.count(name) > 1:
            raise UnreadableFile(f'the key "{name}" stands twice in one object')
    return dict(pairs)


def load(path):
    try:
        text = pathlib.Path(path).read_text(encoding="utf-8")
        return json.loads(text, parse_constant=refuse_constant,
                          object_pairs_hook=object_without_repeats)
    except (OSError, ValueError, UnreadableFile) as error:
        raise UnreadableFile(f"{path}: {error}") from error


def closed(schema):
    """The schema that takes no field of an object but those that it describes."""
    if isinstance(schema, list):
        return [closed(part) for part in schema]
    if not isinstance(schema, dict):
        return schema
    out = {key: closed(part) for key, part in schema.items()}
    if out.get("type") == "object" and "properties" in out:
        out.setdefault("additionalProperties", False)
    return out


def schema_errors(results, schema):
    """(place, message) of every violation, in the order of places."""
    validator = Draft202012Validator(schema)
    found = []
    for error in validator.iter_errors(results):
        place = "/" + "/".join(str(step) for step in error.absolute_path)
        found.append((place, error.message))
    return sorted(found)


def rate_errors(place, name, rate, part, whole):
    if whole == 0:
        if rate is not None:
            yield f"{place}/{name}", f"is {rate} over nothing; it must be null"
    elif rate is None or abs(rate - part / whole) > RATE_TOLERANCE:
        yield f"{place}/{name}", f"is {rate}, but {part} / {whole} is {part / whole}"


def level_errors(place, level):
    if level["hit"] + level["missed"] != level["truth"]:
        yield place, (f"hit {level['hit']} + missed {level['missed']} is not "
                      f"truth {level['truth']}")
    if level["spurious"] > level["reported"]:
        yield place, f"spurious {level['spurious']} exceeds reported {level['reported']}"
    yield from rate_errors(place, "recall", level["recall"], level["hit"], level["truth"])
    yield from rate_errors(place, "spurious_rate", level["spurious_rate"], level["spurious"],
                           level["reported"])


def per_frame_errors(place, run):
    per_frame = run["per_frame"]
    for name in ("truth", "missed", "spurious", "covered_length_fraction", "frame_ms"):
        values = per_frame.get(name)
        if values is not None and len(values) not in (0, run["frames"]):
            yield f"{place}/{name}", f"has {len(values)} entries for {run['frames']} frames"
    finest = per_frame.get("level", "")
    if not finest:
        return
    level = run["levels"].get(finest)
    if level is None:
        yield f"{place}/level", f"{finest} is not among the levels"
        return
    for name in ("truth", "missed", "spurious"):
        if sum(per_frame[name]) != level[name]:
            yield f"{place}/{name}", f"adds up to {sum(per_frame[name])}, not {level[name]}"


def geometry_errors(place, geometry):
    """Spreads are ordered, and null exactly where nothing was judged."""
    for stem, count in (("depth_error", "depth_judged"), ("normal_error_deg", "normal_judged")):
        if count not in geometry:
            continue
        values = [geometry.get(f"{stem}_{which}") for which in ("mean", "p95", "max")]
        if geometry[count] == 0:
            if values != [None] * 3:
                yield f"{place}/{stem}_max", "has values though nothing was judged"
        elif None in values:
            yield f"{place}/{stem}_max", f"is null though {geometry[count]} were judged"
        elif max(values[0], values[1]) > values[2] * (1 + RATE_TOLERANCE):
            yield f"{place}/{stem}_max", "is below the mean or the 95th percentile"


def not_judged_errors(place, run):
    for name in run.get("not_judged", {}):
        if name in run["levels"]:
            yield f"{place}/{name}", "is among the levels, so it was judged"


def time_errors(place, run):
    """Of the detector's own question and of the others, each of which stands once."""
    others = enumerate(run.get("time_ms_other_questions", []))
    seen = set()
    for name, times in [("time_ms", run["time_ms"]),
                        *((f"time_ms_other_questions/{i}", times) for i, times in others)]:
        timed = times.get("timed_frames", 0)
        if timed > run["frames"]:
            yield f"{place}/{name}/timed_frames", f"exceeds the run's {run['frames']} frames"
        if times.get("timed_contact_frames", 0) > timed:
            yield f"{place}/{name}/timed_contact_frames", f"exceeds the {timed} timed frames"
        if times.get("question") in seen:
            yield f"{place}/{name}/question", f"{times['question']} is timed twice"
        seen.add(times.get("question"))
        if "pass_ms" in times:
            yield from pass_errors(f"{place}/{name}/pass_ms", times)
        for regime in ("playback", "cold"):
            if regime in times:
                yield from phase_errors(f"{place}/{name}/{regime}", times[regime])


def pass_errors(place, times):
    passes, frame = times["pass_ms"], times["playback"]["frame"]
    if len(passes) != times["passes"]:
        yield place, f"has {len(passes)} entries for {times['passes']} passes"
        return
    mean = math.exp(sum(map(math.log, passes)) / len(passes))
    if abs(mean - frame) > RATE_TOLERANCE * mean:
        yield place, f"have the geometric mean {mean}, but playback/frame is {frame}"


def phase_errors(place, phases):
    parts = (phases["map"] or 0) + phases["update"] + phases["query"]
    if abs(parts - phases["frame"]) > SUM_TOLERANCE * parts:
        yield f"{place}/frame", f"is {phases['frame']}, but its phases add up to {parts}"


def histogram_errors(place, run):
    """Every error counts once, in bins that do not overlap."""
    geometry = run["geometry"]
    # Distances are those of claimed pairs of triangles, and not of scenes that grade no lengths.
    graded = geometry["spurious_distance_max"] is not None
    spurious = run["levels"].get("triangle", {}).get("spurious") if graded else None
    for name, whole in (("depth_error_histogram", geometry.get("depth_judged")),
                        ("normal_error_deg_histogram", geometry.get("normal_judged")),
                        ("spurious_distance_histogram", spurious)):
        bins = geometry.get(name)
        if bins is None or whole is None:
            continue
        edges = [edge for one in bins for edge in (one["from"], one["below"])]
        if edges != sorted(edges) or any(one["from"] == one["below"] for one in bins):
            yield f"{place}/{name}", "has bins out of order"
        total = sum(one["count"] for one in bins)
        if total != whole:
            yield f"{place}/{name}", f"adds up to {total}, not {whole}"


def informative_errors(place, run):
    claimed = run["semantics"].get("levels")
    if claimed is None:
        return
    for levels in ("levels", "levels_rounded"):
        for name, level in run.get(levels, {}).items():
            if (name in claimed) == level.get("informative", False):
                yield f"{place}/{levels}/{name}", "must be informative exactly when not claimed"


def speedup_errors(place, run):
    timed = {times.get("question"): times.get("passes", 0)
             for times in [run["time_ms"], *run.get("time_ms_other_questions", [])]}
    for question, references in run.get("speedup", {}).items():
        for reference, ratios in references.items():
            here = f"{place}/{question}/{reference}"
            for name in ("playback", "cold", "contact_frames", "without_map"):
                ratio = ratios[name]
                if ratio and not ratio["low"] <= ratio["ratio"] <= ratio["high"]:
                    yield f"{here}/{name}", "lies outside its interval"
            if ratios["passes"] > timed.get(question, 0):
                yield f"{here}/passes", f"exceeds the row's {timed.get(question, 0)} passes"


def step_errors(place, step):
    parts = sum(step[name] for name in ("mss", "cell", "test", "response"))
    if abs(parts - step["total"]) > SUM_TOLERANCE * parts:
        yield f"{place}/total", f"is {step['total']}, but its four parts add up to {parts}"
    for name in ("test_by_repeat", "total_by_repeat"):
        if len(step[name]) != step["repeats"]:
            yield f"{place}/{name}", f"has {len(step[name])} entries for {step['repeats']} repeats"
    for number, (test, total) in enumerate(zip(step["test_by_repeat"], step["total_by_repeat"])):
        if test > total:
            yield f"{place}/test_by_repeat/{number}", f"{test} exceeds the whole step's {total}"


CLOSED_LOOP_FIELDS = ("steps", "levels", "hover_at_rest_max", "hover_at_rest_mean",
                      "deepest_penetration", "energy_gain", "last_speed", "tunnelling_events")


def closed_loop_errors(place, loop):
    """A motion has every field, a motion that there is not has none."""
    for name in CLOSED_LOOP_FIELDS:
        if (name in loop) == (loop["error"] != ""):
            yield f"{place}/{name}", "must be there exactly when error is empty"
    for name, level in loop.get("levels", {}).items():
        yield from level_errors(f"{place}/levels/{name}", level)
    largest, mean = loop.get("hover_at_rest_max"), loop.get("hover_at_rest_mean")
    if (largest is None) != (mean is None):
        yield f"{place}/hover_at_rest_mean", "must be null exactly when the largest is"
    elif largest is not None and mean > largest * (1 + SUM_TOLERANCE):
        yield f"{place}/hover_at_rest_mean", f"{mean} exceeds the largest, {largest}"


def run_errors(place, run):
    if run["status"] != "ok":
        return
    if run["contact_frames"] > run["frames"]:
        yield place, f"{run['contact_frames']} contact frames of {run['frames']} frames"
    for levels in ("levels", "levels_rounded"):
        for name, level in run.get(levels, {}).items():
            yield from level_errors(f"{place}/{levels}/{name}", level)
    yield from informative_errors(place, run)
    yield from geometry_errors(f"{place}/geometry", run["geometry"])
    yield from histogram_errors(f"{place}/geometry", run)
    yield from per_frame_errors(f"{place}/per_frame", run)
    yield from speedup_errors(f"{place}/speedup", run)
    if "closed_loop" in run:
        yield from closed_loop_errors(f"{place}/closed_loop", run["closed_loop"])
    if "step_ms" in run:
        yield from step_errors(f"{place}/step_ms", run["step_ms"])
    yield from not_judged_errors(f"{place}/not_judged", run)
    yield from time_errors(place, run)


def goal_errors(place, goal):
    measured = goal["measured"]
    if measured is None:
        return
    if "low" in goal and not goal["low"] <= measured <= goal["high"]:
        yield f"{place}/measured", "lies outside its interval"
    least, most = goal.get("at_least"), goal.get("at_most")
    if goal["met"] != (measured >= least if least is not None else measured <= most):
        yield f"{place}/met", f"is {goal['met']} for {measured}"


def pairs_errors(place, pairs):
    checked = pairs["rational"]["checked"]
    if checked != pairs["count"]:
        yield f"{place}/rational/checked", f"is {checked} of {pairs['count']} pairs"
    kinds = pairs["per_kind"].values()
    for name, whole in (("pairs", "count"), ("touching", "touching")):
        total = sum(kind[name] for kind in kinds)
        if total != pairs[whole]:
            yield f"{place}/per_kind", f"{name} adds up to {total}, not {pairs[whole]}"
    for name, kind in pairs["per_kind"].items():
        if kind["touching"] > kind["pairs"]:
            yield f"{place}/per_kind/{name}/touching", f"exceeds the {kind['pairs']} pairs"


def contradicts_the_oracle(results, disagreement):
    """Is it of rational arithmetic with the oracle, in a scene of random pairs?"""
    return disagreement["detector"] == "oracle" and any(
        scene["pairs"]["rational"]["oracle_wrong"] > 0
        for scene in results.get("scenes", [])
        if scene.get("id") == disagreement["scene"] and "pairs" in scene)


def contacts_errors(place, scene):
    if "contacts" not in scene:
        return
    if "pairs" in scene:
        yield place, "random pairs have no file of contacts"
    elif scene["contacts"] != f"contacts/{scene['id']}.json":
        yield place, f"is {scene['contacts']}, not contacts/{scene['id']}.json"


def separation_errors(place, scene):
    """One distance per frame, 0 in contact frames alone."""
    distances = scene.get("separation")
    if distances is None:
        return
    if "family" in scene or "pairs" in scene:
        yield place, "frames that are cases have no separation"
    elif len(distances) != scene["frames"]:
        yield place, f"has {len(distances)} entries for {scene['frames']} frames"
    elif distances.count(0) != scene["contact_frames"]:
        yield place, f"is 0 in {distances.count(0)} of {scene['contact_frames']} contact frames"


def frames_errors(place, scene):
    """A sweep has a frame per pose, a fit an error per frame; cold frames are frames."""
    frames, sweep = scene["frames"], scene.get("sweep")
    cold = scene.get("cold_frames", [])
    if cold != sorted(set(cold)) or any(frame >= frames for frame in cold):
        yield f"{place}/cold_frames", f"are not ascending numbers of {frames} frames"
    if sweep and len(sweep["separations"]) * sweep["orientations"] != frames:
        yield f"{place}/sweep", f"has other poses than the scene's {frames} frames"
    for number, fit in enumerate(scene.get("fits", [])):
        if len(fit["rms"]) != frames or len(fit["max"]) != frames:
            yield f"{place}/fits/{number}", f"has no error for each of {frames} frames"
        elif any(rms > most * (1 + 1e-12) for rms, most in zip(fit["rms"], fit["max"])):
            yield f"{place}/fits/{number}/rms", "exceeds the largest distance"


def consistency_errors(results):
    """What a schema cannot state. Expects results that satisfy the schema."""
    runs = {}
    for number, run in enumerate(results["runs"]):
        place = f"/runs/{number}"
        key = (run["scene"], run["detector"])
        if key in runs:
            yield place, f"scene {key[0]} with detector {key[1]} stands twice"
        runs[key] = run
        yield from run_errors(place, run)
    for number, goal in enumerate(results.get("goals", [])):
        yield from goal_errors(f"/goals/{number}", goal)
    for number, scene in enumerate(results.get("scenes", [])):
        if "pairs" in scene:
            yield from pairs_errors(f"/scenes/{number}/pairs", scene["pairs"])
        yield from frames_errors(f"/scenes/{number}", scene)
        yield from contacts_errors(f"/scenes/{number}/contacts", scene)
        yield from separation_errors(f"/scenes/{number}/separation", scene)
    scenes = {scene for scene, _ in runs}
    for number, scene in enumerate(results.get("resumed", [])):
        if scene not in scenes:
            yield f"/resumed/{number}", f"{scene} is no scene of the runs"
    for number, disagreement in enumerate(results["disagreements"]):
        place = f"/disagreements/{number}"
        if contradicts_the_oracle(results, disagreement):
            continue
        run = runs.get((disagreement["scene"], disagreement["detector"]))
        if run is None:
            yield place, "belongs to no run"
        elif disagreement["frame"] >= run.get("frames", 0):
            yield f"{place}/frame", f"is {disagreement['frame']} of {run.get('frames', 0)} frames"


def errors_of(results, schema):
    return schema_errors(results, schema) or list(consistency_errors(results))


def one_line(text):
    text = " ".join(text.split())
    return text if len(text) <= LONGEST_MESSAGE else text[:LONGEST_MESSAGE] + " ..."


def main(words):
    paths = [word for word in words if word != "--described"]
    if not paths or paths[0] in ("-h", "--help"):
        print(__doc__.strip())
        return 0 if paths else 2
    any_error = False
    try:
        schema = load(SCHEMA_FILE)
        if "--described" in words:
            schema = closed(schema)
        for path in paths:
            for place, message in errors_of(load(path), schema):
                any_error = True
                print(f"{path}: {place}: {one_line(message)}")
    except UnreadableFile as error:
        print(error, file=sys.stderr)
        return 2
    return 1 if any_error else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
