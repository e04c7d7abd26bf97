// What the page says in words.
import assert from "node:assert/strict";
import {test} from "node:test";
import {useReport} from "./report.mjs";

const report = useReport("two_scenes.json");

async function findings(page) {
  const texts = await page.locator("dl.findings > *").allTextContents();
  return Object.fromEntries(
    texts.flatMap((text, i) => (i % 2 === 0 ? [[text, texts[i + 1]]] : [])),
  );
}

test("the title says how many were right", async () => {
  const {page} = await report.shared();
  assert.equal(
    await page.locator("h1").textContent(),
    "2 of 6 detectors have no missed and no spurious contacts in 2 scenes; 1 ended in status error",
  );
  assert.equal(
    await page.title(),
    "contactcheck: 2 of 6 detectors have no missed and no spurious contacts in 2 scenes; 1 ended in status error",
  );
});

test("the findings name who is exact, fastest, wrong and failed", async () => {
  const {page} = await report.shared();
  assert.deepEqual(await findings(page), {
    "No missed or spurious contacts": "At level triangle: fcl-aabb and ffd-lazy.",
    "Cheapest without errors":
      "ffd-lazy in all 2 scenes: 25.0 to 37.5x fcl-aabb, of all pairs of triangles, " +
      "0.0300 ms per frame.",
    Missed:
      "2 detectors did not report all true contacts: ffd-aabb 25.0 % (4 of 16, level cell) and " +
      "fcl-obbrss 6.3 % (1 of 16, level triangle).",
    Spurious:
      "2 detectors reported spurious contacts, at level cell: ffd-grid 41.7 % (10 of 24) " +
      "and ffd-aabb 11.1 % (1 of 9).",
    "Too early":
      "2 detectors reported contact of bodies farther apart than declared: ffd-grid 200 mm and ffd-aabb 12.5 mm.",
    "Depth, convex-pair": "Largest error: ffd-aabb 4.00 mm (mean 1.00).",
    Normal: "Largest error: ffd-aabb 90.0 degrees (mean 10.0).",
    "Ended in an error": "<img src=x onerror=alert(1)> in meet (<b>signal 11</b> in phase query).",
    "Not built": "<img src=x onerror=alert(1)>.",
    Goals: "1 of 3 goals of the suite is met; 1 goal could not be measured.",
  });
});

const unjudged = useReport("two_scenes.json", {
  change(results) {
    results.scenes[1].unjudged = "scene second: no progress";
    for (const run of results.runs)
      if (run.scene === results.scenes[1].id)
        Object.assign(run, {status: "error", message: "not judged"});
  },
});

test("a scene that could not be judged is nobody's error", async () => {
  const {page} = await unjudged.open();
  const said = await findings(page);
  assert.equal(said["Not judged"], "scene second: no progress.");
  assert.equal(
    said["Ended in an error"],
    "<img src=x onerror=alert(1)> in meet (<b>signal 11</b> in phase query).",
  );
  assert.match(
    await page.locator("h1").textContent(),
    /no missed and no spurious contacts in 1 scene; 1 ended in status error$/,
  );
});

test("command, machine and libraries are told", async () => {
  const {page} = await report.shared();
  const facts = page.locator("#machine");
  assert.match(await facts.textContent(), /contactcheck run "<i>mine<\/i>"\.json/);
  assert.match(await facts.textContent(), /example, 2 cores, AVX2, Debian 12/);
  assert.match(await facts.textContent(), /fcl 0\.7\.0/);
  assert.match(
    await facts.textContent(),
    /timing: 5 passes, each in a fresh process that has judged nothing. .*Cold: 2 frames of each scene after a sweep of 64 MiB/,
  );
});

const shard = useReport("two_scenes.json", {
  change: (results) => {
    results.shard = {
      index: 2,
      of: 3,
      command: "contactcheck run <b>all</b>",
      scenes: ["a", "b", "c", "d", "e"].map((id) => ({
        id,
        detectors: [],
        references: [],
        content: "",
      })),
      program: "0x1",
      settings: {timing: true},
      goals: [],
      files: {},
    };
  },
});

test("a shard is not taken for the whole run", async () => {
  const {page} = await shard.shared();
  assert.match(
    await page.locator("header").textContent(),
    /Shard 2 of 3: 2 of the 5 scenes of contactcheck run <b>all<\/b>; contactcheck merge puts the shards together\./,
  );
});

const merged = useReport("two_scenes.json", {
  change: (results) => {
    results.merged = ["contactcheck run --shard 1/2", "contactcheck run --shard 2/2"];
  },
});

test("merged results say so", async () => {
  const {page} = await merged.shared();
  assert.match(
    await page.locator("header").textContent(),
    /Put together from 2 shards \(contactcheck merge\)\./,
  );
});
