// Families of hard cases, known defects, random pairs, and the paper's tables.
import assert from "node:assert/strict";
import {test} from "node:test";
import {tableTexts, unfold, unfoldAll, useReport} from "./report.mjs";

const kTimes = {mss: 2, cell: 1, test: 0.5, response: 0.25, total: 3.75};
const kRatio = {
  test: {ratio: 1.5, low: 1.25, high: 1.75},
  total: {ratio: 1.1, low: 1, high: 1.2},
  same_contacts: true,
  missed_before: 3,
  missed_after: 4,
};
const kReproduction = {
  schema: "contactcheck-reproduction/1",
  command: "contactcheck run hello",
  scenes: [
    {
      scene: "teapot",
      ours: "paper-teapot",
      frames: 3,
      contact_frames: 2,
      counts: {triangles: {paper: 6400, ours: 6390, difference_percent: -0.15625}},
      steps: [
        {
          method: "ffd-aabb-sphere2",
          paper_reports: {...kTimes, table: "Table 3", device: "<em>phone</em>"},
          safe: {...kTimes, level: "cell", truth: 10, missed: 1, spurious: 2},
          paper: null,
          exact: null,
        },
      ],
      ratios: [
        {
          before: "ffd-aabb-sphere",
          after: "ffd-aabb-sphere2",
          paper_reports: {table: "Table 3", test: 2.19, total: 1.274},
          safe: kRatio,
          paper: null,
          exact: null,
        },
      ],
      frame_rate: {
        detector: "ffd-aabb-sphere2",
        steps_per_second: 874.4,
        simulated_over_real_time: 14.57,
      },
      hover_at_rest: {"ffd-aabb-sphere2": 0.001, "ffd-grid": 0.09, factor: 90},
      sentences: ["The second level does not pay."],
      closed_loop: [{detector: "ffd-grid", error: "blew up"}],
    },
  ],
  means: {
    scenes: 1,
    test_ratio: {ours: 1.5, paper: 2.19},
    frame_rate_ratio: {ours: 1.1, paper: 1.274, paper_claims: 1.344},
  },
  paper: {
    source: {
      authors: ["Jeon", "Hong"],
      title: "Spheres",
      journal: "Journal",
      year: 2013,
      doi: "10.1/1",
    },
    findings: [
      {
        topic: "rest",
        table: "Table 3",
        scene: "teapot",
        method: null,
        sentence: "Below 0.",
        claimed: 0,
        computed: -0.5,
        unit: "ms",
        agrees: false,
      },
    ],
  },
};

const report = useReport("../schema/example_results.json", {
  beside: {"reproduction.json": kReproduction},
});

test("the title counts scenes and hard cases", async () => {
  const {page} = await report.shared();
  assert.equal(
    await page.locator("h1").textContent(),
    "All 3 detectors have missed or spurious contacts, or status error, in 3 scenes and 3 hard cases",
  );
});

test("hard cases are summed per detector", async () => {
  const {page} = await report.shared();
  assert.deepEqual((await tableTexts(page, "Hard cases per detector"))[1], [
    "ffd-aabb-sphere2",
    "cell",
    "0 of 1",
    "1 of 3",
    "1",
    "1",
    "0",
    "0",
    "0.500",
    "5",
    "0.500 hello",
  ]);
});

test("the table of families says how many cases go wrong", async () => {
  const {page} = await report.shared();
  assert.deepEqual(
    (await tableTexts(page, "Cases that each detector gets wrong, by family"))[1].slice(0, 3),
    ["hello", "3", "2"],
  );
  const cells = page
    .getByRole("region", {name: "Cases that each detector gets wrong, by family"})
    .locator("td");
  assert.equal(
    await cells.nth(1).getAttribute("title"),
    "ffd-aabb-sphere2 in hello: 2 of 3 cases wrong",
  );
  assert.match(await cells.nth(1).getAttribute("style"), /color-mix/);
});

test("a family is drawn case by case, and told from which value on it goes wrong", async () => {
  const {page} = await report.open();
  const summary = page.locator("#family-hello > summary");
  assert.match(await summary.textContent(), /: 2 detectors go wrong$/);
  await unfold(page, summary);
  assert.deepEqual(
    (await page.locator("#family-hello svg g title").allTextContents()).slice(0, 3),
    [
      "ffd-aabb-sphere2 at 0: 0 missed of 0, 1 spurious",
      "ffd-aabb-sphere2 at 1e-9: 1 missed of 4, 0 spurious",
      "ffd-aabb-sphere2 at 1: 0 missed of 6, 0 spurious",
    ],
  );
  assert.deepEqual((await tableTexts(page, "Errors in hello"))[1], [
    "ffd-aabb-sphere2",
    "0",
    "0 missed, 1 spurious of 0 true",
    "2 of 3",
    "1",
    "1",
  ]);
});

test("the picture of a family takes the colours of the page, light or dark", async () => {
  const {page} = await report.open({colorScheme: "dark"});
  await unfold(page, page.locator("#family-hello > summary"));
  const colours = () =>
    page
      .locator("#family-hello svg")
      .evaluate((svg) =>
        [".paper", ".missed", ".mark", "text"].map(
          (part) => getComputedStyle(svg.querySelector(part)).fill,
        ),
      );
  const dark = ["rgb(15, 20, 25)", "rgb(88, 166, 255)", "rgb(15, 20, 25)", "rgb(230, 237, 243)"];
  assert.deepEqual(await colours(), dark);
  await page.getByLabel("light", {exact: true}).check();
  const light = ["rgb(255, 255, 255)", "rgb(11, 98, 196)", "rgb(255, 255, 255)", "rgb(28, 33, 39)"];
  assert.deepEqual(await colours(), light);
});

test("known defects are held against the list", async () => {
  const {page} = await report.shared();
  const text = await page.locator("#defects").textContent();
  assert.match(
    text,
    /Of 3 listed wrong answers of libraries that this run could show, 1 show as listed, 1 with another count and 1 do not\./,
  );
  assert.deepEqual((await tableTexts(page, "Known wrong answers"))[1], [
    "fcl 0.7.0",
    "overlap()",
    "https://example.org/issues/502",
    "missed",
    "it rounds",
    "fcl-aabb",
    "1",
    "2 of 3, 1 with another count",
  ]);
});

test("an error of the oracle itself is not hidden", async () => {
  const {page} = await report.shared();
  const text = await page.locator("#pairs").textContent();
  assert.match(
    text,
    /1,152 pairs, seed 7, 500 touch; oracle against rational arithmetic: 1 wrong, AN ERROR OF CONTACTCHECK ITSELF\./,
  );
  assert.deepEqual((await tableTexts(page, "Kinds of pairs"))[1], [
    "vertex-face",
    "576",
    "300",
    "0.521",
  ]);
  assert.match(
    await page.locator("dl.findings").textContent(),
    /the oracle was wrong 1 time: an error of contactcheck itself/,
  );
});

test("the paper's tables stand beside ours", async () => {
  const {page} = await report.open();
  assert.deepEqual(
    (await tableTexts(page, "Two levels of spheres over one: the paper's ratios beside ours"))[1],
    [
      "teapot",
      "2.19x",
      "1.50x (1.25 to 1.75)",
      "-",
      "-",
      "1.274x",
      "1.10x (1.00 to 1.20)",
      "-",
      "-",
    ],
  );
  await unfoldAll(page);
  assert.deepEqual(
    (
      await tableTexts(
        page,
        "Milliseconds per whole step, timed in lockstep from the same states, cold",
      )
    ).slice(1, 3),
    [
      [
        "ffd-aabb-sphere2",
        "paper, Table 3, <em>phone</em>",
        "2.00",
        "1.00",
        "0.500",
        "0.250",
        "3.75",
        "-",
        "-",
        "-",
      ],
      [
        "ffd-aabb-sphere2",
        "ours, safe",
        "2.00",
        "1.00",
        "0.500",
        "0.250",
        "3.75",
        "cell",
        "1 of 10",
        "2",
      ],
    ],
  );
  assert.deepEqual((await tableTexts(page, "Checks of the paper's own numbers"))[1], [
    "rest",
    "Table 3",
    "teapot",
    "-",
    "-0.500 ms",
    "0",
    "✗ does not agree",
    "Below 0.",
  ]);
  const text = await page.locator("#paper").textContent();
  assert.match(text, /paper-teapot, 3 frames, 2 with contact/);
  assert.match(text, /The second level does not pay\./);
  assert.match(text, /874 whole steps per second, 14\.6 times real time/);
  assert.match(text, /Means, two levels of spheres against one, bounds=safe \(1 of the scenes\)/);
  assert.match(text, /1 check by arithmetic alone; 1 contradict a claim or cannot be\./);
});

test("nothing fails, and nothing is asked of the network", async () => {
  const {page} = await report.open();
  await unfoldAll(page);
  assert.equal(await page.getByText("cannot be shown").count(), 0);
  assert.deepEqual(report.requests(), []);
  assert.deepEqual(report.errors(), []);
});
