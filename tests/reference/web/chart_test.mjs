// The chart of speed against error, and the other charts' bars.
import assert from "node:assert/strict";
import {test} from "node:test";
import {kNarrow, settled} from "./browser.mjs";
import {judgeByBodiesAlone, labelsOf, tableTexts, unfold, useReport} from "./report.mjs";

const report = useReport("two_scenes.json");
// Two scenes of one size; one detector is judged by cells in the first, by bodies alone in the second.
const mixed = useReport("two_scenes.json", {
  change(results) {
    judgeByBodiesAlone(results, results.scenes[1].id, "ffd-aabb");
    results.scenes[1].bodies = results.scenes[0].bodies;
  },
});
const kTable = "Points of the chart of speed against error";

const section = (page) => page.locator("#speed-error");
const labels = (page) =>
  section(page)
    .locator(".points [aria-label]")
    .evaluateAll((all) => all.map((point) => point.getAttribute("aria-label").split("\n")));
const front = (lines) =>
  lines
    .slice(1)
    .filter((line) => line[11] === "yes")
    .map((line) => line[0]);

async function choose(page, label, option) {
  await section(page).getByRole("combobox", {name: label}).selectOption(option);
  await settled(page);
}

async function pointsTable(page) {
  await unfold(page, section(page).getByText("The same as a table"));
  return tableTexts(page, kTable);
}

test("every detector that was timed and judged in all scenes is a point", async () => {
  const {page} = await report.shared();
  const points = await labels(page);
  assert.deepEqual(
    points.map(([first]) => first),
    [
      "fcl-aabb: 1.00 ms per frame (question triangles)",
      "fcl-obbrss: 20.0 ms per frame (question triangles)",
      "ffd-lazy: 0.0300 ms per frame (question triangles)",
      "ffd-aabb: 0.100 ms per frame (question cells)",
      "ffd-grid: 0.200 ms per frame (question cells)",
    ],
  );
  assert.deepEqual(points[3].slice(1), [
    "missed 4 of 16, spurious 1 of 9 (level cell)",
    "options: bounds=paper",
  ]);
  assert.match(
    await section(page).locator(".note").textContent(),
    /^Not in the chart: <img src=x onerror=alert\(1\)> \(ended well in 0 of 2 scenes\)\.$/,
  );
});

const timedBySelf = useReport("two_scenes.json", {
  change({runs}) {
    for (const run of runs)
      if (run.detector === "ffd-grid" && run.time_ms) run.time_ms.question = "self";
  },
});

test("points of the question self have a shape of their own, and the legend names it", async () => {
  // They were circles, as those of the question triangles.
  const {page} = await timedBySelf.shared();
  const outline = (detector) =>
    section(page).locator(`.points [aria-label^="${detector}:"]`).first().getAttribute("d");
  assert.match(await outline("ffd-grid"), /^M0,5\.5L5\.5,-4\.5L-5\.5,-4\.5Z$/);
  assert.match(await outline("ffd-aabb"), /^M0,-5\.5L5\.5,4\.5L-5\.5,4\.5Z$/);
  assert.match(await outline("ffd-lazy"), /A/);
  const text = await section(page).textContent();
  for (const words of [
    "all pairs of triangles",
    "all pairs of cells",
    "contacts of bodies with themselves",
  ])
    assert.ok(text.includes(`timed: ${words}`), words);
  assert.ok(!text.includes("timed: which bodies touch"));
});

test("where there are few points, each has its name", async () => {
  const {page} = await report.shared();
  const names = await section(page).locator(".names text").allTextContents();
  assert.deepEqual(names.sort(), ["fcl-aabb", "fcl-obbrss", "ffd-aabb", "ffd-grid", "ffd-lazy"]);
});

test("the front holds who is not beaten in the same question", async () => {
  const {page} = await report.open();
  const lines = await pointsTable(page);
  assert.deepEqual(lines[3], [
    "ffd-lazy",
    "-",
    "triangles",
    "0.0300",
    "5",
    "triangle",
    "16",
    "0",
    "16",
    "0",
    "0",
    "yes",
  ]);
  assert.deepEqual(lines[4], [
    "ffd-aabb",
    "bounds=paper",
    "cells",
    "0.100",
    "5",
    "cell",
    "16",
    "4",
    "9",
    "1",
    "0.25000",
    "yes",
  ]);
  assert.deepEqual(front(lines), ["ffd-lazy", "ffd-aabb"]);
  assert.equal(await section(page).locator(".fronts path").count(), 2);
});

test("another measure of error makes another front", async () => {
  const {page} = await report.open();
  await choose(page, "Error", "missed");
  assert.deepEqual(front(await pointsTable(page)), ["ffd-lazy", "ffd-aabb", "ffd-grid"]);
});

test("a level leaves out who does not claim it", async () => {
  const {page} = await report.open();
  await choose(page, "Level", "triangle");
  assert.equal((await labels(page)).length, 3);
  assert.match(
    await section(page).locator(".note").textContent(),
    /ffd-aabb, ffd-grid \(does not claim level triangle\)/,
  );
  await choose(page, "Level", "body");
  assert.deepEqual((await labels(page))[4][1], "missed 0 of 3, spurious 1 of 4 (level body)");
});

test("counts of different levels are not added up: the finest in all scenes counts", async () => {
  const {page} = await mixed.open();
  const point = (await labels(page)).find(([first]) => first.startsWith("ffd-aabb:"));
  assert.equal(point[1], "missed 0 of 3, spurious 0 of 3 (level body)");
});

test("one scene and cold caches have times of their own", async () => {
  const {page} = await report.open();
  await choose(page, "Scenes", {label: "scene <script>alert(1)</script>"});
  await section(page).getByLabel("cold").check();
  await settled(page);
  assert.equal((await labels(page))[0][0], "fcl-aabb: 3.00 ms per frame (question triangles)");
});

test("points stand where their time and error say", async () => {
  const {page} = await report.shared();
  const places = await section(page)
    .locator(".points [aria-label]")
    .evaluateAll((all) =>
      all
        .map((point) => point.getBoundingClientRect())
        .map((box) => [box.x + box.width / 2, box.y + box.height / 2]),
    );
  const [aabb, obbrss, lazy, ffd, grid] = places;
  assert.ok(
    lazy[0] < ffd[0] && ffd[0] < grid[0] && grid[0] < aabb[0] && aabb[0] < obbrss[0],
    "left is faster",
  );
  assert.ok(Math.abs(lazy[1] - aabb[1]) < 0.5, "no error is one line");
  assert.ok(obbrss[1] < lazy[1] && ffd[1] < obbrss[1] && grid[1] < ffd[1], "up is worse");
  // A logarithm: a factor of 20 is as long wherever it stands.
  const octave = (a, b, factor) => (b[0] - a[0]) / Math.log(factor);
  assert.ok(Math.abs(octave(aabb, obbrss, 20) - octave(ffd, grid, 2)) < 1);
});

test("losses per stage are bars, and add up in words", async () => {
  const {page} = await report.shared();
  const bars = await labelsOf(page.locator("#stages [aria-label*='lost in']"));
  assert.deepEqual(
    bars.filter((bar) => bar.includes(": ")),
    ["ffd-aabb: 2 lost in hash", "ffd-aabb: 2 lost in node-plane"],
  );
  assert.deepEqual(await page.locator("#stages li:has-text('loses')").allTextContents(), [
    "ffd-aabb loses 4: 2 in hash and 2 in node-plane.",
  ]);
});

test("where pairs of bodies alone are judged, no pair of triangles is lost", async () => {
  const {page} = await mixed.open();
  const losses = page.locator("#stages li:has-text('loses')");
  assert.deepEqual(await losses.allTextContents(), [
    "ffd-aabb loses 3: 1 in hash and 2 in node-plane.",
  ]);
  const ticks = await page
    .locator("#stages figure [aria-label='x-axis tick label'] text")
    .allTextContents();
  assert.ok(
    ticks.length > 2 && ticks.every((tick) => Number(tick) <= 100),
    `shares, in percent: ${ticks}`,
  );
  await page
    .locator("#stages")
    .getByRole("combobox", {name: "Scenes"})
    .selectOption({label: "scene <script>alert(1)</script>"});
  await settled(page);
  assert.equal(await losses.count(), 0);
});

test("time per phase is stacked, with and without mapping", async () => {
  const {page} = await report.open();
  const bars = () => labelsOf(page.locator("#times [aria-label^='fcl-aabb:']"));
  assert.deepEqual((await bars()).sort(), [
    "fcl-aabb: map 0.200 ms",
    "fcl-aabb: query 0.200 ms",
    "fcl-aabb: update 0.600 ms",
  ]);
  await page.locator("#times").getByLabel("without").check();
  await settled(page);
  assert.deepEqual((await bars()).sort(), [
    "fcl-aabb: query 0.200 ms",
    "fcl-aabb: update 0.600 ms",
  ]);
});

test("cost is drawn against triangles and frames for the detectors chosen", async () => {
  const {page} = await report.open();
  const dots = page.locator("#cost figure").first().locator("[aria-label^='ffd-lazy']");
  assert.deepEqual(await labelsOf(dots), [
    "ffd-lazy\nmeet: 24 triangles\n0.0200 ms per frame",
    "ffd-lazy\n<script>alert(1)</script>: 2,400 triangles\n0.0400 ms per frame",
  ]);
  await unfold(page, page.locator("#cost summary"));
  await page.locator("#cost").getByRole("checkbox", {name: "ffd-lazy"}).uncheck();
  await settled(page);
  assert.equal(await dots.count(), 0);
});

const untimedCold = useReport("two_scenes.json", {
  change(results) {
    for (const run of results.runs) delete run.time_ms?.cold;
  },
});

test("where nothing was timed cold, the charts say so", async () => {
  const {page} = await untimedCold.open();
  assert.equal((await labels(page)).length, 5, "playback is there");
  await section(page).getByLabel("cold").check();
  await page.locator("#times").getByLabel("cold").check();
  await page.locator("#cost").getByLabel("cold").check();
  await settled(page);
  assert.match(await section(page).textContent(), /No detector was timed and judged so\./);
  assert.match(await section(page).locator(".note").textContent(), /\(not timed cold\)/);
  assert.match(await page.locator("#times").textContent(), /No detector was timed here\./);
  assert.match(
    await page.locator("#cost figure").first().textContent(),
    /None of these detectors was timed so\./,
  );
  assert.deepEqual(untimedCold.errors(), []);
});

test("costs of a single size are not drawn against sizes", async () => {
  const {page} = await mixed.open();
  const titles = await page.locator("#cost h3").allTextContents();
  assert.deepEqual(titles, ["In one scene"]);
});

test("depths and normals are ranges from the mean to the largest", async () => {
  const {page} = await report.shared();
  const titles = await labelsOf(page.locator("#graded [aria-label^='ffd-aabb']"));
  assert.deepEqual(
    titles.map((title) => title.split("\n")[1]),
    [
      "mean 1.00 mm, 95 % below 3.00 mm, largest 4.00 mm",
      "mean 10.0 °, 95 % below 45.0 °, largest 90.0 °",
    ],
  );
});

// What the screen reader is told of every chart, from the change of the window's width on.
test("a chart that is not yet drawn says that it is busy", async () => {
  const {page} = await report.open();
  assert.equal(await page.locator("figure.chart[aria-busy]").count(), 0, "all are drawn");
  assert.ok(
    await page
      .locator("figure.chart[role=group]")
      .evaluateAll(
        (all) =>
          all.length > 5 &&
          all.every((figure) => !figure.checkVisibility() || figure.firstElementChild),
      ),
    "and hold something",
  );
  await page.evaluate(() => {
    window.told = [];
    new MutationObserver((changes) =>
      window.told.push(
        ...changes.map(({type, target}) =>
          type === "childList" ? "drawn" : `busy ${target.ariaBusy}`,
        ),
      ),
    ).observe(document.querySelector("#speed-error figure"), {
      attributeFilter: ["aria-busy"],
      childList: true,
    });
  });
  await page.setViewportSize(kNarrow);
  await settled(page);
  assert.deepEqual(await page.evaluate(() => window.told), ["busy true", "drawn", "busy null"]);
});
