"""`export --queries --certificates`: check.py accepts what the program writes, and refuses every way to
break it. A file that is changed gets the checksum that belongs to it: the proofs must hold by
themselves.
"""

import json
import shutil
import sys
import zlib

import pytest

from program import names_in, refused, run_program, successful, tiny_scene

KINDS = ("vertex-face", "edge-edge")
# Two triangles that turn in one plane: planar motion, met at irrational times.
TURNING = {
    "id": "turning", "frames": 5, "duration": 1, "levels": ["body"],
    "bodies": [
        {"name": "ground", "mesh": {"file": "ground.obj"},
         "motion": {"spins": [{"axis": [0, 0, 1], "degrees": [[0, 0], [1, 40]]}]}},
        {"name": "hand", "mesh": {"file": "hand.obj"},
         "motion": {"position": [[0, [0.1, 1.5, 0]], [1, [0.3, -0.2, 0]]],
                    "spins": [{"axis": [0, 0, 1], "degrees": [[0, 0], [1, 170]]}]}}]}
MESHES = {"ground.obj": "v -3 0 0\nv 3 0 0\nv 0 -2 0\nf 1 2 3\n",
          "hand.obj": "v 0 0 0\nv 1 0 0\nv 0.5 2 0\nf 1 2 3\n"}


class Export:
    """A folder that an export of queries has written."""

    def __init__(self, folder):
        self.folder = folder

    def index(self):
        return json.loads((self.folder / "queries.json").read_text(encoding="utf-8"))

    def lines(self, name):
        return (self.folder / name).read_text(encoding="utf-8").splitlines()

    def proofs(self, kind):
        return [json.loads(line) for line in self.lines(f"{kind}.certificates.jsonl")]

    def write(self, name, lines):
        data = "".join(line + "\n" for line in lines).encode()
        (self.folder / name).write_bytes(data)
        index = self.index()
        index["crc32"][name] = f"{zlib.crc32(data):08x}"
        self.write_index(index)

    def write_index(self, index):
        (self.folder / "queries.json").write_text(json.dumps(index), encoding="utf-8")

    def replace(self, kind, place, proof):
        name = f"{kind}.certificates.jsonl"
        lines = self.lines(name)
        lines[place] = proof if isinstance(proof, str) else json.dumps(proof)
        self.write(name, lines)

    def check(self):
        return run_program(sys.executable, ["-B", self.folder / "check.py"])

    def is_refused(self, *pieces):
        outcome = self.check()
        assert (outcome.exit_code, outcome.out) == (1, "")
        assert outcome.err.count("\n") == 1, outcome.err
        for piece in pieces:
            assert piece in outcome.err

    def change(self, wanted, change, expected):
        """Breaks the first proof of each kind that has what is wanted: another proof, or None for no
        such change. Some proof must have it."""
        changed = 0
        for kind in KINDS:
            for place, proof in enumerate(self.proofs(kind)):
                if not wanted(proof):
                    continue
                before = self.lines(f"{kind}.certificates.jsonl")
                change(proof)
                self.replace(kind, place, proof)
                self.is_refused(f"{kind}.certificates.jsonl, line {place + 1}: {expected}",
                                f"{kind}.csv, line {8 * place + 1}; ")
                self.write(f"{kind}.certificates.jsonl", before)
                changed += 1
                break
        assert changed, "no proof is of this kind"
        assert self.check().exit_code == 0, "what was broken is not mended"


@pytest.fixture(scope="module")
def exported(tmp_path_factory):
    """The folders of two scenes, by id."""
    folder = tmp_path_factory.mktemp("scenes")
    for name, text in MESHES.items():
        (folder / name).write_text(text, encoding="utf-8")
    scenes = {"tiny": tiny_scene(), "turning": json.dumps(TURNING)}
    files = []
    for name, text in scenes.items():
        files.append(folder / f"{name}.json")
        files[-1].write_text(text, encoding="utf-8")
    successful("export", *files, "--queries", "--certificates", "--out", folder / "out")
    return {name: folder / "out" / name for name in scenes}


@pytest.fixture
def tiny(exported, tmp_path):
    return Export(shutil.copytree(exported["tiny"], tmp_path / "tiny"))


@pytest.fixture
def turning(exported, tmp_path):
    return Export(shutil.copytree(exported["turning"], tmp_path / "turning"))


def reasons(proof):
    return [piece[1] for piece in proof["apart"]]


def is_apart(proof):
    return "crosses" not in proof and "meets" not in proof


def with_reason(reason):
    return lambda proof: reason in reasons(proof)


def with_contact(key):
    return lambda proof: key in proof


# --- What is written


def test_every_query_of_both_scenes_is_proved(tiny, turning):
    for export in (tiny, turning):
        index, outcome = export.index(), export.check()
        assert (outcome.exit_code, outcome.err) == (0, "")
        said = []
        for kind in KINDS:
            counts = index[kind.replace("-", "_")]
            assert (counts["proved"], counts["unproved"]) == (counts["written"], 0)
            apart = counts["written"] - counts["contacts"]
            said.append(f"{kind}: {counts['contacts']} contacts proven, {apart} proven apart, "
                        "0 without proof")
        assert outcome.out == f"{index['scene']}: {'; '.join(said)}\n"


def test_both_scenes_together_have_every_kind_of_proof(tiny, turning):
    proofs = [proof for export in (tiny, turning) for kind in KINDS for proof in export.proofs(kind)]
    assert {reason for proof in proofs for reason in reasons(proof)} == {
        "volume", "side", "direction"}
    assert any(map(with_contact("crosses"), proofs))
    meetings = [proof["meets"] for proof in proofs if "meets" in proof]
    assert {len(meeting) for meeting in meetings} == {2, 3}  # at rational times, and at others


def test_without_the_flag_there_are_no_proofs(exported, tmp_path):
    scene = exported["tiny"].parent.parent / "tiny.json"
    text = successful("export", scene, "--queries", "--out", tmp_path).out
    assert "without proof" not in text and "check.py" not in text
    folder = tmp_path / "tiny"
    assert names_in(folder) == {"vertex-face.csv", "edge-edge.csv", "queries.json"}
    index = json.loads((folder / "queries.json").read_text(encoding="utf-8"))
    assert index["certificates"] is False and "proved" not in index["vertex_face"]
    outcome = run_program(sys.executable, ["-B", exported["tiny"] / "check.py", folder])
    assert outcome.exit_code == 1 and "exported without --certificates" in outcome.err


def test_a_sample_has_the_same_queries_with_and_without_proofs(exported, tmp_path):
    scene = exported["tiny"].parent.parent / "tiny.json"
    words = ["export", scene, "--queries", "--sample", "10"]
    text = successful(*words, "--certificates", "--out", tmp_path / "with").out
    successful(*words, "--out", tmp_path / "without")
    assert text.count(", 0 without proof\n") == 2
    assert f"to check them: python3 {tmp_path / 'with'}/" in text
    proved = Export(tmp_path / "with" / "tiny")
    assert proved.check().exit_code == 0
    for kind in KINDS:
        assert len(proved.proofs(kind)) == 10
        name = f"tiny/{kind}.csv"
        assert (tmp_path / "with" / name).read_bytes() == (tmp_path / "without" / name).read_bytes()


def test_the_flag_is_refused_without_queries(tmp_path):
    refused("export", "bunny-touch", "--certificates", named=["--certificates", "--queries"],
            folder=tmp_path)


# --- What is refused: the query, the list of proofs


@pytest.mark.parametrize("kind", KINDS)
def test_a_flipped_truth(tiny, kind):
    rows = tiny.lines(f"{kind}.csv")
    proofs = tiny.proofs(kind)
    for contact in (True, False):
        place = next(n for n, proof in enumerate(proofs) if is_apart(proof) != contact)
        flipped = [row[:-1] + "01"[not contact] for row in rows[8 * place:8 * place + 8]]
        tiny.write(f"{kind}.csv", rows[:8 * place] + flipped + rows[8 * place + 8:])
        tiny.is_refused(f"line {place + 1}: the truth is {int(not contact)}, the proof's is not")
    tiny.write(f"{kind}.csv", rows[:7] + [rows[7][:-1] + "2"] + rows[8:])
    tiny.is_refused("line 1: the truth is not 0, nor is it 1, on all its lines")
    tiny.write(f"{kind}.csv", rows)
    assert tiny.check().exit_code == 0


@pytest.mark.parametrize("kind", KINDS)
def test_a_moved_point(tiny, kind):
    # The vertex or the end of an edge is far away all the time: nothing meets any more.
    place = next(n for n, proof in enumerate(tiny.proofs(kind)) if not is_apart(proof))
    rows = tiny.lines(f"{kind}.csv")
    for point in range(8) if kind == "edge-edge" else (0, 4):
        rows[8 * place + point] = "100,1,0,1,0,1,1"
    tiny.write(f"{kind}.csv", rows)
    tiny.is_refused(f"line {place + 1}: the elements are not proven")


def test_a_checksum_of_another_file(tiny):
    proofs = tiny.folder / "edge-edge.certificates.jsonl"
    proofs.write_bytes(proofs.read_bytes() + b"null\n")
    tiny.is_refused("edge-edge.certificates.jsonl (", "is not the file that was exported")


def test_a_missing_file_and_a_missing_line(tiny):
    lines = tiny.lines("edge-edge.certificates.jsonl")
    tiny.write("edge-edge.certificates.jsonl", lines[:-1])
    tiny.is_refused("edge-edge.certificates.jsonl has not one line for eight of edge-edge.csv")
    (tiny.folder / "edge-edge.certificates.jsonl").unlink()
    tiny.is_refused("edge-edge.certificates.jsonl is missing")


def test_a_query_without_proof_is_counted(tiny):
    tiny.replace("vertex-face", 0, "null")
    tiny.is_refused("queries.json has other counts of proofs of vertex-face")
    index = tiny.index()
    index["vertex_face"]["proved"] -= 1
    index["vertex_face"]["unproved"] += 1
    tiny.write_index(index)
    outcome = tiny.check()
    assert outcome.exit_code == 0
    vertex_face, edge_edge = outcome.out.split("; ")
    assert vertex_face.endswith(", 1 without proof") and edge_edge.endswith(", 0 without proof\n")


def test_a_line_that_is_no_proof(tiny):
    for line in ("{", "[]", "0", '{"apart":[[1]]}', '{"apart":[[1,"faith"]]}', "{}"):
        tiny.replace("edge-edge", 2, line)
        tiny.is_refused("edge-edge.csv, line 17; edge-edge.certificates.jsonl, line 3: ")


# --- What is refused: pieces in which elements are apart


def test_pieces_that_end_too_early(tiny):
    def stop_early(proof):
        proof["apart"][-1][0] = 0.75
    tiny.change(lambda proof: is_apart(proof) and len(proof["apart"]) == 1, stop_early,
                "the pieces end at t = 0.75")


def test_a_piece_left_out(tiny):
    tiny.change(lambda proof: is_apart(proof) and proof["apart"], lambda proof: proof["apart"].pop(),
                "the pieces end at t = ")


def test_pieces_before_a_contact_left_out(tiny):
    tiny.change(lambda proof: "crosses" in proof and proof["apart"],
                lambda proof: proof["apart"].clear(), "the elements are not proven to cross")


def test_a_piece_that_goes_on_past_the_contact(tiny):
    def go_on(proof):
        proof["apart"][-1][0] = 1
    tiny.change(with_contact("crosses"), go_on, "the elements are not proven apart up to t = 1.0")


def test_pieces_out_of_order_or_beyond_the_step(tiny):
    for ends in ([0.5, 0.5, 1], [0.5, 0.25, 1], [-1, 1], [0, 1], [2]):
        def cut(proof, ends=ends):
            (_, *reason), = proof["apart"]
            proof["apart"] = [[end, *reason] for end in ends]
        tiny.change(lambda proof: is_apart(proof) and len(proof["apart"]) == 1, cut,
                    "the pieces do not follow one another in the step")


def test_another_direction(tiny):
    def turn(proof):
        piece = next(p for p in proof["apart"] if p[1] == "direction")
        piece[2:] = [0, 0, 0]
    tiny.change(with_reason("direction"), turn, "the elements are not proven apart up to t = ")


def test_the_opposite_direction(turning):
    def turn(proof):
        piece = next(p for p in proof["apart"] if p[1] == "direction")
        piece[2:] = [-x if isinstance(x, (int, float)) else x.removeprefix("-") if x[0] == "-"
                     else "-" + x for x in piece[2:]]
    turning.change(with_reason("direction"), turn, "the elements are not proven apart up to t = ")


def test_a_volume_in_planar_motion(turning):
    def claim(proof):
        proof["apart"][0][1:] = ["volume"]
    turning.change(lambda proof: proof["apart"], claim, "the elements are not proven apart up to t = ")


def test_another_side(turning):
    def with_line(*line):
        def claim(proof):
            piece = next(p for p in proof["apart"] if p[1] == "side")
            piece[2:] = line if len(line) == 3 else [line[0], *piece[3:]]
        return claim
    side = with_reason("side")
    turning.change(side, with_line(0), "the elements are not proven apart up to t = ")  # collapses
    # Points 0 and 3 are of both elements; a point that there is not; a point twice; no axis.
    for line in ([2, 0, 3], [2, -1, 3], [2, 0, 4], [3, 2, 3]):
        turning.change(side, with_line(*line), "no line of one element")
    turning.change(side, with_line(2, 2, 2), "the elements are not proven apart up to t = ")


# --- What is refused: contacts


def test_a_crossing_at_another_time(tiny):
    def move(by_start, by_end):
        def shift(proof):
            start, end, _ = proof["crosses"]
            proof["crosses"][:2] = [start + by_start, end + by_end]
        return shift
    width = 2.0 ** -41
    crossing, expected = with_contact("crosses"), "the elements are not proven to cross"
    tiny.change(crossing, move(width, width), expected)  # after the contact
    tiny.change(crossing, move(-width, -width), expected)  # in what was said to be apart
    tiny.change(crossing, move(0, 4 * width), expected)  # too wide
    tiny.change(crossing, move(2 * width, -2 * width), expected)  # backwards


def test_a_crossing_in_a_projection_that_collapses(tiny):
    def project(axis):
        def change(proof):
            proof["crosses"][2] = axis
        return change
    tiny.change(with_contact("crosses"), project(3), "the elements are not proven to cross")


def test_a_crossing_in_place_of_a_meeting(turning):
    def claim(proof):
        reached = proof["apart"][-1][0] if proof["apart"] else 0
        del proof["meets"]
        proof["crosses"] = [reached, reached + 2.0 ** -41, 2]
    turning.change(with_contact("meets"), claim, "the elements are not proven to cross")


def test_other_weights(tiny, turning):
    def weigh(change):
        def changed(proof):
            change(proof["meets"][1])
        return changed

    def swap(weights):
        weights[2], weights[3] = weights[3], weights[2]

    def twice(weights):
        weights[0] = weights[1] = 1

    def nothing(weights):
        weights[:] = [0, 0, 0, 0]

    def three(weights):
        weights.pop()

    expected = "the elements are not proven to meet"
    for export in (tiny, turning):
        for change in (swap, twice, nothing):
            export.change(lambda proof: "meets" in proof and proof["meets"][1][2] !=
                          proof["meets"][1][3], weigh(change), expected)
        export.change(with_contact("meets"), weigh(three), "no time and four weights")


def test_a_meeting_at_another_time(turning):
    def at_the_end(proof):
        proof["meets"][0] = 1

    def other_root(proof):
        proof["meets"][0][1] = proof["meets"][0][1].removeprefix("-") \
            if proof["meets"][0][1].startswith("-") else "-" + proof["meets"][0][1]

    def negative_root(proof):
        proof["meets"][2] = -5
    turning.change(with_contact("meets"), at_the_end, "the elements are not proven to meet")
    irrational = (lambda proof: "meets" in proof and len(proof["meets"]) == 3)
    turning.change(irrational, other_root, "the elements are not proven to meet")
    turning.change(irrational, negative_root, "no time and four weights")


def test_both_kinds_of_contact_or_none(tiny):
    def both(proof):
        proof["meets"] = [0, [1, 1, 0, 0]]
    tiny.change(with_contact("crosses"), both, "the truth is 1, the proof's is not")
    tiny.change(with_contact("crosses"), lambda proof: proof.pop("crosses"),
                "the truth is 1, the proof's is not")


# --- Proofs by hand, of queries at which a careless checker would go wrong. Points at rest are given
# --- once. The triangle is (0, 0, 0), (4, 0, 0), (0, 4, 0).

TRIANGLE = [((0, 0, 0),) * 2, ((4, 0, 0),) * 2, ((0, 4, 0),) * 2]


def write_query(export, kind, points, truth, proof):
    """Replaces all queries of this kind by this one."""
    rows = [",".join(f"{x},1" for x in point[time]) + f",{truth}"
            for time in (0, 1) for point in points]
    export.write(f"{kind}.csv", rows)
    export.write(f"{kind}.certificates.jsonl", [json.dumps(proof)])
    index = export.index()
    index[kind.replace("-", "_")].update(proved=1, unproved=0)
    export.write_index(index)


def accepts(export, kind, points, truth, proof):
    write_query(export, kind, points, truth, proof)
    outcome = export.check()
    assert outcome.exit_code == 0 or f"{kind}.csv, line 1; " in outcome.err, outcome.err
    return outcome.exit_code == 0


def test_crossings_by_hand(tiny):
    # At t = 1/3, through (1, 1, 0); beside the triangle at (9, 1, 0); through its edge; up and down.
    third = ["5555555555/10000000000", "5555555556/10000000000", 2]
    proof = {"apart": [[third[0], "volume"]], "crosses": third}

    def falls(x, y, end=-2, triangle=TRIANGLE):
        return [((x, y, 1), (x, y, end)), *triangle]
    assert accepts(tiny, "vertex-face", falls(1, 1), 1, proof)
    assert accepts(tiny, "vertex-face", falls(2, 2), 1, proof)
    assert not accepts(tiny, "vertex-face", falls(1, 1, -3), 1, proof)
    for triangle in (TRIANGLE, TRIANGLE[::-1]):
        for x, y in ((9, 1), (-1, 1), (1, -1), (1, 9)):
            assert not accepts(tiny, "vertex-face", falls(x, y, -2, triangle), 1, proof)
    for axis in (0, 1):  # in which the triangle is a segment
        assert not accepts(tiny, "vertex-face", falls(1, 1), 1,
                           {**proof, "crosses": [*third[:2], axis]})


def test_edges_that_cross_by_hand(tiny):
    third = ["5555555555/10000000000", "5555555556/10000000000", 2]
    proof = {"apart": [[third[0], "volume"]], "crosses": third}

    def falls(x, *ends):  # an edge along y, onto one from (0, 0, 0) to (4, 0, 0)
        return [((0, 0, 0),) * 2, ((4, 0, 0),) * 2, *(((x, y, 1), (x, y, -2)) for y in ends)]
    for ends in ((-1, 1), (1, -1)):
        assert accepts(tiny, "edge-edge", falls(1, *ends), 1, proof)
        assert accepts(tiny, "edge-edge", falls(4, *ends), 1, proof)
        assert not accepts(tiny, "edge-edge", falls(5, *ends), 1, proof)
        assert not accepts(tiny, "edge-edge", falls(-1, *ends), 1, proof)
    for ends in ((1, 2), (2, 1), (-1, -2), (-2, -1)):
        assert not accepts(tiny, "edge-edge", falls(1, *ends), 1, proof)


def test_meetings_by_hand(tiny):
    # In contact from t = 1/4 on, along x in the plane of the triangle.
    slides = [((-1, 1, 0), (3, 1, 0)), *TRIANGLE]
    before = [0.25 - 2.0 ** -41, "direction", -1, 0, 0]

    def meets(time, weights, last=before):
        return accepts(tiny, "vertex-face", slides, 1, {"apart": [last], "meets": [time, weights]})
    assert meets(0.25, [1, 0.75, 0, 0.25])
    assert not meets(0.25, [1, 0.75, 0, 0.75])
    assert not accepts(tiny, "vertex-face", slides, 1,  # in the plane at t = 0, and outside
                       {"apart": [], "meets": [0, [1, 1, -0.25, 0.25]]})
    assert not meets(0.25, [2, 1.5, 0, 0.5])  # of which the sum is 2
    assert not meets(0.25, [1, 0.5, 0, 0.25])  # of which it is 3/4, and the first corner is 0
    assert not meets(0.5, [1, 0.5, 0.25, 0.25])  # a contact, and not the first one
    assert not meets(0.25, [1, 0.75, 0, 0.25], [0.25, *before[1:]])  # apart until it meets, and then
    assert not meets(0.25, [1, 0.75, 0, 0.25], [0.25 - 2.0 ** -39, *before[1:]])  # not close enough


def test_contacts_before_the_step_by_hand(tiny):
    # Falls away from the triangle, in which it would have been at t = -1/3.
    points = [((1, 1, 1), (1, 1, 4)), *TRIANGLE]
    for apart in ([], [[0.5, "volume"]]):
        assert not accepts(tiny, "vertex-face", points, 1,
                           {"apart": apart, "meets": ["-1/3", [1, 0.5, 0.25, 0.25]]})
        assert not accepts(tiny, "vertex-face", points, 1,
                           {"apart": apart, "crosses": [-0.34, -0.33, 2]})


def test_sides_by_hand(tiny):
    # The vertex stays beyond the edge from (4, 0, 0) to (0, 4, 0).
    beside = [((0, 9, 0), (9, 9, 0)), *TRIANGLE]

    def apart(points, *line):
        return accepts(tiny, "vertex-face", points, 0, {"apart": [[1, "side", *line]]})
    assert apart(beside, 2, 2, 3)
    assert apart(beside, 2, 3, 2)
    for line in ((1, 2), (2, 1)):  # the third corner is on the same side
        assert not apart(beside, 2, *line)
    assert not apart([((1, 1, 0), (9, 9, 0)), *TRIANGLE], 2, 2, 3)  # only at the end
    assert not apart([((2, 2, 0), (9, 9, 0)), *TRIANGLE], 2, 2, 3)  # on the line at the start
    assert not apart([((1, -1, 0), (-1, 1, 0)), *TRIANGLE], 2, 2, 3)  # through the corner


def test_sides_of_edges_by_hand(tiny):
    def apart(*ends):  # of the second edge, along y at x = 1, from one from (0, 0, 0) to (4, 0, 0)
        points = [((0, 0, 0),) * 2, ((4, 0, 0),) * 2, *(((1, y, 0),) * 2 for y in ends)]
        return accepts(tiny, "edge-edge", points, 0, {"apart": [[1, "side", 2, 0, 1]]})
    for sign in (1, -1):
        assert apart(sign, 2 * sign)
        assert not apart(sign, -sign)
        assert not apart(0, sign)
        assert not apart(sign, 0)


def test_surds_by_hand(tiny):
    # The vertex (1 + t, 2) meets the edge from (0, 0) to (4, 3 + 2 t) where 2 t^2 + 5 t = 5, at
    # t = (sqrt(65) - 5) / 4; the other root is negative. The moving end has the weight (1 + t) / 4.
    points = [((1, 2, 0), (2, 2, 0)), ((0, 0, 0),) * 2, ((4, 3, 0), (4, 5, 0)), ((4, -9, 0),) * 2]
    first = (65 ** 0.5 - 5) / 4

    def meets(time, root, reached=first - 2.0 ** -42):
        weights = [[1, 0], ["11/10", "-1/10"], ["-1/10", "1/10"], [0, 0]]
        return accepts(tiny, "vertex-face", points, 1,
                       {"apart": [[reached, "side", 2, 1, 2]], "meets": [time, weights, root]})
    assert meets(["-5/4", "1/4"], 65)
    assert not meets(["-5/4", "1/4"], 65, first - 2.0 ** -30)  # not close enough
    assert not meets(["-5/4", "1/4"], 65, first + 2.0 ** -42)  # not apart until then
    assert not meets(["-5/4", "-1/4"], 65)
    assert not meets(["-5/4", "1/4"], 64)
    assert not meets(["-5/4", "1/4"], 66)
