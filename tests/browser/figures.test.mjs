import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { figure, kinds, open, study, textOf } from "./support.mjs";

const kMap = "map-bearing-isomap";
const kFilm = "forming-bearing";

const viewBox = async (shown) =>
  (await shown.locator("svg").getAttribute("viewBox")).split(" ").map(Number);

// What share of its frames a figure shows.
const viewShown = (shown) => shown.locator("svg").evaluate((svg) => {
  const { x, y, width, height } = viewOf(svg).now;
  return [x, y, width, height];
});

test("drawings are inserted when the reader comes near, and all of them for paper", async () => {
  const { page, close } = await open();
  const held = await page.locator("figure .drawing").count();
  assert.ok(held > 50);
  assert.ok(await page.locator(".drawing > svg").count() < 10);
  await figure(page, kMap);
  await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
  assert.equal(await page.locator(".drawing > noscript").count(), 0);
  // Paper has some drawings in several parts.
  assert.ok(await page.locator(".drawing > svg").count() >= held);
  await close();
});

test("nothing moves when a drawing is inserted", async () => {
  const { page, close } = await open();
  const before = await page.evaluate(() => {
    const box = document.querySelector("#figure-map-bearing-isomap .drawing");
    return [box.clientWidth, box.clientHeight];
  });
  const shown = await figure(page, kMap);
  const after = await shown.locator(".drawing").evaluate(
    (box) => [box.clientWidth, box.clientHeight]);
  assert.ok(Math.abs(before[0] - after[0]) <= 1 && Math.abs(before[1] - after[1]) <= 2,
    `${before} became ${after}`);
  await close();
});

// The point of the frame that is shown at a position of the window.
const pointUnder = (shown, at) => shown.locator("svg").evaluate((svg, event) => {
  const { adapter } = viewOf(svg);
  return adapter.point(adapter.position(event));
}, at);

test("buttons and keys zoom, arrows move, and Fit shows the whole", async () => {
  const { page, close } = await open();
  const shown = await figure(page, kMap);
  const whole = await viewShown(shown);
  await shown.getByRole("button", { name: "Zoom in" }).click();
  assert.ok((await viewShown(shown))[2] < whole[2]);
  await shown.getByRole("button", { name: "Zoom out" }).click();
  assert.deepEqual(await viewShown(shown), whole);
  await shown.locator(".drawing").focus();
  await page.keyboard.press("+");
  const zoomed = await viewShown(shown);
  await page.keyboard.press("ArrowRight");
  assert.ok((await viewShown(shown))[0] > zoomed[0]);
  await page.keyboard.press("0");
  assert.deepEqual(await viewShown(shown), whole);
  await page.keyboard.press("+");
  await shown.getByRole("button", { name: "Fit the whole figure" }).click();
  assert.deepEqual(await viewShown(shown), whole);
  await close();
});

test("the wheel zooms at the pointer after a click, and else scrolls the page", async () => {
  const { page, close } = await open();
  // None is inserted while the page scrolls, which would move it.
  await page.evaluate(() => held.forEach(putIn));
  const shown = await figure(page, kMap);
  const box = await shown.locator(".drawing").boundingBox();
  const pointer = { clientX: box.x + box.width / 2.5, clientY: box.y + box.height / 2.5 };
  await page.mouse.move(pointer.clientX, pointer.clientY);
  const before = await pointUnder(shown, pointer);
  const whole = await viewShown(shown);
  const at = await page.evaluate(() => scrollY);
  await page.mouse.wheel(0, -120);
  await page.waitForFunction((from) => scrollY !== from, at);
  assert.deepEqual(await viewShown(shown), whole);
  await page.mouse.wheel(0, 120);
  await page.waitForFunction((from) => scrollY === from, at);
  await shown.locator(".drawing").focus();
  await page.mouse.wheel(0, -240);
  await page.waitForFunction(() => document.querySelector("#figure-map-bearing-isomap .zoomed"));
  // The point under the pointer stays there.
  const after = await pointUnder(shown, pointer);
  assert.ok(Math.abs(after.x - before.x) < .01 && Math.abs(after.y - before.y) < .01);
  await close();
});

test("a drag moves what is zoomed, and two fingers pinch", async () => {
  const { page, close } = await open({ hasTouch: true });
  const shown = await figure(page, kMap);
  const box = await shown.locator(".drawing").boundingBox();
  const whole = await viewShown(shown);
  await shown.getByRole("button", { name: "Zoom in" }).click();
  const zoomed = await viewShown(shown);
  await page.mouse.move(box.x + 200, box.y + 150);
  await page.mouse.down();
  await page.mouse.move(box.x + 140, box.y + 120, { steps: 3 });
  await page.mouse.up();
  const moved = await viewShown(shown);
  assert.ok(moved[0] > zoomed[0] && moved[1] > zoomed[1], `${zoomed} became ${moved}`);
  await shown.getByRole("button", { name: "Fit the whole figure" }).click();
  await shown.locator(".drawing").evaluate((drawing) => {
    const frame = drawing.getBoundingClientRect();
    const finger = (type, pointerId, x) => drawing.dispatchEvent(new PointerEvent(type, {
      pointerId, pointerType: "touch", bubbles: true, button: 0, buttons: 1,
      clientX: frame.x + x, clientY: frame.y + 150 }));
    drawing.setPointerCapture = () => {};
    finger("pointerdown", 11, 150);
    finger("pointerdown", 12, 200);
    finger("pointermove", 12, 300);
    finger("pointerup", 11, 150);
    finger("pointerup", 12, 300);
  });
  assert.ok((await viewShown(shown))[2] < whole[2] / 2);
  await close();
});

test("a drag that ends outside of the drawing is over", async () => {
  const { page, close } = await open();
  const shown = await figure(page, kMap);
  const box = await shown.locator(".drawing").boundingBox();
  await page.mouse.move(box.x + 100, box.y + 100);
  await page.mouse.down();
  await page.mouse.move(5, 5, { steps: 3 });
  await page.mouse.up();
  await shown.locator(".drawing").focus();
  await page.keyboard.press("+");
  const zoomed = await viewShown(shown);
  await page.mouse.move(box.x + 100, box.y + 100);
  await page.mouse.move(box.x + 160, box.y + 120, { steps: 3 });
  assert.deepEqual(await viewShown(shown), zoomed);
  await close();
});

// What the ticks of one side of a zoomed frame count, and where they are on the screen.
const ticksShown = (shown, anchor) => shown.locator(`.zoom-ticks text[text-anchor="${anchor}"]`)
  .evaluateAll((all) => all.map((text) => {
    const { left, right, top, bottom } = text.getBoundingClientRect();
    return { value: Number(text.textContent), x: (left + right) / 2, y: (top + bottom) / 2 };
  }));

test("zoom changes what the axes count, and lines, marks and words keep their size", async () => {
  const { page, close } = await open();
  const shown = await figure(page, "fig-4");
  const sizes = () => shown.locator("svg").evaluate((svg) => {
    const mark = svg.querySelector("use.marker:not(.outside)").getBoundingClientRect();
    const title = svg.querySelector("g.title").getBoundingClientRect();
    const line = svg.querySelector("path.line[clip-path]");
    return [mark.width, mark.height, title.width, line.getCTM().a *
      Number(line.getAttribute("stroke-width"))].map((size) => size.toFixed(1)).join();
  });
  const before = await sizes();
  await shown.locator(".drawing").focus();
  await page.keyboard.press("+");
  await page.keyboard.press("+");
  assert.equal(await sizes(), before);
  assert.ok(await shown.locator("g.unzoomed").count() >= 3);
  const across = await ticksShown(shown, "middle"), up = await ticksShown(shown, "end");
  assert.ok(across.length >= 2 && up.length >= 2, `${across.length} ${up.length}`);
  // A marker stands where the ticks count its values, on both axes.
  const marks = await shown.locator("[data-points]").evaluateAll((curves) => curves.flatMap(
    (curve) => [...curve.querySelectorAll("use.marker")].map((mark, i) => {
      const { left, right, top, bottom } = mark.getBoundingClientRect();
      const [x, y] = curve.dataset.points.split(";")[i].split(", ").map(Number);
      return { x, y, right: (left + right) / 2, down: (top + bottom) / 2,
        isShown: !mark.classList.contains("outside") };
    })).filter((mark) => mark.isShown));
  assert.ok(marks.length >= 1);
  const isLog = await shown.locator("svg rect[data-y^=log]").count() > 0;
  const scaled = (value) => (isLog ? Math.log(value) : value);
  const between = (first, last, value, from, to) =>
    from + (value - first) / (last - first) * (to - from);
  for (const mark of marks) {
    const x = between(across[0].value, across.at(-1).value, mark.x, across[0].x, across.at(-1).x);
    const y = between(scaled(up[0].value), scaled(up.at(-1).value), scaled(mark.y), up[0].y,
      up.at(-1).y);
    assert.ok(Math.abs(x - mark.right) < 3, `x ${mark.x}: ${x}, ${mark.right}`);
    assert.ok(Math.abs(y - mark.down) < 3, `y ${mark.y}: ${y}, ${mark.down}`);
  }
  await page.keyboard.press("0");
  assert.equal(await shown.locator(".zoom-ticks, .zoom-grid, .unzoomed, .outside").count(), 0);
  await close();
});

test("ticks of a part of an axis count in ones, twos and fives, on logarithmic axes as well", async () => {
  const { page, close } = await open();
  const ticks = (scale, low, high) => page.evaluate((axis) => {
    const found = ticksOf(axis);
    return found.map((tick) => tickWords(tick, found)).join(" ");
  }, { scale, low, high });
  assert.equal(await ticks("linear", 0, 2000), "0 500 1000 1500 2000");
  assert.equal(await ticks("linear", 0, 20000), "0 5,000 10,000 15,000 20,000");
  assert.equal(await ticks("linear", -.0312, .0105), "\u22120.03 \u22120.02 \u22120.01 0 0.01");
  assert.equal(await ticks("log", .02, 3), "0.02 0.05 0.1 0.2 0.5 1 2");
  assert.equal(await ticks("log", .021, .028), "0.022 0.024 0.026 0.028");
  assert.equal(await ticks("log", 1e-6, 1e12), "1 × 10⁻⁶ 0.001 1 1000 1 × 10⁶ 1 × 10⁹ 1 × 10¹²");
  await close();
});

test("all panels of a figure show the same part, with the names of an axis beside it", async () => {
  const { page, close } = await open();
  const shown = await figure(page, "published-errors");
  await shown.locator(".drawing").focus();
  await page.keyboard.press("+");
  assert.equal(await shown.locator(".zoom-ticks").count(), 2);
  const names = await shown.locator(".zoom-ticks [data-words]").evaluateAll(
    (all) => all.map((name) => name.dataset.words));
  assert.ok(names.length >= 4 && names.length < 20, `${names}`);
  await close();
});

test("a figure fills the screen and comes back, also where the browser refuses", async () => {
  const { page, close } = await open();
  const shown = await figure(page, kMap);
  const button = shown.getByRole("button", { name: "Full screen" });
  await button.click();
  await page.waitForFunction(() => document.fullscreenElement?.dataset.id === "map-bearing-isomap");
  await shown.getByRole("button", { name: "Leave full screen" }).click();
  await page.waitForFunction(() => !document.fullscreenElement);
  await shown.evaluate((each) => {
    each.requestFullscreen = () => Promise.reject(new Error("no"));
  });
  await button.click();
  await shown.and(page.locator(".filling")).waitFor();
  assert.equal(await button.textContent(), "Leave full screen");
  const { width } = await shown.boundingBox();
  assert.equal(width, 1400);
  await page.keyboard.press("Escape");
  assert.equal(await page.locator(".filling").count(), 0);
  assert.equal(await button.textContent(), "Full screen");
  await close();
});

test("the step slider shows one panel at a time", async () => {
  const { page, close } = await open();
  const shown = await figure(page, kFilm);
  const slider = shown.getByRole("slider");
  const heightOf = () => shown.locator(".drawing").evaluate((box) => box.clientHeight);
  const whole = await heightOf(), heights = new Set(), sizes = [];
  // Of words and of the frame of the panel that is shown.
  const seeSizes = async () => sizes.push(await shown.locator("svg").evaluate((svg) => {
    const sizeOf = (kind) => [...svg.querySelectorAll(`:scope > .${kind}`)]
      .find((part) => getComputedStyle(part).display !== "none").getBoundingClientRect();
    return { words: sizeOf("panel-title").height, frame: sizeOf("frame").height };
  }));
  await seeSizes();
  assert.equal(await shown.locator(".step output").textContent(), "All steps side by side");
  const seen = [];
  await slider.focus();
  for (let step = 1; step <= 3; ++step) {
    await page.keyboard.press("ArrowRight");
    seen.push(`${await shown.locator(".step output").textContent()}`);
    heights.add(await heightOf());
    await seeSizes();
  }
  // The panel fills the box, and its words stay as large as they were.
  for (const { words, frame } of sizes.slice(1)) {
    assert.ok(frame > 2.5 * sizes[0].frame, `${frame} of ${sizes[0].frame}`);
    assert.ok(words < 1.3 * sizes[0].words, `${words} of ${sizes[0].words}`);
  }
  assert.ok(seen[0].startsWith("500 steps") && seen[2].startsWith("2000 steps"), seen.join());
  // The box grows to what one panel fills, and then stays.
  assert.equal(heights.size, 1);
  assert.ok([...heights][0] >= whole);
  // One panel alone, with the labels and tick labels of both axes, all within the box.
  const parts = await shown.locator("svg").evaluate((svg) => {
    const { x, y, width, height } = svg.viewBox.baseVal;
    const isWhole = (part) => {
      const box = part.getBBox();
      return x <= box.x && box.x + box.width <= x + width &&
        y <= box.y && box.y + box.height <= y + height;
    };
    const seen = (kind) => [...svg.querySelectorAll(`:scope > .${kind}`)]
      .filter((part) => getComputedStyle(part).display !== "none");
    const kinds = ["panel-title", "frame", "zoom-ticks", "step-axes"];
    const whole = kinds.map((kind) => seen(kind).map(isWhole));
    return { whole: whole.map(String), others: seen("title").length + seen("legend-text").length,
      axes: svg.querySelectorAll(".step-axes > g").length };
  });
  assert.deepEqual(parts.whole, ["true", "true", "true", "true"]);
  assert.equal(parts.others, 0);
  assert.ok(parts.axes >= 4, `${parts.axes}`);  // Two labels, and two tick labels at least.
  await slider.fill("0");
  assert.equal(await shown.locator(".off, .step-axes").count(), 0);
  await close();
});

test("a method that is chosen is highlighted in figures and tables, those inserted later too", async () => {
  const { page, close } = await open();
  const list = page.getByRole("combobox", { name: "Highlight a method in all figures and tables" });
  await list.selectOption("SMACOF, kNN weights");
  const rows = page.locator("tr.chosen th");
  assert.ok(await rows.count() >= 2);
  for (const name of await rows.allTextContents()) assert.equal(name.trim(), "SMACOF, kNN weights");
  for (const id of ["fig-4", "published-errors", "cost-bearing"]) {
    const shown = await figure(page, id);
    const left = await shown.locator("[data-curve], [data-setting], [data-method]").evaluateAll(
      (marks) => marks.filter((mark) => !mark.classList.contains("dim"))
        .map((mark) => mark.dataset.curve ?? mark.dataset.setting ?? mark.dataset.method));
    assert.ok(left.length >= 1, id);
    for (const name of left) assert.match(name, /^SMACOF,? kNN/);
  }
  assert.equal(await page.locator("#figure-map-bearing-smacof-knn.chosen").count(), 1);
  await list.selectOption("");
  assert.equal(await page.locator(".dim, .chosen").count(), 0);
  await close();
});

// Results of methods whose names end in numbers, in rooms of which the second lacks the first method.
// A diagram of ranks names the first one "Solver 1.00", too.
function resultsOfSolvers() {
  const labels = ["Solver", "Solver 1.00", "Solver 0.1", "Solver 0.01", "EKF"];
  const folder = mkdtempSync(join(tmpdir(), "mapproof-solvers-"));
  const runs = [1, 2, 3, 4, 5, 6].flatMap((run) => [[run, 100], [run, 200]]);
  const rows = ["room", "hall"].flatMap((setup, first) => labels.flatMap((_, i) => runs.map(
    ([run, steps]) => [setup, `m${i}`, "ate_m", run, `g${run}`, 1 + i + .1 * run, steps].join()))
    .slice(first * runs.length));
  writeFileSync(join(folder, "results.csv"),
    ["setup,method,quantity,run,group,value,at.steps", ...rows].join("\n"));
  writeFileSync(join(folder, "study.json"), JSON.stringify({
    schema: { name: "mapproof.results_study", version: 1 }, name: "solvers", title: "Solvers",
    question: "Which is the best?", factors: [{ id: "steps", label: "steps", unit: "" }],
    quantities: [{ id: "ate_m", label: "trajectory error", unit: "m", better: "lower" }],
    methods: labels.map((label, i) => ({ id: `m${i}`, label })) }));
  execFileSync(process.env.MAPPROOF_PROGRAM, ["report", folder, "--quiet"]);
  return { folder, labels };
}

// The methods of what is lit in a figure: of its marks, and of the words that name a method.
const litIn = (shown, labels) => shown.evaluate((each, names) => {
  const lit = (query) => [...each.querySelectorAll(query)].filter(
    (part) => !part.classList.contains("dim")).map((part) => part.dataset);
  const rank = each.dataset.id.includes("-ranks-") ? / \d\.\d\d$/ : "";
  return {
    marks: lit("[data-curve], [data-method]").map(({ curve, method }) => curve ?? method),
    words: lit("svg [data-words]").map(({ words }) => words.replace(rank, ""))
      .filter((words) => names.includes(words)),
  };
}, labels);

test("of methods whose names end in numbers one alone is highlighted, in marks and words", async () => {
  const { folder, labels } = resultsOfSolvers();
  const { page, errors, close } = await open({}, folder);
  const list = page.locator("select.method");
  await list.waitFor({ state: "attached" });
  const names = (await list.locator("option").allTextContents()).slice(1);
  assert.deepEqual(names.toSorted(), labels.toSorted());
  const ids = await page.locator("figure[data-id]").evaluateAll(
    (all) => all.map((each) => each.dataset.id));
  for (const id of ids) {
    const shown = await figure(page, id), { marks } = await litIn(shown, labels);
    for (const name of labels.filter((each) => marks.includes(each))) {
      await list.selectOption(name);
      const lit = await litIn(shown, labels);
      assert.deepEqual([...new Set(lit.marks)], [name], id);
      assert.deepEqual([...new Set(lit.words)], [name], id);
      await list.selectOption("");
    }
  }
  assert.deepEqual(errors, []);
  await close();
});

test("curves are hidden and shown by a list and by the legend", async () => {
  const { page, close } = await open();
  const shown = await figure(page, "fig-4");
  const parts = shown.locator('[data-curve="LPCA"]');
  assert.ok(await parts.first().isVisible());
  await shown.locator("details.curves summary").click();
  await shown.getByRole("checkbox", { name: "LPCA" }).uncheck();
  assert.equal(await parts.first().isVisible(), false);
  const words = await shown.locator('.legend-text [data-words="LPCA"]').boundingBox();
  await page.mouse.click(words.x + words.width / 2, words.y + words.height / 2);
  assert.ok(await parts.first().isVisible());
  assert.ok(await shown.getByRole("checkbox", { name: "LPCA" }).isChecked());
  await close();
});

const slam = kinds.find(([name]) => name === "slam")?.[1];

test("the legend of paths hides a method's path with its landmarks", { skip: !slam }, async () => {
  const { page, close } = await open({}, slam);
  const shown = await figure(page, "path-own");
  const parts = shown.locator('[data-curve="dead reckoning"]');
  assert.ok(await parts.count() > 1, "the path and landmarks");
  const words = await shown.locator('.legend-text [data-words="dead reckoning"]').first()
    .boundingBox();
  await page.mouse.click(words.x + words.width / 2, words.y + words.height / 2);
  for (const part of await parts.all()) assert.equal(await part.isVisible(), false);
  await page.mouse.click(words.x + words.width / 2, words.y + words.height / 2);
  assert.ok(await parts.first().isVisible());
  await close();
});

test("Play goes through the steps of a map forming and stops at the last", async () => {
  const { page, close } = await open();
  const film = await figure(page, "forming-bearing");
  const slider = film.getByRole("slider"), last = Number(await slider.getAttribute("max"));
  await slider.fill(String(last - 1));
  await film.getByRole("button", { name: "Play" }).click();
  await page.waitForFunction((value) => Number(
    document.querySelector("#figure-forming-bearing input[type=range]").value) === value, last);
  assert.equal(await film.getByRole("button", { name: "Stop" }).count(), 0);
  // Read with the click: the next step follows within a second.
  const { step, words } = await film.evaluate((each) => {
    const play = [...each.querySelectorAll("button")].find(({ textContent }) => textContent === "Play");
    play.click();
    return { step: each.querySelector("input[type=range]").value, words: play.textContent };
  });
  assert.deepEqual([step, words], ["1", "Stop"]);
  await close();
});

test("a point tells errors of maps that diverged in words, and powers of ten", async () => {
  const { page, close } = await open();
  const shown = await figure(page, "fig-4");
  const words = await shown.locator("svg").evaluate((svg) => {
    const [first] = valuesOf(svg);
    const said = (y, over) => wordsOfValue(svg, { ...first, interval: undefined, y, over })[1];
    return [said("1.3e+15", "1000"), said("1.3e+15"), said("0.9978", "1000"),
      errorWords("1000.5"), errorWords("0.0123")];
  });
  assert.deepEqual(words, ["MPE over 1\u00a0km", "MPE 1.30 × 10¹⁵\u00a0m", "MPE 0.998\u00a0m",
    "over 1\u00a0km", "0.0123 m"]);
  await close();
});

test("the page saves SVG and PNG, and links to the PDF and data files", async () => {
  const { page, close } = await open();
  const shown = await figure(page, kMap);
  await shown.locator("summary").click();
  const saved = async (name) => {
    const [download] = await Promise.all([
      page.waitForEvent("download"), shown.getByRole("link", { name, exact: true }).click()]);
    return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
  };
  const svg = await saved("SVG");
  assert.equal(svg.name, `${kMap}.svg`);
  assert.equal(svg.bytes.toString().trim(), textOf(`figures/${kMap}.svg`).trim());
  const png = await saved("PNG");
  assert.equal(png.name, `${kMap}.png`);
  assert.equal(png.bytes.subarray(1, 4).toString(), "PNG");
  const file = readFileSync(`${study}/figures/${kMap}.png`);
  assert.deepEqual(png.bytes.subarray(16, 24), file.subarray(16, 24));  // Width and height.
  for (const [name, end] of [["PDF", "pdf"], ["data", "figure.json"]]) {
    const href = await shown.getByRole("link", { name, exact: true }).getAttribute("href");
    assert.equal(href, `figures/${kMap}.${end}`);
    assert.ok(textOf(href).length > 1000);
  }
  const where = await shown.locator(".where").textContent();
  assert.match(where, /PDF and data are in the folder figures\//);
  await close();
});

test("the command of a figure is shown, copied, and draws it again", async () => {
  const { page, close } = await open({ permissions: ["clipboard-read", "clipboard-write"] });
  const shown = await figure(page, kMap);
  await shown.locator("summary").click();
  await shown.locator(".command code").waitFor();
  const command = await shown.locator(".command code").textContent();
  assert.match(command, /^mapproof render .*--figure map-bearing-isomap$/);
  await shown.getByRole("button", { name: `Copy the command of ${kMap}` }).click();
  await page.waitForFunction(
    () => document.querySelector("#status")?.textContent.includes("copied"));
  assert.equal(await page.evaluate(() => navigator.clipboard.readText()), command);
  await close();
});
