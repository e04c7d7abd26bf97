"""Runs the Snakemake sweep on local cores and on a stand-in of Slurm, and holds it against one run.

    sweep_test.py CONTACTCHECK SNAKEMAKE ROOT
"""
import json
import os
import pathlib
import shlex
import subprocess
import sys
import tempfile
import unittest

PROGRAM, SNAKEMAKE, ROOT = (pathlib.Path(word).resolve() for word in sys.argv[1:4])
SCENES = ["one", "two", "three"]
WORDS = "--detector fcl-aabb --detector ffd-grid --no-timing"

SCENE = """{"id": "%s", "title": "Two boxes", "frames": 4, "duration": 1,
  "levels": ["body", "cell", "triangle"], "bodies": [
    {"name": "left", "mesh": {"shape": "box"}, "lattice": {"cells": [3, 3, 3]}},
    {"name": "right", "mesh": {"shape": "box"}, "lattice": {"cells": [3, 3, 3]},
     "motion": {"position": [[0, [1.3, 0.1, 0.2]], [1, [0.9, 0.1, 0.2]]]}}]}
"""

# The stand-ins are told by the environment where to keep what they know (FOLDER), and which program
# is the real one: either may have any name.

# Says who calls, and is killed at its first try of shard 2.
MORTAL = """#!/bin/sh
echo "$*" >> "$FOLDER/calls"
case "$*" in
  *--shard\\ 2/3*) [ -e "$FOLDER/died" ] || { touch "$FOLDER/died"; kill -9 $$; } ;;
esac
exec "$PROGRAM" "$@"
"""

# The first job is lost with its machine: it never runs, and never says so.
SBATCH = """#!/bin/sh
for script; do :; done
id=$$
echo "$*" >> "$FOLDER/submitted"
if [ ! -e "$FOLDER/lost" ]; then
  touch "$FOLDER/lost"
  echo NODE_FAIL > "$FOLDER/state.$id"
else
  echo RUNNING > "$FOLDER/state.$id"
  ( if sh "$script"; then state=COMPLETED; else state=FAILED; fi
    echo $state > "$FOLDER/state.$id" ) </dev/null >/dev/null 2>&1 &
fi
echo $id
"""
SACCT = """#!/bin/sh
cat "$FOLDER/state.$2"
"""
NO_SACCT = """#!/bin/sh
echo Slurm accounting storage is disabled >&2
exit 1
"""
SCONTROL = """#!/bin/sh
echo "JobId=$4 JobName=shard Priority=1 JobState=$(cat "$FOLDER/state.$4") Reason=None"
"""
NO_JOB = """#!/bin/sh
echo "slurm_load_jobs error: Invalid job id specified" >&2
exit 1
"""


def rows_of(folder):
    results = json.loads((folder / "results.json").read_bytes())
    rows = [(run["scene"], run["detector"], run["levels"], run["contact_hash"])
            for run in results["runs"]]
    return rows, results["disagreements"], results["scenes"]


class Sweep(unittest.TestCase):
    def setUp(self):
        # Nothing may hang on what the folders are called, that of the workflow among them.
        self.scratch = tempfile.TemporaryDirectory(prefix="Größe mit Leerzeichen-")
        self.folder = pathlib.Path(self.scratch.name)
        self.workflow = self.folder / "workflow"
        self.workflow.symlink_to(ROOT / "reference/suite/sweep")
        for scene in SCENES:
            (self.folder / f"{scene}.json").write_text(SCENE % scene)
        self.run_words = shlex.join([str(self.folder / f"{s}.json") for s in SCENES]) + " " + WORDS
        self.addCleanup(self.scratch.cleanup)

    def script(self, path, text):
        path.parent.mkdir(exist_ok=True)
        path.write_text(text)
        path.chmod(0o755)
        return path

    def sweep(self, *more, program=PROGRAM, shards=3, path=None):
        environment = dict(os.environ, HOME=self.scratch.name, FOLDER=self.scratch.name,
                           PROGRAM=str(PROGRAM))
        if path:
            environment["PATH"] = f"{path}:{environment['PATH']}"
        return subprocess.run(
            [SNAKEMAKE, "-s", self.workflow / "Snakefile", *more, "--config",
             f"shards={shards}", f"run={self.run_words}", "out=swept", f"program={program}"],
            cwd=self.folder, env=environment, capture_output=True, encoding="utf-8", check=False)

    def expect_whole(self, outcome):
        self.assertEqual(outcome.returncode, 0, outcome.stderr)
        whole = self.folder / "whole"
        subprocess.run([PROGRAM, "run", *shlex.split(self.run_words), "--quiet", "--out", whole],
                       check=True, stdout=subprocess.DEVNULL)
        self.assertEqual(rows_of(self.folder / "swept"), rows_of(whole))

    def test_on_local_cores_it_gives_what_one_run_gives(self):
        self.expect_whole(self.sweep("--cores", "2"))

    def test_shard_whose_worker_is_killed_is_run_again_and_no_other(self):
        mortal = self.script(self.folder / "mortal", MORTAL)
        self.expect_whole(self.sweep("--cores", "1", program=mortal))
        calls = (self.folder / "calls").read_text(encoding="utf-8").splitlines()
        tries = [sum(f"--shard {k}/3" in call for call in calls) for k in (1, 2, 3)]
        self.assertEqual(tries, [1, 2, 1])

    def test_more_shards_than_scenes_fail_with_the_programs_sentence(self):
        outcome = self.sweep("--cores", "1", shards=4)
        self.assertNotEqual(outcome.returncode, 0)
        self.assertIn("this run has 3 scenes", outcome.stderr)

    def on_a_cluster(self, **stand_ins):
        tools = self.folder / "tools"
        self.script(tools / "sbatch", SBATCH)
        for name, text in stand_ins.items():
            self.script(tools / name, text)
        outcome = self.sweep("--profile", self.workflow / "slurm", "--latency-wait", "10",
                             path=tools)
        self.expect_whole(outcome)
        submitted = (self.folder / "submitted").read_text(encoding="utf-8").splitlines()
        self.assertEqual(len(submitted), 4, "three shards, one of them twice")
        self.assertTrue(all("--parsable" in words for words in submitted))

    def test_on_a_cluster_a_lost_job_is_submitted_again(self):
        self.on_a_cluster(sacct=SACCT)

    def test_on_a_cluster_without_accounts_too(self):
        self.on_a_cluster(sacct=NO_SACCT, scontrol=SCONTROL)

    def test_job_that_nobody_knows_any_more_has_failed(self):
        tools = self.folder / "tools"
        self.script(tools / "sacct", NO_SACCT)
        self.script(tools / "scontrol", NO_JOB)
        said = subprocess.run([ROOT / "reference/suite/sweep/slurm/status.sh", "7"], check=True,
                              env=dict(os.environ, PATH=f"{tools}:{os.environ['PATH']}"),
                              capture_output=True, text=True)
        self.assertEqual(said.stdout, "failed\n")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
