"""Runs the recorded scenes and the sweep that fixtures/README.md shows, as a reader would.

Usage: recorded_readme_test.py PAGE CONTACTCHECK FOLDER
"""

import json
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

import recorded_frames

# Who is refused where a body has no lattice, says the page.
NEEDS_LATTICES = ("ffd-grid", "ffd-aabb")


class Reader:
    """Somebody with the page in hand, in a folder with frames and meshes."""

    def __init__(self, page, program, folder):
        self.text, self.program, self.folder = page.read_text(encoding="utf-8"), program, folder
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        recorded_frames.write(folder)
        for name in "ab":
            text = recorded_frames.obj_text(recorded_frames.ball(3 if name == "a" else 0),
                                            recorded_frames.BALL_FACES)
            (folder / f"{name}.obj").write_text(text)

    def scene(self, name):
        """The JSON of the page that is to be the file `name`."""
        blocks = re.findall(r"`%s`:\n\n```json\n(.*?)```" % re.escape(name), self.text, re.S)
        assert len(blocks) == 1, f"the page shows {len(blocks)} scenes {name}, not 1"
        return blocks[0]

    def run(self, name, text=None, detectors=()):
        """Results, and what was printed. The command is the page's where the scene is."""
        (self.folder / name).write_text(text or self.scene(name), encoding="utf-8")
        command = f"contactcheck run {name}"
        assert text or f"\n    {command}\n" in self.text, f"the page does not say: {command}"
        options = ["--no-timing", *(f"--detector {name}" for name in detectors)]
        printed = self.call(" ".join([command, *options]))
        return json.loads((self.folder / "out/results.json").read_bytes()), printed

    def call(self, command):
        words = [str(self.program), *shlex.split(command)[1:]]
        return subprocess.run(words, cwd=self.folder, check=True, stdout=subprocess.PIPE,
                              text=True).stdout

    def in_code(self, pattern):
        return re.findall(f"`({pattern})`", self.text)


def expect_statuses(results, refused):
    """All rows are ok, but for those of detectors whose names start as `refused` says."""
    names = [run["detector"] for run in results["runs"]]
    assert all(any(name.startswith(start) for name in names) for start in NEEDS_LATTICES), names
    for run in results["runs"]:
        wanted = "refused" if run["detector"].startswith(refused) else "ok"
        assert run["status"] == wanted, (run["detector"], run["status"], run["message"])


def expect_exact(results, detector):
    counts = next(r for r in results["runs"] if r["detector"] == detector)["levels"]["triangle"]
    assert counts["truth"] > 0, "the bodies never touch"
    assert counts["missed"] == counts["spurious"] == 0, counts


def check_frames_alone(reader):
    results, printed = reader.run("cloth.json")
    assert results["scenes"][0]["frames"] == recorded_frames.FRAMES
    assert 0 < results["scenes"][0]["contact_frames"] < recorded_frames.FRAMES
    expect_statuses(results, refused=NEEDS_LATTICES)
    expect_exact(results, "ffd-lazy")
    assert "fits" not in results["scenes"][0] and "fitted" not in printed
    return results["scenes"][0]["truth_hash"]


def check_caches(reader, truth_hash):
    """What the page says of caches, put into its scene: the same numbers, hence the same truth."""
    named = reader.in_code(r'"mesh": [^`]*"recording": {"cache": [^`]*')
    assert len(named) == 2 and ".pc2" in named[0] and ".mdd" in named[1], named
    for words in named:
        numbered = '"recording": {"frames": "cloth_%04d.obj"}'
        scene = reader.scene("cloth.json")
        assert numbered in scene
        results, _ = reader.run("cache.json", scene.replace(numbered, words), ["ffd-lazy"])
        assert results["scenes"][0]["truth_hash"] == truth_hash, words


def check_fit(reader):
    results, printed = reader.run("cloth-fit.json")
    expect_statuses(results, refused=())
    expect_exact(results, "ffd-aabb+tri")
    fits = results["scenes"][0]["fits"]
    assert [fit["body"] for fit in fits] == ["cloth", "ball"], fits
    assert all(len(fit[key]) == recorded_frames.FRAMES for fit in fits for key in ("rms", "max"))
    assert max(fits[0]["max"]) > 0, "the cloth sags as lattices cannot"
    above_the_table = reader.in_code(r"judged with lattices[^`]*")
    assert len(above_the_table) == 1 and above_the_table[0].split("...")[0] in printed, printed
    assert "Lattices fitted" in (reader.folder / "out/report.md").read_text(encoding="utf-8")
    return max(fits[0]["max"])


def check_what_changes_the_fit(reader, error):
    scene, lattice = reader.scene("cloth-fit.json"), '"lattice": {"kept": 150, "fit": true}'
    assert scene.count(lattice) == 2
    one_bare = re.sub(r",\s*" + re.escape(lattice), "", scene, count=1)
    expect_statuses(reader.run("bare.json", one_bare)[0], refused=NEEDS_LATTICES)
    finer, _ = reader.run("finer.json", scene.replace('"kept": 150', '"kept": 600'), ["ffd-lazy"])
    assert max(finer["scenes"][0]["fits"][0]["max"]) < error / 2, finer["scenes"][0]["fits"]


def check_exported_frames(reader):
    commands = reader.in_code("contactcheck export [^`]*")
    frames = reader.in_code(r'"frames": "out/export/[^`]*')
    assert len(commands) == 1 and len(frames) == 2, (commands, frames)
    reader.call(commands[0])
    scene = reader.scene("cloth.json")
    for own, exported in zip(('"cloth_%04d.obj"', '"ball_%04d.ply"'), frames):
        assert own in scene
        scene = scene.replace(f'"frames": {own}', exported)
    results, _ = reader.run("exported.json", scene, ["ffd-lazy"])
    assert [run["status"] for run in results["runs"]] == ["ok"], results["runs"]
    assert results["scenes"][0]["frames"] == 6
    expect_exact(results, "ffd-lazy")


def check_sweep(reader):
    results, _ = reader.run("gap.json")
    scene, sweep = results["scenes"][0], json.loads(reader.scene("gap.json"))["sweep"]
    expect_statuses(results, refused=())
    expect_exact(results, "ffd-lazy")
    wanted = [s for s in sweep["separations"] for _ in range(sweep["orientations"])]
    assert scene["frames"] == len(wanted) == 40
    for asked, found in zip(wanted, scene["separation"]):
        if asked > 0:
            assert abs(found - asked * scene["size"]) < 2e-6 * scene["size"], (asked, found)
    assert "spurious against separation" in (reader.folder / "out/report.md").read_text(encoding="utf-8")


def main():
    page, program, folder = (pathlib.Path(a).resolve() for a in sys.argv[1:4])
    reader = Reader(page, program, folder)
    check_caches(reader, check_frames_alone(reader))
    check_what_changes_the_fit(reader, check_fit(reader))
    check_exported_frames(reader)
    check_sweep(reader)


if __name__ == "__main__":
    main()
