// Charts of what newer results hold: distances of bodies, histograms of errors; and reports without.
import assert from "node:assert/strict";
import {test} from "node:test";
import {settled} from "./browser.mjs";
import {labelsOf, tableTexts, useReport} from "./report.mjs";

const kFarScene = 1;

/** Six frames: four apart, two in contact. */
function moveApart(results) {
  const scene = results.scenes[kFarScene];
  Object.assign(scene, {frames: 6, contact_frames: 2, separation: [0.5, 0.05, 0.005, 0.005, 0, 0]});
  results.scenes[0].separation = [0, 0];
  for (const run of results.runs.filter((one) => one.scene === scene.id && one.status === "ok")) {
    const slow = run.time_ms.playback.frame;
    Object.assign(run.per_frame, {
      truth: [0, 0, 0, 0, 3, 3],
      missed: [0, 0, 0, 0, 0, 0],
      spurious: [0, 0, 0, 0, 0, 0],
      frame_ms: [1, 2, 3, 5, null, 10].map((part) => (part === null ? null : part * slow)),
    });
    run.frames = 6;
    for (const times of [run.time_ms, ...(run.time_ms_other_questions ?? [])])
      times.timed_frames = 6;
  }
}

function addHistograms(results) {
  const run = (detector) =>
    results.runs.find((one) => one.scene === "meet" && one.detector === detector);
  Object.assign(run("ffd-aabb").geometry, {
    depth_error_histogram: [
      {from: 1e-9, below: 2e-9, count: 1},
      {from: 1e-7, below: 2e-7, count: 1},
      {from: 0.002, below: 0.005, count: 5},
    ],
    normal_error_deg_histogram: [
      {from: 0, below: 5, count: 6},
      {from: 90, below: 95, count: 1},
    ],
  });
  Object.assign(run("fcl-obbrss").geometry, {
    spurious_distance_max: 0.0015,
    spurious_distance_histogram: [
      {from: 0.0001, below: 0.0002, count: 3},
      {from: 0.001, below: 0.002, count: 1},
    ],
  });
  run("ffd-grid").geometry.episodes = [0.2, 0.1, null].map((gap) => ({
    bodies: [0, 1],
    first_true: null,
    first_reported: 0,
    hover_gap: gap,
    late_frames: null,
  }));
}

function addBullet(results) {
  const bullet = structuredClone(
    results.runs.find((one) => one.scene === "meet" && one.detector === "ffd-aabb"),
  );
  bullet.detector = "bullet-vf";
  Object.assign(bullet.geometry, {
    normal_error_deg_max: 180,
    normal_error_deg_mean: 150,
    normal_error_deg_histogram: [
      {from: 0, below: 5, count: 1},
      {from: 175, below: 180, count: 6},
    ],
  });
  results.runs.push(bullet);
}

const report = useReport("two_scenes.json", {
  change(results) {
    moveApart(results);
    addHistograms(results);
    addBullet(results);
  },
});
const old = useReport("two_scenes.json");

const boxesOf = (marks) =>
  marks.evaluateAll((all) =>
    all.map((mark) => {
      const {x, y, width, height} = mark.getBoundingClientRect();
      return {x, y, width, height};
    }),
  );
const separation = (page) =>
  page.getByRole("group", {name: "Milliseconds per frame against the distance of the bodies"});
const picture = (page, name) => page.locator("#graded").getByRole("group", {name, exact: true});

async function chooseFarScene(page) {
  await page
    .locator("#cost")
    .getByRole("combobox", {name: "Scene"})
    .selectOption(String(kFarScene));
  await settled(page);
}

test("cost is drawn against the distance of the bodies, frames with contact apart", async () => {
  const {page} = await report.open();
  assert.match(
    await separation(page).textContent(),
    /The surfaces touch in every timed frame of this scene\./,
  );
  await chooseFarScene(page);
  const apart = separation(page).locator(".apart [aria-label^='ffd-lazy']");
  assert.deepEqual(await labelsOf(apart), [
    "ffd-lazy, frame 0\n500 mm apart, 0.0400 ms",
    "ffd-lazy, frame 1\n50.0 mm apart, 0.0800 ms",
    "ffd-lazy, frame 2\n5.00 mm apart, 0.120 ms",
    "ffd-lazy, frame 3\n5.00 mm apart, 0.200 ms",
  ]);
  const [far, middle, near] = await boxesOf(apart);
  assert.ok(
    Math.abs(far.x - middle.x - (middle.x - near.x)) < 1,
    "a factor of ten is as long wherever it stands",
  );
  const touching = separation(page).locator(".touching [aria-label^='ffd-lazy']");
  assert.deepEqual(await labelsOf(touching), [
    "ffd-lazy, surfaces touch (frames: 1)\n0.400 to 0.400 ms, median 0.400 ms",
  ]);
  const [contact] = await boxesOf(touching);
  assert.ok(contact.x < near.x - 5 && contact.y < near.y, "left of every distance, and dearer");
});

test("the size of depth errors is told by bars, those below a micrometre in one", async () => {
  const {page} = await report.shared();
  const bars = picture(page, "Depth, convex-pair").locator(".bars [aria-label^='ffd-aabb']");
  assert.deepEqual(await labelsOf(bars), [
    "ffd-aabb: 28.6 % (2) from 0 to 0.00100 mm",
    "ffd-aabb: 71.4 % (5) from 2.00 to 4.00 mm",
  ]);
  const [small, large] = await boxesOf(bars);
  assert.ok(
    Math.abs(large.height / small.height - Math.sqrt(5 / 2)) < 0.1,
    "heights go with the square root of the share",
  );
  assert.ok(small.x + small.width < large.x);
});

test("normals, distances of spurious pairs and hover have charts of their own", async () => {
  const {page} = await report.shared();
  assert.deepEqual(
    await labelsOf(picture(page, "Normal").locator(".bars [aria-label^='bullet-vf']")),
    ["bullet-vf: 14.3 % (1) from 0 to 5.00 °", "bullet-vf: 85.7 % (6) from 175 to 180 °"],
  );
  const distances = picture(page, "Distance of spurious pairs of triangles");
  assert.deepEqual(await labelsOf(distances.locator(".bars [aria-label]")), [
    "fcl-obbrss: 75.0 % (3) from 0.100 to 0.200 mm",
    "fcl-obbrss: 25.0 % (1) from 1.00 to 1.50 mm",
  ]);
  assert.deepEqual(await labelsOf(distances.locator(".largest [aria-label]")), [
    "fcl-obbrss\nlargest 1.50 mm\n4 spurious pairs",
  ]);
  const hover = picture(page, "Hover");
  assert.deepEqual(await labelsOf(hover.locator(".largest [aria-label]")), [
    "ffd-grid\nlargest 200 mm\n2 episodes of contact",
  ]);
  assert.equal(await hover.locator(".points line").count(), 2);
});

test("the page says why Bullet's normals are turned", async () => {
  const {page} = await report.shared();
  assert.deepEqual(
    (await tableTexts(page, "Bullet's vertex-face normals turn with the side of the vertex"))[1],
    ["meet", "7", "6", "150", "180"],
  );
  const link = page.getByRole("link", {name: "Why normals of bullet-vf are 180 degrees off"});
  assert.match(
    await page.locator(await link.getAttribute("href")).textContent(),
    /^Bullet's vertex-face normals turn/,
  );
  assert.match(
    report.markdown(),
    /normals turn with the side of the vertex[^]*\| meet \| 7 \| 6 \| 150 \| 180 \|/,
  );
});

test("results of older versions leave these charts out, and nothing else", async () => {
  const {page} = await old.open();
  assert.equal(await separation(page).count(), 0);
  assert.equal(await page.locator(".bars rect").count(), 0);
  assert.deepEqual(await page.locator("#graded h3").allTextContents(), [
    "Depth, convex-pair",
    "Normal",
  ]);
  assert.equal(await page.locator("#cost figure").count(), 3);
  assert.equal(await page.getByText("cannot be shown").count(), 0);
  assert.equal(await page.getByText("normals turn").count(), 0);
});

test("the charts come before the words, and words lead to their meaning", async () => {
  const {page} = await report.open();
  const ids = await page.locator("section[id]").evaluateAll((all) => all.map(({id}) => id));
  assert.equal(ids[0], "speed-error");
  assert.equal(ids.at(-1), "words");
  await page.locator("#levels a.term", {hasText: "Recall"}).click();
  assert.equal(await page.evaluate(() => location.hash), "#word-recall");
  assert.ok(
    await page
      .locator("#word-recall")
      .evaluate((word) => word.getBoundingClientRect().top < innerHeight),
  );
  const dangling = await page
    .locator("a[href^='#']")
    .evaluateAll(
      (all) => all.filter((link) => !document.getElementById(link.hash.slice(1))).length,
    );
  assert.equal(dangling, 0, "links that lead nowhere");
});

test("nothing fails, and nothing is asked of the network", () => {
  for (const one of [report, old]) {
    assert.deepEqual(one.requests(), []);
    assert.deepEqual(one.errors(), []);
  }
});
