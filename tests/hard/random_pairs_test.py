#!/usr/bin/env python3
"""random_pairs_test.py PROGRAM COUNT: so many random hard pairs of triangles, the oracle held against
rational arithmetic on each, and our exact detectors against the oracle."""

import json
import pathlib
import subprocess
import sys
import tempfile

DETECTORS = ["ffd-lazy", "full-refit", "ffd-aabb-sphere2+tri"]


def main():
    program, count = sys.argv[1], int(sys.argv[2])
    with tempfile.TemporaryDirectory() as folder:
        words = [program, "run", "--pairs", str(count), "--no-timing", "--quiet", "--out", folder]
        for name in DETECTORS:
            words += ["--detector", name]
        subprocess.run(words, check=True, stdout=subprocess.DEVNULL)
        results = json.loads((pathlib.Path(folder) / "results.json").read_bytes())
    pairs = results["scenes"][0]["pairs"]
    assert pairs["count"] == pairs["rational"]["checked"] == count, pairs
    # Neither touching nor apart may be rare, or little was tried.
    assert 0.3 * count < pairs["touching"] < 0.7 * count, pairs
    assert pairs["rational"]["oracle_wrong"] == 0, pairs
    assert [run["detector"] for run in results["runs"]] == DETECTORS, results["runs"]
    for run in results["runs"]:
        level = run["levels"]["triangle"]
        assert (run["status"], level["truth"], level["missed"], level["spurious"]) == (
            "ok", pairs["touching"], 0, 0), run
    print(f"{count} pairs, {pairs['touching']} touch, none wrong")


if __name__ == "__main__":
    main()
