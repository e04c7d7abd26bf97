"""`contactcheck diff` of files that are not complete; what it says of others are cases."""

import json

import pytest

from program import EXAMPLE_RESULTS, refused


@pytest.mark.parametrize("order", [("whole.json", "cut.json"), ("cut.json", "whole.json")])
def test_refuses_a_file_that_is_not_complete_by_its_name(tmp_path, order):
    results = json.loads(EXAMPLE_RESULTS.read_text(encoding="utf-8"))
    (tmp_path / "whole.json").write_text(json.dumps(results), encoding="utf-8")
    del results["runs"][0]["geometry"]
    (tmp_path / "cut.json").write_text(json.dumps(results), encoding="utf-8")
    refused("diff", *(tmp_path / name for name in order),
            named=[f"{tmp_path / 'cut.json'}: not complete: runs[0]", "geometry"], folder=tmp_path)
