// A headless Chromium, driven by the playwright-core that the bundler of the page has installed.
// Environment: CONTACTCHECK_WEB_WORK, the bundler's work folder (its node_modules); CHROMIUM.
import {createRequire} from "node:module";
import {dirname, resolve} from "node:path";
import {fileURLToPath, pathToFileURL} from "node:url";

const root = resolve(dirname(fileURLToPath(import.meta.url)), "../../..");
const work = resolve(
  process.env.CONTACTCHECK_WEB_WORK ?? `${root}/build/release/reference/report/formats/web/work`,
);
const {chromium} = createRequire(`${work}/package.json`)("playwright-core");

/** Flags for launch(): WebGL without a graphics card. */
export const kWebGl = ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"];

export const kWide = {width: 1280, height: 900},
  kNarrow = {width: 400, height: 800};

const kPatience = 60_000; // ms, of whatever is waited for: a busy machine may take long to open a page

/** @returns a browser; close() ends it. `args`: further flags, for WebGL for instance */
export function launch(args = ["--disable-gpu"]) {
  return chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    headless: true,
    args: ["--no-sandbox", "--disable-quic", "--no-first-run", ...args],
  });
}

/**
 * Opens a report from disk and waits until it is drawn. `requests` and `errors` grow with every
 * request that is not the page itself or inside it, and with every exception or console error.
 */
export async function openReport(browser, file, {viewport = kWide, colorScheme = "light"} = {}) {
  const context = await browser.newContext({viewport, colorScheme});
  context.setDefaultTimeout(kPatience);
  const page = await context.newPage();
  const url = pathToFileURL(resolve(file)).href,
    requests = [],
    errors = [];
  page.on("request", (request) => {
    if (request.url().split("#")[0] !== url && !/^(data|blob):/.test(request.url()))
      requests.push(request.url());
  });
  page.on("pageerror", (error) => errors.push(String(error)));
  page.on("console", (message) => message.type() === "error" && errors.push(message.text()));
  await page.goto(url);
  await page.waitForSelector("h1");
  await settled(page);
  return {page, requests, errors, close: () => context.close()};
}

/**
 * Until all that can be seen is drawn: parts of the page that are not yet say aria-busy. A part hears of a
 * new width at the end of a frame, so one frame goes by before they are asked.
 * @throws where something is never drawn, with its name
 */
export async function settled(page) {
  const busy = await page.evaluate(async (patience) => {
    const frame = () => new Promise((done) => requestAnimationFrame(() => setTimeout(done)));
    const busyParts = () =>
      [...document.querySelectorAll("[aria-busy='true']")].filter((part) => part.checkVisibility());
    const end = performance.now() + patience;
    do await frame();
    while (busyParts().length > 0 && performance.now() < end);
    return busyParts().map((part) => part.ariaLabel ?? part.className);
  }, kPatience);
  if (busy.length > 0) throw new Error(`not drawn after ${kPatience / 1000} s: ${busy.join("; ")}`);
}
