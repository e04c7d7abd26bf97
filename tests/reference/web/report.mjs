// Reports made by the built program from hand-built results, and opened in the browser.
// Environment: CONTACTCHECK_PROGRAM, and that of browser.mjs.
import {execFileSync} from "node:child_process";
import {existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync} from "node:fs";
import {tmpdir} from "node:os";
import {dirname, join, resolve} from "node:path";
import {after, afterEach, before} from "node:test";
import {fileURLToPath} from "node:url";
import {launch, openReport, settled} from "./browser.mjs";

const here = dirname(fileURLToPath(import.meta.url));
const program =
  process.env.CONTACTCHECK_PROGRAM ?? resolve(here, "../../../build/release/contactcheck");

/**
 * A browser and the report of `results` (a file of this folder), for all tests of a file.
 * `beside`: JSON files to lie beside the results, by name. `change`: of the results, in place.
 * @returns open(options), as openReport; shared(), a page for tests that only read; requests() and
 * errors() of all that was opened; markdown(), the report of the same results in Markdown
 */
export function useReport(results, {beside = {}, change, args} = {}) {
  const folder = mkdtempSync(join(tmpdir(), "contactcheck-web-"));
  const opened = [];
  let browser, shared;
  before(async () => {
    const read = JSON.parse(readFileSync(resolve(here, results), "utf8"));
    change?.(read);
    writeFileSync(join(folder, "results.json"), JSON.stringify(read));
    for (const [name, json] of Object.entries(beside))
      writeFileSync(join(folder, name), JSON.stringify(json));
    execFileSync(program, [
      "report",
      join(folder, "results.json"),
      "--format",
      "html",
      "--out",
      folder,
    ]);
    if (!existsSync(join(folder, "report.html"))) {
      console.log("skipped: this program was built without the page (npm ci failed)");
      process.exit(0);
    }
    browser = await launch(args);
  });
  // Pages that nobody reads any more would slow the next one down.
  afterEach(async () => {
    for (const report of opened) if (report !== shared) await report.close();
  });
  after(async () => {
    await browser?.close();
    rmSync(folder, {recursive: true, force: true});
  });
  return {
    async open(options) {
      const report = await openReport(browser, join(folder, "report.html"), options);
      opened.push(report);
      return report;
    },
    markdown() {
      execFileSync(program, [
        "report",
        join(folder, "results.json"),
        "--format",
        "md",
        "--out",
        folder,
      ]);
      return readFileSync(join(folder, "report.md"), "utf8");
    },
    /** The page, opened once, for tests that leave it as it is. */
    async shared() {
      shared ??= await this.open();
      return shared;
    },
    requests: () => opened.flatMap((report) => report.requests),
    errors: () => opened.flatMap((report) => report.errors),
  };
}

/** The texts of all cells of a table by its accessible name, line by line, headings first; waits for the table. */
export async function tableTexts(page, name) {
  const box = page.getByRole("region", {name, exact: true});
  await box.first().waitFor();
  return box
    .locator("tr")
    .evaluateAll((lines) =>
      lines.map((line) => [...line.children].map((cell) => cell.textContent)),
    );
}

/** What a screen reader is told of each of these marks. */
export const labelsOf = (marks) =>
  marks.evaluateAll((all) => all.map((mark) => mark.getAttribute("aria-label")));

/** Changes results: a detector that is judged by cells answers for pairs of bodies alone in one scene. */
export function judgeByBodiesAlone(results, scene, detector) {
  const run = results.runs.find((one) => one.scene === scene && one.detector === detector);
  run.per_frame.level = "body";
  delete run.levels.cell;
}

/** Opens a folded part of the page by its summary; what it holds is built after the click. */
export async function unfold(page, summary) {
  await summary.click();
  await summary.locator("xpath=following-sibling::*[1]").waitFor();
  await settled(page);
}

/** Opens every part of the page that is folded. */
export async function unfoldAll(page) {
  await page.evaluate(async () => {
    // What is opened may hold more to open; its own listener, which fills it, comes before this one.
    const open = (details) =>
      new Promise((done) => {
        details.addEventListener("toggle", done, {once: true});
        details.open = true;
      });
    for (let closed; (closed = [...document.querySelectorAll("details:not([open])")]).length > 0; )
      await Promise.all(closed.map(open));
  });
  await settled(page);
}
