// Dark and light, narrow and printed, by keyboard alone.
import assert from "node:assert/strict";
import {test} from "node:test";
import {kNarrow, settled} from "./browser.mjs";
import {unfoldAll, useReport} from "./report.mjs";

const report = useReport("two_scenes.json");
const kLight = "rgb(255, 255, 255)",
  kDark = "rgb(15, 20, 25)";

const background = (page) => page.evaluate(() => getComputedStyle(document.body).backgroundColor);

// Of the ink on the surface, by WCAG 2.
const contrast = (page, selector) =>
  page
    .locator(selector)
    .first()
    .evaluate((element) => {
      const luminance = (css) => {
        const [r, g, b] = css
          .match(/[\d.]+/g)
          .slice(0, 3)
          .map((v) => v / 255)
          .map((v) => (v <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4));
        return 0.2126 * r + 0.7152 * g + 0.0722 * b;
      };
      const a = luminance(getComputedStyle(element).color),
        b = luminance(getComputedStyle(document.body).backgroundColor);
      return (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
    });

test("colours follow the system, and the switch", async () => {
  const light = await report.open(),
    dark = await report.open({colorScheme: "dark"});
  assert.equal(await background(light.page), kLight);
  assert.equal(await background(dark.page), kDark);
  await dark.page.getByLabel("light", {exact: true}).check();
  assert.equal(await background(dark.page), kLight);
  await light.page.getByLabel("dark", {exact: true}).check();
  assert.equal(await background(light.page), kDark);
  await light.page.reload();
  await light.page.waitForSelector("h1");
  assert.equal(await background(light.page), kDark, "the choice is remembered");
});

test("text can be read in light and dark", async () => {
  for (const colorScheme of ["light", "dark"]) {
    const {page} = await report.open({colorScheme});
    for (const selector of ["h1", "dl.findings dt", ".note", "nav a", "td.error"])
      assert.ok((await contrast(page, selector)) >= 4.5, `${selector}, ${colorScheme}`);
  }
});

test("at 400 pixels the page does not scroll sideways, with everything open", async () => {
  const {page} = await report.open({viewport: kNarrow});
  await unfoldAll(page);
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 400);
  const wide = await page
    .locator("figure.chart > svg, figure.chart > figure")
    .evaluateAll(
      (all) =>
        all.filter(
          (chart) => !chart.closest(".scroll") && chart.getBoundingClientRect().right > 401,
        ).length,
    );
  assert.equal(wide, 0, "charts that stick out");
});

test("charts follow the width of the window", async () => {
  const {page} = await report.open();
  const width = () =>
    page
      .locator("#speed-error figure svg")
      .first()
      .evaluate((svg) => Math.round(svg.getBoundingClientRect().width));
  const wide = await width();
  await page.setViewportSize(kNarrow);
  await settled(page);
  assert.ok(wide > 1000 && (await width()) <= 400);
});

test("print is black on white, without controls, and whole", async () => {
  const {page} = await report.open({colorScheme: "dark"});
  await page.emulateMedia({media: "print", colorScheme: "dark"});
  assert.equal(await background(page), kLight);
  for (const selector of ["nav", ".controls", ".theme"])
    assert.equal(await page.locator(selector).first().isVisible(), false, selector);
  const cut = await page
    .locator(".scroll")
    .evaluateAll((all) => all.filter((box) => getComputedStyle(box).overflow !== "visible").length);
  assert.equal(cut, 0, "tables that a printer would cut");
  assert.ok((await page.pdf()).length > 10000);
});

test("every control is reached by the keyboard", async () => {
  const {page} = await report.open();
  const wanted = await page
    .locator("select, input:checked, summary, .scroll, thead button")
    .count();
  const reached = await page.evaluate(() => {
    const all = [
      ...document.querySelectorAll("select, input:checked, summary, .scroll, thead button"),
    ];
    return all.filter((element) => {
      element.focus();
      return document.activeElement === element || element.closest("details:not([open])") !== null;
    }).length;
  });
  assert.equal(reached, wanted);
  await page.locator("#speed-error").getByRole("combobox", {name: "Level"}).focus();
  await page.keyboard.press("ArrowDown");
  await settled(page);
  assert.equal(
    await page.locator("#speed-error").getByRole("combobox", {name: "Level"}).inputValue(),
    "body",
  );
});
