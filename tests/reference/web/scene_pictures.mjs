// Pictures of a report's 3D view: node scene_pictures.mjs REPORT.html OUTDIR
// Per scene, light and dark: the frame with most contacts as a whole, and the first missed or spurious
// pair. The report's own contacts decide what is shown; see browser.mjs for the environment.
import {mkdirSync} from "node:fs";
import {join} from "node:path";
import {kWebGl, launch, openReport, settled} from "./browser.mjs";

const [report, folder] = process.argv.slice(2);
if (!report || !folder) {
  console.error("usage: node scene_pictures.mjs REPORT.html OUTDIR");
  process.exit(2);
}
mkdirSync(folder, {recursive: true});

async function picture(page, name) {
  await settled(page);
  const path = join(folder, `${name}.png`);
  await page.locator(".view-picture").screenshot({path});
  console.log(path);
}

/** The pair in the middle of the list: neither the first graze nor the last. */
const choose = (page, scene, kind) =>
  page.evaluate(
    ([id, what]) => {
      const pairs = window.contactcheckView.missedPairs(id).filter((pair) => pair.kind === what);
      const pair = pairs[Math.floor(pairs.length / 2)];
      if (pair) window.contactcheckView.show(pair);
      return Boolean(pair);
    },
    [scene, kind],
  );

async function scenePictures(page, scene, suffix) {
  await page.selectOption('[data-control="scene"]', scene);
  await picture(page, `${scene}${suffix}`);
  for (const kind of ["missed", "spurious"])
    if (await choose(page, scene, kind)) await picture(page, `${scene}-${kind}${suffix}`);
}

const browser = await launch(kWebGl);
try {
  for (const colorScheme of ["light", "dark"]) {
    const {page, close} = await openReport(browser, report, {colorScheme});
    await page.waitForSelector(".view-canvas[aria-label]");
    const scenes = await page.$$eval('[data-control="scene"] option', (all) =>
      all.map((option) => option.value),
    );
    for (const scene of scenes)
      await scenePictures(page, scene, colorScheme === "dark" ? "-dark" : "");
    await close();
  }
} finally {
  await browser.close();
}
