// A report of more figures than one page holds: its pages, and the ways between them.
import assert from "node:assert/strict";
import { existsSync } from "node:fs";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { open } from "./support.mjs";

const folder = process.env.MAPPROOF_MANY;
const options = { skip: folder ? false : "no python3, which makes the study" };

test("the index leads to each figure of another page, and opens it there", options, async () => {
  const { page, errors, close } = await open({}, folder);
  assert.equal(await page.locator("figure[data-id]").count() +
    await page.locator(".page-links a").count(), 401);  // With the best map in space.
  const link = page.locator(".page-links a").last();
  const title = await link.textContent();
  await page.evaluate(() => unfold([...document.querySelectorAll(".page-links a")].at(-1)));
  await link.click();
  await page.waitForURL(/pages\/\d+\.html#figure-/);
  const shown = page.locator(new URL(page.url()).hash);
  await shown.locator(".drawing > svg").waitFor();
  assert.match(await shown.locator("figcaption bdi").first().textContent(), new RegExp(`^${title}`));
  assert.ok(await shown.getByRole("button", { name: "Full screen" }).isVisible());
  await page.locator("#opening a").first().click();
  await page.waitForURL(/report\.html$/);
  assert.deepEqual(errors, []);
  await close();
});

test("a method that is chosen is highlighted on the other pages, too", options, async () => {
  const { page, errors, close } = await open({}, folder);
  const list = page.getByRole("combobox", { name: "Highlight a method in all figures and tables" });
  const name = await list.locator("option").nth(1).textContent();
  await list.selectOption(name);
  // Also where a link is opened by a menu, copied or found by the search.
  const field = page.getByRole("searchbox", { name: "Search this page" });
  await field.fill(await page.locator(".page-links a").last().textContent());
  const leading = await page.locator("a[href*='pages/']").evaluateAll(
    (all) => all.map((each) => each.getAttribute("href")));
  assert.ok(leading.length > await page.locator(".page-links a").count());
  const query = `?${new URLSearchParams({ method: name })}#`;
  assert.ok(leading.every((each) => each.includes(query)), leading.find((each) => !each.includes(query)));
  await field.fill("");
  const link = page.locator(".page-links a").first();
  const follow = async () => {
    await page.evaluate(() => unfold(document.querySelector(".page-links a")));
    await link.click();
  };
  await follow();
  await page.waitForURL(/pages\/\d+\.html\?method=.*#figure-/);
  assert.equal(await list.inputValue(), name);
  await page.locator("#opening a").first().click();
  await page.waitForURL(/report\.html\?method=/);
  assert.equal(await list.inputValue(), name);
  await list.selectOption("");
  await follow();
  await page.waitForURL(/pages\/\d+\.html#figure-/);
  assert.deepEqual(errors, []);
  await close();
});

test("the search of the index finds what other pages hold", options, async () => {
  const { page, close } = await open({}, folder);
  const title = await page.locator(".page-links a").last().textContent();
  const field = page.getByRole("searchbox", { name: "Search this page" });
  await field.fill(title);
  await field.press("Enter");
  await page.waitForURL(/pages\/\d+\.html#figure-/);
  await close();
});

test("a further page leads to its neighbours and to files that are there", options, async () => {
  const { page, requests, close } = await open({}, folder, "pages/2.html");
  assert.deepEqual(requests, []);
  const links = await page.locator("figure .files a[href^='..']").evaluateAll(
    (all) => all.slice(0, 8).map((each) => each.href));
  assert.equal(links.length, 8);
  for (const link of links) assert.ok(existsSync(fileURLToPath(link)), link);
  await close();
});
