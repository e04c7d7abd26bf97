import pytest

FEWEST_FOR_CORRELATION = FEWEST_SUMMED_SCENES = 10


def level_counts(truth, reported, hit, missed, spurious):
    return {"truth": truth, "reported": reported, "hit": hit, "missed": missed, "spurious": spurious,
            "recall": hit / truth, "spurious_rate": spurious / reported}


def speedup(ratio):
    ends = {"ratio": ratio, "low": ratio, "high": ratio}
    return {"playback": ends, "cold": None, "contact_frames": None, "without_map": None, "passes": 3,
            "interval": "range", "reference_options": {}}


@pytest.fixture
def run_of(sample):
    """A function: an untimed run of eight frames, judged by 10 pairs of triangles."""

    def run(scene, detector, missed=0):
        return {**sample["runs"][0], "scene": scene, "detector": detector, "frames": 8, "contact_frames": 4,
                "semantics": {"questions": ["triangles"], "levels": ["triangle"]},
                "per_frame": {**sample["runs"][0]["per_frame"], "level": "triangle"},
                "levels": {"triangle": level_counts(10, 10 - missed, 10 - missed, missed, 0)},
                "time_ms": {"prepare": 0.0}, "speedup": {}}

    return run


@pytest.fixture
def drawn(sample, run_of):
    """A function: scenes drawn-7-1 and on; every second one has contact. "fast" is (number) times as fast
    as fcl-aabb and half that over embree, so that more triangles are better for it; it misses one contact
    in the third scene."""
    varied = {"triangles": 0.0, "speed": 0.5}
    constant = ("bodies", "cells", "contact_share", "deformers", "distance", "frames", "size_ratio")
    phases = dict.fromkeys(("map", "update", "query", "contact_frame", "first_frame", "cpu"), 0.0)
    times = {"prepare": 0.0, "question": "triangles", "timed_frames": 8, "timed_contact_frames": 0,
             "passes": 3, "playback": {**phases, "frame": 1.0}}

    def results_of(count):
        results = {**sample, "scenes": [], "runs": [], "disagreements": []}
        for i in range(1, count + 1):
            scene = f"drawn-7-{i}"
            parameters = {**dict.fromkeys(constant, 1.0), **varied, "triangles": 100.0 * i}
            results["scenes"].append({
                **sample["scenes"][0], "id": scene, "frames": 8, "contact_frames": 0 if i % 2 == 0 else 4,
                "cold_frames": [], "drawn": {"seed": 7, "number": i, "redrawn": 0, "happens": "touch",
                                             "parameters": parameters}})
            results["runs"] += [
                {**run_of(scene, "fcl-aabb"), "time_ms": times,
                 "speedup": {"triangles": {"fcl-aabb": speedup(1.0)}}},
                {**run_of(scene, "fast", missed=int(i == 3)), "time_ms": times,
                 "speedup": {"triangles": {"fcl-aabb": speedup(i), "embree": speedup(0.5 * i)}}}]
        return results

    return results_of


@pytest.fixture
def section_of(markdown):
    return lambda results: markdown(results).split("## Drawn scenes\n\n")[1].split("\n## ")[0]


def test_are_no_section_where_none_was_drawn(markdown, drawn):
    results = drawn(1)
    assert "## Drawn scenes" in markdown(results)
    del results["scenes"][0]["drawn"]
    assert "## Drawn scenes" not in markdown(results)


def test_errors_with_and_without_contact_are_counted_apart(section_of, table_below, drawn):
    text = section_of(drawn(5))
    assert text.startswith("5 scenes drawn from seed 7, 3 with contact.\n")
    assert text.count("### Missed and spurious in ") == 2
    assert table_below(text, "### Missed and spurious in 3 scenes with contact") == [
        ["fcl-aabb", "3", "triangle", "30", "0", "1", "0", "0", "0", "-"],
        ["fast", "3", "triangle", "30", "1", "0.96666", "0", "0", "1", "-"]]
    without = table_below(text, "### Missed and spurious in 2 scenes without contact")
    assert without[1][0] == "fast"
    assert without[1][4] == "0"
    assert table_below(text, "### Scenes with wrong answers") == [["fast", "1", "drawn-7-3 (1 missed)", "-"]]


def test_sums_of_different_levels_are_apart(section_of, table_below, drawn):
    results = drawn(5)
    fast = results["runs"][1]
    fast["per_frame"]["level"] = "body"
    fast["levels"]["body"] = level_counts(4, 5, 4, 0, 1)
    rows = table_below(section_of(results), "### Missed and spurious in 3 scenes with contact")
    assert len(rows) == 3
    assert rows[1] == ["fast", "1", "body", "4", "0", "1", "1", "0.20000", "1", "-"]
    assert rows[2] == ["fast", "2", "triangle", "20", "1", "0.95000", "0", "0", "1", "-"]


def test_those_without_answer_are_no_score_and_are_said(section_of, table_below, drawn):
    results = drawn(5)
    results["runs"][1].update(status="error", message="signal 11")
    results["runs"][9].update(status="refused", message="flat")
    results["scenes"][4]["drawn"]["redrawn"] = 2
    results["scenes"][2]["unjudged"] = "too large"
    text = section_of(results)
    assert text.startswith(
        "5 scenes drawn from seed 7, 2 with contact. 1 of them was drawn again because a limit of time or "
        "memory ended the judging. 1 could not be judged within the limits and is left out below.\n")
    assert table_below(text, "### Missed and spurious in 2 scenes with contact")[1] == [
        "fast", "0", "-", "0", "0", "-", "0", "-", "0", "1 error, 1 refused"]
    assert table_below(text, "### Scenes with wrong answers") == [["fast", "1", "drawn-7-1 (error)", "-"]]


def test_speedups_are_median_tenth_percentile_and_worst(section_of, table_below, drawn):
    text = section_of(drawn(40))
    assert text.count("### Speed-ups in ") == 2
    # Ratios 1, 3, ..., 39, and half of that.
    assert table_below(text, "### Speed-ups in 20 scenes with contact") == [
        ["fast", "triangles", "fcl-aabb", "20", "20.0x", "3.00x", "1.00x", "drawn-7-1", "19"],
        ["fast", "triangles", "embree", "20", "10.0x", "1.50x", "0.500x", "drawn-7-1", "19"],
        ["fast", "triangles", "the fastest", "20", "10.0x", "1.50x", "0.500x", "drawn-7-1", "19"]]
    # Ratios 2, 4, ..., 40.
    without = table_below(text, "### Speed-ups in 20 scenes without contact")
    assert without[0][4] == "21.0x"
    assert without[0][6] == "2.00x"


def test_without_times_have_no_speedups(section_of, drawn):
    results = drawn(12)
    for run in results["runs"]:
        run.update(time_ms={"prepare": 0.0}, speedup={})
    text = section_of(results)
    assert "Missed and spurious in 6 scenes with contact" in text
    assert "Speed-ups" not in text
    assert "What decides" not in text


def sentences(text):
    """What is said below "What decides"."""
    part = text.split("### What decides\n\n")[1].split("\n#")[0]
    return [line.removeprefix("- ") for line in part.split("\n") if line]


def test_the_parameter_that_decides_is_named(section_of, table_below, drawn):
    text = section_of(drawn(30))
    assert sentences(text) == [
        "`fast` is faster than every reference in 28 of 30 scenes, median 7.75x; triangles per body decides "
        "most (rank correlation +1.00): median 2.75x up to 1000, 12.8x from 2100."]
    rows = table_below(text, "### Speed-ups against the parameters")
    assert len(rows) == 3
    # Of one parameter that varies: 1.96 / sqrt(29).
    assert rows[0] == ["fast", "fcl-aabb", "30", "0.36", "triangles per body +1.00",
                       "5.50x up to 1000, 25.5x from 2100"]


def test_what_may_be_chance_decides_nothing(section_of, drawn):
    results = drawn(12)
    for i, scene in enumerate(results["scenes"]):  # 0, 1, 2, 0, 1, ...: 0.17 by the ranks
        scene["drawn"]["parameters"]["triangles"] = float(i % 3)
    text = sentences(section_of(results))
    assert len(text) == 1
    assert "; no parameter decides: the strongest correlation, +" in text[0]
    assert " with triangles per body, may be chance." in text[0]


def test_few_scenes_show_no_correlation(section_of, drawn):
    text = section_of(drawn(FEWEST_FOR_CORRELATION - 1))
    assert sentences(text) == [
        "`fast` is faster than every reference in 7 of 9 scenes, median 2.50x; fewer than 10 scenes show no "
        "correlation."]
    assert "Speed-ups against the parameters" not in text


def test_many_are_shown_as_sums_alone(markdown, drawn):
    assert "\n## drawn-7-2\n" in markdown(drawn(FEWEST_SUMMED_SCENES - 1))
    assert "\n## drawn-7-2\n" not in markdown(drawn(FEWEST_SUMMED_SCENES))


def test_other_scenes_are_shown_with_many_drawn_ones(markdown, drawn, run_of):
    results = drawn(FEWEST_SUMMED_SCENES)
    results["scenes"].append({**results["scenes"][0], "id": "hello"})
    del results["scenes"][-1]["drawn"]
    results["runs"].append(run_of("hello", "fast"))
    assert "\n## hello\n" in markdown(results)


@pytest.fixture
def steps(drawn):
    """A function: as drawn, of scenes of two steps. Bodies meet in every second scene. "fast" is (number)
    times as fast as fcl-ccd and half that over embree-swept; in the third scene it misses a vertex and a
    triangle and lets a pair of bodies through; only it answers about bodies themselves."""

    def results_of(count):
        results = drawn(count)
        for i, scene in enumerate(results["scenes"], 1):
            scene["id"] = f"drawn-steps-7-{i}"
            meets = i % 2
            scene["truth"] = {"impact": meets, "impact-triangle": 10 * meets, "impact-vf": 4 * meets,
                              "impact-ee": 6 * meets, "impact-self-vf": 0}
            scene["impacts"] = {"motion": [0.5, 2.0], "starting": [0, 0], "passing": [meets, 0],
                                "new_triangles": 10 * meets, "passing_triangles": 0}
        for place, run in enumerate(results["runs"]):
            i, fast = place // 2 + 1, place % 2
            missed = int(fast and i == 3)
            run.update(scene=f"drawn-steps-7-{i}", detector="fast" if fast else "fcl-ccd",
                       semantics={"questions": ["impacts"], "levels": ["impact-vf", "impact"]})
            run["per_frame"]["level"] = "impact-vf"
            run["levels"] = {"impact": level_counts(1, 1, 1, 0, 0),
                             "impact-vf": level_counts(4, 4 - missed, 4 - missed, missed, 0)}
            run["impacts"] = {"tunnelled": [missed, 0], "timed": 1, "early_max": 0.25 * missed,
                              "late_max": None}
            run["time_ms"] = {**run["time_ms"], "question": "impacts"}
            run["speedup"] = {"impacts": {"fcl-ccd": speedup(i), "embree-swept": speedup(0.5 * i)}
                              if fast else {"fcl-ccd": speedup(1.0)}}
        return results

    return results_of


def test_steps_are_summed_by_level_with_and_without_impacts(section_of, table_below, steps):
    text = section_of(steps(5))
    assert text.startswith("5 scenes drawn from seed 7, 3 with impacts; 10 steps, in which 3 pairs of bodies "
                           "meet and touch at neither end.\n")
    assert ("True pairs: 3 bodies, 30 triangles, 12 vertex-face, 18 edge-edge, 0 self vf, 0 self ee. Errors "
            "are missed / spurious.") in text
    assert table_below(text, "### Missed and spurious in 3 scenes with impacts") == [
        ["fcl-ccd", "3", "0 / 0", "-", "0 / 0", "-", "-", "-", "0", "0", "-", "0", "-"],
        ["fast", "3", "0 / 0", "-", "1 / 0", "-", "-", "-", "1", "0.250", "-", "1", "-"]]
    without = table_below(text, "### Missed and spurious in 2 scenes without impacts")
    assert without[1][:3] == ["fast", "2", "0 / 0"]
    assert table_below(text, "### Scenes with wrong answers") == [
        ["fast", "1", "drawn-steps-7-3 (1 missed)", "-"]]


def test_steps_have_speedups_over_references_of_steps(section_of, table_below, steps):
    text = section_of(steps(40))
    # Ratios 1, 3, ..., 39, and half of that.
    assert table_below(text, "### Speed-ups in 20 scenes with impacts") == [
        ["fast", "impacts", "fcl-ccd", "20", "20.0x", "3.00x", "1.00x", "drawn-steps-7-1", "19"],
        ["fast", "impacts", "embree-swept", "20", "10.0x", "1.50x", "0.500x", "drawn-steps-7-1", "19"],
        ["fast", "impacts", "the fastest", "20", "10.0x", "1.50x", "0.500x", "drawn-steps-7-1", "19"]]
    assert table_below(text, "### Speed-ups in 20 scenes without impacts")[0][4] == "21.0x"
    assert sentences(text)[0].startswith("`fast` is faster than every reference in 38 of 40 scenes")


def test_steps_and_frames_are_summed_apart(section_of, steps, drawn):
    results, frames = steps(4), drawn(3)
    results["scenes"] += frames["scenes"]
    results["runs"] += frames["runs"]
    text = section_of(results)
    assert "3 scenes drawn from seed 7, 2 with contact." in text
    assert "4 scenes drawn from seed 7, 2 with impacts; 8 steps" in text


def test_many_steps_are_sums_alone(markdown, steps):
    assert "| drawn-steps-7-2 |" in markdown(steps(FEWEST_SUMMED_SCENES - 1)).split("## Between frames")[1]
    assert "drawn-steps-7-2 |" not in markdown(steps(FEWEST_SUMMED_SCENES)).split("## Drawn scenes")[0]
