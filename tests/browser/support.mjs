// What the tests share: one Chromium per file, and a new page of a real report per test.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { after, before } from "node:test";
import { pathToFileURL } from "node:url";
import axe from "axe-core";
import { chromium } from "playwright-core";
import { drawingsNear } from "./waits.mjs";

export { openingPlaced, until } from "./waits.mjs";

/// The folder of `mapproof reproduce yairi2007 --profile quick`, and that of a comparison's page.
export const study = process.env.MAPPROOF_REPORT;
export const comparison = process.env.MAPPROOF_DIFF_PAGE;

/// The pages of all kinds, [name, folder]; MAPPROOF_PAGES has "name=folder", separated by colons.
export const kinds = (process.env.MAPPROOF_PAGES ?? "").split(":").filter(Boolean)
  .map((each) => each.split("="));

export const textOf = (name) => readFileSync(join(study, name), "utf8");

let browser;
before(async () => {
  browser = await chromium.launch({
    executablePath: process.env.MAPPROOF_CHROMIUM,
    args: ["--no-sandbox", "--disable-gpu", "--disable-quic", "--disable-background-networking"],
  });
});
after(() => browser.close());

/// Opens a file of a folder, by default the report. Returns its requests for other files and its
/// errors, too.
export async function open(options = {}, folder = study, file = "report.html", hash = "") {
  const context = await browser.newContext({ viewport: { width: 1400, height: 900 }, ...options });
  const page = await context.newPage();
  page.setDefaultTimeout(120000);  // A report of both papers lays out slowly.
  const requests = [], errors = [];
  const own = pathToFileURL(join(folder, file)).href;
  page.on("request", (request) => {
    const url = request.url(), isInside = /^(data|blob):/.test(url);
    if (!isInside && url.split("#")[0] !== own) requests.push(url);
  });
  page.on("pageerror", (error) => errors.push(String(error)));
  page.on("console", (message) => { if (message.type() === "error") errors.push(message.text()); });
  await page.goto(own + hash);
  return { page, requests, errors, context, close: () => context.close() };
}

/// A figure of the report, with its drawing inserted, and those near it, which could move it later.
export async function figure(page, id) {
  const found = page.locator(`#figure-${id}`);
  await found.evaluate((each) => unfold(each));
  await found.scrollIntoViewIfNeeded();
  await found.locator(".drawing > svg").waitFor();
  await drawingsNear(page);
  return found;
}

// What axe-core leaves to people, and what they found: tables have a gradient of their own paper's
// colours at their sides, where words keep their contrast; the list of contents scrolls below nothing;
// what axe-core takes as behind the tables of a comparison stands above them, images that come late;
// "−", "+" and "#" are signs whose names are words, and "#" stands behind a heading, not in a text.
const kReviewed = {
  "color-contrast": /gradient|image node|overlap|obscured|non-text characters|too short/,
  "label-content-name-mismatch": /Unable to determine/,
  "link-in-text-block": /pseudo style/,
};

/// The violations that axe-core finds in the page, in words, and what it leaves to a review that
/// nobody has made; the page keeps its own policy.
/// @param exclude  Selectors of what is left out.
export async function violations(page, exclude = []) {
  if (!await page.evaluate(() => "axe" in window)) await page.evaluate(axe.source);
  const result = await page.evaluate((without) => window.axe.run(
    { exclude: without.map((one) => [one]) }, { resultTypes: ["violations", "incomplete"] }), exclude);
  const isNew = (id, { any, all, none }) =>
    [...any, ...all, ...none].some(({ message }) => !kReviewed[id]?.test(message));
  const unreviewed = result.incomplete
    .map(({ id, nodes }) => ({ id, nodes: nodes.filter((node) => isNew(id, node)) }))
    .filter(({ nodes }) => nodes.length > 0);
  return [...result.violations, ...unreviewed].map(({ id, nodes }) =>
    `${id}: ${nodes.length}: ${nodes[0].html.slice(0, 160)} ${nodes[0].failureSummary}`);
}
