// Names are text: nothing in results becomes HTML, and nothing leaves the page.
import assert from "node:assert/strict";
import {test} from "node:test";
import {tableTexts, unfoldAll, useReport} from "./report.mjs";

const report = useReport("two_scenes.json");

test("names that look like HTML stay text", async () => {
  const {page} = await report.open();
  let dialogs = 0;
  page.on("dialog", (dialog) => {
    ++dialogs;
    return dialog.dismiss();
  });
  const scripts = await page.locator("script").count();
  await unfoldAll(page);
  assert.equal(await page.locator("main script, main img, main i, main b, main u").count(), 0);
  assert.equal(await page.locator("script").count(), scripts);
  assert.equal(dialogs, 0);
  assert.ok(
    (await page.locator("main").textContent()).includes('A title with <b>tags</b> & "quotes"'),
  );
  assert.equal((await tableTexts(page, "Bodies"))[1][0], "left");
});

test("no request leaves the page, whatever is clicked", async () => {
  const {page} = await report.open();
  await unfoldAll(page);
  for (const select of await page.locator("select").all())
    for (const option of await select.locator("option").all())
      await select.selectOption(await option.getAttribute("value"));
  await page.mouse.move(640, 450);
  assert.deepEqual(report.requests(), []);
  assert.deepEqual(report.errors(), []);
});

test("the page forbids itself the network", async () => {
  const {page} = await report.shared();
  const allowed = await page.evaluate(() =>
    fetch("https://example.org/").then(
      () => true,
      () => false,
    ),
  );
  assert.equal(allowed, false);
  assert.match(
    await page.locator("meta[http-equiv]").getAttribute("content"),
    /^default-src 'none'/,
  );
});
