import assert from "node:assert/strict";
import { existsSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { open, violations } from "./support.mjs";

/// The folder of a history of two nightly runs.
const history = process.env.MAPPROOF_HISTORY;
const pages = [
  [history, "index.html"],
  [join(history, "trends", "small"), "report.html"],
  [join(history, "nightly_runs", "0002", "small"), "report.html"],
];
const settings = [{}, { colorScheme: "dark" }, { viewport: { width: 390, height: 844 } },
  { viewport: { width: 390, height: 844 }, colorScheme: "dark" }];

for (const [folder, file] of pages) {
  const name = join(folder, file).slice(history.length + 1);
  test(`axe-core finds no violation in ${name}, wide and phone, light and dark`, async () => {
    for (const setting of settings) {
      const { page, errors, requests, close } = await open(setting, folder, file);
      assert.deepEqual(await violations(page), []);
      assert.equal(await page.evaluate(() => document.documentElement.scrollWidth - innerWidth), 0);
      assert.deepEqual([...errors, ...requests], []);
      await close();
    }
  });

  test(`every link of ${name} leads to an existing file`, async () => {
    const { page, close } = await open({}, folder, file);
    const links = await page.locator("a[href]").evaluateAll((all) => all.map((link) => link.href));
    const files = links.filter((link) => link.startsWith("file:"))
      .map((link) => fileURLToPath(link.split("#")[0]));
    assert.ok(files.length > 0);
    const here = dirname(join(folder, file));
    for (const each of files) assert.ok(existsSync(resolve(here, each)), each);
    await close();
  });
}

test("the index and the report of the last nightly run link to each other", async () => {
  const { page, close } = await open({}, history, "index.html");
  assert.match(await page.locator(".standing").innerText(), /Nightly run 2: /);
  assert.ok(await page.locator("#section-course svg").count() > 0);
  await page.locator("#section-last").getByRole("link", { name: "report of nightly run 2" }).click();
  assert.match(await page.locator(".standing").innerText(), /Nightly run 2: /);
  await page.getByRole("link", { name: "trends of small" }).click();
  assert.match(await page.locator(".standing").innerText(), /Nightly run 2: /);
  await page.getByRole("link", { name: "all nightly runs" }).click();
  await page.locator("#section-nightly-runs").waitFor();
  await close();
});

test("the first column of the table of nightly runs is as wide as a number", async () => {
  const phone = { viewport: { width: 390, height: 844 } };
  const { page, close } = await open(phone, history, "index.html");
  const { width } = await page.locator("#table-nightly-runs tbody th").first().boundingBox();
  assert.ok(width < 80, `${width}`);
  await close();
});
