import assert from "node:assert/strict";
import { statSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { comparison, figure, open, study, violations } from "./support.mjs";

// One figure in six: axe-core examines each element of a drawing.
const insertSome = (page) => page.evaluate(() =>
  document.querySelectorAll("figure[data-id]").forEach((figure, i) => {
    if (i % 6 === 0) putIn(figure);
  }));

const insertAll = (page) => page.evaluate(() => dispatchEvent(new Event("beforeprint")));

test("the first screen has the verdict, the figure it rests on, what is wrong and the rest", async () => {
  const { page, errors, requests, close } = await open({ viewport: { width: 1280, height: 800 } });
  const opening = page.locator("#opening"), text = await opening.innerText();
  assert.match(text, /simulated robot.+10 methods.+runs?\./);  // What was done.
  assert.match(text, /\d+ of \d+\s+published errors inside our 95\s%/);  // Whether it is good.
  assert.match(text, /best published: [\d.]+\sm/);  // Compared with what.
  assert.match(text, /Warnings: /);
  assert.match(await page.locator(".made").innerText(), /mapproof \S+ \(.+\)\. \d{4}-\d\d-\d\d/);
  // All of it, the images too, is seen without scrolling.
  const { y, height } = await opening.boundingBox();
  assert.ok(y + height <= 800, `the opening ends at ${y + height}`);
  const figureLink = opening.locator(".main-figure a");
  assert.equal(await figureLink.getAttribute("href"), "#figure-published-errors");
  assert.ok((await figureLink.locator("img").getAttribute("alt")).length > 40);
  const links = opening.locator(".thumbnails a");
  assert.equal(await links.count(), 6);
  assert.ok(await opening.locator('.thumbnails a[href^="#figure-scene-"]').count() >= 1);
  for (const image of await opening.locator("img").all()) {
    assert.ok(await image.evaluate((each) => each.decode().then(() => each.naturalWidth > 0)));
  }
  // There is no earlier nightly run to compare with.
  assert.equal(await page.locator(".standing").count(), 0);
  for (const link of await opening.locator(".highlights a").all()) {
    assert.equal(await page.locator(await link.getAttribute("href")).count(), 1);
  }
  const target = (await links.nth(1).getAttribute("href")).slice(1);
  await links.nth(1).click();
  await page.locator(`#${target} svg`).waitFor();
  assert.deepEqual(errors, []);
  assert.deepEqual(requests, []);
  await close();
});

test("the contents follow the reader, also if they are longer than the window", async () => {
  const { page, close } = await open({ viewport: { width: 1400, height: 300 } });
  await page.locator("main > section").last().evaluate((section) => section.scrollIntoView());
  await page.waitForFunction(() => {
    const link = document.querySelector(".contents a[aria-current]")?.getBoundingClientRect();
    const list = document.querySelector(".contents").getBoundingClientRect();
    return link && list.height < 300 && document.querySelector(".contents").scrollTop > 0 &&
      link.top >= list.top - 1 && link.bottom <= list.bottom + 1;
  });
  await close();
});

test("at the head of the page the contents start with their first entry", async () => {
  const { page, close } = await open({ viewport: { width: 1400, height: 300 } });
  await page.locator("main > section").last().evaluate((section) => section.scrollIntoView());
  await page.waitForFunction(() => document.querySelector(".contents").scrollTop > 0);
  await page.evaluate(() => scrollTo(0, 0));
  await page.waitForFunction(() => document.querySelector(".contents").scrollTop === 0,
    undefined, { timeout: 5000 });
  assert.equal(await page.locator(".contents a[aria-current]").count(), 0);
  await close();
});

test("every entry of the contents links to its section", async () => {
  const { page, close } = await open();
  const links = await page.locator(".contents a").evaluateAll(
    (all) => all.map((link) => link.getAttribute("href").slice(1)));
  assert.ok(links.length > 8);
  for (const id of links) assert.equal(await page.locator(`section[id="${id}"]`).count(), 1, id);
  await close();
});

for (const [name, options] of [["light", {}], ["dark", { colorScheme: "dark" }],
  ["phone", { viewport: { width: 390, height: 844 } }]]) {
  test(`axe-core finds no violation in the report: ${name}`, async () => {
    const { page, close } = await open(options);
    await insertSome(page);
    assert.deepEqual(await violations(page), []);
    await close();
  });
}

test("axe-core finds no violation in a figure that is zoomed and highlighted", async () => {
  const { page, close } = await open();
  const film = await figure(page, "forming-bearing");
  await film.getByRole("slider").fill("2");
  const map = await figure(page, "map-bearing-isomap");
  await map.locator("summary").click();
  await map.getByRole("button", { name: "Zoom in" }).click();
  await map.locator(".drawing").focus();
  await page.keyboard.press("n");
  assert.deepEqual(await violations(page), []);
  await close();
});

test("axe-core finds no violation in the page of a comparison", { skip: !comparison }, async () => {
  for (const options of [{}, { colorScheme: "dark" }]) {
    const { page, close } = await open(options, comparison, "diff.html");
    assert.deepEqual(await violations(page), []);
    await close();
  }
});

test("the page is not wider than a phone", async () => {
  const { page, close } = await open({ viewport: { width: 390, height: 844 } });
  await insertAll(page);
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth) <= 390);
  await close();
});

test("without a script every figure is shown", async () => {
  const { page, close } = await open({ javaScriptEnabled: false });
  const shown = await page.locator(".drawing noscript > svg").count();
  assert.ok(shown > 50);
  assert.equal(shown, await page.locator("figure .drawing").count());
  assert.ok((await page.locator("#figure-map-bearing-isomap svg").boundingBox()).height > 200);
  assert.equal(await page.locator(".tools").count(), 0);
  await close();
});

test("every control can be reached by Tab and has a name", async () => {
  const { page, close } = await open();
  await figure(page, "map-bearing-isomap");
  const nameless = await page.evaluate(() => {
    const isNamed = (each) => each.textContent.trim() || each.ariaLabel || each.labels?.length;
    return Array.from(document.querySelectorAll("button, input, select, a[href], summary"))
      .filter((each) => each.tabIndex < 0 || !isNamed(each)).length;
  });
  assert.equal(nameless, 0);
  const drawing = page.locator("#figure-map-bearing-isomap .drawing");
  await drawing.focus();
  await page.keyboard.press("Tab");
  const label = await page.evaluate(() => document.activeElement.getAttribute("aria-label"));
  assert.equal(label, "Zoom out");
  await close();
});

test("the printed report has all figures", async () => {
  const { page, close } = await open();
  const held = await page.locator("figure .drawing").count();
  const pdf = (await page.pdf({ format: "A4" })).toString("latin1");
  assert.equal(await page.locator(".drawing > svg").count(), held);
  const pages = (pdf.match(/\/Type\s*\/Page[^s]/g) ?? []).length;
  assert.ok(pages > 15 && pages < 120, `${pages} pages`);
  await close();
});

test("the report is one file of at most 10 MB that loads nothing else", async () => {
  assert.ok(statSync(join(study, "report.html")).size <= 10e6);
  const { page, requests, errors, close } = await open();
  await insertAll(page);
  await page.waitForTimeout(500);
  assert.deepEqual(requests, []);
  assert.deepEqual(errors, []);
  await close();
});
