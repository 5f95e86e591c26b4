"use strict";
// Runs beside a report in a frame, clicks in it, looks at it, and writes one "name=value" line a
// finding into <pre id="findings">. What the values must be is the business of browser_test.cpp.
const findings = [];
const say = (name, value) => findings.push(`${name}=${value}`);

// The text of the page as its own code points: templates may break lines around a text.
function checkTexts(page, expected) {
  const text = page.body.textContent + "\n" + page.title;
  const attributes = Array.from(page.querySelectorAll("*"),
    (element) => Array.from(element.attributes, (attribute) => attribute.value)).flat();
  say("texts", expected.texts.length);
  say("missing-texts", expected.texts.filter((each) => !text.includes(each)).length);
  const missing = expected.attributes.filter((each) => !attributes.includes(each));
  say("missing-attributes", missing.length);
}

function checkTraps(page) {
  const all = Array.from(page.querySelectorAll("*"));
  const names = (element) => Array.from(element.attributes, (attribute) => attribute.name);
  say("scripts", page.scripts.length);
  say("images", page.querySelectorAll("img, iframe, object, embed, video, audio").length);
  say("handlers", all.flatMap(names).filter((name) => name.startsWith("on")).length);
  say("pwned", page.title.startsWith("pwned"));
  const ids = all.map((element) => element.id).filter((id) => id !== "");
  say("repeated-ids", ids.length - new Set(ids).size);
  say("fetched", page.defaultView.performance.getEntriesByType("resource").length);
}

// Every landmark of every map is named by the tip as its mark has it.
function checkLandmarks(page) {
  const view = page.defaultView;
  page.querySelectorAll("figure[data-id]").forEach((figure) => view.putIn(figure));
  const named = new Set();
  for (const box of page.querySelectorAll(".drawing")) {
    const marks = Array.from(box.querySelectorAll("[data-landmark]"), (mark) => mark.dataset.landmark);
    for (let i = 0; i < new Set(marks).size; ++i) {
      box.dispatchEvent(new view.KeyboardEvent("keydown", { key: "n" }));
      const name = box.querySelector(".tip bdi")?.textContent;
      if (marks.includes(name)) named.add(name);
    }
  }
  say("landmarks-named", named.size);
}

const keys = (table, column) => Array.from(table.tBodies[0].rows,
  (row) => row.cells[column].dataset.sort ?? row.cells[column].textContent.trim());

function checkSorting(page) {
  const table = page.querySelector("#table-numbers table");
  if (!table) return;
  const button = (column) => table.querySelector(`th[data-column="${column}"] button`);
  button(1).click();
  say("ascending", keys(table, 1).join());
  say("aria", button(1).parentElement.getAttribute("aria-sort"));
  button(1).click();
  say("descending", keys(table, 1).join());
  say("aria-again", button(1).parentElement.getAttribute("aria-sort"));
  button(0).click();
  say("words", keys(table, 0).join());
  say("sorted-columns", table.querySelectorAll("[aria-sort]").length);
  button(0).focus();
  say("focusable", page.activeElement === button(0));
}

// A long table is folded on the screen and whole on paper.
function checkFolding(page) {
  const table = page.querySelector("#table-long details");
  if (!table) return;
  say("folded", !table.open);
  say("fold-says", table.querySelector("summary").textContent);
  page.defaultView.dispatchEvent(new Event("beforeprint"));
  say("folded-on-paper", !table.open);
}

function luminance(colour) {
  const linear = (value) => value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4;
  const [r, g, b] = colour.match(/[\d.]+/g).map((value) => linear(Number(value) / 255));
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

function backgroundOf(element) {
  for (let each = element; each; each = each.parentElement) {
    const colour = getComputedStyle(each).backgroundColor;
    if (colour !== "rgba(0, 0, 0, 0)" && colour !== "transparent") return colour;
  }
  return "rgb(255, 255, 255)";
}

// The least contrast of any text with what lies behind it.
function leastContrast(page) {
  let least = 21;
  for (const element of page.querySelectorAll("body *:not(script):not(svg *)")) {
    const own = Array.from(element.childNodes).some(
      (node) => node.nodeType === Node.TEXT_NODE && node.data.trim() !== "");
    if (!own) continue;
    const text = luminance(getComputedStyle(element).color);
    const behind = luminance(backgroundOf(element));
    least = Math.min(least, (Math.max(text, behind) + 0.05) / (Math.min(text, behind) + 0.05));
  }
  return least.toFixed(2);
}

// Cells whose text runs out into the next one.
function spilledCells(page) {
  return Array.from(page.querySelectorAll("th > *, td > *")).filter((content) => {
    const cell = content.parentElement.getBoundingClientRect();
    return content.getBoundingClientRect().right > cell.right + 1;
  }).length;
}

function checkLooks(frame) {
  const page = frame.contentDocument;
  say("light-contrast", leastContrast(page));
  const before = getComputedStyle(page.body).backgroundColor;
  page.querySelector("button.theme").click();
  say("theme-changes", getComputedStyle(page.body).backgroundColor !== before);
  say("dark-contrast", leastContrast(page));
  for (const width of [390, 768, 1400]) {
    frame.style.width = `${width}px`;
    say(`overflow-${width}`, page.documentElement.scrollWidth - width);
    say(`spilled-${width}`, spilledCells(page));
  }
}

function check(frame, expected) {
  const page = frame.contentDocument;
  checkTexts(page, expected);
  checkLandmarks(page);
  checkTraps(page);
  checkSorting(page);
  checkFolding(page);
  checkLooks(frame);
  say("done", true);
}

window.addEventListener("load", () => {
  const frame = document.querySelector("iframe");
  const expected = JSON.parse(document.querySelector("#expected").textContent);
  try {
    check(frame, expected);
  } catch (error) {
    say("error", error.message);
  }
  frame.remove();
  document.querySelector("#findings").textContent = findings.join("\n");
});
