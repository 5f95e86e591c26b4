import assert from "node:assert/strict";
import { test } from "node:test";
import { figure, open } from "./support.mjs";

const rings = (page) => page.evaluate(() => Array.from(document.querySelectorAll("g.lit"),
  (layer) => layer.closest("figure").dataset.id));

// A landmark of the map that is not an anchor, with what its marks hold.
const sample = (shown) => shown.locator("svg").evaluate((svg) => {
  const mark = svg.querySelector("use[data-kind=estimate]");
  const groundTruth = svg.querySelector(
    `use[data-kind=true][data-landmark="${mark.dataset.landmark}"]`);
  const at = mark.getBoundingClientRect();
  return { name: mark.dataset.landmark, error: Number(mark.dataset.error),
    x: Number(groundTruth.dataset.x), left: at.x + at.width / 2, top: at.y + at.height / 2 };
});

test("a landmark under the pointer has a tip with ground truth, estimate and error", async () => {
  const { page, close } = await open();
  const shown = await figure(page, "map-bearing-isomap");
  const landmark = await sample(shown);
  await page.mouse.move(landmark.left, landmark.top);
  const tip = shown.locator(".tip");
  await tip.waitFor();
  const words = await tip.innerText();
  assert.ok(words.startsWith(landmark.name), words);
  assert.ok(words.includes(`ground truth (${landmark.x.toFixed(3)}`), words);
  assert.match(words, /estimate \(/);
  const shownError = Number(/error ([\d.]+) m/.exec(words)[1]);
  assert.ok(Math.abs(shownError - landmark.error) < 0.005 * landmark.error,
    `${shownError} ${landmark.error}`);
  await page.mouse.move(5, 5);
  await tip.waitFor({ state: "detached" });
  assert.deepEqual(await rings(page), []);
  await close();
});

test("the same landmark is highlighted in all maps of its world and in no other", async () => {
  const { page, close } = await open();
  await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
  const shown = await figure(page, "map-bearing-isomap");
  const landmark = await sample(shown);
  await page.mouse.move(landmark.left, landmark.top);
  await shown.locator(".tip").waitFor();
  const lit = await rings(page);
  assert.ok(lit.includes("map-bearing-isomap"));
  const expected = await page.evaluate(({ name, x }) => {
    const found = new Set();
    for (const mark of document.querySelectorAll("use[data-landmark]")) {
      const { landmark, kind } = mark.dataset;
      const is = landmark === name && (kind === "true" || kind === "anchor") &&
        Number(mark.dataset.x) === x;
      if (is) found.add(mark.closest("figure").dataset.id);
    }
    return [...found];
  }, landmark);
  assert.deepEqual(lit, expected);
  assert.ok(lit.length > 3, lit.join());
  await close();
});

test("n and p step through the landmarks and announce them, Escape ends it", async () => {
  const { page, close } = await open();
  const shown = await figure(page, "map-bearing-isomap");
  await shown.locator(".drawing").focus();
  await page.keyboard.press("n");
  const first = await shown.locator(".tip bdi").textContent();
  await page.keyboard.press("n");
  assert.notEqual(await shown.locator(".tip bdi").textContent(), first);
  await page.keyboard.press("p");
  assert.equal(await shown.locator(".tip bdi").textContent(), first);
  assert.ok((await page.locator("#status").textContent()).startsWith(first));
  await page.keyboard.press("Escape");
  assert.equal(await page.locator(".tip").count(), 0);
  await close();
});

test("a tip that cuts a long name says so", async () => {
  const { page, close } = await open();
  const shown = await figure(page, "map-bearing-isomap");
  await shown.locator(".drawing").focus();
  await page.keyboard.press("n");
  const name = shown.locator(".tip bdi");
  const { lines, clamp, isCut } = await name.evaluate((bdi) => {
    bdi.textContent = "a long name of a landmark ".repeat(20);
    const { lineHeight, webkitLineClamp } = getComputedStyle(bdi);
    return { lines: bdi.clientHeight / parseFloat(lineHeight), clamp: webkitLineClamp,
      isCut: bdi.scrollHeight > bdi.clientHeight + 1 };
  });
  assert.ok(isCut && lines < 3.2, `${lines}`);
  assert.equal(clamp, "3");
  await close();
});

test("the tip of a chosen landmark is there while the landmark is in view", async () => {
  const { page, close } = await open();
  const shown = await figure(page, "map-bearing-isomap");
  const names = (await shown.locator("select.landmark option").allTextContents()).slice(1);
  assert.deepEqual(names, names.toSorted((a, b) => a.localeCompare(b, "en", { numeric: true })));
  await shown.getByRole("combobox").selectOption({ label: names[4] });
  for (let i = 0; i < 12; ++i) {
    await shown.getByRole("button", { name: "Zoom in" }).click();
    const { inView, tips } = await shown.locator("svg").evaluate((svg) => {
      const inView = svg.querySelectorAll("g.lit circle").length > 0;
      return { inView,
        tips: svg.parentElement.querySelectorAll(".tip").length };
    });
    assert.equal(tips, inView ? 1 : 0);
  }
  await shown.getByRole("button", { name: "Fit the whole figure" }).click();
  assert.equal(await shown.locator(".tip bdi").textContent(), names[4]);
  await close();
});

test("a landmark chosen by name is highlighted in drawings that are inserted later", async () => {
  const { page, close } = await open();
  const shown = await figure(page, "map-bearing-isomap");
  const { name } = await sample(shown);
  await shown.getByRole("combobox").selectOption({ label: name });
  assert.equal(await shown.locator(".tip bdi").textContent(), name);
  const count = (await rings(page)).length;
  await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
  assert.ok((await rings(page)).length > count);
  await close();
});
