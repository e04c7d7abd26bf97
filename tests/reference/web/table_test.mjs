// The tables: recall and spurious rates with their colours, the summary, the numbers of a scene.
import assert from "node:assert/strict";
import {test} from "node:test";
import {judgeByBodiesAlone, tableTexts, unfold, unfoldAll, useReport} from "./report.mjs";

const report = useReport("two_scenes.json");
const kScene = "<script>alert(1)</script>";

test("recall per scene, and its sum", async () => {
  const {page} = await report.shared();
  assert.deepEqual(await tableTexts(page, "Recall per detector and scene"), [
    ["detector", "all scenes", "meet", kScene],
    ["fcl-aabb", "1", "1", "1"],
    ["fcl-obbrss", "0.93750", "0.90000", "1"],
    ["ffd-lazy", "1", "1", "1"],
    ["ffd-aabb", "0.75000", "0.70000", "0.83333"],
    ["ffd-grid", "1", "1", "1"],
    ["<img src=x onerror=alert(1)>", "", "error", "absent"],
  ]);
});

const mixed = useReport("two_scenes.json", {
  change: (results) => judgeByBodiesAlone(results, kScene, "ffd-aabb"),
});

test("counts of different levels are not added up", async () => {
  const {page} = await mixed.open();
  const line = async () =>
    (await tableTexts(page, "Recall per detector and scene")).find(([name]) => name === "ffd-aabb");
  assert.deepEqual(await line(), ["ffd-aabb", "levels differ", "0.70000", "1"]);
  await page.locator("#levels").getByRole("combobox", {name: "Level"}).selectOption("cell");
  assert.deepEqual(await line(), ["ffd-aabb", "0.70000", "0.70000", ""]);
});

test("a perfect cell has no colour, others the more the worse", async () => {
  const {page} = await report.shared();
  const colour = (line, cell) =>
    page
      .getByRole("region", {name: "Recall per detector and scene"})
      .locator(`tbody tr:nth-child(${line}) > :nth-child(${cell})`)
      .evaluate((td) => td.style.background);
  assert.equal(await colour(1, 3), "");
  const strength = async (line, cell) => Number(/(\d+)%/.exec(await colour(line, cell))[1]);
  assert.ok((await strength(4, 3)) > (await strength(2, 3)), "0.7 is worse than 0.9");
});

test("level and measure switch the table", async () => {
  const {page} = await report.open();
  await page.locator("#levels").getByLabel("spurious rate").check();
  const lines = await tableTexts(page, "Spurious rate per detector and scene");
  assert.deepEqual(lines[5], ["ffd-grid", "0.41667", "0.50000", "0"]);
  await page.locator("#levels").getByRole("combobox", {name: "Level"}).selectOption("body");
  assert.deepEqual((await tableTexts(page, "Spurious rate per detector and scene"))[5], [
    "ffd-grid",
    "0.25000",
    "0.33334",
    "0",
  ]);
  await page.locator("#levels").getByRole("combobox", {name: "Level"}).selectOption("triangle");
  assert.deepEqual(
    (await tableTexts(page, "Spurious rate per detector and scene")).map(([name]) => name),
    ["detector", "fcl-aabb", "fcl-obbrss", "ffd-lazy", "<img src=x onerror=alert(1)>"],
  );
});

test("the summary has the sums of the other reports", async () => {
  const {page} = await report.shared();
  const lines = await tableTexts(page, "Summary of all detectors");
  assert.deepEqual(lines[4], [
    "ffd-aabb",
    "2",
    "cell",
    "16",
    "4",
    "1",
    "0/0",
    "12.5",
    "body",
    "5",
    "5.00 to 15.0x",
    "-",
    "-",
  ]);
  assert.deepEqual(lines[6].slice(0, 3), [
    "<img src=x onerror=alert(1)>",
    "0 (1 error, 1 absent)",
    "",
  ]);
});

test("goals are set beside what was measured", async () => {
  const {page} = await report.shared();
  assert.deepEqual((await tableTexts(page, "Goals of the suite")).slice(1), [
    ["fast", "meet", "ffd-lazy", ">= 20.0x", "25.0x [22.5, 27.5]", "5", "✓ yes"],
    ["pairs are cheap", "meet", "ffd-lazy", "<= 0.500 us", "1.25 us", "5", "✗ no"],
    [
      "on <b>AVX-512</b>",
      "meet",
      "ffd-lazy",
      ">= 2.00x",
      "-",
      "-",
      "not measured: no AVX-512 here",
    ],
  ]);
});

test("a heading sorts, and sorts the other way", async () => {
  const {page} = await report.open();
  const box = page.getByRole("region", {name: "Summary of all detectors"});
  const names = async () =>
    (await tableTexts(page, "Summary of all detectors")).slice(1, 6).map(([name]) => name);
  await box.getByRole("button", {name: "missed"}).click();
  assert.deepEqual((await names()).slice(-2), ["fcl-obbrss", "ffd-aabb"]);
  await box.getByRole("button", {name: "missed"}).press("Enter");
  assert.equal(await box.locator("th[aria-sort]").getAttribute("aria-sort"), "descending");
  assert.deepEqual((await names()).slice(1, 3), ["ffd-aabb", "fcl-obbrss"]);
});

test("an open scene shows every number", async () => {
  const {page} = await report.open();
  await unfold(page, page.locator("#scene-meet > summary"));
  const texts = (name) => tableTexts(page, name);
  assert.deepEqual((await texts("Result"))[4], [
    "ffd-aabb",
    "cell",
    "10",
    "0.70000",
    "3",
    "1",
    "0/0",
    "12.5",
    "-1",
    "body",
    "0.0500 (own 0.0350)",
    "5",
    "5.00x",
    "-",
    "-",
  ]);
  assert.deepEqual((await texts("Bodies"))[1], ["left", "shape box", "8", "12", "8", "yes", ""]);
  assert.deepEqual((await texts("Every level judged (sums over frames)"))[8], [
    "ffd-aabb",
    "cell",
    "doubles",
    "10",
    "5",
    "3",
    "1",
    "0.70000",
    "0.20000",
  ]);
  assert.deepEqual(
    (await texts("Which stage lost which true triangle pairs (sums over frames)"))[2],
    ["ffd-aabb", "node-plane", "cell pairs", "9", "5", "12 planes", "2"],
  );
  assert.deepEqual(
    (await texts("Times in milliseconds per frame (playback unless said, means over passes)"))[1],
    [
      "fcl-aabb",
      "triangles",
      "1.50",
      "0.100",
      "0.300",
      "0.100",
      "0.500",
      "0.500",
      "1.00",
      "-",
      "0.500",
      "1.00",
      "2",
      "5",
      "0.500",
      "1.00",
    ],
  );
  assert.deepEqual((await texts("Disagreements with the truth (first of each kind)"))[1], [
    "fcl-obbrss",
    "missed",
    "triangle",
    "1",
    "cases/0001.json",
  ]);
});

// Of a text; commas within numbers and at their ends do not matter.
const numbersIn = (text) =>
  (text.match(/[-+]?\d[\d.,e+-]*x?/g) ?? []).map((number) =>
    number.replaceAll(",", "").replace(/\.$/, ""),
  );

test("every number of the Markdown report stands on the page", async () => {
  const {page} = await report.open();
  await unfoldAll(page);
  const texts = await page
    .locator("td, th, p, li, dd, dt, h1, h2, h3, h4, summary")
    .allTextContents();
  const shown = new Set(texts.flatMap(numbersIn)),
    wanted = numbersIn(report.markdown());
  assert.ok(wanted.length > 400, `${wanted.length} numbers`);
  assert.deepEqual(
    wanted.filter((number) => !shown.has(number)),
    [],
  );
});

test("everything can be opened", async () => {
  const {page} = await report.open();
  await unfoldAll(page);
  assert.equal(await page.locator("details:not([open])").count(), 0);
  assert.deepEqual(report.errors(), []);
});
