"""Lists of known defects that contactcheck defects refuses, and those of this repository."""

import json

import pytest

from program import EXAMPLE_RESULTS, FIXTURES, contactcheck

DEFECTS = """{
 "defects": [
  {
   "library": "fcl",
   "version": "0.7.0",
   "where": "overlap()",
   "upstream": "https://example.org/issues/502",
   "kind": "spurious",
   "sentence": "near is there",
   "seen": {
     "fcl-aabb": {
      "gap": {"0":1,"1e-9":1000000},
      "tip": {"2":3}},
     "fcl-obbrss": {
      "gap": {"0":2}}}
  },
  {
   "library": "fcl",
   "version": "0.7.0",
   "where": "loop()",
   "upstream": null,
   "kind": "error",
   "sentence": "it hangs",
   "seen": {
     "fcl-aabb": {
      "pile": {"-":1}}}
  }
 ]
}
"""


@pytest.fixture
def defects(tmp_path):
    """The outcome of the command with this list."""
    def outcome(text):
        (tmp_path / "hard").mkdir(exist_ok=True)
        (tmp_path / "hard" / "known-defects.json").write_text(text, encoding="utf-8")
        (tmp_path / "hard" / "readings.json").write_text('{"readings": []}', encoding="utf-8")
        if not (tmp_path / "results.schema.json").exists():
            (tmp_path / "results.schema.json").symlink_to(FIXTURES / "results.schema.json")
        return contactcheck("defects", EXAMPLE_RESULTS, env={"CONTACTCHECK_FIXTURES": str(tmp_path)})
    return outcome


def changed(*pairs):
    text = DEFECTS
    for old, new in pairs:
        assert old in text
        text = text.replace(old, new, 1)
    return text


def test_list_that_can_be_read_is_compared(defects):
    outcome = defects(DEFECTS)
    assert outcome.err == ""
    assert outcome.out != ""


@pytest.mark.parametrize("text, named", [
    ("{", "known defects"),
    (changed(('"spurious"', '"odd"')),
     'defects[0].kind is "odd"; it must be one of missed, spurious, error, refused.'),
    (changed(('"where": "overlap()",', "")), "defects[0].where is missing"),
    (changed(('"upstream": null,', "")), "defects[1].upstream is missing"),
    (changed(("null", '"502"')), 'defects[1].upstream is "502"; it must be the address'),
    (changed(('"library": "fcl"', '"library": "contactcheck"')),
     'defects[0].library is "contactcheck"; it must be another\'s'),
    (changed(('"0":1,', '"0":1,"0":2,')), "defects[0].seen.fcl-aabb.gap.0 is given"),
    (changed(('"2":3', '"2":0')), "defects[0].seen.fcl-aabb.tip.2 is 0"),
    (changed(('"2":3', '"2":true')), "defects[0].seen.fcl-aabb.tip.2 is true"),
    (changed(('{"2":3}', "{}")), "defects[0].seen.fcl-aabb.tip is an object"),
    (changed(('"-":1', '"-":2')),
     "defects[1].seen.fcl-aabb.pile.- is 2; it must be a whole number from 1 to 1."),
    # Of the form without counts.
    (changed(('"where": "overlap()"', '"issue": "502"')),
     'defects[0].issue is of the list without counts; "where" and "upstream" must stand in its place.'),
    (changed(('{"2":3}', '["2"]')), "defects[0].seen.fcl-aabb.tip lists cases without their counts; it must "
                                    "be an object of counts by case.")])
def test_list_that_cannot_be_read_is_refused_with_the_place(defects, text, named):
    outcome = defects(text)
    assert (outcome.exit_code, outcome.out) == (2, "")
    assert named in outcome.err
    assert outcome.err.count("\n") == 1


def test_detector_scene_and_kind_have_one_cause(defects):
    twice = [('"kind": "error"', '"kind": "spurious"'), ('"pile": {"-":1}', '"gap": {"1e-3":1}')]
    assert defects(changed(*twice)).exit_code == 2
    before, _, after = changed(*twice).rpartition("0.7.0")
    assert defects(f"{before}0.8.0{after}").err == ""


def test_defects_of_this_repository_are_explained():
    lists = {name: json.loads((FIXTURES / "hard" / f"{file}.json").read_text(encoding="utf-8"))[name]
             for name, file in (("defects", "known-defects"), ("readings", "readings"))}
    assert lists["defects"] and lists["readings"]
    for defect in [*lists["defects"], *lists["readings"]]:
        assert "not looked into yet" not in (defect["where"], defect["sentence"])
