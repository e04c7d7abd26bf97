import json

import program
import pytest


def test_are_in_the_report_in_place_of_a_section_per_family(markdown, hard):
    text = markdown(hard)
    assert "### Where they go wrong" in text
    assert "## one\n" not in text


def test_are_left_out_of_results_without_families(markdown, sample):
    text = markdown(sample)
    assert "Hard cases" not in text
    assert "Where they go wrong" not in text


@pytest.fixture
def refused(tmp_path):
    """A function: `report` refuses these results and says that a case of the family is missing."""

    def refuse(results, missing):
        (tmp_path / "results.json").write_text(json.dumps(results), encoding="utf-8")
        program.refused("report", "results.json", "--out", "out", "--format", "md", folder=tmp_path,
                        named=[f'the results of family "one" are not complete: frame {missing} is missing'])

    return refuse


def test_error_in_a_case_that_the_family_does_not_have_is_refused(refused, hard):
    hard["runs"][2]["failed_frame"] = 3
    refused(hard, missing=3)


def test_run_that_was_judged_in_too_few_cases_is_refused(refused, hard):
    hard["runs"][1]["per_frame"]["missed"].pop()
    refused(hard, missing=2)
