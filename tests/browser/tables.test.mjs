import assert from "node:assert/strict";
import { test } from "node:test";
import { open, textOf, until } from "./support.mjs";

async function firstTable(page) {
  const holder = page.locator(".table:has(input[type=search])").first();
  await holder.evaluate((each) => unfold(each));
  const id = (await holder.getAttribute("id")).replace("table-", "");
  return { holder, id };
}

const clipboard = (page) => page.evaluate(() => navigator.clipboard.readText());

async function copied(page, holder, name) {
  // An earlier copy has left its words.
  await page.evaluate(() => document.querySelector("#status")?.replaceChildren());
  await holder.getByRole("button", { name }).click();
  await until(page, () => document.querySelector("#status")?.textContent.includes("copied"));
  return clipboard(page);
}

test("a heading sorts its table both ways and sets aria-sort", async () => {
  const { page, close } = await open();
  const { holder } = await firstTable(page);
  const heading = holder.locator("th[data-column]:not([class~=text])").last();
  const column = Number(await heading.getAttribute("data-column"));
  const keys = () => holder.locator("tbody tr").evaluateAll(
    (rows, index) => rows.map((row) => Number(row.cells[index].dataset.sort || NaN))
      .filter((key) => !Number.isNaN(key)), column);
  await heading.getByRole("button").click();
  assert.equal(await heading.getAttribute("aria-sort"), "ascending");
  const up = await keys();
  assert.deepEqual(up, [...up].sort((a, b) => a - b));
  await heading.getByRole("button").press("Enter");
  assert.equal(await heading.getAttribute("aria-sort"), "descending");
  assert.deepEqual(await keys(), [...up].reverse());
  await close();
});

test("a table is filtered by method, counts its rows, and is whole on paper", async () => {
  const { page, close } = await open();
  const { holder } = await firstTable(page);
  const rows = await holder.locator("tbody tr").count();
  await holder.getByRole("combobox").fill("smacof");
  const shown = holder.locator("tbody tr:not([hidden])");
  for (const name of await shown.locator("th").allTextContents()) assert.match(name, /SMACOF/);
  const left = await shown.count();
  assert.ok(left > 0 && left < rows);
  assert.equal(await holder.locator("output").textContent(), `${left} of ${rows} rows`);
  await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
  assert.equal(await shown.count(), rows);
  await page.evaluate(() => dispatchEvent(new Event("afterprint")));
  assert.equal(await shown.count(), left);
  await close();
});

test("the tables have intervals and the paper's values", async () => {
  const { page, close } = await open();
  const { holder } = await firstTable(page);
  const words = await holder.locator("thead").innerText();
  assert.match(words, /95 % interval/);
  assert.match(words, /Paper/);
  await close();
});

test("copies equal the files, and follow filter and order", async () => {
  const { page, close } = await open({ permissions: ["clipboard-read", "clipboard-write"] });
  const { holder, id } = await firstTable(page);
  assert.equal(await copied(page, holder, /Copy CSV/), textOf(`tables/${id}.csv`));
  assert.equal(await copied(page, holder, /Copy LaTeX/), textOf(`tables/${id}.tex`));
  await holder.locator("th[data-column] button").first().click();
  await holder.locator("th[data-column] button").first().click();
  await holder.getByRole("combobox").fill("smacof");
  const lines = (await copied(page, holder, /Copy CSV/)).trimEnd().split("\r\n");
  const names = await holder.locator("tbody tr:not([hidden]) th").allTextContents();
  assert.equal(lines.length, 1 + names.length);
  names.forEach((name, i) => {
    assert.ok(lines[i + 1].replaceAll('"', "").startsWith(name), lines[i + 1]);
  });
  await close();
});

test("without access to the clipboard the older command copies", async () => {
  const { page, close } = await open({ permissions: ["clipboard-read", "clipboard-write"] });
  const { holder, id } = await firstTable(page);
  await page.evaluate(() => {
    navigator.clipboard.writeText = () => Promise.reject(new Error("not allowed"));
  });
  assert.equal((await copied(page, holder, /Copy CSV/)).replaceAll("\r\n", "\n"),
    textOf(`tables/${id}.csv`).replaceAll("\r\n", "\n"));
  await close();
});
