// The page of `contactcheck check`, made by the built program from frames, in a browser.
import assert from "node:assert/strict";
import {execFileSync} from "node:child_process";
import {existsSync, mkdtempSync, rmSync, writeFileSync} from "node:fs";
import {tmpdir} from "node:os";
import {dirname, join, resolve} from "node:path";
import {after, before, test} from "node:test";
import {fileURLToPath} from "node:url";
import {kNarrow, kWebGl, launch, openReport, settled} from "./browser.mjs";
import {tableTexts} from "./report.mjs";

const here = dirname(fileURLToPath(import.meta.url));
const program =
  process.env.CONTACTCHECK_PROGRAM ?? resolve(here, "../../../build/release/contactcheck");
const folder = mkdtempSync(join(tmpdir(), "contactcheck-check-"));
const kFrames = 60;
const kOpened = [];
let browser;

// A triangle that lies, and one that stands on it, `depth` below; apart where that is negative.
const lying = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
const standing = (depth) =>
  `v 0.2 0.2 ${-depth}\nv 0.4 0.2 ${1 - depth}\nv 0.2 0.4 ${1 - depth}\nf 1 2 3\n`;

function check(name, ...words) {
  const out = join(folder, name);
  try {
    execFileSync(program, ["check", "--quiet", "--out", out, ...words], {cwd: folder});
  } catch (error) {
    if (error.status !== 1) throw error;
  }
  return join(out, "check.html");
}

async function open(file, options) {
  const report = await openReport(browser, file, options);
  kOpened.push(report);
  return report.page;
}

let many, steps, allowed, clean;

before(async () => {
  const files = [];
  for (let frame = 0; frame < kFrames; ++frame) {
    const file = `a_${String(frame).padStart(2, "0")}.obj`;
    // In contact from frame 10 to 39: more frames than a page has in 3D.
    writeFileSync(
      join(folder, file),
      standing(frame >= 10 && frame < 40 ? 0.1 + frame / 1000 : -0.1),
    );
    files.push(file);
  }
  writeFileSync(join(folder, "floor.obj"), lying);
  writeFileSync(join(folder, "ball_0.obj"), standing(-0.5));
  writeFileSync(join(folder, "ball_1.obj"), standing(2));
  many = check("many", ...files, "floor.obj");
  steps = check("steps", "ball_0.obj", "ball_1.obj", "floor.obj", "--between");
  allowed = check(
    "allowed",
    "ball_0.obj",
    "ball_1.obj",
    "floor.obj",
    "--between",
    "--allow",
    "impact",
  );
  clean = check("clean", "floor.obj");
  if (!existsSync(many)) {
    console.log("skipped: this program was built without the page (npm ci failed)");
    process.exit(0);
  }
  browser = await launch(kWebGl);
});

after(async () => {
  await browser?.close();
  rmSync(folder, {recursive: true, force: true});
});

test("the head says how many frames, the list has them all", async () => {
  const page = await open(many);
  assert.equal(
    await page.locator("h1").textContent(),
    "30 of 60 frames have a contact that is not allowed",
  );
  const rows = await tableTexts(page, "Contacts, frame by frame and step by step");
  assert.equal(rows.length, 31);
  assert.match(rows[1][0], /^frame 10 \(a_10\.obj\)$/);
  assert.match(rows[1][1], /^a and floor: 1 pair of triangles, first 0 and 0, depth unknown: /);
  assert.equal(
    await page.locator("section#speed-error, section#times, section#levels").count(),
    0,
    "nothing of a benchmark",
  );
});

test("twenty frames at most are in 3D, by the numbers of their files", async () => {
  const page = await open(many);
  const slider = page.getByLabel("Frame", {exact: true});
  await slider.waitFor();
  assert.ok(Number(await slider.getAttribute("max")) < 20);
  await page.getByRole("button", {name: "show"}).first().click();
  await settled(page);
  assert.equal(await slider.getAttribute("aria-valuetext"), "frame 10 (a_10.obj)");
  assert.match(await page.locator(".view-message").textContent(), /^a and floor: 1 pair/);
  await slider.press("ArrowRight");
  const next = await slider.getAttribute("aria-valuetext");
  assert.match(next, /^frame 1[1-9] \(a_1[1-9]\.obj\)$/);
  const shown = await page.getByRole("button", {name: "show"}).count();
  assert.ok(shown > 10 && shown <= 20, String(shown));
});

test("a step has both its ends", async () => {
  const page = await open(steps);
  assert.match(
    await page.locator("h1").textContent(),
    /^1 of 1 step has a contact that is not allowed, on straight paths/,
  );
  const slider = page.getByLabel("Frame", {exact: true});
  await slider.waitFor();
  assert.equal(await slider.getAttribute("max"), "1");
  assert.match(
    await page.locator(".view-message").textContent(),
    /^from frame 0 to 1, ball and floor: first at .* apart at both frames$/,
  );
});

test("impacts that are allowed are listed as allowed", async () => {
  const page = await open(allowed);
  assert.equal(
    await page.locator("h1").textContent(),
    "No frame and no step has a contact that is not allowed",
  );
  const rows = await tableTexts(page, "Contacts, frame by frame and step by step");
  assert.match(rows[1][1], /apart at both frames, allowed$/);
});

test("clean frames have a page that says so", async () => {
  const page = await open(clean);
  assert.equal(
    await page.locator("h1").textContent(),
    "No frame has a contact that is not allowed",
  );
  assert.equal(await page.locator("section#view").count(), 0);
});

test("it is readable at 400 pixels, light and dark, and asks nothing of the network", async () => {
  for (const colorScheme of ["light", "dark"]) {
    const page = await open(many, {viewport: kNarrow, colorScheme});
    assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 400);
  }
  assert.deepEqual(
    kOpened.flatMap(({requests}) => requests),
    [],
  );
  assert.deepEqual(
    kOpened.flatMap(({errors}) => errors),
    [],
  );
});
