"""What tests of the report share: results to begin with, and what the command `report` makes of them."""

import copy
import json
import pathlib
import re

import program
import pytest


def parsed(name):
    return json.loads((pathlib.Path(__file__).parent / name).read_text(encoding="utf-8"))


@pytest.fixture
def sample():
    """Five detectors in one scene: two have answered, one of these errs; the others have a message."""
    return parsed("sample.json")


@pytest.fixture
def two_scenes(sample):
    """The sample, and all of it once more in the scene "again"."""
    sample["scenes"].append({**copy.deepcopy(sample["scenes"][0]), "id": "again"})
    sample["runs"] += [{**run, "scene": "again"} for run in copy.deepcopy(sample["runs"])]
    return sample


@pytest.fixture
def hard():
    """Two families of three cases. "exact" is right, "skin" errs in both, "crash" has no answer."""
    return parsed("hard.json")


@pytest.fixture
def bullet():
    """bullet-vf alone, judged at levels, depths and normals that only it has."""
    return parsed("bullet.json")


@pytest.fixture
def report(tmp_path):
    """A function: the files that `report` writes for results, their texts by path."""

    def files_of(results):
        folder = tmp_path / f"report-{len(list(tmp_path.iterdir()))}"
        out = folder / "out"
        folder.mkdir()
        (folder / "results.json").write_text(json.dumps(results), encoding="utf-8")
        program.successful("report", folder / "results.json", "--out", out, "--format", "md", "csv")
        return {path.relative_to(out).as_posix(): path.read_bytes().decode("utf-8")
                for path in out.rglob("*") if path.is_file()}

    return files_of


@pytest.fixture
def markdown(report):
    """A function: the report.md of results."""
    return lambda results: report(results)["report.md"]


@pytest.fixture
def table_below():
    """A function: the first table below the line that begins so, as a list of rows of cells without the
    row of titles; "" finds the first table of all. With `titles` each row is a dictionary by title."""

    def rows_of(text, heading, titles=False):
        lines = text[re.search("^" + re.escape(heading), text, re.MULTILINE).start():].split("\n")
        first = next(i for i, line in enumerate(lines) if line.startswith("| "))
        end = lines.index("", first)
        rows = [[cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]] for line in lines[first:end]]
        return [dict(zip(rows[0], row, strict=True)) if titles else row for row in rows[2:]]

    return rows_of
