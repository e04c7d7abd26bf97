"""The verdict on a mutant of the whole product: users' commands of the patched contactcheck.

The unchanged program runs every command first: it must pass, and what it writes is what the patched
program's is compared with. A command catches a mutant by its own verdict where it has one (gate,
defects, check.py, exit codes), by an independent recomputation (check_results.py), or, last, because
something differs that the patch had no business to change. The unit tests of the changed folders are
tried when all commands pass.

The patched program is linked beside a build folder (mutant_build.py), which stays as it is.
"""

import copy
import functools
import json
import os
import pathlib
import re
import subprocess
import tempfile
import threading
import xml.etree.ElementTree

import check_results
from mutant_build import (CAUGHT, DOES_NOT_COMPILE, QUICK_FLAGS, ROOT, SURVIVED, Build, Failure,
                          Mutant, build_program)
from mutant_verdict import Verdict

SECONDS = 600
POLICIES = ROOT / "fixtures" / "policies"
DEFECTS = ["fixtures/hard/known-defects.json"]
# Data that say what a command demands.
FIXTURES = {"run": ["fixtures/policies/default.json", "fixtures/policies/ci.json",
                    "fixtures/policies/unchanged.json", "fixtures/baselines/ci.json"],
            "performance": ["fixtures/policies/unchanged.json"],
            "simulated": ["fixtures/policies/unchanged.json"],
            "timing": ["fixtures/policies/default.json"], "hard": DEFECTS}
KEPT = ["bunny-touch", "far-apart", "--frames", "12", "--processes", "5"]
KEPT_DETECTORS = ["fcl-aabb", "embree", "full-refit", "ffd-lazy", "ffd-aabb", "libccd-gjk"]
# What two runs of one program need not have in common; and how much a stage or a tree looked at: one
# that looks at less has lost nothing, unless its `missed` says so.
OF_ITS_RUN = {"in", "out", "visited", "counters",
              "command", "machine", "timing", "time_ms", "time_ms_other_questions", "speedup",
              "memory_bytes", "prepared_bytes", "frame_ms", "recording", "libraries"}


class Found(Exception):
    """What catches the mutant, in one line."""


def first_line(text):
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    return lines[0] if lines else "nothing is said"


class Context:
    """A program, the unchanged program's work where this is not it, and a folder."""

    def __init__(self, program, folder, workers, reference=None):
        self.program, self.folder, self.workers, self.reference = program, folder, workers, reference
        folder.mkdir(parents=True, exist_ok=True)

    def path(self, name):
        return self.folder / name

    def of_reference(self, name):
        """What the unchanged program wrote, or this one if it is the unchanged one."""
        return (self.reference or self).path(name)

    def call(self, *words, program=None, codes=(0,)):
        """Standard output."""
        command = [str(word) for word in (program or self.program, *words)]
        try:
            done = self.workers.run(command, cwd=self.folder, timeout=SECONDS,
                                    env={**os.environ, "NO_COLOR": "1"})
        except subprocess.TimeoutExpired as error:
            raise Found(f"{' '.join(command[1:4])}: does not end within {SECONDS} s") from error
        if done.returncode not in codes:
            raise Found(f"{' '.join(command[1:4])}: exit code {done.returncode}: "
                        f"{first_line(red_line(done.stdout) or done.stderr or done.stdout)}")
        return done.stdout

    def run(self, name, *words, codes=(0,)):
        self.call("run", *words, "--quiet", "--out", name, codes=codes)

    def recompute(self, name, report=True):
        try:
            results = json.loads(self.path(name).joinpath("results.json").read_text("utf-8"))
            found = list(check_results.wrong_results(results))
            if report:
                found += check_results.wrong_report(
                    results, self.path(name).joinpath("report.md").read_text("utf-8"))
        except (OSError, ValueError, KeyError, TypeError, ZeroDivisionError) as error:
            raise Found(f"{name}: cannot be recomputed: {error!r}") from error
        if found:
            raise Found(f"recomputed: {found[0]}")

    def same_bytes(self, *names):
        for name in names:
            if self.path(name).read_bytes() != self.of_reference(name).read_bytes():
                mine, its = (file.read_text("utf-8", "replace").splitlines()
                             for file in (self.path(name), self.of_reference(name)))
                line = next((a for a, b in zip(mine, its) if a != b), "its end")
                raise Found(f"{name} differs from that of the unchanged program: {line[:200]}")

    def same_results(self, name):
        """But for times, memory and what else belongs to one run."""
        mine, its = (json.loads((folder / name / "results.json").read_text("utf-8"))
                     for folder in (self.folder, (self.reference or self).folder))
        place = difference(mine, its)
        if place:
            raise Found(f"{name}: differs from the unchanged program's results: {place}")


def red_line(text):
    """What a gate is red for: the rule, and the first place."""
    lines = [line.strip() for line in text.splitlines()]
    for at, line in enumerate(lines):
        if line.startswith("FAIL  "):
            places = [other for other in lines[at + 1:] if not other.startswith("(")]
            return f"{line[len('FAIL  '):]}: {places[0] if places else ''}"
    return ""


def difference(mine, its, place=""):
    if isinstance(mine, dict) and isinstance(its, dict):
        name = mine.get("detector") or mine.get("id") or ""
        for key in [*its, *(key for key in mine if key not in its)]:
            if key in OF_ITS_RUN:
                continue
            if key not in mine or key not in its:
                return f"{place} {name} {key}: only in one of them".strip()
            found = difference(mine[key], its[key], " ".join(f"{place} {name} {key}".split()))
            if found:
                return found
        return ""
    if isinstance(mine, list) and isinstance(its, list) and len(mine) == len(its):
        for a, b in zip(mine, its):
            found = difference(a, b, place)
            if found:
                return found
        return ""
    return "" if mine == its else f"{place}: {str(mine)[:80]}, not {str(its)[:80]}"


def untimed(name, context):
    """The name of a policy of another's rules on accuracy: a run without timing cannot be judged by
    the others."""
    policy = json.loads((POLICIES / f"{name}.json").read_text("utf-8"))
    policy["rules"] = [rule for rule in policy["rules"]
                       if rule["measure"] not in ("speedup", "slowdown")]
    context.path(f"{name}.json").write_text(json.dumps(policy), encoding="utf-8")
    return f"{name}.json"


# --- the commands; each raises Found

def on_kept(context):
    """The results that the unchanged program made are in its folder: kept/ and kept-hard/."""
    if context.reference is None and not context.path("kept").is_dir():
        context.run("kept", *KEPT, *(word for d in KEPT_DETECTORS for word in ("--detector", d)))
        context.run("kept-hard", "hard", "--no-timing")
    return (context.of_reference("kept").joinpath("results.json"),
            context.of_reference("kept-hard").joinpath("results.json"))


def report(context):
    kept, hard = on_kept(context)
    context.call("report", kept, "--out", "report")
    context.path("report").joinpath("results.json").write_bytes(kept.read_bytes())
    context.recompute("report")
    context.call("report", hard, "--out", "report-hard", "--format", "md,csv")
    context.same_bytes("report/report.md", "report/report.csv", "report/plots/speed_error.svg",
                       "report-hard/report.md", "report-hard/report.csv", "report/report.html")


PROBE = {"schema": "contactcheck-policy/1", "id": "probe", "title": "probe",
         "cannot_judge_at_most": 0, "rules": [
             {"rule": "answers", "scenes": ["*"], "detectors": ["*"], "measure": "status",
              "equals": "ok"},
             {"rule": "missed", "scenes": ["*"], "detectors": ["ffd-lazy"], "measure": "missed",
              "level": "triangle", "at_most": 0},
             {"rule": "spurious", "scenes": ["*"], "detectors": ["ffd-lazy"], "measure": "spurious",
              "level": "triangle", "at_most": 0},
             {"rule": "recall", "scenes": ["bunny-touch"], "detectors": ["ffd-aabb"],
              "measure": "recall", "level": "cell", "at_least": 0.8},
             {"rule": "truth", "scenes": ["*"], "detectors": ["ffd-lazy"],
              "measure": "contact_hash", "equals": "truth"},
             {"rule": "unchanged", "scenes": ["*"], "detectors": ["*"], "measure": "contact_hash",
              "unchanged": True},
             {"rule": "hover", "scenes": ["bunny-touch"], "detectors": ["ffd-lazy"],
              "measure": "hover_gap_max", "at_most": 0.00001},
             {"rule": "late", "scenes": ["bunny-touch"], "detectors": ["ffd-lazy"],
              "measure": "late_frames", "at_most": 0},
             {"rule": "stages", "scenes": ["*"], "detectors": ["ffd-lazy"],
              "measure": "stage_missed", "at_most": 0},
             {"rule": "memory", "scenes": ["*"], "detectors": ["ffd-lazy"],
              "measure": "memory_bytes", "at_most": 8000000},
             {"rule": "speedup", "scenes": ["bunny-touch"], "detectors": ["ffd-lazy"],
              "measure": "speedup", "question": "triangles", "reference": "fcl-aabb",
              "at_least": 4, "floor_us": 20},
             {"rule": "slowdown", "scenes": ["bunny-touch"], "detectors": ["ffd-lazy"],
              "measure": "slowdown", "question": "triangles", "reference": "fcl-aabb",
              "at_most": 1.5, "floor_us": 20}]}
BASELINE_RULE = "everything that the baseline has"


def speedup_of(ratio, low, high):
    return {"ratio": ratio, "low": low, "high": high}


def doctored_results(kept):
    """(name, results, the rules that must be red): by what is in the results, not by any run."""
    def lazy(results):
        return next(run for run in results["runs"]
                    if (run["scene"], run["detector"]) == ("bunny-touch", "ffd-lazy"))

    def count(run, level, **changes):
        c = run["levels"][level]
        c.update(changes)
        c["recall"] = c["hit"] / c["truth"]
        c["spurious_rate"] = c["spurious"] / c["reported"] if c["reported"] else None

    def timed(run, frame, ratio, low, high):
        """As if each frame had taken so long."""
        times = run["time_ms"]
        factor = frame / times["playback"]["frame"]
        for regime in ("playback", "cold"):
            times[regime] = {key: value if value is None else value * factor
                             for key, value in times[regime].items()}
        times["pass_ms"] = [value * factor for value in times["pass_ms"]]
        run["speedup"]["triangles"]["fcl-aabb"]["playback"] = speedup_of(ratio, low, high)

    def case(name, red, edit):
        results = copy.deepcopy(kept)
        edit(results, lazy(results))
        return name, results, set(red)

    def one_missed(_, run):
        c = run["levels"]["triangle"]
        count(run, "triangle", missed=1, hit=c["truth"] - 1, reported=c["truth"] - 1)

    def one_spurious(_, run):
        count(run, "triangle", spurious=1, reported=run["levels"]["triangle"]["truth"] + 1)

    def fails(_, run):
        run.update(status="error", message="query died with signal 11")

    def lose(results, _):
        # Of the detectors that no rule names: a rule that matches no row is red by itself.
        results["runs"] = [run for run in results["runs"]
                           if (run["scene"], run["detector"]) != ("bunny-touch", "libccd-gjk")]

    def lose_scene(results, _):
        results["runs"] = [run for run in results["runs"] if run["scene"] != "far-apart"]
        results["scenes"] = [scene for scene in results["scenes"] if scene["id"] != "far-apart"]

    def paper_loses(results, _):
        run = next(run for run in results["runs"]
                   if (run["scene"], run["detector"]) == ("bunny-touch", "ffd-aabb"))
        truth = run["levels"]["cell"]["truth"]
        hit = truth * 79 // 100
        count(run, "cell", missed=truth - hit, hit=hit)

    edits = [
        ("as-it-is", [], lambda results, run: timed(run, 0.01, 20, 18, 22)),
        ("missed", ["missed"], one_missed), ("spurious", ["spurious"], one_spurious),
        ("recall", ["recall"], paper_loses),
        ("hash", ["truth", "unchanged"],
         lambda _, run: run.update(contact_hash="0x0123456789abcdef")),
        ("hover", ["hover"], lambda _, run: run["geometry"].update(hover_gap_max=2e-5)),
        ("hover-within", [], lambda _, run: run["geometry"].update(hover_gap_max=9e-6)),
        ("late", ["late"], lambda _, run: run["geometry"].update(late_frames=1)),
        ("stages", ["stages"], lambda _, run: run["stages"][0].update(missed=1)),
        ("memory", ["memory"], lambda _, run: run.update(memory_bytes=8000001)),
        ("memory-within", [], lambda _, run: run.update(memory_bytes=8000000)),
        ("slow", ["speedup", "slowdown"], lambda _, run: timed(run, 0.2, 2, 1.9, 2.1)),
        ("slower", ["slowdown"], lambda _, run: timed(run, 0.2, 8, 7.9, 8.1)),
        ("noisy", [], lambda _, run: timed(run, 0.2, 5, 2.5, 50)),
        ("below-the-floor", [], lambda _, run: timed(run, 0.02, 3.9, 3.8, 3.95)),
        ("lost-row", [BASELINE_RULE], lose),
        ("lost-only-row", [BASELINE_RULE, "hover", "late", "speedup", "slowdown"],
         lambda results, run: results["runs"].remove(run)),
        ("lost-scene", [BASELINE_RULE], lose_scene)]
    for name, red, edit in edits:
        yield case(name, red, edit)
    # Rules on a row without an answer fail, too, by their `error`, which is "fail" unless said.
    yield case("crash", {"answers", BASELINE_RULE, "missed", "spurious", "truth", "unchanged",
                         "hover", "late", "stages", "memory", "speedup", "slowdown"}, fails)


def gate(context):
    kept = json.loads(on_kept(context)[0].read_text("utf-8"))
    run = next(run for run in kept["runs"]
               if (run["scene"], run["detector"]) == ("bunny-touch", "ffd-lazy"))
    # A baseline with times that do not depend on the machine's mood.
    run["speedup"]["triangles"]["fcl-aabb"]["playback"] = speedup_of(20, 18, 22)
    context.path("probe.json").write_text(json.dumps(PROBE), encoding="utf-8")
    context.path("base.json").write_text(json.dumps(kept), encoding="utf-8")
    context.call("accept", "base.json", "--as", "baseline.json")
    context.same_bytes("baseline.json")
    for name, results, red in doctored_results(kept):
        context.path(f"{name}.json").write_text(json.dumps(results), encoding="utf-8")
        said = context.call("gate", f"{name}.json", "--policy", "probe.json", "--baseline",
                            "baseline.json", "--junit", f"{name}.xml", codes=(0, 1))
        found = {case.get("classname")
                 for case in xml.etree.ElementTree.parse(context.path(f"{name}.xml")).iter("testcase")
                 if case.find("failure") is not None}
        if found != red or ("gate: red" in said) != bool(red):
            raise Found(f"gate over doctored results \"{name}\": red for "
                        f"{', '.join(sorted(found)) or 'nothing'}, and must be for "
                        f"{', '.join(sorted(red)) or 'nothing'}")
        context.path(f"{name}.txt").write_text(said, encoding="utf-8")
        context.same_bytes(f"{name}.txt", f"{name}.xml")


def diff(context):
    kept = on_kept(context)[0]
    for name, results, _ in doctored_results(json.loads(kept.read_text("utf-8"))):
        context.path(f"{name}.json").write_text(json.dumps(results), encoding="utf-8")
    context.path("kept.json").write_bytes(kept.read_bytes())
    worse = context.call("diff", "kept.json", "missed.json")
    if "Worse (1)\n  bunny-touch  ffd-lazy" not in worse:
        raise Found(f"diff does not name the detector that misses more: {first_line(worse)}")
    for name in ("kept", "missed", "spurious", "hash", "hover", "slow", "lost-row", "lost-scene", "crash"):
        for pair in (("kept", name), (name, "kept")):
            text = context.call("diff", *(f"{part}.json" for part in pair))
            context.path("-".join(pair) + ".diff").write_text(text, encoding="utf-8")
            context.same_bytes("-".join(pair) + ".diff")


def ab(context):
    """The unchanged program against itself, and against one that answers otherwise."""
    base = (context.reference or context).program
    scene = ["bunny-touch", "--frames", "12", "--rounds", "5", "--detector", "full-refit",
             "--slower-than", "3", "--floor-us", "500", "--quiet"]
    context.call("ab", base, context.program, *scene, "--out", "ab", program=base)
    context.call("ab", base, base, *scene, "--out", "ab")
    said = context.call("ab", base, context.of_reference("wrong"), *scene, "--out", "ab", codes=(1,))
    if "full-refit" not in said:
        raise Found(f"ab does not name the detector that answers otherwise: {first_line(said)}")


def pairs(context):
    context.run("pairs", "--pairs", "20000", "--no-timing", "--detector", "ffd-lazy", "--detector",
                "embree", "--detector", "fcl-aabb", "--detector", "ffd-aabb-sphere2+tri")
    scene = json.loads(context.path("pairs/results.json").read_text("utf-8"))["scenes"][0]
    if scene["pairs"]["rational"] != {"checked": 20000, "oracle_wrong": 0}:
        raise Found(f"oracle against rational arithmetic: {scene['pairs']['rational']}")
    context.recompute("pairs")
    context.same_results("pairs")


def export(context):
    """Proofs of a scene's truth, checked by a script that has nothing of the program."""
    context.call("export", "small-pair", "--frames", "10", "--out", "export")
    check = context.path("export/small-pair/check.py")
    expected = ROOT / "reference" / "judge" / "check.py"
    if check.read_bytes() != expected.read_bytes():
        raise Found("check.py is not the one of reference/judge")
    context.call(check, program="python3")


def accuracy(context, name, policy, *baseline):
    context.call("gate", f"{name}/results.json", "--policy", untimed(policy, context), *baseline)
    context.recompute(name)


def unchanged(context, name):
    """By the unchanged program's gate, and field by field."""
    context.call("gate", f"{name}/results.json", "--policy", POLICIES / "unchanged.json",
                 "--baseline", context.of_reference(name) / "results.json",
                 program=(context.reference or context).program)
    context.same_results(name)


def run(context):
    context.run("bunnies", "bunny-touch", "--frames", "12", "--no-timing")
    accuracy(context, "bunnies", "ci", "--baseline", ROOT / "fixtures" / "baselines" / "ci.json")
    context.run("default", "default", "--no-timing")
    accuracy(context, "default", "default")
    unchanged(context, "default")


def hard(context):
    context.run("hard", "hard", "--no-timing")
    context.call("defects", "hard/results.json")
    context.recompute("hard")
    unchanged(context, "hard")


def simulated(context):
    """Bodies that deform by their own dynamics."""
    context.run("simulated", "paper-teapot", "paper-alphabet", "--frames", "40", "--no-timing",
                "--detector", "ffd-lazy", "--detector", "ffd-aabb")
    context.recompute("simulated")
    unchanged(context, "simulated")


def performance(context):
    context.run("performance", "contact", "pile", "near-miss", "scaling-contact-4", "--frames", "3",
                "--no-timing", *(word for d in ("fcl-aabb", "embree", "full-refit", "ffd-lazy",
                                                "ffd-aabb-sphere2+tri")
                                 for word in ("--detector", d)))
    results = json.loads(context.path("performance/results.json").read_text("utf-8"))
    for row in results["runs"]:
        counts = row.get("levels", {}).get("triangle", {"missed": None, "spurious": None})
        if row["status"] != "ok" or counts["missed"] or counts["spurious"]:
            raise Found(f"performance: {row['scene']} {row['detector']}: {row['status']}, missed "
                        f"{counts['missed']}, spurious {counts['spurious']}")
    context.recompute("performance")
    unchanged(context, "performance")


TIMED_DETECTORS = ["fcl-aabb", "fcl-obbrss", "fcl-collide", "bullet-vf", "libccd-gjk", "embree",
                   "full-refit", "ffd-lazy", "ffd-aabb-sphere2+tri"]
TIMED_SCENES = ["bunny-touch", "far-apart"]


def timing(context):
    """Times of two scenes by the policy's rules on ratios."""
    policy = json.loads((POLICIES / "default.json").read_text("utf-8"))
    rules = []
    for rule in policy["rules"]:
        # "!" in front takes a scene out, and one that did not run cannot be taken out.
        scenes = [scene for scene in rule["scenes"]
                  if scene.removeprefix("!") in ("*", *TIMED_SCENES)]
        if rule["measure"] in ("speedup", "status") and scenes:
            rules.append({**rule, "scenes": scenes})
    context.path("timed.json").write_text(json.dumps({**policy, "rules": rules}), encoding="utf-8")
    context.run("timing", *TIMED_SCENES, "--processes", "5",
                *(word for d in TIMED_DETECTORS for word in ("--detector", d)))
    context.call("gate", "timing/results.json", "--policy", "timed.json")
    context.recompute("timing")


# From cheap to dear; "tests" is not a command of the program.
COMMANDS = {"gate": gate, "report": report, "diff": diff, "pairs": pairs, "export": export,
            "simulated": simulated, "hard": hard, "run": run, "performance": performance, "ab": ab,
            "timing": timing, "tests": None}


def test_targets(build_folder, files):
    """The test programs of the folders of the changed files."""
    done = subprocess.run(["ninja", "-C", str(build_folder), "-t", "targets", "all"],
                          capture_output=True, text=True, check=False)
    programs = re.findall(r"^(\S+): CXX_EXECUTABLE", done.stdout, re.MULTILINE)
    folders = {f"tests/{pathlib.PurePath(name).parent}" for name in files}
    return [program for program in programs if str(pathlib.PurePath(program).parent) in folders
            and "test" in pathlib.PurePath(program).name]


def failed_test(program, workers):
    """The first one that fails, or nothing."""
    try:
        done = workers.run([str(program)], cwd=ROOT, timeout=SECONDS)
    except subprocess.TimeoutExpired:
        return f"{program.name} does not end within {SECONDS} s"
    failed = re.search(r"^\[  FAILED  \] (\S+)", done.stdout, re.MULTILINE)
    if done.returncode != 0:
        return failed.group(1) if failed else f"{program.name} ends with {done.returncode}"
    return ""


class ProductJudge:
    def __init__(self, options, workers):
        self.folder = options.product_build.resolve()
        self.jobs = options.jobs
        if not (self.folder / "CMakeCache.txt").is_file():
            self._call(["cmake", "--preset", "release", "-S", str(ROOT), "-B", str(self.folder)])
        self._ninja("contactcheck")
        self.build = Build(self.folder, "contactcheck")
        self._kept = tempfile.TemporaryDirectory(prefix="unchanged-")
        self._lock = threading.Lock()
        self._passed = set()
        scratch = pathlib.Path(self._kept.name)
        self.unchanged = Context(self.folder / "contactcheck", scratch / "work", workers)

    def _call(self, command):
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              check=False)
        if done.returncode != 0:
            raise Failure(DOES_NOT_COMPILE, f"the unchanged program: {done.stdout}")

    def _ninja(self, target):
        self._call(["cmake", "--build", str(self.folder), "--target", target, "-j",
                    str(self.jobs)])

    def _build_wrong(self, workers):
        """Another program than the mutants': one that ab must tell from the unchanged one."""
        with tempfile.TemporaryDirectory(prefix="mutant-") as folder:
            build_program(Mutant(ROOT / "tests/faults/mutants/lazy-last-triangle.patch"), self.build,
                          self.unchanged.path("wrong"), pathlib.Path(folder), workers, QUICK_FLAGS)

    def _require_clean(self, command, workers):
        """The unchanged program passes the command; its work is compared with."""
        with self._lock:
            if command in self._passed:
                return
            if command == "ab":
                self._build_wrong(workers)
            try:
                if command in ("gate", "report", "diff"):
                    on_kept(self.unchanged)
                COMMANDS[command](self.unchanged)
            except Found as found:
                raise Failure(SURVIVED,
                              f"the unchanged program does not pass {command}: {found}") from found
            self._passed.add(command)

    def verdict(self, mutant, workers):
        first = mutant.caught_by
        if first not in COMMANDS:
            return Verdict(SURVIVED, f"no command \"{first}\"")
        order = [first, *(command for command in COMMANDS if command != first)]
        try:
            with tempfile.TemporaryDirectory(prefix="mutant-") as folder:
                programs = functools.cache(functools.partial(self._program, mutant, workers,
                                                             pathlib.Path(folder)))
                for command in order:
                    # Tests fall back to where nothing else is left.
                    found = (self._by_tests(mutant, workers, pathlib.Path(folder))
                             if command == "tests" else
                             self._by(command, programs, pathlib.Path(folder), workers))
                    if found:
                        return Verdict(CAUGHT, f"{command}: {found}")
        except Failure as failure:
            return Verdict(failure.code, str(failure))
        return Verdict(SURVIVED, "no command and no unit test of its folder finds it")

    def _program(self, mutant, workers, folder, timed):
        scratch = folder / ("timed" if timed else "quick")
        scratch.mkdir()
        build_program(mutant, self.build, scratch / "contactcheck", scratch, workers,
                      [] if timed else QUICK_FLAGS)
        return scratch / "contactcheck"

    def _by(self, command, programs, folder, workers):
        self._require_clean(command, workers)
        # Times of what was compiled quickly say nothing.
        program = programs(command in ("timing", "ab"))
        try:
            COMMANDS[command](Context(program, folder / "work", workers, self.unchanged))
        except Found as found:
            return str(found)
        return ""

    def _by_tests(self, mutant, workers, folder):
        for target in test_targets(self.folder, mutant.files):
            with self._lock:
                self._ninja(target)
            if failed_test(self.folder / target, workers):
                continue  # says nothing of the mutant
            build = Build(self.folder, target)
            if not build.users(mutant.files):
                continue
            scratch = folder / pathlib.PurePath(target).name
            scratch.mkdir()
            program = scratch / pathlib.PurePath(target).name
            build_program(mutant, build, program, scratch, workers)
            failed = failed_test(program, workers)
            if failed:
                return failed
        return ""
