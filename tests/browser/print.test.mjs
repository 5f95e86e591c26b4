// The pages of all kinds on paper: nothing is shrunk, cut off, too small, alone or half empty.
import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { kinds, open } from "./support.mjs";
import { openingPlaced } from "./waits.mjs";

const kPaper_px = 688;  // Between the margins of A4.
const kLeast_pt = 8;

async function onPaper(folder) {
  const opened = await open({ viewport: { width: kPaper_px, height: 990 } }, folder);
  await opened.page.emulateMedia({ media: "print" });
  await opened.page.evaluate(() => dispatchEvent(new Event("beforeprint")));
  return opened;
}

for (const [name, folder] of kinds) {
  test(`${name}: nothing is wider than paper, which would shrink the page`, async () => {
    const { page, errors, close } = await onPaper(folder);
    const { width, wider } = await page.evaluate((most) => ({
      width: document.documentElement.scrollWidth,
      wider: [...document.querySelectorAll("table, .drawing, img")]
        .filter((each) => each.getBoundingClientRect().right > most + 1)
        .map((each) => each.closest("[id]").id) }), kPaper_px);
    assert.deepEqual(wider, []);
    assert.ok(width <= kPaper_px, `${width} px`);
    assert.deepEqual(errors, []);
    await close();
  });

  test(`${name}: text and the words of drawings have 8 pt at least on paper`, async () => {
    const { page, close } = await onPaper(folder);
    const small = await page.evaluate((least) => {
      const found = [], kPoints = .75, kUnitsOfFont = 2048;
      const texts = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
      while (texts.nextNode()) {
        const element = texts.currentNode.parentElement;
        if (!texts.currentNode.data.trim() || element.getClientRects().length === 0) continue;
        if (element.closest("svg, script, style, noscript, .visually-hidden")) continue;
        const size = kPoints * parseFloat(getComputedStyle(element).fontSize);
        if (size < least - .01) found.push(`${size} pt: ${element.outerHTML.slice(0, 80)}`);
      }
      for (const svg of document.querySelectorAll(".drawing > svg")) {
        const words = [...svg.querySelectorAll('g[transform*="scale("]')].filter(
          (each) => each.getBoundingClientRect().width > 0);
        const size = kPoints * svg.getScreenCTM().a * Math.min(...words.map((each) =>
          kUnitsOfFont * Number(/scale\(([\d.]+)/.exec(each.getAttribute("transform"))[1])));
        if (size < least - .02) found.push(`${size} pt: ${svg.closest("figure").id}`);
      }
      return found;
    }, kLeast_pt);
    assert.deepEqual(small, []);
    await close();
  });
}

for (const [name, folder] of kinds) {
  test(`${name}: paper shows all panels of the figure of the first screen`, async () => {
    const { page, close } = await onPaper(folder);
    await openingPlaced(page);
    const panels = await page.evaluate(() => {
      const link = document.querySelector(".main-figure a");
      if (!link) return [];
      const count = (text) => text.match(/class="frame"/g)?.length ?? 0;
      const source = count(sourceOf(document.getElementById(link.hash.slice(1))));
      return [...link.querySelectorAll("img")].filter((each) => each.checkVisibility()).map(
        (each) => [count(openingDrawings.get(each)), source]);
    });
    assert.ok(panels.length <= 1, `${panels.length} images`);
    for (const [shown, all] of panels) assert.equal(shown, all);
    await close();
  });
}

test("a table that paper is too narrow for has its intervals below their values, and gets them back",
  async () => {
    const { page, close } = await open({ viewport: { width: kPaper_px, height: 990 } });
    const table = page.locator("table:has(th.interval)").first();
    const state = () => table.evaluate((each) => ({
      below: each.querySelectorAll(".below").length, hidden: each.querySelectorAll("[hidden]").length,
      columns: [...each.tHead.rows[0].cells].reduce((sum, cell) => sum + cell.colSpan, 0),
      text: each.textContent }));
    const before = await state();
    await page.evaluate((wide) => {
      // A name that leaves the numbers no room.
      document.querySelector("table:has(th.interval) thead th[data-column]").append(wide);
      dispatchEvent(new Event("beforeprint"));
    }, "m".repeat(60));
    const paper = await state();
    assert.ok(paper.below > before.below && paper.hidden >= paper.below, JSON.stringify(paper));
    assert.ok(paper.columns < before.columns);
    await page.evaluate(() => dispatchEvent(new Event("afterprint")));
    const after = await state();
    assert.equal(after.below, before.below);
    assert.equal(after.columns, before.columns);
    assert.equal(after.text.replace("m".repeat(60), ""), before.text);
    await close();
  });

test("the titles of drawings are text on paper, and drawn again after it", async () => {
  const { page, close } = await open();
  const boxes = () => page.evaluate(() => held.slice(0, 8).map((each) => {
    putIn(each);
    return each.querySelector("svg").getAttribute("viewBox");
  }));
  const before = await boxes();
  await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
  const paper = await boxes();
  assert.ok(paper.every((box, i) => box !== before[i]));
  assert.ok(await page.locator(".drawn-title").count() >= paper.length);
  await page.evaluate(() => dispatchEvent(new Event("afterprint")));
  assert.deepEqual(await boxes(), before);
  assert.equal(await page.locator(".drawn-title").count(), 0);
  await close();
});

test("a drawing that is higher than a third of a page is shown in slices of its rows on paper", async () => {
  const boots = new Map(kinds).get("boots");
  const { page, close } = await open({}, boots);
  const state = () => page.evaluate(() => [...document.querySelectorAll("figure[data-id]")]
    .map((figure) => [...figure.querySelectorAll(".drawing > svg")].map((svg) => {
      const [, y, width, height] = svg.getAttribute("viewBox").split(" ").map(Number);
      return { y, width, height, shown_px: parseFloat(
        svg.parentElement.style.getPropertyValue("--paper-width")) * height / width };
    })));
  await page.evaluate(() => {
    for (const each of held) putIn(each);
  });
  const before = await state();
  await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
  const paper = (await state()).filter((slices) => slices.length > 1);
  assert.ok(paper.length > 0, "no figure is high");
  for (const slices of paper) {
    const whole = slices.reduce((sum, { shown_px }) => sum + shown_px, 0);
    assert.ok(whole > 340 && slices.every(({ shown_px }) => shown_px < .75 * whole), `${whole}`);
    // One begins where the one before it ends.
    for (const [i, { y, height }] of slices.slice(0, -1).entries()) {
      assert.ok(Math.abs(y + height - slices[i + 1].y) < .01);
    }
  }
  await page.evaluate(() => dispatchEvent(new Event("afterprint")));
  assert.deepEqual(await state(), before);
  await close();
});

test("a row of panels that is too high for paper gets lower, with all its words, and high again", async () => {
  const { page, close } = await open();
  const state = () => page.evaluate(() => [...document.querySelectorAll("figure[data-id]")]
    .map((figure) => ({ id: figure.dataset.id, svg: figure.querySelector(".drawing > svg") }))
    .map(({ id, svg }) => ({ id, drawn: svg.innerHTML,
      heights: [...svg.querySelectorAll("clipPath > rect")].map((each) => Number(each.getAttribute("height"))),
      hidden: [...svg.querySelectorAll('g[transform*="scale("]')].filter(
        (words) => words.getAttribute("display") === "none").length })));
  await page.evaluate(() => {
    for (const each of held) {
      unfold(each);
      putIn(each);
    }
  });
  const before = await state();
  await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
  const paper = await state();
  const lowered = paper.filter(({ heights }, i) => heights.some(
    (height, k) => height < before[i].heights[k] - 1)).map(({ id }) => id);
  for (const id of ["fig-4", "ranks-bearing"]) assert.ok(lowered.includes(id), `${lowered}`);
  assert.deepEqual(paper.map(({ hidden }) => hidden), before.map(({ hidden }) => hidden));
  await page.evaluate(() => dispatchEvent(new Event("afterprint")));
  (await state()).forEach(({ id, drawn }, i) => assert.ok(drawn === before[i].drawn, id));
  await close();
});

// What a page of paper is filled to, of what it holds between its margins, and its words.
function pagesOf(pdf) {
  const folder = mkdtempSync(join(tmpdir(), "mapproof-print-"));
  try {
    writeFileSync(join(folder, "report.pdf"), pdf);
    const file = join(folder, "report.pdf"), options = { maxBuffer: 1 << 28 };
    const texts = execFileSync("pdftotext", ["-layout", file, "-"], options).toString()
      .split("\f").slice(0, -1);
    const images = execFileSync("pdftoppm", ["-r", "30", "-gray", file], options);
    const pages = [];
    for (let at = 0; at < images.length;) {
      const head = /^P5\s+(\d+)\s+(\d+)\s+\d+\s/.exec(images.subarray(at, at + 40).toString("latin1"));
      const [width, height] = head.slice(1).map(Number), begin = at + head[0].length;
      const kFoot = .955, kDark = 200;  // The number of the page is below.
      const end = Math.floor(kFoot * height);
      let last = end - 1;
      while (last > 0 && images.subarray(begin + last * width, begin + (last + 1) * width)
        .every((grey) => grey >= kDark)) --last;
      const lines = texts[pages.length].split("\n").map((line) => line.trim().replace(/\s+/g, " "))
        .filter((line) => line !== "" && !/^\d+ \/ \d+$/.test(line));
      pages.push({ filled: last / end, lines });
      at = begin + width * height;
    }
    assert.equal(pages.length, texts.length);
    return pages;
  } finally {
    rmSync(folder, { recursive: true });
  }
}

const hasPoppler = ["pdftotext", "pdftoppm"].every(
  (name) => spawnSync(name, ["-v"]).status === 0);
const withPoppler = { skip: hasPoppler ? false : "no pdftotext and pdftoppm (poppler-utils)" };

const nightlyIndex = process.env.MAPPROOF_HISTORY
  ? [["nightly index", process.env.MAPPROOF_HISTORY, "index.html"]] : [];

for (const [name, folder, file] of [...kinds, ...nightlyIndex]) {
  test(`${name}: no page of paper but the last ends before the figure of a heading, or is half empty`, withPoppler,
    async () => {
      const { page, close } = await open({}, folder, file);
      const pdf = await page.pdf({ format: "A4", preferCSSPageSize: true });
      const headings = await page.evaluate(() => {
        const words = (selector) => [...document.querySelectorAll(selector)].map(
          (each) => each.textContent.trim().replace(/\s+/g, " "));
        const leads = words(":is(h2, summary) + p:has(+ :is(figure, .gallery))");
        return words("h3").concat(leads).concat([...document.querySelectorAll("main h2")].map(
          (each) => [...each.childNodes].filter((node) => node.nodeType === Node.TEXT_NODE)
            .map((node) => node.data).join("").trim().replace(/\s+/g, " ")));
      });
      const pages = pagesOf(pdf);
      assert.ok(pages.length >= 2, `${pages.length} pages`);
      const kLeastFilled = .5;  // Figures keep their proportions; the emptiest page of all has .55.
      pages.slice(0, -1).forEach(({ filled, lines }, i) => {
        const last = lines.at(-1) ?? "";
        // The first pages may end with the contents, which name the headings.
        assert.ok(i < 2 || !headings.some((one) => one !== "" && last.length > 8 && one.endsWith(last)),
          `page ${i + 1} ends with ${last}`);
        assert.ok(filled > kLeastFilled, `page ${i + 1} is filled to ${filled}, and then comes ${
          pages[i + 1].lines[0]}`);
      });
      if (await page.locator(".other-pages").count() > 0) {
        assert.ok(pages.at(-1).lines.length > 2, `alone: ${pages.at(-1).lines}`);
      }
      await close();
    });
}

test("what can be divided begins below a figure that leaves room for its beginning", withPoppler,
  async () => {
    const { page, close } = await open();
    await page.evaluate(() => {
      const first = document.createElement("section"), heading = document.createElement("h2");
      heading.textContent = "First";
      first.append(heading, document.querySelector("figure[data-id]:not(.wide)"));
      document.querySelector("main").replaceChildren(first, document.querySelector("#section-provenance"));
      for (const each of document.querySelectorAll("header, nav")) each.remove();
    });
    const [{ filled, lines }] = pagesOf(await page.pdf({ format: "A4", preferCSSPageSize: true }));
    assert.ok(filled > .7 && lines.some((line) => line.startsWith("Provenance")),
      `filled to ${filled}: ${lines.join("; ")}`);
    await close();
  });
