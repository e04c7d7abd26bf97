// The 3D view in a real browser: node view_test.mjs [PAGE.html], PAGE being the bundler's page.
// Ends with 1 when anything is not as it must be. Environment: CONTACTCHECK_WEB_WORK, the bundler's
// work folder, where the page is looked for; and that of browser.mjs.
import assert from "node:assert/strict";
import {existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync} from "node:fs";
import {tmpdir} from "node:os";
import {join} from "node:path";
import {kNarrow, kWebGl, kWide, launch, openReport, settled} from "./browser.mjs";
import {kMissed, reportOf} from "./view_scene.mjs";

const kPage =
  process.argv[2] ??
  join(
    process.env.CONTACTCHECK_WEB_WORK ?? "build/release/reference/report/formats/web/work",
    "page.html",
  );
if (!existsSync(kPage)) {
  console.log(`skipped: no ${kPage}: npm ci failed; build again with a network`);
  process.exit(0);
}
const folder = mkdtempSync(join(tmpdir(), "contactcheck-view-"));
const report = join(folder, "report.html");

const state = (page) => page.evaluate(() => window.contactcheckView.state());

/** Red, green, blue and alpha of every third pixel of the canvas in both directions. */
async function pixels(page) {
  await settled(page);
  return page.evaluate(() => {
    const drawn = document.querySelector(".view-canvas");
    const width = Math.floor(drawn.width / 3),
      height = Math.floor(drawn.height / 3);
    const context = Object.assign(document.createElement("canvas"), {width, height}).getContext(
      "2d",
    );
    context.imageSmoothingEnabled = false;
    context.drawImage(drawn, 0, 0, width, height);
    return {width, height, rgba: Array.from(context.getImageData(0, 0, width, height).data)};
  });
}

function count({rgba}, holds) {
  let found = 0;
  for (let i = 0; i < rgba.length; i += 4) if (holds(rgba[i], rgba[i + 1], rgba[i + 2])) ++found;
  return found;
}

const near = (a, by) => (r, g, b) =>
  Math.abs(r - a[0]) + Math.abs(g - a[1]) + Math.abs(b - a[2]) < by;
const differing = (one, other) =>
  one.rgba.reduce((sum, value, i) => sum + (value !== other.rgba[i] ? 1 : 0), 0);
const background = ({rgba}) => rgba.slice(0, 3);
const drawnOn = (picture) => count(picture, (...c) => !near(background(picture), 24)(...c));

/** Much more blue than red, as the colour of missed pairs alone is in both themes. */
const missedColour = (r, g, b) => b > r + 90 && b > g + 50;

/** More red and blue than green, as the second triangle of a chosen pair is in both themes. */
const secondColour = (r, g, b) => r > g + 50 && b > g + 25;

async function setFrame(page, frame) {
  await page.locator(".view-slider input").fill(String(frame));
  await settled(page);
}

async function withReport(args, options, checks) {
  const browser = await launch(args);
  try {
    const {page, requests, errors, close} = await openReport(browser, report, options);
    await page.waitForSelector(".view3d[data-scene]");
    for (const check of checks) {
      await check(page);
      console.log(`ok  ${check.name} ${options.viewport.width} ${options.colorScheme ?? "light"}`);
    }
    assert.deepEqual(errors, [], "errors in the page");
    assert.deepEqual(requests, [], "a request left the page");
    await close();
  } finally {
    await browser.close();
  }
}

async function drawsTheScene(page) {
  const {scene, detector, frame, frames} = await state(page);
  assert.deepEqual(
    {scene, detector, frame, frames},
    {scene: "seeded", detector: "half-blind", frame: 1, frames: 3},
  );
  const picture = await pixels(page);
  assert.ok(
    drawnOn(picture) > 0.02 * picture.width * picture.height,
    "bodies cover some of the canvas",
  );
  assert.match(
    await page.locator(".view-message").textContent(),
    /2 pairs of triangles touch; half-blind misses 1 and makes up 0/,
  );
  assert.match(
    await page.locator(".view-left-out").textContent(),
    /lost: "recordings\/lost\.ccr" cannot be read\./,
  );
}

async function slidesThroughFrames(page) {
  const before = await pixels(page);
  await setFrame(page, 0);
  assert.equal((await state(page)).frame, 0);
  const after = await pixels(page);
  assert.ok(differing(before, after) > 300, "the tent is elsewhere");
  assert.equal(count(after, missedColour), 0, "nothing is missed in frame 0");
}

async function leadsToTheMissedPair(page) {
  await setFrame(page, 0);
  const rows = page.locator(".view-table tbody tr");
  assert.equal(await rows.count(), 2);
  assert.deepEqual(
    await rows
      .first()
      .locator("td")
      .evaluateAll((all) => all.map((td) => td.innerText.trim())),
    ["✕ missed", "1", "square triangle 0\ntent triangle 0"],
  );
  await rows.first().locator("button").click();
  const {frame, pair, target, distance} = await state(page);
  assert.equal(frame, kMissed.frame);
  assert.deepEqual(pair, kMissed.pair);
  target.forEach((value, k) =>
    assert.ok(Math.abs(value - kMissed.centroid[k]) < 1e-6, `looks at ${target}`),
  );
  assert.ok(distance > 0.5 && distance < 10, `near enough to see it: ${distance} m`);
  assert.equal(await rows.first().getAttribute("data-chosen"), "");
  const picture = await pixels(page);
  const blue = count(picture, missedColour),
    purple = count(picture, secondColour);
  assert.ok(
    blue > 0.005 * picture.width * picture.height,
    `the first triangle is coloured: ${blue} pixels`,
  );
  // Most of it is behind the first.
  assert.ok(purple >= 5, `the second triangle has its own colour: ${purple} pixels`);
  assert.equal(
    await page.locator(".view-message code").textContent(),
    "contactcheck reduce out/recordings/seeded.ccr@1 --detector half-blind --level triangle --kind missed",
  );
  // Its own mean on the screen: the middle of the canvas, but for perspective and the hidden half.
  let x = 0,
    y = 0;
  for (let i = 0; i < picture.rgba.length / 4; ++i)
    if ([missedColour, secondColour].some((is) => is(...picture.rgba.slice(4 * i, 4 * i + 3)))) {
      x += (i % picture.width) / picture.width / (blue + purple);
      y += Math.floor(i / picture.width) / picture.height / (blue + purple);
    }
  assert.ok(
    Math.abs(x - 0.5) < 0.2 && Math.abs(y - 0.5) < 0.2,
    `the pair is in the middle: ${x}, ${y}`,
  );
}

async function isLedByOthers(page) {
  await page.evaluate((target) => window.contactcheckView.show(target), {
    scene: "seeded",
    detector: "half-blind",
    frame: 2,
    pair: [0, 1, 1, 1],
    kind: "spurious",
  });
  assert.deepEqual((await state(page)).pair, [0, 1, 1, 1]);
  const listed = await page.evaluate(() => window.contactcheckView.missedPairs("seeded"));
  assert.deepEqual(
    listed.map(({kind, frame}) => [kind, frame]),
    [
      ["missed", 1],
      ["spurious", 2],
    ],
  );
  await page.getByRole("button", {name: "Whole scene"}).click();
  assert.equal((await state(page)).pair, null);
}

async function showsHardCases(page) {
  const range = page.getByRole("heading", {name: "In which range of sizes each is right"});
  assert.equal(await range.count(), 1);
  assert.match(await page.locator("#hard").textContent(), /half-blind\s*1e-3/);
  const family = page.locator("#family-cases");
  await family.locator("summary").click();
  await family.getByRole("button", {name: "show"}).click();
  const {scene, frame, pair} = await state(page);
  assert.deepEqual(
    {scene, frame, pair},
    {scene: "cases", frame: 1, pair: kMissed.pair},
    "where it goes wrong first",
  );
  assert.equal(
    await page.locator(".view-frame").textContent(),
    "case 1 of 0 to 2, value a quarter below",
  );
  assert.match(await page.locator(".view-message").textContent(), /half-blind, case 1, missed/);
  await family
    .locator("svg title", {hasText: "at a half"})
    .locator("..")
    .locator("rect")
    .first()
    .click();
  assert.equal((await state(page)).frame, 2, "a click on a case");
  await page.evaluate((target) => window.contactcheckView.show(target), {
    scene: "seeded",
    detector: "half-blind",
    frame: 1,
  });
}

async function switchesLayers(page) {
  await setFrame(page, 1);
  for (const layer of ["lattice", "boxes", "spheres1", "spheres2", "bodies", "missed"]) {
    const before = await pixels(page);
    await page.locator(`[data-layer="${layer}"]`).click();
    const changed = differing(before, await pixels(page));
    assert.ok(changed > 30, `${layer}: ${changed} values changed`);
  }
}

async function drawsOnDemandAlone(page) {
  const {drawn} = await state(page);
  await page.waitForTimeout(400);
  assert.equal((await state(page)).drawn, drawn, "nothing happened, nothing was drawn");
  await page.locator(".view-canvas").focus();
  const before = await pixels(page);
  for (let i = 0; i < 4; ++i) await page.keyboard.press("ArrowLeft");
  assert.ok(differing(before, await pixels(page)) > 300, "the arrow keys turn the scene");
}

async function plays(page) {
  const start = (await state(page)).frame;
  await page.getByRole("button", {name: "Play"}).click();
  await page.waitForFunction((frame) => window.contactcheckView.state().frame !== frame, start);
  await page.getByRole("button", {name: "Pause"}).click();
  const {frame} = await state(page);
  await page.waitForTimeout(700); // a step is 500 ms
  assert.equal((await state(page)).frame, frame);
}

async function isDark(page) {
  const picture = await pixels(page);
  assert.ok(
    background(picture).every((value) => value < 60),
    `dark background: ${background(picture)}`,
  );
  assert.ok(drawnOn(picture) > 0.02 * picture.width * picture.height);
}

async function fitsANarrowWindow(page) {
  const {width} = await page.locator(".view-canvas").boundingBox();
  assert.ok(width > 250 && width <= kNarrow.width, `canvas ${width} wide`);
  assert.ok(
    (await page.evaluate(() => document.documentElement.scrollWidth)) <= kNarrow.width,
    "no sideways scrolling",
  );
  await leadsToTheMissedPair(page);
}

async function saysThatWebGlIsMissing(page) {
  assert.match(await page.locator(".view-none").textContent(), /gives no WebGL 2/);
  await page.locator(".view-table tbody button").first().click();
  assert.deepEqual((await state(page)).pair, kMissed.pair);
}

const kChecks = [
  [
    kWebGl,
    {viewport: kWide},
    [
      drawsTheScene,
      slidesThroughFrames,
      leadsToTheMissedPair,
      isLedByOthers,
      showsHardCases,
      switchesLayers,
      drawsOnDemandAlone,
      plays,
    ],
  ],
  [kWebGl, {viewport: kWide, colorScheme: "dark"}, [isDark, leadsToTheMissedPair]],
  [kWebGl, {viewport: kNarrow}, [fitsANarrowWindow]],
  [["--disable-gpu", "--disable-3d-apis"], {viewport: kWide}, [saysThatWebGlIsMissing]],
];

try {
  writeFileSync(report, reportOf(readFileSync(kPage, "utf8")));
  for (const [args, options, checks] of kChecks) await withReport(args, options, checks);
} finally {
  rmSync(folder, {recursive: true});
}
