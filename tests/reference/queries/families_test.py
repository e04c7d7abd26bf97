"""`contactcheck queries --families`: exact is right in all, and what libraries do wrong is what
fixtures/queries/known-defects.json says, count by count.

    CONTACTCHECK_PROGRAM=... python3 families_test.py --write   (PYTHONPATH=tests/support)

writes the counts anew.
"""

import json
import os
import pathlib
import re
import sys
import tempfile

import pytest

from program import ROOT, successful

DEFECTS = ROOT / "fixtures" / "queries" / "known-defects.json"
LIBRARIES = {"fcl": "fcl-intersect", "bullet": "bullet-bernstein"}


def judge(folder):
    out = successful("queries", "--families", "--out", folder).out
    document = json.loads((folder / "queries.json").read_text(encoding="utf-8"))
    return document["files"], out


def values_of(text):
    """The values of each family, in order, as the tables have them."""
    values, family = {}, None
    for line in text.partition("First value of each family")[0].splitlines():
        if line and not line.startswith(" "):
            family = line.partition(":")[0]
            values[family] = []
        elif line and values.get(family) is not None:
            values[family].append(line.split()[0])
    return {family: rows[1:] for family, rows in values.items()}  # behind the title


def seen(files, text, detector, kind):
    """{family: {value: count}} of what the detector does wrong."""
    values, found = values_of(text), {}
    for file in files:
        family, _, number = file["name"].rpartition("@")
        for row in file["detectors"]:
            if row["detector"] == detector and row["score"][kind] > 0:
                found.setdefault(family, {})[values[family][int(number)]] = row["score"][kind]
    return found


@pytest.fixture(scope="module")
def judged(tmp_path_factory):
    return judge(tmp_path_factory.mktemp("families"))


def test_exact_is_right_in_all(judged):
    files, text = judged
    rows = [row for file in files for row in file["detectors"] if row["detector"] == "exact"]
    assert len(rows) == len(files) > 200
    for row in rows:
        wrong = (row["score"]["missed"], row["score"]["spurious"], row["errors"], row["refused"])
        assert wrong == (0, 0, 0, 0)
        assert max(row["time_of_contact"]["early_max"], row["time_of_contact"]["late_max"]) <= 2**-40
    assert text.count("\n") < 1000


@pytest.mark.parametrize("defect", json.loads(DEFECTS.read_text(encoding="utf-8"))["defects"],
                         ids=lambda defect: f"{defect['library']}-{defect['kind']}")
def test_known_defects_hold(defect, judged):
    detector = LIBRARIES[defect["library"]]
    assert seen(*judged, detector, defect["kind"]) == defect["seen"]


def test_every_defect_is_listed(judged):
    listed = {(d["library"], d["kind"]) for d in json.loads(DEFECTS.read_text(encoding="utf-8"))["defects"]}
    found = {(library, kind) for library, detector in LIBRARIES.items() for kind in ("missed", "spurious")
             if seen(*judged, detector, kind)}
    assert found == listed


def test_summary_has_a_row_a_family(judged):
    files, text = judged
    families = {file["name"].rpartition("@")[0] for file in files}
    summary = text.partition("First value of each family")[2].splitlines()
    assert {line.split()[0] for line in summary[2:] if line.startswith("  ")} == families
    for line in summary[2:]:
        if line.startswith("  "):
            assert line.split("  ")[-1] != ""


def write():
    with tempfile.TemporaryDirectory() as folder:
        files, text = judge(pathlib.Path(folder))
    document = json.loads(DEFECTS.read_text(encoding="utf-8"))
    for defect in document["defects"]:
        defect["seen"] = seen(files, text, LIBRARIES[defect["library"]], defect["kind"])
    text = json.dumps(document, indent=1)
    one_line = re.sub(r"\{\s*((?:\"[^\"{}]*\": \d+,?\s*)+)\}",
                      lambda counts: "{" + " ".join(counts[1].split()) + "}", text)
    DEFECTS.write_text(one_line + "\n", encoding="utf-8")


if __name__ == "__main__":
    if sys.argv[1:] != ["--write"] or os.environ.get("CI"):
        sys.exit(__doc__)
    write()
