"""Which files `contactcheck check` takes for the frames of one body, told by their names."""

import json

import pytest

from meshes import box, obj_text
from program import contactcheck


def write(folder, names):
    """Files of one box; those of a name that is given twice are the same."""
    mesh = obj_text(box(1))
    for name in names:
        file = folder / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(mesh, encoding="utf-8")


def check(folder, names, *more):
    write(folder, names)
    return contactcheck("check", *names, *more, "--allow", "contact", "--out", folder / "out", cwd=folder)


def start_of(outcome):
    assert outcome.exit_code == 0, outcome.err
    return json.loads(outcome.out.splitlines()[0])


def numbered(pattern, *numbers):
    return [pattern.format(number) for number in numbers]


# Names, then bodies with the number of frames, and what is not checked.
READ = {
    "one_sequence": (numbered("cloth_{:04}.obj", 0, 1, 2), ["cloth"], 3, []),
    "numbers_without_zeros": (numbered("cloth_{}.obj", 9, 10, 11), ["cloth"], 3, []),
    "numbers_with_fewer_zeros": (["cloth_9.obj", "cloth_010.obj"], ["cloth"], 2, []),
    "numbers_behind_a_dot": (numbered("cloth.{}.obj", 1, 2), ["cloth"], 2, []),
    "numbers_alone": (numbered("{}.obj", 1, 2), ["body"], 2, []),
    "numbers_in_steps": (numbered("cloth_{}.obj", 10, 20, 30), ["cloth"], 3, []),
    "very_long_numbers": (numbered("cloth_{}.obj", 99999999999999999999, 100000000000000000000), ["cloth"], 2, []),
    "negative_numbers": (numbered("cloth.{}.obj", -2, -1, 0, 1), ["cloth"], 4, []),
    "negative_numbers_alone": (numbered("cloth_{}.obj", -2, -1), ["cloth"], 2, []),
    "hyphens": (numbered("cloth-{}.obj", 1, 2), ["cloth"], 2, []),
    "times": (["cloth_t0.0.obj", "cloth_t0.5.obj", "cloth_t1.0.obj"], ["cloth"], 3, []),
    "irregular_times": (["cloth_time_0.25.obj", "cloth_time_0.3.obj", "cloth_time_10.0.obj"], ["cloth"], 3, []),
    "percent_in_names": (numbered("50%_{}.obj", 1, 2), ["50%"], 2, []),
    "extensions_in_either_case": (["s_0.OBJ", "s_1.obj"], ["s"], 2, []),
    "words_for_frames": (numbered("frame{}.obj", 1, 2), ["body"], 2, []),
    "words_for_frames_before_the_body": (
        [f"frame_{f}_ball_{b}.obj" for f in (0, 1, 2) for b in (0, 1)], ["ball_0", "ball_1"], 3, []),
    "words_for_frames_behind_the_body": (
        [f"body{b}_frame{f}.obj" for b in (1, 2, 3) for f in (0, 1)], ["body1", "body2", "body3"], 2, []),
    "zeros_tell_the_frame": (
        [f"ball{b}_{f:04}.obj" for b in (1, 2, 3) for f in (0, 1)], ["ball1", "ball2", "ball3"], 2, []),
    "a_folder_a_frame": (numbered("frame_{:03}/cloth.obj", 0, 1, 2), ["cloth"], 3, []),
    "a_folder_a_frame_of_two": (
        [f"step{f}/{b}.obj" for f in (0, 1) for b in ("cloth", "ball")], ["cloth", "ball"], 2, []),
    "a_folder_a_body": (
        [f"{b}/frame_{f}.obj" for b in ("left", "right") for f in (0, 1)], ["left", "right"], 2, []),
    "a_body_at_rest": ([*numbered("cloth_{}.obj", 0, 1), "ground.obj"], ["cloth", "ground"], 2, []),
    "a_body_of_one_number": ([*numbered("cloth_{}.obj", 0, 1), "ground_7.obj"], ["cloth", "ground_7"], 2, []),
    "a_body_of_one_of_their_numbers": (
        ["body1_frame0.obj", "body1_frame1.obj", "body5_frame0.obj"], ["body1", "body5"], 2, []),
    "unequal_length": ([*numbered("a_{}.obj", 0, 1), *numbered("b_{}.obj", 0, 1, 2)], ["a", "b"], 2, ["b_2.obj"]),
    "from_0_and_from_1": (
        [*numbered("a_{}.obj", 0, 1, 2), *numbered("b_{}.obj", 1, 2, 3)], ["a", "b"], 2, ["a_0.obj", "b_3.obj"]),
    "other_steps": (
        [*numbered("a_{}.obj", 0, 2, 4), *numbered("b_{}.obj", 2, 3, 4)], ["a", "b"], 2, ["a_0.obj", "b_3.obj"]),
    "one_file_twice": (["cloth_0.obj", "cloth_0.obj"], ["cloth_0", "cloth_0-2"], 1, []),
}


@pytest.mark.parametrize(("names", "bodies", "frames", "unchecked"), READ.values(), ids=READ.keys())
def test_reads(tmp_path, names, bodies, frames, unchecked):
    start = start_of(check(tmp_path, names, "--json-lines"))
    assert [body["name"] for body in start["bodies"]] == bodies
    assert start["frames"] == frames
    assert start["unchecked"] == unchecked


REFUSED = {
    "numbers_behind_letters": (
        ["ball1.obj", "ball2.obj"],
        "\"ball1.obj\" and \"ball2.obj\" differ in a number with two readings: --frames 'ball{frame}.obj' if it "
        "counts frames of one body, --frames 'ball{body}.obj' if it counts bodies"),
    "folders": (
        ["run1/cloth.obj", "run2/cloth.obj", "run3/cloth.obj"],
        "\"run1/cloth.obj\" and 2 more files differ in a number with two readings: --frames "
        "'run{frame}/cloth.obj' if it counts frames of one body, --frames 'run{body}/cloth.obj' if it counts "
        "bodies"),
    "two_numbers": (
        [f"ball_{b}_{f}.obj" for b in (0, 1) for f in (0, 1, 2)],
        "\"ball_0_0.obj\" and 5 more files differ in several numbers with two readings: --frames "
        "'ball_{frame}_{body}.obj', or --frames 'ball_{body}_{frame}.obj'"),
    "decimals_without_a_word": (
        ["cloth_0.0.obj", "cloth_0.5.obj", "cloth_1.0.obj", "cloth_1.5.obj"], "--frames 'cloth_{frame}.obj'"),
    "hyphens_and_none": (["cloth-1.obj", "cloth0.obj", "cloth1.obj"], "with a hyphen or with a sign"),
    "one_number_twice": (["cloth_1.obj", "cloth_01.obj", "cloth_2.obj"], "are one frame of one body"),
    "a_gap": (numbered("cloth_{}.obj", 8, 10, 11), "go from 10 to 11, and before in steps of 2; all steps must be alike"),
    "no_common_number": (
        [*numbered("a_{}.obj", 0, 1), *numbered("b_{}.obj", 5, 6)], "no frame is one of all bodies"),
}


@pytest.mark.parametrize(("names", "sentence"), REFUSED.values(), ids=REFUSED.keys())
def test_refuses_what_has_two_readings(tmp_path, names, sentence):
    outcome = check(tmp_path, names)
    assert outcome.exit_code == 2
    assert sentence in outcome.err


CHOSEN = {
    "frames": (["ball1.obj", "ball2.obj"], ["ball{frame}.obj"], ["ball"], 2),
    "bodies": (["ball1.obj", "ball2.obj"], ["ball{body}.obj"], ["ball1", "ball2"], 1),
    "folders_as_frames": (["run1/cloth.obj", "run2/cloth.obj"], ["run{frame}/cloth.obj"], ["cloth"], 2),
    "folders_as_bodies": (["run1/cloth.obj", "run2/cloth.obj"], ["run{body}/cloth.obj"], ["run1", "run2"], 1),
    "first_number": ([f"b_{b}_{f}.obj" for b in (0, 1) for f in (0, 1, 2)], ["b_{frame}_{body}.obj"],
                     ["b_0", "b_1", "b_2"], 2),
    "last_number": ([f"b_{b}_{f}.obj" for b in (0, 1) for f in (0, 1, 2)], ["b_{body}_{frame}.obj"],
                    ["b_0", "b_1"], 3),
    "decimals": (["cloth_0.0.obj", "cloth_0.5.obj", "cloth_1.0.obj"], ["cloth_{frame}.obj"], ["cloth"], 3),
    "signs": (["cloth-1.obj", "cloth0.obj", "cloth1.obj"], ["cloth{frame}.obj"], ["cloth"], 3),
    "two_patterns": (["a1.obj", "a2.obj", "b1.obj", "b2.obj"], ["a{frame}.obj", "b{body}.obj"],
                     ["a", "b1", "b2"], 2),
    "the_rest_stands_still": (["a1.obj", "a2.obj", "c_1.obj", "c_2.obj"], ["a{frame}.obj"], ["a", "c_1", "c_2"], 2),
    "letters_of_patterns": (["a+b(1).obj", "a+b(2).obj"], ["a+b({frame}).obj"], ["a+b"], 2),
}


@pytest.mark.parametrize(("names", "patterns", "bodies", "frames"), CHOSEN.values(), ids=CHOSEN.keys())
def test_takes_the_reading_that_it_is_told(tmp_path, names, patterns, bodies, frames):
    words = [word for pattern in patterns for word in ("--frames", pattern)]
    start = start_of(check(tmp_path, names, *words, "--json-lines"))
    assert [body["name"] for body in start["bodies"]] == bodies
    assert start["frames"] == frames


@pytest.mark.parametrize(("pattern", "sentence"), [
    ("cloth.obj", "must have {frame} once, or {body} for bodies at rest"),
    ("{frame}_{frame}.obj", "must have {frame} once"),
    ("c_{frame}.obj", "\"c_{frame}.obj\" matches no file")], ids=["no_place", "twice", "unused"])
def test_refuses_patterns_that_say_nothing(tmp_path, pattern, sentence):
    outcome = check(tmp_path, ["a_1.obj", "a_2.obj"], "--frames", pattern)
    assert outcome.exit_code == 2
    assert sentence in outcome.err


def test_names_files_of_frames_that_not_every_body_has(tmp_path):
    outcome = check(tmp_path, [*numbered("a_{}.obj", 0, 1), *numbered("b_{}.obj", *range(8))])
    assert outcome.exit_code == 0, outcome.err
    assert ("not checked, because not every body has that frame: b_2.obj, b_3.obj, b_4.obj, b_5.obj and 2 more "
            "files\n2 frames\n" in outcome.out)
