import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { cpSync, existsSync, mkdtempSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { open, until, violations } from "./support.mjs";

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

/// The folder of a history whose second nightly run got worse, with a commit each.
const regressed = process.env.MAPPROOF_REGRESSED;
const ofRegressed = { skip: regressed ? false : "no python3, which makes the study" };
const study = "localisers";

test("no date of the index ends a line on a phone, in tables and in sentences", async () => {
  const { page, close } = await open({ viewport: { width: 390, height: 844 } }, history, "index.html");
  const dates = await page.evaluate(() => {
    const found = [], texts = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    while (texts.nextNode()) {
      const { data, parentElement } = texts.currentNode;
      if (parentElement.closest("svg, script, style, noscript, code")) continue;
      for (const date of data.matchAll(/\d{4}[-\u2011]\d\d[-\u2011]\d\d([ \u00a0]\d\d:\d\d)?/g)) {
        const range = document.createRange();
        range.setStart(texts.currentNode, date.index);
        range.setEnd(texts.currentNode, date.index + date[0].length);
        const tops = [...range.getClientRects()].map(({ top }) => Math.round(top));
        if (tops.length > 0) found.push({ date: date[0], lines: new Set(tops).size });
      }
    }
    return found;
  });
  assert.ok(dates.length >= 4, `${dates.length} dates`);
  assert.deepEqual(dates.filter(({ lines }) => lines > 1), []);
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth - innerWidth), 0);
  await close();
});

test("as many findings are listed as the title counts, and the curve is red", ofRegressed, async () => {
  const { page, close } = await open({}, regressed, "index.html");
  const title = await page.locator(".standing strong").innerText();
  const [, count] = title.match(/: (\d+) findings?$/);
  const items = await page.locator(".standing li").allInnerTexts();
  const listed = items.map((item) => /both findings/.test(item) ? 2
    : Number(item.match(/(\d+) (?:of the \d+ |more )?findings/)?.[1] ??
      item.match(/all (\d+) (?:settings|levels)/)?.[1] ?? 1));
  assert.equal(listed.reduce((sum, one) => sum + one), Number(count), items.join("\n"));
  const row = page.locator("#table-studies tbody tr").first();
  assert.equal(await row.locator("svg.curve circle").first().getAttribute("class"), "worse");
  await close();
});

test("a tip on a figure of trends says of which nightly run it is", ofRegressed, async () => {
  const { page, close } = await open({}, regressed,
    "trends/localisers/report.html");
  await page.keyboard.press("Tab");  // What follows is focus by keyboard.
  await page.locator("figure .drawing").first().focus();
  const tip = page.locator(".tip").first();
  await tip.waitFor();
  assert.match(await tip.innerText(), /\nnightly run \d/);
  await close();
});

test("the first screen says what ran, how good it is, compared with what, what is wrong and where " +
  "the rest is", ofRegressed, async () => {
  const { page, close } = await open({ viewport: { width: 1280, height: 800 } }, regressed,
    "index.html");
  const opening = page.locator("#opening");
  const text = await opening.innerText();
  for (const answer of [/Last: nightly run 2, .*, of localisers/, /accuracy got worse/,
    /Compared with: nightly run 1/, /EKF: .* \+/, /report of nightly run 2/])
    assert.match(text, answer);
  const box = await opening.locator(".standing").boundingBox();
  assert.ok(box.y + box.height < 800);
  await close();
});

test("statistics and the search for the commit are behind a click", ofRegressed, async () => {
  const { page, close } = await open({}, regressed, "index.html");
  const finding = page.locator("#section-worse .worsening").first();
  const command = finding.locator("pre");
  assert.equal(await command.isVisible(), false);
  await finding.locator("summary").click();
  const line = await command.innerText();
  assert.match(line, /^git bisect start [0-9a-f]{9} [0-9a-f]{9} && git bisect run sh -c /);
  assert.doesNotMatch(line, /--commit|--build/);
  assert.match(await finding.innerText(), /diff of nightly runs 1 and 2/);
  await close();
});

test("on paper statistics and the search for the commit are open", ofRegressed, async () => {
  const report = join(regressed, "nightly_runs", "0002", study);
  for (const [folder, file] of [[regressed, "index.html"], [report, "report.html"]]) {
    const { page, close } = await open({}, folder, file);
    const command = page.locator(".worsening pre").first();
    await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
    assert.ok(await command.isVisible(), file);
    await page.evaluate(() => dispatchEvent(new Event("afterprint")));
    assert.equal(await command.isVisible(), false);
    await close();
  }
});

test("the index has commands that can be copied as they stand", ofRegressed, async () => {
  const { page, close } = await open({ permissions: ["clipboard-read", "clipboard-write"] }, regressed,
    "index.html");
  await page.locator("#opening").getByRole("button", { name: "Copy the search for the commit" }).click();
  // The button names it for two seconds, and the status stays.
  await until(page, () => document.querySelector("#status")?.textContent.includes("copied"));
  assert.match(await page.evaluate(() => navigator.clipboard.readText()), /^git bisect start .*\(make\)/);
  const selects = page.locator(".compare select");
  await selects.nth(0).selectOption("2");
  await selects.nth(1).selectOption("1");
  const command = await page.locator(".compare code").innerText();
  assert.match(command, /^mapproof history \S+ --compare 2 1$/);
  assert.doesNotMatch(command, /STORE/);
  await close();
});

test("a nightly run's report begins with what got worse, marked in tables and figures", ofRegressed,
  async () => {
    const { page, close } = await open({}, join(regressed, "nightly_runs", "0002", study));
    const ids = await page.locator("main > section").evaluateAll((all) => all.map((one) => one.id));
    assert.deepEqual(ids.slice(0, 2), ["opening", "section-worse"]);
    const next = page.locator("main > section").nth(2);
    assert.ok(await next.locator(".regression").count() > 0);
    assert.ok(await page.locator("tr.regressed").first().isVisible());
    const figure = page.locator("figure:has(p.regression)").first();
    await figure.scrollIntoViewIfNeeded();
    await figure.locator(".drawing > svg").waitFor();
    assert.ok(await figure.locator("svg .got-worse").count() > 0);
    assert.ok(await page.locator(".opening p.regression").isVisible());
    await close();
  });

test("on a phone each ring is around the point that it marks", ofRegressed, async () => {
  const { page, close } = await open({ viewport: { width: 390, height: 844 } },
    join(regressed, "nightly_runs", "0002", study));
  const figure = page.locator("figure:has(p.regression)").first();
  await figure.scrollIntoViewIfNeeded();
  await figure.locator(".drawing.stacked > svg").waitFor();
  const rings = figure.locator("svg .got-worse");
  assert.ok(await rings.count() > 0);
  const misplaced = await rings.evaluateAll((all) => all.filter((ring) =>
    ![...ring.closest("g").querySelectorAll(".marker")].some((marker) => ["x", "y"].every(
      (name) => marker.getAttribute(name) === ring.getAttribute(name)))).length);
  assert.equal(misplaced, 0);
  await close();
});

test("decisions that the page saves are taken by the program", ofRegressed, async () => {
  const folder = mkdtempSync(join(tmpdir(), "mapproof-decisions-"));
  const store = join(folder, "history");
  cpSync(regressed, store, { recursive: true });
  const first = await open({ acceptDownloads: true }, store, "index.html");
  const boxes = first.page.locator(".worsening .decision");
  for (let i = 0; i < await boxes.count(); ++i) {
    await boxes.nth(i).getByRole("combobox").selectOption("known");
    await boxes.nth(i).getByRole("textbox").fill("the <b>map</b> changed, issue 12");
  }
  const saved = first.page.waitForEvent("download");
  await first.page.getByRole("button", { name: "Save decisions" }).click();
  const file = join(folder, "mapproof-decisions.json");
  await (await saved).saveAs(file);
  await first.close();
  execFileSync(process.env.MAPPROOF_PROGRAM, ["history", store, "--from", file, "--quiet"]);
  const { page, close } = await open({}, store, "index.html");
  assert.match(await page.locator(".standing strong").innerText(), /nothing new got worse .*; accuracy is worse as known: \d+ findings$/);
  assert.equal(await page.locator(".standing.worse").count(), 0);
  assert.match(await page.locator(".worsening.known").first().innerText(),
    /Known: the <b>map<\/b> changed, issue 12/);
  await close();
});
