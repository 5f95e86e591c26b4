import assert from "node:assert/strict";
import { test } from "node:test";
import { figure, kinds, open, until } from "./support.mjs";

const kCurves = "fig-4";  // The errors of five methods over the steps.

// The points of a curve as its mark names them, and where they are in the window.
const pointsOf = (shown, name) => shown.locator("svg").evaluate((svg, curve) => {
  const mark = [...svg.querySelectorAll("g[data-points]")].find(
    (each) => each.dataset.curve === curve);
  const values = mark.dataset.points.split(";").map((pair) => pair.split(", "));
  return [...mark.querySelectorAll("use.marker")].map((use, i) => {
    const { x, y, width, height } = use.getBoundingClientRect();
    return { left: x + width / 2, top: y + height / 2, x: values[i][0], y: Number(values[i][1]) };
  });
}, name);

const tipOf = async (shown) => {
  const tip = shown.locator(".tip");
  await tip.waitFor();
  return tip.innerText();
};

// "MPE 0.995 m" as the number that is nearest to a value.
const errorIn = (words) => Number(/MPE ([\d.]+)\u00a0m/.exec(words)?.[1]);

test("the point under the pointer has a tip with series, axes, units and its interval", async () => {
  const { page, errors, close } = await open();
  const shown = await figure(page, kCurves);
  for (const point of await pointsOf(shown, "LPCA")) {
    await page.mouse.move(point.left, point.top);
    const words = await tipOf(shown);
    assert.match(words, /^LPCA\n/);
    assert.ok(words.includes(point.x), words);
    assert.ok(Math.abs(errorIn(words) - point.y) < .006 * point.y, `${words} ${point.y}`);
    const interval = /95\u00a0% interval ([\d.]+) to ([\d.]+)\u00a0m/.exec(words);
    assert.ok(interval, words);
    assert.ok(Number(interval[1]) <= point.y * 1.01 && point.y * .99 <= Number(interval[2]), words);
  }
  await page.mouse.move(5, 5);
  await shown.locator(".tip").waitFor({ state: "detached" });
  assert.equal(await shown.locator("g.value").count(), 0);
  assert.equal(await shown.locator("svg .marker title").count(), 0);
  assert.deepEqual(errors, []);
  await close();
});

test("keys step through the points of a curve and from curve to curve", async () => {
  const { page, close } = await open();
  const shown = await figure(page, kCurves);
  const box = shown.locator(".drawing");
  await page.keyboard.press("Tab");  // What follows is focus by keyboard.
  await box.focus();
  const first = await tipOf(shown);
  await page.keyboard.press("n");
  const second = await tipOf(shown);
  assert.notEqual(first, second);
  assert.equal(first.split("\n")[0], second.split("\n")[0]);
  assert.ok((await page.locator("#status").textContent()).startsWith(second.split("\n")[0]));
  await page.keyboard.press("c");
  const third = await tipOf(shown);
  assert.notEqual(third.split("\n")[0], second.split("\n")[0]);
  await page.keyboard.press("Escape");
  assert.equal(await shown.locator(".tip").count(), 0);
  await close();
});

test("every point keeps its interval on a phone", async () => {
  const { page, close } = await open({ viewport: { width: 390, height: 844 }, isMobile: true });
  const shown = await figure(page, kCurves);
  const missing = await shown.locator("svg").evaluate((svg) =>
    valuesOf(svg).filter(({ interval }) => !interval).map(({ name, x }) => `${name} ${x}`));
  assert.deepEqual(missing, []);
  await close();
});

test("a touch shows a point in stacked panels of a phone", async () => {
  const { page, close } = await open({ viewport: { width: 390, height: 844 }, hasTouch: true,
    isMobile: true });
  const shown = await figure(page, kCurves);
  const [point] = (await pointsOf(shown, "LPCA")).slice(-1);
  await page.touchscreen.tap(point.left, point.top);
  const words = await tipOf(shown);
  assert.match(words, /^LPCA\n/);
  assert.ok(Math.abs(errorIn(words) - point.y) < .006 * point.y, words);
  const { x, width } = await shown.locator(".tip").boundingBox();
  assert.ok(x >= 0 && x + width <= 390, `${x} ${width}`);
  await close();
});

test("in zoomed axes a point keeps its values, and one that is zoomed away has no tip", async () => {
  const { page, close } = await open();
  const shown = await figure(page, kCurves);
  await shown.locator(".drawing").focus();
  await page.keyboard.press("+");
  const frame = await shown.locator("svg").evaluate((svg) => {
    const { x, y, width, height } = svg.querySelector("g.frame path").getBoundingClientRect();
    return { left: x, top: y, right: x + width, bottom: y + height };
  });
  let seen = 0;
  for (const name of ["LPCA", "SMACOF, equal weights"]) {
    for (const point of await pointsOf(shown, name)) {
      const isInside = frame.left < point.left && point.left < frame.right &&
        frame.top < point.top && point.top < frame.bottom;
      if (!isInside) continue;
      ++seen;
      await page.mouse.move(point.left, point.top);
      const words = await tipOf(shown);
      assert.ok(Math.abs(errorIn(words) - point.y) < .006 * point.y, `${words} ${point.y}`);
    }
  }
  assert.ok(seen > 0);
  await close();
});

test("in zoomed axes names at the ends of lines follow them, and keys say what is shown", async () => {
  const { page, close } = await open();
  const shown = await figure(page, kCurves);
  // Each name that a line leads to: where that line begins, and where its curve leaves the frame.
  const ends = () => shown.locator("svg").evaluate((svg) => {
    const frame = svg.querySelector("defs clipPath rect"), drawn = svg.querySelector("g.frame path");
    const { right, top, bottom } = drawn.getBoundingClientRect();
    const curves = [...svg.querySelectorAll("[data-curve]")].filter((each) => !each.closest("g.band"))
      .map((each) => (each.localName === "path" ? each : each.querySelector("path"))).filter(Boolean);
    return curves.map((path) => {
      const name = path.closest("[data-curve]").dataset.curve;
      const words = [...svg.querySelectorAll("g.legend-text [data-words]")].find(
        (each) => each.dataset.words === name);
      const matrix = path.getScreenCTM(), length = path.getTotalLength();
      let height = NaN, least = Infinity;
      for (let i = 0; i <= 4000; ++i) {
        const at = path.getPointAtLength(i / 4000 * length).matrixTransform(matrix);
        if (Math.abs(at.x - right) < least) [least, height] = [Math.abs(at.x - right), at.y];
      }
      const box = words?.getBoundingClientRect();
      return { name, height: Math.min(bottom, Math.max(top, height)),
        row: box?.height > 0 ? box.top + box.height / 2 : NaN, hasFrame: frame !== null };
    }).filter(({ row }) => !Number.isNaN(row)).sort((a, b) => a.row - b.row);
  });
  const isInOrder = (all) => all.every((end, i) => i === 0 || all[i - 1].height <= end.height + 1);
  const before = await ends();
  assert.ok(before.length >= 3 && isInOrder(before), JSON.stringify(before));
  await shown.locator(".drawing").focus();
  await page.keyboard.press("+");
  assert.match(await page.locator("#status").textContent(), / to .*, MPE [\d.]+ to [\d.]+\u00a0m$/);
  await page.keyboard.press("+");
  const after = await ends();
  assert.ok(isInOrder(after), JSON.stringify(after));
  assert.notDeepEqual(after.map(({ height }) => height), before.map(({ height }) => height));
  for (let i = 0; i < 12; ++i) await page.keyboard.press("+");
  for (let i = 0; i < 3; ++i) await page.keyboard.press("ArrowDown");
  await page.keyboard.press("n");
  assert.match(await page.locator("#status").textContent(), /^No point of a curve/);
  await page.keyboard.press("0");
  assert.deepEqual(await ends(), before);
  await close();
});

test("the dots of a dot plot name their interval", async () => {
  const { page, close } = await open();
  const shown = await figure(page, "published-errors");
  const dot = await shown.locator("svg").evaluate((svg) => {
    const mark = svg.querySelector("use[data-method][id*='-ours-']");
    const { x, y, width, height } = mark.getBoundingClientRect();
    return { name: mark.dataset.method, left: x + width / 2, top: y + height / 2,
      mpe: Number(mark.dataset.mpe) };
  });
  await page.mouse.move(dot.left, dot.top);
  const words = await tipOf(shown);
  assert.ok(words.startsWith(`${dot.name}, ours\n`), words);
  const [, value] = / ([\d.]+)\u00a0m/.exec(words);
  assert.ok(Math.abs(Number(value) - dot.mpe) < .01 * dot.mpe, words);
  assert.match(words, /95\u00a0% interval [\d.]+ to [\d.]+\u00a0m/);
  await close();
});

const evaluated = kinds.find(([name]) => name === "evaluate");
test("curves without markers, as errors over time, have values", {
  skip: evaluated ? false : "no page of evaluate" }, async () => {
  const { page, close } = await open({}, evaluated[1]);
  const id = await page.locator("figure[data-id$=-curves]").first().getAttribute("data-id");
  const shown = await figure(page, id);
  const at = await shown.locator("svg").evaluate((svg) => {
    const path = svg.querySelector("path[data-curve]");
    const { x, y } = path.getPointAtLength(.4 * path.getTotalLength())
      .matrixTransform(path.getScreenCTM());
    return { x, y, name: path.dataset.curve };
  });
  await page.mouse.move(at.x, at.y);
  const words = await tipOf(shown);
  assert.ok(words.startsWith(at.name), words);
  assert.match(words, /(time [\d.]+\u00a0s|pose \d+)\nerror [\d.]+\u00a0(mm|m)/);
  await close();
});

test("one listener of each kind serves a drawing of many points", async () => {
  const { page, close } = await open();
  await page.evaluate(() => {
    window.heard = 0;
    const add = EventTarget.prototype.addEventListener;
    EventTarget.prototype.addEventListener = function count(...all) {
      if (this.closest?.("svg")) ++window.heard;
      return add.apply(this, all);
    };
  });
  await figure(page, kCurves);
  await until(page, () => document.querySelector("#figure-fig-4 .curves"));
  assert.equal(await page.evaluate(() => window.heard), 0);
  await close();
});
