"""Files of fixtures/published: the few fields of results that texts quote, one row a line."""

import datetime
import json
import os
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDER = pathlib.Path("fixtures") / "published"  # below the root
RANGES = pathlib.Path("fixtures") / "hard" / "ranges.json"
LARGEST = 200_000  # bytes of a file
REFERENCES = ("fcl-aabb", "fcl-obbrss", "embree")
COUNTS = ("missed", "spurious")
ELEMENTS = ("impact-vf", "impact-ee", "impact-self-vf", "impact-self-ee")  # levels


class TextError(Exception):
    """What is wrong, with its place, in one sentence."""


def read_text(path, shown):
    try:
        return path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        why = getattr(error, "strerror", None) or error
        raise TextError(f"{shown} cannot be read: {why}") from error


def read_json(path, shown):
    try:
        return json.loads(read_text(path, shown))
    except ValueError as error:
        raise TextError(f"{shown} is not JSON: {error}") from error


# What a scene's row may have.
SCENE_FIELDS = {
    "frames": lambda scene: scene["frames"],
    "steps": lambda scene: scene["frames"] * scene["simulation"]["every"],
    "triangles": lambda scene: sum(body["triangles"] for body in scene["bodies"]),
    "true_pairs": lambda scene: scene["truth"]["triangle"],
    "true_bodies": lambda scene: scene["truth"]["body"],
    "true_self": lambda scene: [scene["truth"][level] for level in
                                ("self", "self-vertex", "self-edge")],
    "between": lambda scene: {"steps": len(scene["impacts"]["motion"]),
                              "passing": sum(scene["impacts"]["passing"]),
                              "pairs": sum(scene["truth"].get(level, 0) for level in ELEMENTS)},
}


def question_of(run):
    """The question whose speed-ups the reports show: triangles or body, else the detector's own."""
    asked = "triangles" if "triangles" in run["semantics"]["questions"] else "body"
    own = run["time_ms"]
    others = [times["question"] for times in run.get("time_ms_other_questions", [])]
    timed = "question" not in own or asked in [own["question"], *others]
    return asked if timed else own["question"]


def level_of(run):
    """The finest level judged; without one nothing was."""
    return run["per_frame"].get("level") or "-"


def finest(run):
    return run["levels"].get(level_of(run), {})


def speedups(run):
    """By reference [ratio, low, high, passes]."""
    out = {}
    for reference, speedup in run["speedup"].get(question_of(run), {}).items():
        ratio = speedup["playback"]
        if reference in REFERENCES and ratio:
            out[reference] = [ratio["ratio"], ratio["low"], ratio["high"], speedup["passes"]]
    return out


def self_ms(run):
    """Of contacts of bodies with themselves, whatever else is timed."""
    return next(times["playback"]["frame"]
                for times in (run["time_ms"], *run.get("time_ms_other_questions", []))
                if times["question"] == "self")


def self_wrong(run):
    """Missed and spurious contacts of bodies with themselves, all classes."""
    levels = [counts for level, counts in run["levels"].items() if level.startswith("self")]
    return [sum(counts[kind] for counts in levels) for kind in COUNTS]


def self_speedup(run):
    """Over Embree [ratio, low, high, passes]."""
    speedup = run["speedup"].get("self", {}).get("embree")
    ratio = speedup and speedup["playback"]
    return ratio and [ratio["ratio"], ratio["low"], ratio["high"], speedup["passes"]]


def step_wrong(run):
    """By level of steps, missed and spurious."""
    return {level: [counts[kind] for kind in COUNTS] for level, counts in run["levels"].items()
            if level.startswith("impact")}


def step_speedup(run):
    """In the first question of steps that is timed, by reference [ratio, low, high, passes]."""
    for question in ("impacts", "self-impacts"):
        if question in run["speedup"]:
            return {reference: [speedup["playback"][end] for end in ("ratio", "low", "high")] +
                    [speedup["passes"]]
                    for reference, speedup in run["speedup"][question].items() if speedup["playback"]}
    return {}


# What a run's row may have. Counts are of the finest level judged.
RUN_FIELDS = {
    "level": level_of,
    "truth": lambda run: finest(run).get("truth"),
    "missed": lambda run: finest(run).get("missed"),
    "spurious": lambda run: finest(run).get("spurious"),
    "missed_bodies": lambda run: run["levels"]["body"]["missed"],
    "spurious_bodies": lambda run: run["levels"]["body"]["spurious"],
    "spurious_distance": lambda run: run["geometry"]["spurious_distance_max"],
    "rounded": lambda run: ([run["levels_rounded"]["triangle"][kind] for kind in COUNTS]
                            if "levels_rounded" in run else None),
    "hover": lambda run: run["geometry"]["hover_gap_max"],
    "lost": lambda run: {stage["name"]: stage["missed"]
                         for stage in run["stages"] if stage["missed"]},
    "question": question_of,
    "passes": lambda run: run["time_ms"]["passes"],
    "ms": lambda run: run["time_ms"]["playback"]["frame"],
    "speedup": speedups,
    "ratios": lambda run: {reference: ends[0] for reference, ends in speedups(run).items()},
    "memory_bytes": lambda run: run["memory_bytes"],
    "step_wrong": step_wrong,
    "step_speedup": step_speedup,
    "tunnelled": lambda run: sum(run["impacts"]["tunnelled"]),
    "self_ms": self_ms,
    "self_wrong": self_wrong,
    "self_speedup": self_speedup,
    "options": lambda run: run["options"],
    "depth_error": lambda run: run["geometry"].get("depth_error_max"),
}


def scene_rows(results, fields):
    return [{"scene": scene["id"], **{field: SCENE_FIELDS[field](scene) for field in fields}}
            for scene in results["scenes"]]


def run_rows(results, fields):
    rows = []
    for run in results["runs"]:
        row = {"scene": run["scene"], "detector": run["detector"]}
        if run["status"] != "ok":
            row["status"] = run["status"]
        else:
            row |= {field: RUN_FIELDS[field](run) for field in fields}
        rows.append(row)
    return rows


def goal_rows(results, fields):
    """With the passes of the ratio that the goal is about: without them nobody knows its ends."""
    rows = []
    for goal in results["goals"]:
        run = next((run for run in results["runs"] if run["status"] == "ok" and
                    (run["scene"], run["detector"]) == (goal["scene"], goal["detector"])), None)
        passes = 0
        if run:
            times = run["time_ms"]
            ratios = run["speedup"].get(times.get("question"), {})
            passes = ratios.get(goal.get("over"), times).get("passes", 0)
        rows.append({field: goal[field] for field in fields if field in goal} | {"passes": passes})
    return rows


def family_rows(results, fields):
    """One row a detector, and one more for each class of contacts of a body with itself: sums over
    families of hard cases. `rounded`: by levels_rounded, too; `between`: of contacts between bodies
    alone."""
    cases = {scene["id"]: len(scene["family"]["values"])
             for scene in results["scenes"] if "family" in scene}
    own = {scene["id"]: next((level for level in scene["truth"] if level.startswith("self")), "")
           for scene in results["scenes"]}
    rows = {}
    for run in results["runs"]:
        if run["scene"] not in cases or run["status"] == "absent":
            continue
        if "between" in fields and own[run["scene"]]:
            continue
        row = rows.setdefault((own[run["scene"]], run["detector"]), {
            "detector": run["detector"], "level": "-", "families": 0, "families_right": 0, "cases": 0,
            "right": 0, "truth": 0, "missed": 0, "spurious": 0, "refused": 0, "refused_cases": 0,
            "errors": 0})
        row["families"] += 1
        if run["status"] == "refused":
            row["refused_cases"] += cases[run["scene"]]
        if run["status"] != "ok":
            row["refused" if run["status"] == "refused" else "errors"] += 1
            continue
        if level_of(run) == "-":
            continue
        frames = run["per_frame"]
        wrong = sum(any(pair) for pair in zip(frames["missed"], frames["spurious"], strict=True))
        row["level"] = frames["level"]
        row["families_right"] += wrong == 0
        row["cases"] += cases[run["scene"]]
        row["right"] += cases[run["scene"]] - wrong
        for kind in ("truth", *COUNTS):
            row[kind] += sum(frames[kind])
        rounded = run.get("levels_rounded", {}).get("triangle")
        if "rounded" in fields and rounded:
            row["rounded_truth"] = row.get("rounded_truth", 0) + rounded["truth"]
            row["rounded_wrong"] = (row.get("rounded_wrong", 0) + rounded["missed"] +
                                    rounded["spurious"])
    return list(rows.values())


def family_sums(results, _):
    families = [scene["family"] for scene in results["scenes"] if "family" in scene]
    known = results.get("known_defects", {})

    def listed(list_name, refused):
        return sum(entry["listed"] for entry in known.get(list_name, [])
                   if (entry["kind"] == "refused") == refused)
    return [{"families": len(families), "cases": sum(len(family["values"]) for family in families),
             "known_defects": listed("defects", False), "known_refusals": listed("defects", True),
             "readings": listed("readings", False)}]


def paper_rows(reproduction, _):
    """A row a scene: two levels of spheres over one, safe bounds, beside the paper."""
    rows = []
    for scene in reproduction["scenes"]:
        for ratio in scene["ratios"]:
            if ratio["after"] == "ffd-aabb-sphere2" and ratio["paper_reports"]:
                ours = ratio["safe"]
                rows.append({
                    "scene": scene["scene"],
                    "test": [ours["test"][end] for end in ("ratio", "low", "high")],
                    "paper_test": ratio["paper_reports"]["test"],
                    "left_to_hash": ours["into_hash_after"] / ours["into_hash_before"],
                    "test_share": ours["test_share_before"],
                    "steps_per_second": scene["frame_rate"]["steps_per_second"],
                    "hover_at_rest": scene["hover_at_rest"] and {
                        detector: scene["hover_at_rest"][detector]
                        for detector in ("ffd-grid", "ffd-aabb-sphere2")}})
    return rows


def paper_sums(reproduction, _):
    findings = reproduction["paper"]["findings"]
    means = reproduction["means"]
    return [{"figures": len(findings), "contradict": sum(f["agrees"] is False for f in findings),
             "test": means["test_ratio"]["ours"], "steps": means["frame_rate_ratio"]["ours"]}]


def drawn_scenes(results):
    """What was drawn from one seed: those of its scenes that were judged, and the sums of all."""
    scenes = [scene for scene in results["scenes"] if "drawn" in scene]
    seeds = {scene["drawn"]["seed"] for scene in scenes}
    if len(seeds) != 1:
        raise TextError(f"the scenes are drawn from {len(seeds)} seeds and not from one")
    judged = [scene for scene in scenes if "unjudged" not in scene]
    return judged, {"seed": seeds.pop(), "scenes": len(scenes), "judged": len(judged),
                    "redrawn": sum(scene["drawn"]["redrawn"] > 0 for scene in scenes)}


def drawn_sums(results, _):
    judged, sums = drawn_scenes(results)
    return [{**sums,
             "with_contact": sum(scene["contact_frames"] > 0 for scene in judged),
             "frames": sum(scene["frames"] for scene in judged),
             "true_pairs": sum(scene["truth"]["triangle"] for scene in judged)}]


def step_sums(results, _):
    """Of scenes that are judged between frames: true pairs by level."""
    judged, sums = drawn_scenes(results)
    levels = sorted({level for scene in judged for level in scene["truth"]})
    true = {level: sum(scene["truth"].get(level, 0) for scene in judged) for level in levels}
    return [{**sums,
             "with_impacts": sum(any(scene["truth"].values()) for scene in judged),
             "with_self": sum("impact-self-vf" in scene["truth"] for scene in judged),
             "steps": sum(len(scene["impacts"]["motion"]) for scene in judged),
             "passing": sum(sum(scene["impacts"]["passing"]) for scene in judged),
             "true": true}]


def drawn_rows(results, titles):
    """Rows of the run's own report, in its words: of tables whose title begins with one of these."""
    rows, title, columns = [], "", None
    section = results["report"].partition("\n## Drawn scenes\n")[2].partition("\n## ")[0]
    for line in section.splitlines():
        if line.startswith("### "):
            title, columns = line[4:], None
        elif line.startswith("| ") and title.startswith(titles):
            cells = [cell.strip() for cell in line.strip("| ").split(" | ")]
            if columns:
                rows.append({"table": title, **dict(zip(columns, cells, strict=True))})
            columns = columns or cells
    if not rows:
        raise TextError(f"the report has no rows of drawn scenes below \"{titles[0]}\"")
    return rows


MAKERS = {"scenes": scene_rows, "runs": run_rows, "goals": goal_rows, "sums": family_sums,
          "detectors": family_rows, "paper_sums": paper_sums, "paper": paper_rows,
          "drawn_sums": drawn_sums, "step_sums": step_sums, "drawn": drawn_rows}

GOAL = ("goal", "detector", "part", "at_least", "at_most", "measured", "low", "high", "unit", "why",
        "met")
# Which rows each file has, and which fields of theirs.
FILES = {
    "default": {"scenes": ("frames", "triangles", "true_pairs", "true_bodies"),
                "runs": ("level", "truth", *COUNTS, "missed_bodies", "spurious_bodies", "hover",
                         "lost", "question", "ms", "passes", "ratios")},
    "performance": {"scenes": ("frames", "triangles", "true_pairs"),
                    "runs": ("truth", *COUNTS, "ms", "passes", "speedup"), "goals": GOAL},
    "self": {"scenes": ("frames", "triangles", "true_self"),
             "runs": ("self_wrong", "self_ms", "self_speedup"), "goals": GOAL},
    "continuous": {"scenes": ("triangles", "between"),
                   "runs": ("step_wrong", "step_speedup", "tunnelled"), "goals": GOAL},
    "hard": {"sums": (), "detectors": ()},
    "single-lazy": {"scenes": ("true_pairs",),
                    "runs": (*COUNTS, "missed_bodies", "spurious_bodies", "spurious_distance")},
    "single-historic": {"scenes": ("true_pairs",),
                        "runs": (*COUNTS, "rounded")},
    "single-hard": {"detectors": ("rounded", "between")},
    "settings": {"runs": ("truth", *COUNTS, "depth_error", "options", "ms", "passes")},
    "settings-hard": {"detectors": ()},
    "settings-drawn": {"drawn_sums": (), "drawn": ("Missed and spurious",)},
    "single-lazy-times": {"runs": ("ms", "passes")},
    "single-historic-times": {"runs": ("ms", "passes")},
    "paper-64": {"scenes": ("steps",), "runs": ("memory_bytes",)},
    "reproduce": {"paper_sums": (), "paper": ()},
    "drawn": {"drawn_sums": (), "drawn": ("Missed and spurious",)},
    "drawn-times": {"drawn_sums": (), "drawn": ("Missed and spurious", "Speed-ups")},
    "drawn-steps": {"step_sums": (), "drawn": ("Missed and spurious",)},
    "drawn-steps-times": {"step_sums": (), "drawn": ("Missed and spurious", "Speed-ups")},
}


def files_of(root):
    """What tables and figures are made of: published files by name, and the ranges of the suite
    scales, which the program keeps and reads itself."""
    return {**{name: Published(root, name) for name in FILES},
            "ranges": read_json(root / RANGES, RANGES)["ranges"]}


def command_of(results):
    """Without what says only where results go and how much is printed."""
    command = re.sub(r" --(?:quiet|out \S+)(?= |$)", "", results["command"])
    if re.search(r"(?<![^\s\"'=])/", command):
        raise TextError(f"the command \"{command}\" names an absolute path, which is of one machine "
                        "alone")
    return command


def published(name, path, seconds, commit=""):
    """The text of the file NAME, made of the results at `path` by the program of `commit`."""
    if name not in FILES:
        raise TextError(f"{name} is no published file; there are {', '.join(FILES)}")
    results = read_json(path, path)
    date = datetime.datetime.fromtimestamp(os.stat(path).st_mtime, datetime.timezone.utc)
    if "drawn" in FILES[name]:
        results["report"] = read_text(path.parent / "report.md", "report.md")
    head = {"command": command_of(results), "version": results["version"],
            "machine": results["machine"], "date": f"{date:%Y-%m-%d}", "seconds": seconds}
    if commit:
        head["commit"] = commit
    try:
        sections = {kind: MAKERS[kind](results, fields) for kind, fields in FILES[name].items()}
    except KeyError as error:
        raise TextError(f"{path} has no field {error} that {FOLDER / name}.json needs") from error
    return written(head, sections)


def written(head, sections):
    lines = [f" {json.dumps(key)}: {json.dumps(value)}" for key, value in head.items()]
    for kind, rows in sections.items():
        row_lines = ",\n".join(f"  {json.dumps(row)}" for row in rows)
        lines.append(f" {json.dumps(kind)}: [\n{row_lines}\n ]")
    return "{\n" + ",\n".join(lines) + "\n}\n"


class Row(dict):
    """Says of which file it is when a field is asked for that it lacks."""

    def __init__(self, place, row):
        super().__init__(row)
        self.place = place

    def __missing__(self, field):
        row = ", ".join(str(self[key]) for key in ("scene", "detector", "goal") if key in self)
        raise TextError(f"{self.place}: the row {row or 'of sums'} has no {field}")


class Published:
    """One file, asked for rows; whatever it lacks is an error that names the file."""

    def __init__(self, root, name):
        self.place = str(FOLDER / f"{name}.json")
        path = root / self.place
        self.head = read_json(path, self.place)
        missing = [key for key in ("command", "version", "machine", "date", "seconds", *FILES[name])
                   if key not in self.head]
        if missing:
            raise TextError(f"{self.place} has no {', '.join(missing)}")
        if path.stat().st_size > LARGEST:
            raise TextError(f"{self.place} has {path.stat().st_size} bytes; {LARGEST} are allowed")

    def rows(self, kind):
        return [Row(self.place, row) for row in self.head[kind]]

    def row(self, kind, **wanted):
        found = [row for row in self.rows(kind) if all(row.get(k) == v for k, v in wanted.items())]
        if len(found) != 1:
            what = ", ".join(f"{k} {v}" for k, v in wanted.items()) or "it"
            raise TextError(f"{self.place} has {len(found)} rows of {kind} with {what}; "
                            "one is needed")
        return found[0]

    def run(self, scene, detector):
        row = self.row("runs", scene=scene, detector=detector)
        if "status" in row:
            raise TextError(f"{self.place}: {detector} in {scene} has status {row['status']}, "
                            "not ok")
        return row

    def scenes(self):
        return list(dict.fromkeys(row["scene"] for row in self.rows("runs")))

    def detectors(self):
        return list(dict.fromkeys(row["detector"] for row in self.rows("runs")))

    def same(self, values, what):
        """The one value of several that a sentence gives as one."""
        if len(set(values)) != 1:
            raise TextError(f"{self.place}: {what} are {', '.join(map(str, values))}; "
                            "the text gives one value for all")
        return values[0]
