"""`contactcheck ab` on two stand-ins for builds of the program: scripts that copy prepared results, so
that no test depends on the machine's speed.
"""

import json

import pytest

from program import EXAMPLE_RESULTS, contactcheck, successful

ROUNDS = 7

# Writes its name and words into `order`, counts its runs, and copies NAME-RUN.json to the folder behind
# --out.
SCRIPT = """#!/bin/sh
here=$(dirname "$0")
name=$(basename "$0")
echo "$name $*" >> "$here/order"
while [ $# -gt 0 ]; do
  [ "$1" = --out ] && out=$2
  shift
done
run=$(cat "$here/$name.count" 2> /dev/null || echo 0)
echo $((run + 1)) > "$here/$name.count"
mkdir -p "$out" && cp "$here/$name-$run.json" "$out/results.json" || exit 1
"""

# Both builds share a drift, and each has noise of a few percent.
DRIFT = (1.0, 1.4, 0.9, 1.1, 2.0, 1.0, 1.3)
NOISE = {"base": (1.00, 1.03, 0.98, 1.02, 0.99, 1.01, 0.97),
         "head": (1.01, 0.98, 1.02, 0.99, 1.03, 0.97, 1.00)}


def unchanged(results):
    pass


def build(folder, name, *, slower=1.0, change=unchanged, end=""):
    """The path of a stand-in; `end` is what its script does last."""
    for number in range(ROUNDS):
        results = json.loads(EXAMPLE_RESULTS.read_text(encoding="utf-8"))
        times = results["runs"][0]["time_ms"]
        for regime in ("playback", "cold"):
            times[regime] = {phase: ms and 10 * slower * DRIFT[number] * NOISE[name][number] * ms
                             for phase, ms in times[regime].items()}
        change(results)
        (folder / f"{name}-{number}.json").write_text(json.dumps(results), encoding="utf-8")
    script = folder / name
    script.write_text(SCRIPT + end, encoding="utf-8")
    script.chmod(0o700)
    return script


def ab(folder, *more, run=contactcheck, **head):
    """The outcome of comparing a base with the head that these keywords of build() describe."""
    return run("ab", build(folder, "base"), build(folder, "head", **head), "--quiet", "--out",
               folder / "out", *more)


def contacts_changed(results):
    results["runs"][0]["contact_hash"] = "0xdead"


def test_noise_alone_passes(tmp_path):
    outcome = ab(tmp_path, run=successful)
    assert outcome.err == ""
    assert "PASS: " in outcome.out
    assert "Slower" not in outcome.out


def test_thirty_percent_slower_fails_and_names_the_detector(tmp_path):
    outcome = ab(tmp_path, slower=1.3)
    assert outcome.exit_code == 1, outcome.err
    assert "Slower than 1.10x (1)\n  hello  ffd-aabb-sphere2  1.3" in outcome.out
    assert "FAIL: " in outcome.out


@pytest.mark.parametrize("option", [("--slower-than", "1.5"), ("--floor-us", "1e6")],
                         ids=["slower_than", "floor_us"])
def test_limit_and_floor_are_options(tmp_path, option):
    assert "PASS: " in ab(tmp_path, *option, slower=1.3, run=successful).out


def test_builds_run_in_turns_with_the_same_words(tmp_path):
    ab(tmp_path, "hello", "--detector", "ffd-lazy", "--frames", "4", run=successful)
    order = (tmp_path / "order").read_text(encoding="utf-8").splitlines()
    assert order == [f"{name} run --quiet --processes 1 --frames 4 --detector ffd-lazy "
                     f"--out {tmp_path / 'out' / name} hello"
                     for name in ["base", "head", "head", "base"] * 3 + ["base", "head"]]


def test_changed_contacts_fail(tmp_path):
    outcome = ab(tmp_path, change=contacts_changed)
    assert outcome.exit_code == 1, outcome.err
    assert ("Other answers, base -> head (1)\n"
            "  hello  ffd-aabb-sphere2  contact hash ") in outcome.out
    assert "-> 0xdead\n" in outcome.out


def test_changed_contacts_pass_where_they_may(tmp_path):
    ab(tmp_path, "--accuracy-may-change", change=contacts_changed, run=successful)


def test_one_missed_contact_fails(tmp_path):
    def miss(results):
        results["runs"][0]["levels"]["body"]["missed"] = 1

    outcome = ab(tmp_path, change=miss)
    assert outcome.exit_code == 1, outcome.err
    assert "body missed 0 -> 1" in outcome.out


def test_detector_that_one_side_lacks_is_named(tmp_path):
    outcome = ab(tmp_path, change=lambda results: results["runs"].pop(3), run=successful)
    assert "Only in base (1)\n  detector " in outcome.out


def test_program_that_fails_is_one_sentence_with_its_last_words(tmp_path):
    outcome = ab(tmp_path, end="echo 'no such scene' >&2; exit 2\n")
    assert outcome.exit_code == 2
    assert outcome.err == f'contactcheck: head "{tmp_path / "head"}" ended in exit code 2: no such scene\n'


def test_errors_in_rows_are_no_failure_of_the_program(tmp_path):
    base, head = build(tmp_path, "base", end="exit 3\n"), build(tmp_path, "head", end="exit 3\n")
    successful("ab", base, head, "--quiet", "--out", tmp_path / "out")


def test_program_that_leaves_no_results_is_refused(tmp_path):
    outcome = ab(tmp_path, end='rm "$out/results.json"\n')
    assert outcome.exit_code == 2
    assert str(tmp_path / "out" / "head" / "results.json") in outcome.err


@pytest.mark.parametrize("other", ["text", ".", "/nonexistent"])
def test_what_is_no_program_is_refused_before_anything_runs(tmp_path, other):
    (tmp_path / "text").write_text("words", encoding="utf-8")
    head = tmp_path / other
    outcome = contactcheck("ab", build(tmp_path, "base"), head, "--quiet", "--out", tmp_path / "out")
    assert outcome.exit_code == 2
    assert outcome.err == f'contactcheck: head "{head}" is not a program that can be run\n'
    assert not (tmp_path / "order").exists()


def test_github_gets_annotations_and_a_summary_behind_what_is_there(tmp_path, monkeypatch):
    summary = tmp_path / "summary.md"
    summary.write_text("# Before\n", encoding="utf-8")
    monkeypatch.setenv("GITHUB_STEP_SUMMARY", str(summary))
    outcome = ab(tmp_path, "--github", slower=1.3)
    assert outcome.exit_code == 1, outcome.err
    assert ("\n::error title=contactcheck ab::slower than 1.10x: hello  ffd-aabb-sphere2  1.3"
            in outcome.out)
    text = summary.read_text(encoding="utf-8")
    assert text.startswith("# Before\n## contactcheck ab\n\nFAIL: ")
    assert "| **slower** |\n" in text


def test_github_without_its_file_is_refused_before_anything_runs(tmp_path, monkeypatch):
    monkeypatch.delenv("GITHUB_STEP_SUMMARY", raising=False)
    outcome = ab(tmp_path, "--github")
    assert outcome.exit_code == 2
    assert "GITHUB_STEP_SUMMARY" in outcome.err
    assert not (tmp_path / "order").exists()


# In its fourth run it kills the program that has started it, once.
KILLS_ONCE = """
[ "$run" = 3 ] && [ ! -e "$here/killed" ] && touch "$here/killed" && kill -9 $PPID
exit 0
"""


def killed(folder):
    """The words of a comparison that was killed in its fourth round."""
    words = ["ab", build(folder, "base"), build(folder, "head", slower=1.3, end=KILLS_ONCE), "--out", folder / "out"]
    assert contactcheck(*words).exit_code == 128 + 9
    return words


def test_goes_on_with_the_round_that_was_interrupted(tmp_path):
    words = killed(tmp_path)
    before = len((tmp_path / "order").read_text().splitlines())
    (tmp_path / "head.count").write_text("3\n")  # what that round would have got
    outcome = contactcheck(*words, "--resume")
    assert outcome.exit_code == 1, outcome.err
    assert outcome.err.startswith("resumed: 3 of 7 rounds\nround 4 of 7\n")
    assert len((tmp_path / "order").read_text().splitlines()) - before == 8, "four rounds of two"
    assert "Slower than 1.10x (1)\n  hello  ffd-aabb-sphere2  1.3" in outcome.out
    assert not (tmp_path / "out" / "kept-rounds").exists()


def test_refuses_to_discard_rounds(tmp_path):
    words = killed(tmp_path)
    assert ("a comparison that did not end has left 3 whole rounds there: --resume takes them over, --overwrite "
            "discards them") in contactcheck(*words).err
    (tmp_path / "base").write_text(SCRIPT + "true\n", encoding="utf-8")
    other = contactcheck(*words, "--resume")
    assert other.exit_code == 2
    assert "of another one (other base): contactcheck ab " in other.err
    assert (tmp_path / "out" / "kept-rounds" / "3.json").exists()
    for name in ("base", "head"):
        (tmp_path / f"{name}.count").unlink()
    outcome = contactcheck(*words, "--overwrite")
    assert outcome.exit_code == 1, outcome.err
    assert outcome.err.startswith("round 1 of 7\n")


def test_leaves_what_others_have_put_into_its_folder(tmp_path):
    theirs = tmp_path / "out" / "kept-rounds" / "notes.txt"
    theirs.parent.mkdir(parents=True)
    theirs.write_text("mine", encoding="utf-8")
    assert ab(tmp_path).exit_code == 0
    assert theirs.read_text(encoding="utf-8") == "mine"
    assert len(list(theirs.parent.iterdir())) == 1
