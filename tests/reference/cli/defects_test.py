"""`contactcheck defects` on a family of hard cases, with a list of known defects that the test makes."""

import json

import pytest

from program import FIXTURES, contactcheck, names_in, successful

# Two segments in one plane, apart: FCL takes them for a contact at every value.
FAMILY = "hard-two-segments-plane"


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """The program's fixtures but for its lists of known defects."""
    hard = tmp_path / "fixtures" / "hard"
    hard.mkdir(parents=True)
    for name in ("scenes", "suites", "results.schema.json", "hard/families"):
        (tmp_path / "fixtures" / name).symlink_to(FIXTURES / name)
    monkeypatch.setenv("CONTACTCHECK_FIXTURES", str(tmp_path / "fixtures"))
    return tmp_path


def run(folder):
    successful("run", FAMILY, "--detector", "fcl-aabb", "--no-timing", "--out", folder / "out")
    return json.loads((folder / "out" / "results.json").read_text(encoding="utf-8"))


def defects(folder, *flags):
    return contactcheck("defects", folder / "out" / "results.json", *flags)


def written(folder):
    """What `defects --write` has just made of the results: one defect that nobody has explained."""
    outcome = defects(folder, "--write")
    assert outcome.exit_code == 0, outcome.err
    hard = folder / "fixtures" / "hard"
    assert json.loads((hard / "readings.json").read_text(encoding="utf-8")) == {"readings": []}
    defect, = json.loads((hard / "known-defects.json").read_text(encoding="utf-8"))["defects"]
    return defect


def list_only(folder, defect):
    (folder / "fixtures" / "hard" / "known-defects.json").write_text(json.dumps({"defects": [defect]}),
                                                                     encoding="utf-8")


def test_says_what_is_not_listed(folder):
    unlisted, = run(folder)["known_defects"]["unlisted"]
    assert (unlisted["detector"], unlisted["kind"]) == ("fcl-aabb", "spurious")
    outcome = defects(folder)
    assert outcome.exit_code == 1, outcome.err
    assert f"shown, not listed:\n  fcl-aabb  {FAMILY}  spurious  0: 1; 0.1: 1;" in outcome.out
    assert names_in(folder / "fixtures" / "hard") == {"families"}, "a list is written only when asked for"


def test_writes_what_shows_and_is_then_content(folder):
    run(folder)
    defect = written(folder)
    assert (defect["library"], defect["where"]) == ("fcl", "not looked into yet")
    outcome = defects(folder)
    assert outcome.exit_code == 0, outcome.out
    assert "show as listed, 0 with another count and 0 do not. 0 show that are not listed.\n" in outcome.out
    assert run(folder)["known_defects"]["unlisted"] == []


def test_says_what_does_not_show(folder):
    run(folder)
    defect = written(folder)
    value = next(iter(defect["seen"]["fcl-aabb"][FAMILY]))
    list_only(folder, {**defect, "kind": "missed", "seen": {"fcl-aabb": {FAMILY: {value: 5}}}})
    outcome = defects(folder)
    assert outcome.exit_code == 1, outcome.err
    assert f"listed, not shown:\n  fcl-aabb  {FAMILY}  missed  {value}: 5\n" in outcome.out


def test_says_which_count_changed(folder):
    run(folder)
    defect = written(folder)
    counts = defect["seen"]["fcl-aabb"][FAMILY]
    value = next(iter(counts))
    counts[value] = 40
    list_only(folder, defect)
    outcome = defects(folder)
    assert outcome.exit_code == 1, outcome.err
    assert (f"count changed (listed -> shown):\n  fcl-aabb  {FAMILY}  spurious  {value}: 40 -> 1\n"
            in outcome.out)
    assert len(run(folder)["known_defects"]["changed"]) == 1


def test_watches_refusals(folder):
    """One that is not listed, and a listed one that does not show any more."""
    results = run(folder)
    written(folder)
    frames = results["runs"][0]["frames"]
    results["runs"][0] = {"scene": FAMILY, "detector": "fcl-aabb", "status": "refused",
                          "message": "not this one", "frames": frames, "contact_frames": 0,
                          "failed_frame": 2}
    (folder / "out" / "results.json").write_text(json.dumps(results), encoding="utf-8")
    outcome = defects(folder)
    assert outcome.exit_code == 1, "it refuses what it answered"
    assert f"shown, not listed:\n  fcl-aabb  {FAMILY}  refused  " in outcome.out
    assert defects(folder, "--write").exit_code == 0
    assert defects(folder).exit_code == 0
    run(folder)
    outcome = defects(folder)
    assert outcome.exit_code == 1, "it answers what it refused"
    assert f"listed, not shown:\n  fcl-aabb  {FAMILY}  refused  " in outcome.out


def test_a_bad_list_ends_a_run_before_it_starts(folder):
    (folder / "fixtures" / "hard" / "known-defects.json").write_text("{}", encoding="utf-8")
    outcome = contactcheck("run", FAMILY, "--out", folder / "out")
    assert outcome.exit_code == 2
    assert 'known-defects.json": defects' in outcome.err
    assert not (folder / "out" / "results.json").exists()


def test_compares_ranges_of_the_suite_scales(folder):
    """They are listed by --write alone, and then any run says where its scenes lie."""
    (folder / "fixtures" / "scales").symlink_to(FIXTURES / "scales")
    successful("run", "size-gap-1", "--detector", "fcl-aabb", "--detector", "full-refit:precision=single",
               "--no-timing", "--out", folder / "out")
    outcome = defects(folder)
    assert outcome.exit_code == 1, outcome.err
    assert outcome.out.startswith("2 ranges of sizes and distances, not as listed (listed -> shown):\n"
                                  "  fcl-aabb  size  - -> 1 to 3e5 (all tried), ")
    assert defects(folder, "--write").exit_code == 0
    ours, = [row for row in json.loads((folder / "fixtures" / "hard" / "ranges.json").read_text("utf-8"))
             ["ranges"] if row["detector"] != "fcl-aabb"]
    assert (ours["library"], ours["version"], ours["by"]) == ("contactcheck", "any", "size")
    assert defects(folder).out == "2 ranges of sizes and distances, all as listed\n"

    successful("run", "small-pair", "--detector", "fcl-aabb", "--frames", "2", "--no-timing", "--out",
               folder / "other")
    results = json.loads((folder / "other" / "results.json").read_text(encoding="utf-8"))
    assert [row["detector"] for row in results["known_ranges"]] == ["fcl-aabb"]
    assert 0 < results["scenes"][0]["scale"]["shortest_edge"] < 1
    page = (folder / "other" / "report.md").read_text(encoding="utf-8")
    assert "| fcl-aabb | size | 1 to 3e5 (all tried) | small-pair (" in page
