"""fixtures/queries: what by_hand.py writes, with truths that are proved, and what `contactcheck queries`
says of them."""

import json
import pathlib
import sys
from fractions import Fraction

import pytest

from program import contactcheck, successful

sys.path.append(str(pathlib.Path(__file__).resolve().parent))
import by_hand  # noqa: E402
from by_hand import (  # noqa: E402
    FAMILIES, FOLDER, SIZES, VERTEX_FACE, Apart, Cross, Meet, Query, cross, dot, queries_of)

IN_DOUBLES = ["vertex-face/by_hand.csv", "edge-edge/by_hand.csv"]
FIRST_LINES = range(1, 801, 8)


# --- Proofs


def places(query, time):
    """The points of both elements at a time."""
    points = [tuple(Fraction(a) + time * (Fraction(b) - a) for a, b in zip(start, end))
              for start, end in zip(query.start, query.end)]
    first, _ = SIZES[query.kind]
    return points[:first], points[first:]


def meets(query, proof):
    assert 0 <= proof.at <= 1
    means = []
    first, _ = SIZES[query.kind]
    for points, weights in zip(places(query, proof.at), (proof.weights[:first], proof.weights[first:])):
        assert min(weights) >= 0 and sum(weights) == 1 and len(weights) == len(points)
        means.append([sum(w * p[axis] for w, p in zip(weights, points)) for axis in range(3)])
    return means[0] == means[1]


def are_apart(query, proof):
    begin = Fraction(0)
    for until, direction in proof.pieces:
        assert begin < until
        for time in (begin, until):
            first, second = places(query, time)
            if min(dot(direction, p) for p in first) <= max(dot(direction, p) for p in second):
                return False
        begin = until
    return begin == 1


def side(a, b, c, d):
    """The sign of it says on which side of a, b, c the point d is."""
    u, v, w = ([x - y for x, y in zip(p, a)] for p in (b, c, d))
    return dot(cross(u, v), w)


def keeps_its_sign(turn, begin, end):
    """1 or -1 where a quadratic has that sign all through; else 0. (It is between the least and the
    greatest of its Bernstein coefficients.)"""
    first, middle, last = turn(begin), turn((begin + end) / 2), turn(end)
    coefficients = (first, 2 * middle - (first + last) / 2, last)
    return 1 if min(coefficients) > 0 else -1 if max(coefficients) < 0 else 0


def cross_each_other(query, proof):
    def turn(i, j, k):
        """Of three of the four points, looked at along the axis."""
        def at(time):
            points = [p for element in places(query, time) for p in element]
            a, b, c = ([p[axis] for axis in range(3) if axis != proof.axis]
                       for p in (points[i], points[j], points[k]))
            return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])

        return keeps_its_sign(at, proof.begin, proof.end)

    if query.kind == VERTEX_FACE:
        overlap = turn(1, 2, 0) == turn(2, 3, 0) == turn(3, 1, 0) != 0
    else:
        overlap = turn(0, 1, 2) * turn(0, 1, 3) == -1 and turn(2, 3, 0) * turn(2, 3, 1) == -1
    sides = [side(*(p for element in places(query, time) for p in element))
             for time in (proof.begin, proof.end)]
    return 0 <= proof.begin < proof.end <= 1 and overlap and sides[0] * sides[1] < 0


CHECKS = {Meet: meets, Apart: are_apart, Cross: cross_each_other}


def is_proved(query):
    return CHECKS[type(query.proof)](query, query.proof)


@pytest.mark.parametrize("name", FAMILIES)
def test_every_truth_is_proved(name):
    queries = queries_of(name)
    assert [i for i, query in enumerate(queries) if not is_proved(query)] == []


def test_a_wrong_proof_is_none():
    """Of queries that are next to those of the files."""
    assert not is_proved(by_hand.falls(-by_hand.TINY, 1, by_hand.at_place(Fraction(1, 3), 0, 1)))
    assert not is_proved(by_hand.falls(0, 1, by_hand.apart(-1, 0, 0)))
    assert not is_proved(by_hand.falls(-1, 1, Apart(((by_hand.HALF, (-1, 0, 0)),))))
    for many in (by_hand.many_contacts_of_a_vertex()[4], by_hand.many_contacts_of_edges()[3]):
        later = Cross(many.proof.end, many.proof.end + Fraction(1, 100), 2)
        assert not is_proved(Query(many.kind, many.start, many.end, later))


# --- Files


def is_double(value):
    try:
        return Fraction(float(value)) == value
    except OverflowError:
        return False


def coordinates(query):
    return [Fraction(x) for point in (*query.start, *query.end) for x in point]


@pytest.mark.parametrize("name", FAMILIES)
def test_the_file_is_what_the_generator_writes(name):
    assert (FOLDER / name).read_text(encoding="utf-8") == by_hand.text_of(queries_of(name))


def test_nothing_else_is_in_the_folder():
    assert {str(path.relative_to(FOLDER)) for path in FOLDER.rglob("*.csv") if path.is_file()} == set(FAMILIES)


@pytest.mark.parametrize("name", IN_DOUBLES)
def test_a_hundred_different_queries_in_doubles(name):
    queries = queries_of(name)
    assert len(queries) == 100
    assert len({(tuple(coordinates(query))) for query in queries}) == 100
    assert 40 <= sum(query.truth for query in queries) <= 65
    assert all(is_double(x) for query in queries for x in coordinates(query))


def test_each_of_eight_queries_is_beyond_doubles():
    queries = by_hand.no_doubles()
    assert len(queries) == 8
    assert not any(all(map(is_double, coordinates(query))) for query in queries)


# --- What the program says of them


def judged(folder, file, *words):
    """What queries.json says of one file, and what the terminal says."""
    outcome = successful("queries", file, *words, "--out", folder / "out")
    assert outcome.err == ""
    document = json.loads((folder / "out" / "queries.json").read_text(encoding="utf-8"))
    score, = document["files"]
    return score, outcome.out


def without_times(score):
    """The score without what differs from run to run, and the name of the file."""
    detectors = [{key: value for key, value in detector.items() if key != "microseconds"}
                 for detector in score["detectors"]]
    for detector in detectors:
        detector["decades"] = [{key: value for key, value in decade.items() if key != "micros"}
                               for decade in detector["decades"]]
    return {**{key: value for key, value in score.items() if key not in ("name", "oracle_microseconds")},
            "detectors": detectors}


@pytest.fixture(name="scores", scope="module")
def fixture_scores(tmp_path_factory):
    return {name: judged(tmp_path_factory.mktemp("scores"), FOLDER / name) for name in FAMILIES}


@pytest.mark.parametrize("name", FAMILIES)
def test_the_truth_of_the_file_is_right(name, scores):
    score, text = scores[name]
    queries = queries_of(name)
    assert score["kind"] == name.split("/")[0]
    assert score["queries"] == score["file_truths"] == len(queries)
    assert score["file_wrong"] == 0 and "wrong_lines" not in score
    assert score["contacts"] == sum(query.truth for query in queries)
    assert score["starts_in_contact"] == sum(
        query.truth and isinstance(query.proof, Meet) and query.proof.at == 0 for query in queries)
    assert f"the file's own truth: all {len(queries)} right\n" in text


@pytest.mark.parametrize("name", IN_DOUBLES)
def test_our_exact_detector_is_right_and_others_are_not(name, scores):
    queries = queries_of(name)
    detectors = {detector["detector"]: detector for detector in scores[name][0]["detectors"]}
    others = ["root-finder", "fcl-intersect", *(["bullet-bernstein"] if name.startswith("vertex") else [])]
    assert list(detectors) == ["exact", *others]
    exact = detectors["exact"]
    contacts = sum(query.truth for query in queries)
    assert exact["score"] == {"truth": contacts, "reported": contacts, "hit": contacts, "missed": 0,
                              "spurious": 0, "near": 0, "undecided": 0, "near_max": 0.0}
    times = exact["time_of_contact"]
    assert times["timed"] == contacts
    assert max(times["early_max"], times["late_max"]) <= 2.0**-40
    for detector in detectors.values():
        score = detector["score"]
        assert (detector["queries"], detector["refused"], detector["errors"]) == (100, 0, 0)
        assert score["truth"] == contacts == score["hit"] + score["missed"]
        assert score["reported"] == score["hit"] + score["spurious"]
        assert sum(decade["score"]["missed"] for decade in detector["decades"]) == score["missed"]
    for other in others:
        score = detectors[other]["score"]
        assert score["missed"] > 0, other
        line = score["first_missed"]
        assert line in FIRST_LINES and queries[line // 8].truth
        assert ("first_spurious" in score) == (score["spurious"] > 0)
        if score["spurious"] > 0:
            assert not queries[score["first_spurious"] // 8].truth


def test_floats_change_a_question_that_is_judged_both_ways(scores):
    """Of the two queries that rounding to floats flips, and of one unit in the last place, Bullet's answers
    are judged twice."""
    bullet, = [detector for detector in scores["vertex-face/by_hand.csv"][0]["detectors"]
               if detector["detector"] == "bullet-bernstein"]
    assert bullet["precision"] == "single" and bullet["score_fed"]["truth"] != bullet["score"]["truth"]
    assert bullet["time_of_contact"]["timed"] == 0


def test_queries_that_are_no_doubles_are_judged_and_no_detector_is_asked(scores):
    score, text = scores["vertex-face/no_doubles.csv"]
    assert score["not_doubles"] == 8
    assert all((detector["queries"], detector["refused"], detector["score"]["truth"]) == (8, 8, 0)
               for detector in score["detectors"])
    assert "8 queries with coordinates that are no doubles" in text


@pytest.mark.parametrize("name", IN_DOUBLES)
def test_truth_beside_the_file_gives_the_same_scores(name, scores, tmp_path):
    queries = queries_of(name)
    lines = (FOLDER / name).read_text(encoding="utf-8").splitlines()
    file = tmp_path / name.replace("/", "-")
    file.write_text("".join(line.rpartition(",")[0] + "\n" for line in lines), encoding="utf-8")
    truth = tmp_path / "truth.json"
    truth.write_text(json.dumps([query.truth for query in queries]), encoding="utf-8")
    kind = name.split("/")[0]
    score, _ = judged(tmp_path, file, "--kind", kind, "--truth", truth)
    assert without_times(score) == without_times(scores[name][0])
    score, text = judged(tmp_path, file, "--kind", kind)
    assert score["file_truths"] == 0 and "own truth" not in text


def test_a_wrong_truth_is_told_with_its_line(tmp_path):
    """The third and the last query of the file, and of a list beside it."""
    name = "vertex-face/by_hand.csv"
    queries = queries_of(name)
    lines = (FOLDER / name).read_text(encoding="utf-8").splitlines()
    for number in (*range(16, 24), *range(792, 800)):
        rest, _, truth = lines[number].rpartition(",")
        lines[number] = f"{rest},{1 - int(truth)}"
    file = tmp_path / "vf.csv"
    file.write_text("\n".join(lines) + "\n", encoding="utf-8")
    score, text = judged(tmp_path, file, "--detector", "exact")
    assert (score["file_truths"], score["file_wrong"], score["wrong_lines"]) == (100, 2, [17, 793])
    assert "the file's own truth: 2 of 100 wrong" in text and "17, 793" in text
    truth = tmp_path / "truth.json"
    truth.write_text(json.dumps([query.truth for query in queries]), encoding="utf-8")
    score, _ = judged(tmp_path, file, "--detector", "exact", "--truth", truth)
    assert score["file_wrong"] == 0, "--truth stands before the seventh column"


def test_the_file_of_another_kind_has_another_truth(tmp_path):
    """So a kind that nobody says right is noticed."""
    outcome = contactcheck("queries", FOLDER / "vertex-face" / "by_hand.csv", "--kind", "edge-edge",
                           "--detector", "exact", "--out", tmp_path / "out")
    assert outcome.exit_code == 0
    assert " of 100 wrong" in outcome.out
