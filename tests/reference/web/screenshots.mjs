// Pictures of a report: node screenshots.mjs REPORT.html OUTDIR [SECTION...]
// The whole page at 1280 and 400 pixels, light and dark, and each section by itself.
import {mkdirSync} from "node:fs";
import {join} from "node:path";
import {kNarrow, kWide, launch, openReport} from "./browser.mjs";

const [report, folder, ...wanted] = process.argv.slice(2);
if (!report || !folder) {
  console.error("usage: node screenshots.mjs REPORT.html OUTDIR [SECTION...]");
  process.exit(2);
}
mkdirSync(folder, {recursive: true});

async function wholePage(browser, viewport, colorScheme) {
  const {page, close} = await openReport(browser, report, {viewport, colorScheme});
  const path = join(folder, `report-${viewport.width}-${colorScheme}.png`);
  await page.screenshot({path, fullPage: true});
  await close();
  console.log(path);
}

async function sections(browser, viewport) {
  const {page, close} = await openReport(browser, report, {viewport});
  // It would stand in the middle of a section that is taller than the window.
  await page.addStyleTag({content: "nav { display: none }"});
  const names =
    wanted.length > 0 ? wanted : await page.$$eval("section[id]", (all) => all.map((s) => s.id));
  for (const name of names) {
    const path = join(folder, `section-${name}-${viewport.width}.png`);
    await page.locator(`section[id="${name}"]`).screenshot({path});
    console.log(path);
  }
  await close();
}

const browser = await launch();
try {
  for (const viewport of [kWide, kNarrow])
    for (const scheme of ["light", "dark"]) await wholePage(browser, viewport, scheme);
  for (const viewport of [kWide, kNarrow]) await sections(browser, viewport);
} finally {
  await browser.close();
}
