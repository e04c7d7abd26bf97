"""A library that answers the question `self`, on a hinge of two triangles that folds flat at one of ten
values."""

import os

from program import contactcheck, valid_results

LIBRARY = os.environ["CONTACTCHECK_SELF_LIBRARY"]


def row_saying(what, folder):
    outcome = contactcheck("run", "hard-self-hinge", "--detector", f"{LIBRARY}:says={what}", "--no-timing",
                           "--out", folder / "out")
    assert outcome.exit_code != 2, outcome.err
    return valid_results(folder / "out" / "results.json")["runs"][0]


def test_pairs_of_its_triangles_are_judged_by_class(tmp_path):
    row = row_saying("pair", tmp_path)
    assert row["status"] == "ok", row["message"]
    level = row["levels"]["self-edge"]
    assert (level["truth"], level["hit"], level["spurious"]) == (1, 1, 9)
    assert "self" not in row["levels"], "neither claimed nor asked for"


def test_body_alone_is_an_answer_too(tmp_path):
    row = row_saying("body", tmp_path)
    assert row["status"] == "ok", row["message"]
    assert row["semantics"]["questions"] == ["self"]


def test_pair_of_two_bodies_is_no_answer(tmp_path):
    row = row_saying("others", tmp_path)
    assert row["status"] == "error"
    assert "answers the question self with triangles of two bodies, 0 and 1" in row["message"]
