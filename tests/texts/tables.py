"""The tables that pages show and the figures that sentences quote, out of fixtures/published."""

import math
import re
import statistics

from published import REFERENCES, TextError

FEWEST_FOR_INTERVAL = 5  # passes, as reference/results/statistics.h has it
ISA = {"AVX3": "AVX-512"}  # how the pages call what results.json names


# Numbers as the reports write them (reference/report/tables/format.cpp).
def three_digits(value):
    if value is None:
        return "-"
    if value == 0:
        return "0"
    size = abs(value)
    if size >= 1e6 or size < 1e-4:
        return f"{value:.2e}"
    return f"{value:.{max(0, 2 - math.floor(math.log10(size)))}f}"


def count(value):
    return f"{value:,}"


def span(values, write=three_digits):
    low, high = write(min(values)), write(max(values))
    return low if low == high else f"{low} to {high}"


def recall(truth, missed):
    """Cut, not rounded: with one missed contact it is not 1."""
    if truth == 0:
        return "-"
    if missed in (0, truth):
        return "1" if missed == 0 else "0"
    return f"{(truth - missed) * 100_000 // truth / 1e5:.5f}"


def ratio(value, low, high, passes, unit="x"):
    ends = ("" if passes == 0 else " (1 pass)" if passes == 1 else
            f" ({three_digits(low)} to {three_digits(high)})" if passes < FEWEST_FOR_INTERVAL else
            f" [{three_digits(low)}, {three_digits(high)}]")
    return three_digits(value) + unit + ends


def percent(share):
    return f"{100 * share:.0f}"


def wrong(pair):
    """Missed and spurious contacts in one cell."""
    return "0" if pair == [0, 0] else f"{count(pair[0])} + {count(pair[1])}"


def machine(file):
    about = file.head["machine"]
    cpu = re.sub(r"\(R\)|\(TM\)| Processor\b| CPU\b", "", about["cpu"])
    return f"{about['cores']}-core {cpu} with {ISA.get(about['isa'], about['isa'])}"


def took(file):
    minutes, seconds = divmod(round(file.head["seconds"]), 60)
    return f"{minutes} min {seconds} s" if minutes else f"{seconds} s"


def minutes_of(file):
    minutes = max(1, round(file.head["seconds"] / 60))
    return f"{minutes} minute{'' if minutes == 1 else 's'}"


def passes_of(file):
    return max(run["passes"] for run in file.rows("runs") if "status" not in run)


def table(columns, rows):
    """Columns: titles; those of numbers, which stand at the right, end in a colon."""
    lines = ["| " + " | ".join(title.rstrip(":") for title in columns) + " |",
             "| " + " | ".join("--:" if title.endswith(":") else "---" for title in columns) + " |"]
    lines += ["| " + " | ".join(cells) + " |" for cells in rows]
    return "\n".join(lines)


def default_summary(files):
    file = files["default"]
    rows = []
    for detector in file.detectors():
        runs = [run for run in file.rows("runs") if run["detector"] == detector]
        ok = [run for run in runs if "status" not in run]
        if not ok:
            continue
        truth, missed, spurious = (sum(run[kind] or 0 for run in ok)
                                   for kind in ("truth", "missed", "spurious"))
        hovers = [run["hover"] for run in ok if run["hover"] is not None]
        cells = [detector + (f" ({len(runs) - len(ok)} not ok)" if len(ok) < len(runs) else ""),
                 file.same([run["level"] for run in ok], f"levels of {detector}"),
                 recall(truth, missed), str(missed), str(spurious),
                 three_digits(1e3 * max(hovers)) if hovers else "-", ok[0]["question"]]
        for reference in REFERENCES:
            ratios = [run["ratios"][reference] for run in ok if reference in run["ratios"]]
            cells.append(span(ratios) + "x" if ratios else "-")
        rows.append(cells)
    return table(["detector", "level", "recall:", "missed:", "spurious:", "hover mm:", "question",
                  *(f"vs {reference}:" for reference in REFERENCES)], rows)


# The rows of the front page: five answer `triangles`, three something coarser.
HEADLINE = ("fcl-aabb", "libccd-gjk", "embree", "ffd-lazy", "ffd-aabb-sphere2+tri",
            "ffd-aabb-sphere2", "bullet-vf", "bullet-cl")
COARSE = {"cell": "cells", "near": "near", "body": "bodies"}


def mean_ms(file, detector):
    times = [run["ms"] for run in file.rows("runs") if run["detector"] == detector]
    return statistics.mean(times)


def mean_ms_in(file, reference, detector):
    """The reference's mean in the detector's question. Where that is not its own, only their ratios
    are kept."""
    pairs = [(file.run(scene, detector), file.run(scene, reference)) for scene in file.scenes()]
    return statistics.mean(one["ms"] if one["question"] == run["question"] else
                           run["ratios"][reference] * run["ms"] for run, one in pairs)


def headline_name(file, detector):
    level = file.same([run["level"] for run in file.rows("runs") if run["detector"] == detector],
                      f"levels of {detector}")
    return detector, COARSE.get(level)


def headline(files):
    file = files["default"]
    rows = []
    for detector in HEADLINE:
        runs = [file.run(scene, detector) for scene in file.scenes()]
        name, coarse = headline_name(file, detector)
        cells = [f"`{name}`" + (f" ({coarse})" if coarse else ""),
                 *(count(sum(run[kind] for run in runs)) for kind in ("missed", "spurious")),
                 three_digits(mean_ms(file, detector))]
        for reference in ("fcl-aabb", "embree"):
            over = mean_ms_in(file, reference, detector) / mean_ms(file, detector)
            cells.append(three_digits(over) + "x")
        rows.append(cells)
    return table(["detector", "missed:", "spurious:", "ms a frame:", "against FCL:",
                  "against Embree:"], rows)


LAZY_SCENES = ("near-miss", "contact", "small-pair", "pile", "coincident", "scaling-near-miss-16",
               "scaling-contact-16")


def over_full_refit(file, scene):
    return file.run(scene, "full-refit")["ms"] / file.run(scene, "ffd-lazy")["ms"]


def performance_peers(files):
    file = files["performance"]
    rows = []
    for scene in LAZY_SCENES:
        about, run = file.row("scenes", scene=scene), file.run(scene, "ffd-lazy")
        cells = [scene, count(about["triangles"]), count(round(run["truth"] / about["frames"])),
                 three_digits(run["ms"])]
        for peer in ("embree", "full-refit", "fcl-aabb", "fcl-obbrss"):
            if peer == "full-refit":
                cells.append(three_digits(over_full_refit(file, scene)) + "x")
            else:
                cells.append(ratio(*run["speedup"][peer]) if peer in run["speedup"] else "-")
        rows.append(cells)
    return table(["scene", "triangles:", "true pairs a frame:", "ms a frame:", "embree:",
                  "full-refit:", "fcl-aabb:", "fcl-obbrss:"], rows)


GOAL_PARTS = {"playback": "all", "contact_frames": "with contact", "cold": "cold"}


SELF_PEERS = ("full-refit", "embree", "fcl-aabb")
# What is wrong, where it is no pair of triangles.
SELF_COUNTED = {"bullet-cl": " bodies", "bullet-vf": " near pairs", "ffd-aabb": " by cells",
                "ffd-aabb-sphere2": " by cells"}


def self_scenes(files):
    file = files["self"]
    rows = []
    for scene in file.scenes():
        about, run = file.row("scenes", scene=scene), file.run(scene, "ffd-lazy")
        for other in file.rows("runs"):
            exact = other["detector"] in ("aabb-tree", "embree", "full-refit", "ffd-lazy")
            if other["scene"] == scene and exact and other.get("self_wrong") != [0, 0]:
                raise TextError(f"{file.place}: {other['detector']} is wrong in {scene}; the text "
                                "says that it is right in all")
        errors = [f"`{row['detector']}` {wrong(row['self_wrong'])}" +
                  SELF_COUNTED.get(row["detector"], "")
                  for row in file.rows("runs")
                  if row["scene"] == scene and row["self_wrong"] != [0, 0]]
        rows.append([scene, count(about["triangles"]), *map(count, about["true_self"]),
                     three_digits(run["self_ms"]),
                     *(three_digits(file.run(scene, peer)["self_ms"]) for peer in SELF_PEERS),
                     ratio(*run["self_speedup"]), ", ".join(errors) or "-"])
    return table(["scene", "triangles:", "true pairs, no vertex shared:", "one:", "two:",
                  "ffd-lazy, ms a frame:", *(peer + ":" for peer in SELF_PEERS),
                  "ffd-lazy over embree:", "missed + spurious"], rows)


EXACT_BETWEEN = ("ffd-lazy", "full-refit", "swept-aabb", "embree-swept")


def continuous(files):
    """Between frames: the exact detectors are right in every row, or the text is not made."""
    file, rows = files["continuous"], []
    for scene in file.scenes():
        about = file.row("scenes", scene=scene)
        runs = {row["detector"]: row for row in file.rows("runs") if row["scene"] == scene}
        for detector in EXACT_BETWEEN:
            if any(pair != [0, 0] for pair in runs[detector]["step_wrong"].values()):
                raise TextError(f"{file.place}: {detector} is wrong in {scene}; the text says that "
                                "it is right in all")
        lazy, fcl = runs["ffd-lazy"]["step_speedup"], runs.get("fcl-ccd", {})
        rows.append([scene, count(about["triangles"]), count(about["between"]["steps"]),
                     count(about["between"]["pairs"]), count(about["between"]["passing"]),
                     count(runs["embree"]["tunnelled"]),
                     *(ratio(*lazy[peer]) if peer in lazy else "-"
                       for peer in ("embree-swept", "fcl-ccd")),
                     wrong(fcl["step_wrong"]["impact-triangle"]) if fcl else "-"])
    return table(["scene", "triangles:", "steps:", "true pairs of elements:", "passing bodies:",
                  "unseen in frames:", "ffd-lazy over embree-swept:", "over fcl-ccd:",
                  "fcl-ccd, missed + spurious:"], rows)


def continuous_goals(files):
    return goals_of(files["continuous"])


def self_goals(files):
    return goals_of(files["self"])


def performance_goals(files):
    return goals_of(files["performance"])


def goals_of(file):
    rows = []
    for goal in file.rows("goals"):
        unit = {"us": " us"}.get(goal.get("unit"), "x")
        wanted = (f">= {three_digits(goal['at_least'])}" if "at_least" in goal else
                  f"<= {three_digits(goal['at_most'])}") + unit
        if goal["measured"] is None:
            measured, met = "-", f"not measured: {goal['why']}"
        else:
            measured = ratio(goal["measured"], goal.get("low"), goal.get("high"),
                             goal["passes"] if "low" in goal else 0, unit)
            met = "yes" if goal["met"] else "no"
        rows.append([goal["goal"], GOAL_PARTS[goal["part"]], wanted, measured, met])
    return table(["goal", "frames", "wanted:", "measured:", "met"], rows)


def single_lazy(files):
    file = files["single-lazy"]
    rows = []
    for scene in file.scenes():
        runs = [file.run(scene, detector) for detector in file.detectors()]
        rows.append([scene, count(file.row("scenes", scene=scene)["true_pairs"]),
                     *(count(file.same([run[kind] for run in runs], f"{kind} contacts in {scene}"))
                       for kind in ("missed", "spurious"))])
    return table(["scene", "true pairs:", "missed:", "spurious:"], rows)


def single_lazy_times(files):
    file = files["single-lazy-times"]
    rows = []
    for scene in file.scenes():
        runs = [file.run(scene, detector + precision) for detector in ("ffd-lazy", "full-refit")
                for precision in ("", ":precision=single")]
        rows.append([scene, *(three_digits(run["ms"]) for run in runs)])
    return table(["scene", "ffd-lazy:", "in single:", "full-refit:", "in single:"], rows)


FED_VERTICES = tuple(f"{name}:precision=single"
                     for name in ("aabb-tree", "spatial-hash", "sphere-tree"))


def single_historic(files):
    file = files["single-historic"]
    rows = []
    for scene in file.scenes():
        fed = [file.run(scene, detector) for detector in FED_VERTICES]
        other = file.run(scene, "bd-tree:precision=single")
        rows.append([scene, count(file.row("scenes", scene=scene)["true_pairs"]),
                     file.same([wrong([run["missed"], run["spurious"]]) for run in fed],
                               f"wrong contacts in {scene}"),
                     wrong([other["missed"], other["spurious"]]),
                     file.same([wrong(run["rounded"]) for run in fed],
                               f"wrong contacts by levels_rounded in {scene}")])
    return table(["scene", "true pairs:", "missed + spurious: given vertices:", "`bd-tree`:",
                  "given vertices, by `levels_rounded`:"], rows)


def single_historic_times(files):
    file = files["single-historic-times"]
    scenes, rows = file.scenes(), []
    for detector in file.detectors():
        if ":" in detector:
            continue
        runs = [(file.run(scene, detector), file.run(scene, detector + ":precision=single"))
                for scene in scenes]
        rows.append([f"`{detector}`", *(", ".join(three_digits(run["ms"]) for run in pair)
                                        for pair in runs)])
    return table(["detector", *(scene + ":" for scene in scenes)], rows)


def hard_wrong(files):
    file = files["hard"]
    rows = [[row["detector"], row["level"], f"{row['families_right']} of {row['families']}",
             f"{row['right']} of {row['cases'] + row['refused_cases']}", count(row["missed"]),
             count(row["spurious"]),
             str(row["refused"]) + (f" ({row['errors']} errors)" if row["errors"] else "")]
            for row in file.rows("detectors") if row["families_right"] < row["families"]]
    return table(["detector", "level", "families right:", "cases right:", "missed:", "spurious:",
                  "families refused:"], rows)


# What each library does where nobody says otherwise, by its own headers.
LIBRARY_DEFAULTS = {("fcl", "refit"): "bottom-up", ("fcl", "split"): "mean",
                    ("embree", "build"): "medium", ("bullet", "scale"): "1", ("bullet", "k"): "none",
                    ("libccd", "scale"): "1", ("libccd", "iterations"): "no limit",
                    ("libccd", "tolerance"): "1e-4", ("libccd", "epa_tolerance"): "1e-4"}


def settings(files):
    """One row a setting of a detector; what is `ours` is the detector's own default."""
    timed, hard, drawn = (files[name] for name in ("settings", "settings-hard", "settings-drawn"))
    in_drawn = {row["detector"] for row in drawn.rows("drawn")}
    ok = {(run["scene"], run["detector"]): run for run in timed.rows("runs") if "status" not in run}

    def sums(rows):
        return [sum(row[kind] or 0 for row in rows) for kind in ("missed", "spurious")]

    def cells(detector, base):
        runs = [(ok[scene, detector], ok[scene, base]) for scene in timed.scenes()
                if (scene, detector) in ok and (scene, base) in ok]
        ratios = [run["ms"] / own["ms"] for run, own in runs]
        depths = [run["depth_error"] for run, _ in runs if run["depth_error"] is not None]
        hard_rows = [row for row in hard.rows("detectors") if row["detector"] == detector]
        drawn_sums = detector in in_drawn and [
            sum(int(drawn_row(drawn, "Missed and spurious", kind, detector=detector)[column])
                for kind in DRAWN_KINDS) for column in ("missed", "spurious")]
        return [statistics.geometric_mean(ratios), min(ratios), max(ratios),
                sums([run for run, _ in runs]), drawn_sums, sums(hard_rows),
                max(depths, default=None)]

    def row(name, option, default, value, found):
        mean, low, high, *counts, depth = found
        time = "1" if value.startswith("**") else f"{mean:.2f} ({low:.2f} to {high:.2f})"
        return [name, option, default, value, time,
                *(wrong(count) if count else "-" for count in counts),
                "-" if depth is None else three_digits(1e3 * depth)]

    rows, shown = [], set()
    for detector in timed.detectors():
        head, _, words = detector.partition(":")
        options = dict(word.split("=") for word in words.split(",") if word)
        base = head + (":pieces=boxes" if options.pop("pieces", "") == "boxes" else "")
        for option, value in options.items():
            default = LIBRARY_DEFAULTS[(head.split("-")[0], option)]
            if (base, option) not in shown:
                shown.add((base, option))
                own = next(run for run in timed.rows("runs") if run["detector"] == base)
                ours = own["options"][option]
                if option == "scale" and ours == "0":
                    ours = "automatic"
                rows.append(row(f"`{base}`", f"`{option}`", default, f"**{ours}**", cells(base, base)))
            rows.append(row("", "", "", value, cells(detector, base)))
    return table(["detector", "setting", "library's default", "value", "time over ours:",
                  "wrong:", "wrong, drawn:", "wrong, hard:", "depth off by, mm:"], rows)


def scale_ranges(files):
    """One row a detector: of sizes and of distances from the origin, with the nearest wrong cases."""
    def span(row):
        if row is None:
            return "-"
        if "from" not in row:
            return "nowhere"
        tried = row["from"] == row["least"] and row["to"] == row["most"]
        return f"{row['from']} to {row['to']}" + (" (all)" if tried else "")

    found = {(row["detector"], row["by"]): row for row in files["ranges"]}
    rows = []
    for name in dict.fromkeys(name for name, _ in found):
        both = [found.get((name, by)) for by in ("size", "distance")]
        known = [row for row in both if row]
        wrong = [row[side] for row in known for side in ("wrong_below", "wrong_above") if side in row]
        rows.append([f"`{name}`", known[0]["level"], *map(span, both),
                     f"{count(sum(row['right'] for row in known))} of "
                     f"{count(sum(row['cases'] for row in known))}",
                     "; ".join(wrong) or "-"])
    return table(["detector", "level", "right for edges of, m", "right at, edges from the origin",
                  "cases right:", "nearest wrong cases"], rows)


def paper_overview(files):
    rows = []
    for row in files["reproduce"].rows("paper"):
        value, low, high = row["test"]
        hover = row["hover_at_rest"] or {}
        rows.append([row["scene"], f"{value:.2f}x [{low:.2f}, {high:.2f}]",
                     percent(value / row["paper_test"]) + " %", f"{row['steps_per_second']:.0f}",
                     *(three_digits(1e3 * hover[name]) if name in hover else "-"
                       for name in ("ffd-grid", "ffd-aabb-sphere2"))])
    return table(["scene", "collision test, one level of spheres over two, safe bounds:",
                  "share of the paper's ratio:", "whole steps per second, `ffd-aabb-sphere2`:",
                  "at rest, mm apart: `ffd-grid`:", "`ffd-aabb-sphere2`:"], rows)


# With contact first: where a detector has to do something.
DRAWN_KINDS = ("with contact", "without contact")
STEP_KINDS = ("with impacts", "without impacts")
STEP_SPEED = ("ffd-lazy", "full-refit", "swept-aabb")
STEP_PEERS = ("embree-swept", "fcl-ccd")
DRAWN_SPEED = ("ffd-lazy", "full-refit", "ffd-aabb-sphere2+tri")
DRAWN_PEERS = {"fcl-aabb": "FCL", "embree": "Embree"}


def drawn_row(file, table, kind, **wanted):
    found = [row for row in file.rows("drawn")
             if re.fullmatch(rf"{table} in \d+ scenes? {kind}", row["table"]) and
             all(row[k] == v for k, v in wanted.items())]
    if len(found) != 1:
        raise TextError(f"{file.place} has {len(found)} rows \"{table}\" {kind} of "
                        f"{', '.join(wanted.values())}; one is needed")
    return found[0]


def drawn_speedups(file, detector, kinds=DRAWN_KINDS, peers=tuple(DRAWN_PEERS)):
    """(kind of scenes, reference, row) of each of its ratios."""
    return [(kind, over, drawn_row(file, "Speed-ups", kind, detector=detector, over=over))
            for kind in kinds for over in peers]


def drawn_headline(files):
    """One row a detector: median, 10th percentile and worst in a cell."""
    columns = ["detector", *(f"{peer}, {kind}:" for kind in DRAWN_KINDS
                             for peer in DRAWN_PEERS.values())]
    rows = [[f"`{detector}`", *(f"{row['median']}, {row['10th percentile']}, {row['worst']}"
                                for _, _, row in drawn_speedups(files["drawn-times"], detector))]
            for detector in DRAWN_SPEED]
    return table(columns, rows)


def drawn_speed(files):
    rows = [[f"`{detector}`", kind, DRAWN_PEERS[over], row["median"], row["10th percentile"],
             row["worst"], f"{row['faster in']} of {row['scenes']}"]
            for detector in DRAWN_SPEED
            for kind, over, row in drawn_speedups(files["drawn-times"], detector)]
    return table(["detector", "scenes", "over", "median:", "10th percentile:", "worst:",
                  "faster in:"], rows)


def drawn_decides(files):
    """The three strongest rank correlations of each ratio with what was drawn."""
    file, rows = files["drawn-times"], []
    for row in file.rows("drawn"):
        if row["table"] == "Speed-ups against the parameters of the scenes" and \
                row["detector"] in DRAWN_SPEED and row["over"] in DRAWN_PEERS:
            strongest = row["rank correlations, strongest first"].split(", ")[:3]
            rows.append([f"`{row['detector']}`", DRAWN_PEERS[row["over"]], ", ".join(strongest),
                         row["medians for the strongest"]])
    return table(["detector", "over", "rank correlations", "medians for the strongest"], rows)


def drawn_accuracy(files):
    file, rows = files["drawn"], []
    for detector in dict.fromkeys(row["detector"] for row in file.rows("drawn")):
        touching, apart = (drawn_row(file, "Missed and spurious", kind, detector=detector)
                           for kind in DRAWN_KINDS)
        rows.append([f"`{detector}`", touching["level"], touching["scenes"], touching["missed"],
                     touching["recall"], touching["spurious"], touching["scenes wrong"],
                     apart["scenes"], apart["spurious"], apart["scenes wrong"]])
    return table(["detector", "level", "with contact:", "missed:", "recall:", "spurious:",
                  "scenes wrong:", "without contact:", "spurious:", "scenes wrong:"], rows)


def drawn_step_speed(files):
    file = files["drawn-steps-times"]
    rows = [[f"`{detector}`", kind, f"`{over}`", row["median"], row["10th percentile"],
             row["worst"], f"{row['faster in']} of {row['scenes']}"]
            for detector in STEP_SPEED
            for kind, over, row in drawn_speedups(file, detector, STEP_KINDS, STEP_PEERS)]
    return table(["detector", "scenes", "over", "median:", "10th percentile:", "worst:",
                  "faster in:"], rows)


def drawn_steps(files):
    """Errors at each level over all drawn steps, as missed / spurious."""
    file, rows = files["drawn-steps"], []
    levels = ("bodies", "triangles", "vertex-face", "edge-edge", "self vf", "self ee")

    def summed_errors(cells):
        pairs = [[int(n) for n in cell.split(" / ")] for cell in cells if cell != "-"]
        return f"{sum(p[0] for p in pairs)} / {sum(p[1] for p in pairs)}" if pairs else "-"
    for detector in dict.fromkeys(row["detector"] for row in file.rows("drawn")):
        kinds = [drawn_row(file, "Missed and spurious", kind, detector=detector)
                 for kind in STEP_KINDS]
        rows.append([f"`{detector}`", *(str(sum(int(kind[column]) for kind in kinds))
                                        for column in ("scenes", "scenes wrong")),
                     *(summed_errors([kind[level] for kind in kinds]) for level in levels),
                     str(sum(int(kind["tunnelled"]) for kind in kinds))])
    return table(["detector", "scenes:", "wrong:", *(f"{level}:" for level in levels),
                  "tunnelled:"], rows)


TABLES = {"headline": headline, "default": default_summary, "performance": performance_peers,
          "goals": performance_goals, "drawn": drawn_headline, "drawn-times": drawn_speed,
          "drawn-decides": drawn_decides, "self": self_scenes, "self-goals": self_goals,
          "continuous": continuous, "continuous-goals": continuous_goals,
          "drawn-accuracy": drawn_accuracy, "drawn-steps": drawn_steps,
          "drawn-steps-times": drawn_step_speed, "single-lazy": single_lazy,
          "single-lazy-times": single_lazy_times, "single-historic": single_historic,
          "single-historic-times": single_historic_times, "hard": hard_wrong, "settings": settings,
          "ranges": scale_ranges,
          "reproduce": paper_overview}


def lost_in(file, detector, stage):
    return sum(run["lost"].get(stage, 0) for run in file.rows("runs")
               if run["detector"] == detector)


def summed(file, detector, kind):
    runs = [run for run in file.rows("runs") if run["detector"] == detector]
    if not runs:
        raise TextError(f"{file.place} has no run of {detector}")
    return sum(file.run(run["scene"], detector)[kind] for run in runs)


def all_ok(file):
    return [file.run(run["scene"], run["detector"]) for run in file.rows("runs")]


def figures(files):
    """By name, each a function: what a page does not quote need not exist."""
    default, performance, hard = files["default"], files["performance"], files["hard"]
    lazy, hard_single, paper = files["single-lazy"], files["single-hard"], files["reproduce"]
    drawn, drawn_times = files["drawn"].row("drawn_sums"), files["drawn-times"].row("drawn_sums")
    steps = files["drawn-steps"].row("step_sums")
    step_times = files["drawn-steps-times"].row("step_sums")
    historic_times, lazy_times, small = (files["single-historic-times"], files["single-lazy-times"],
                                         files["paper-64"])

    def faster_than(reference):
        """In how many drawn scenes ffd-lazy is."""
        return count(sum(int(row["faster in"])
                         for _, over, row in drawn_speedups(files["drawn-times"], "ffd-lazy")
                         if over == reference))

    def pairs_of_drawn():
        """With what the front page says about all of them."""
        for detector in ("fcl-aabb", "embree", "full-refit", "ffd-lazy", "ffd-aabb-sphere2+tri"):
            for kind in DRAWN_KINDS:
                row = drawn_row(files["drawn"], "Missed and spurious", kind, detector=detector)
                if (row["missed"], row["spurious"], row["no answer"]) != ("0", "0", "-"):
                    raise TextError(f"{files['drawn'].place}: {detector} is wrong in drawn scenes "
                                    f"{kind}; the text says that it is right in all")
        return count(drawn["true_pairs"])

    def of_fed(field):
        return hard_single.same([hard_single.row("detectors", detector=detector)[field]
                                 for detector in FED_VERTICES], f"{field} of those fed vertices")

    def of_nodes(field):
        detectors = [f"{name}:precision=single" for name in ("bd-tree", "ffd-lazy")]
        return hard_single.same([hard_single.row("detectors", detector=detector)[field]
                                 for detector in detectors], f"{field} of those fed nodes")

    def in_pile(field):
        return lazy.same([lazy.run("pile", detector)[field] for detector in lazy.detectors()],
                         f"{field} in pile")

    def spurious_distance():
        if in_pile("spurious") != 1 or any(run["missed_bodies"] or run["spurious_bodies"]
                                           for run in all_ok(lazy)):
            raise TextError(f"{lazy.place}: the text says that one pair is spurious in pile and that "
                            "all pairs of bodies are right")
        return f"{in_pile('spurious_distance'):.1e}".replace("e-0", "e-")

    def gains():
        """Of full-refit in single precision, by scene."""
        return [1 - lazy_times.run(scene, "full-refit:precision=single")["ms"] /
                lazy_times.run(scene, "full-refit")["ms"] for scene in lazy_times.scenes()]

    def rounded_truth():
        if of_fed("rounded_wrong") != 0:
            raise TextError(f"{hard_single.place}: contacts are wrong by levels_rounded; the text "
                            "says that none is")
        return of_fed("rounded_truth")

    def pairs_that_all_find():
        for run in performance.rows("runs"):
            shown = run["detector"] in ("ffd-lazy", "full-refit", *REFERENCES) and "status" not in run
            if shown and (run["spurious"] or run["missed"]):
                raise TextError(f"{performance.place}: {run['detector']} is wrong in {run['scene']}; "
                                "the text says that none is")
        return sum(scene["true_pairs"] for scene in performance.rows("scenes"))

    return {
        "default.detectors": lambda: str(len(default.detectors())),
        "default.scenes": lambda: str(len(default.rows("scenes"))),
        "default.frames": lambda: str(default.same([s["frames"] for s in default.rows("scenes")],
                                                   "frames")),
        "default.triangles": lambda: span([s["triangles"] for s in default.rows("scenes")],
                                          lambda value: count(round(value, -2))),
        "default.true_pairs": lambda: count(sum(s["true_pairs"] for s in default.rows("scenes"))),
        "default.passes": lambda: str(passes_of(default)),
        "default.machine": lambda: machine(default),
        "default.took": lambda: took(default),
        "default.ffd-aabb.missed": lambda: count(summed(default, "ffd-aabb", "missed")),
        "default.ffd-aabb.lost.hash": lambda: count(lost_in(default, "ffd-aabb", "hash")),
        "default.ffd-aabb.lost.node-plane": lambda: count(
            lost_in(default, "ffd-aabb", "node-plane")),
        "performance.machine": lambda: machine(performance),
        "performance.minutes": lambda: minutes_of(performance),
        "performance.passes": lambda: str(passes_of(performance)),
        "performance.true_pairs": lambda: count(pairs_that_all_find()),
        "continuous.machine": lambda: machine(files["continuous"]),
        "continuous.took": lambda: took(files["continuous"]),
        "continuous.pairs": lambda: count(sum(
            scene["between"]["pairs"] for scene in files["continuous"].rows("scenes"))),
        "self.machine": lambda: machine(files["self"]),
        "self.took": lambda: took(files["self"]),
        "drawn.scenes": lambda: count(drawn["scenes"]),
        "drawn.with_contact": lambda: count(drawn["with_contact"]),
        "drawn.true_pairs": pairs_of_drawn,
        "drawn.frames": lambda: count(drawn["frames"]),
        "drawn.seed": lambda: str(drawn["seed"]),
        "drawn.machine": lambda: machine(files["drawn"]),
        "drawn.minutes": lambda: minutes_of(files["drawn"]),
        **{f"drawn-steps.{name}": lambda name=name: count(steps[name])
           for name in ("scenes", "steps", "with_impacts", "with_self", "passing")},
        **{f"drawn-steps.true.{level}": lambda level=level: count(steps["true"][level])
           for level in steps["true"]},
        "drawn-steps-times.scenes": lambda: count(step_times["scenes"]),
        "drawn-steps-times.with_impacts": lambda: count(step_times["with_impacts"]),
        "drawn-steps-times.steps": lambda: count(step_times["steps"]),
        "drawn-steps-times.machine": lambda: machine(files["drawn-steps-times"]),
        "drawn-steps-times.minutes": lambda: minutes_of(files["drawn-steps-times"]),
        "drawn-steps.seed": lambda: str(steps["seed"]),
        "drawn-steps.machine": lambda: machine(files["drawn-steps"]),
        "drawn-steps.minutes": lambda: minutes_of(files["drawn-steps"]),
        "settings-drawn.scenes": lambda: count(files["settings-drawn"].row("drawn_sums")["scenes"]),
        "drawn-times.scenes": lambda: count(drawn_times["scenes"]),
        "drawn-times.with_contact": lambda: count(drawn_times["with_contact"]),
        "drawn-times.faster.fcl": lambda: faster_than("fcl-aabb"),
        "drawn-times.faster.embree": lambda: faster_than("embree"),
        "drawn-times.machine": lambda: machine(files["drawn-times"]),
        "drawn-times.minutes": lambda: minutes_of(files["drawn-times"]),
        "hard.families": lambda: str(hard.row("sums")["families"]),
        "hard.cases": lambda: count(hard.row("sums")["cases"]),
        "hard.detectors": lambda: str(len({row["detector"] for row in hard.rows("detectors")})),
        "hard.known_defects": lambda: count(hard.row("sums")["known_defects"]),
        "hard.known_refusals": lambda: count(hard.row("sums")["known_refusals"]),
        "hard.readings": lambda: count(hard.row("sums")["readings"]),
        "pile.spurious_distance": spurious_distance,
        "single-hard.families": lambda: str(hard_single.same(
            [row["families"] for row in hard_single.rows("detectors")], "families")),
        "single-hard.refused": lambda: str(hard_single.same(
            [row["refused"] for row in hard_single.rows("detectors")], "refused families")),
        "single-hard.cases": lambda: str(of_fed("cases")),
        "single-hard.fed.right": lambda: str(of_fed("right")),
        "single-hard.nodes.right": lambda: str(of_nodes("right")),
        "single-hard.rounded.truth": lambda: count(rounded_truth()),
        "single-lazy.gain": lambda: span(gains(), percent),
        "single-lazy.passes": lambda: str(passes_of(lazy_times)),
        "single-lazy.machine": lambda: machine(lazy_times),
        "single-historic.passes": lambda: str(passes_of(historic_times)),
        "single-historic.machine": lambda: machine(historic_times),
        "reproduce.minutes": lambda: minutes_of(paper),
        "reproduce.test": lambda: f"{paper.row('paper_sums')['test']:.2f}x",
        "reproduce.steps": lambda: f"{paper.row('paper_sums')['steps']:.2f}x",
        "reproduce.figures": lambda: str(paper.row("paper_sums")["figures"]),
        "reproduce.contradict": lambda: str(paper.row("paper_sums")["contradict"]),
        "reproduce.left_to_hash": lambda: span([r["left_to_hash"] for r in paper.rows("paper")],
                                               percent),
        "reproduce.test_share": lambda: span([r["test_share"] for r in paper.rows("paper")],
                                             percent),
        "paper-64.detectors": lambda: str(len(small.detectors())),
        "paper-64.rows": lambda: str(len(all_ok(small))),
        "paper-64.steps": lambda: str(small.same([s["steps"] for s in small.rows("scenes")],
                                                 "steps")),
        "paper-64.took": lambda: str(round(small.head["seconds"])),
        "paper-64.memory": lambda: span([run["memory_bytes"] / 1e6 for run in all_ok(small)],
                                        lambda value: f"{value:.1f}"),
    }
