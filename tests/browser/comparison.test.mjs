import assert from "node:assert/strict";
import { test } from "node:test";
import { comparison, open } from "./support.mjs";

const options = { skip: !comparison };
const openComparison = (more = {}) => open(more, comparison, "diff.html");

// A comparison of figures, one of studies, and one of maps, which has lines of a CSV in a table.
const kPages = ["diff.html", "whole.html", "maps.html"];
const kPaper_px = 688;  // Between the margins of A4.

// The page of a comparison with all of its images, as it is printed or in a window of some width.
async function openWhole(file, media, width) {
  const opened = await open({ viewport: { width, height: 900 } }, comparison, file);
  await opened.page.emulateMedia({ media });
  await opened.page.evaluate(async (isPrinted) => {
    if (isPrinted) dispatchEvent(new Event("beforeprint"));
    else for (const item of items) unfold(item.querySelector("details.fold") ?? item);
    for (const item of items) item.style.contentVisibility = "visible";
    for (const image of document.images) image.loading = "eager";
    await Promise.all(Array.from(document.images, (image) => image.decode().catch(() => {})));
  }, media === "print");
  return opened;
}

// Magnification and translation of each visible image of the first item, as the browser shows them.
const matrices = (page) => page.locator(".stage").first().evaluate((stage) =>
  Array.from(stage.querySelectorAll(".canvas"))
    .filter((canvas) => canvas.getClientRects().length > 0)
    .map((canvas) => {
      const { a, e, f } = new DOMMatrix(getComputedStyle(canvas).transform);
      return [a, e, f].map((value) => Math.round(value * 100) / 100);
    }));

const stageOf = async (page) => {
  const stage = page.locator(".stage").first();
  await stage.scrollIntoViewIfNeeded();
  return { stage, box: await stage.locator(".view").first().boundingBox() };
};

test("keys and buttons zoom both images of a comparison alike", options, async () => {
  const { page, errors, close } = await openComparison();
  const { stage } = await stageOf(page);
  await stage.focus();
  await page.keyboard.press("+");
  const [first, second] = await matrices(page);
  assert.equal(first[0], 1.5);
  assert.deepEqual(second, first);
  await page.keyboard.press("ArrowRight");
  assert.ok((await matrices(page))[0][1] < first[1]);
  await page.locator("#fit").click();
  assert.deepEqual((await matrices(page))[0], [1, 0, 0]);
  await page.locator("#zoom-in").click();
  assert.equal(await page.locator("#zoom").textContent(), "150 %");
  await page.locator("#zoom-out").click();
  assert.equal(await page.locator(".stage.zoomed").count(), 0);
  assert.deepEqual(errors, []);
  await close();
});

test("the wheel zooms a comparison at the pointer, and a drag moves it", options, async () => {
  const { page, close } = await openComparison();
  const { stage, box } = await stageOf(page);
  await stage.focus();
  await page.mouse.move(box.x + box.width / 4, box.y + box.height / 4);
  await page.mouse.wheel(0, -200);
  await page.locator(".stage.zoomed").first().waitFor();
  const [zoomed] = await matrices(page);
  assert.ok(zoomed[0] > 1.5 && zoomed[1] < 0, `${zoomed}`);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width / 4 - 40, box.y + box.height / 4 - 20, { steps: 3 });
  await page.mouse.up();
  const [moved, other] = await matrices(page);
  assert.ok(Math.abs(moved[1] - zoomed[1] + 40) < 1, `${zoomed} became ${moved}`);
  assert.ok(Math.abs(moved[2] - zoomed[2] + 20) < 1, `${zoomed} became ${moved}`);
  assert.deepEqual(other, moved);
  await close();
});

test("a pinch of two fingers zooms a comparison between them", options, async () => {
  const { page, close } = await openComparison({ hasTouch: true });
  const { box } = await stageOf(page);
  const session = await page.context().newCDPSession(page);
  const touch = (type, ...points) => session.send("Input.dispatchTouchEvent", {
    type, touchPoints: points.map(([x, y], id) => ({ x: box.x + x, y: box.y + y, id })) });
  await touch("touchStart", [150, 100], [190, 100]);
  for (const reach of [10, 20, 30]) {
    await touch("touchMove", [150 - reach, 100], [190 + reach, 100]);
  }
  await touch("touchEnd");
  await page.locator(".stage.zoomed").first().waitFor();
  const [first, second] = await matrices(page);
  assert.ok(Math.abs(first[0] - 2.5) < 0.05, `${first}`);
  assert.deepEqual(second, first);
  await close();
});

// Mean lightness of what the screen shows of an element, 0 to 255.
async function lightness(page, element) {
  const png = (await element.screenshot()).toString("base64");
  return page.evaluate(async (bytes) => {
    const image = new Image();
    image.src = `data:image/png;base64,${bytes}`;
    await image.decode();
    const canvas = new OffscreenCanvas(image.width, image.height), context = canvas.getContext("2d");
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, 0, image.width, image.height);
    return data.reduce((sum, value, i) => sum + (i % 4 < 3 ? value : 0), 0) / (data.length * .75);
  }, png);
}

test("thumbnails of figures are dark on a dark page, those of foreign images are as they are", options,
  async () => {
    const { page, close } = await openComparison({ colorScheme: "dark" });
    for (const small of await page.locator(".thumbnail").all()) {
      const mean = await lightness(page, small);
      assert.ok(mean < 100, `${mean}`);
    }
    await page.evaluate(() => {
      for (const each of document.querySelectorAll(".thumbnail")) each.remove();
      for (const each of document.querySelectorAll(".stage")) each.classList.remove("drawn");
      addThumbnails();
    });
    const foreign = await lightness(page, page.locator(".thumbnail").first());
    assert.ok(foreign > 150, `${foreign}`);
    await close();
  });

test("the comparison of two studies has 15 screens at most, and its last items are found", options,
  async () => {
    const { page, errors, close } = await open({}, comparison, "whole.html");
    const screens = await page.evaluate(async () => {
      for (const item of items) item.style.contentVisibility = "visible";
      for (const image of document.images) image.loading = "eager";
      await Promise.all(Array.from(document.images, (image) => image.decode().catch(() => {})));
      return document.documentElement.scrollHeight / innerHeight;
    });
    assert.ok(screens > 4 && screens <= 15, `${screens} screens`);
    const last = page.locator("article.item").last(), id = await last.getAttribute("data-name");
    await page.locator("#search").fill(id);
    assert.ok(await last.locator("h2").isVisible());
    await page.locator("#search").fill("");
    // By another order, too, the items that are folded are the last ones.
    const folded = await page.locator(".further .item").count();
    await page.locator("#order").selectOption("name");
    assert.equal(await page.locator(".further .item").count(), folded);
    const names = await page.locator("article.item").evaluateAll(
      (all) => all.map((each) => each.dataset.name));
    assert.deepEqual(names, [...names].sort((a, b) => a.localeCompare(b)));
    assert.deepEqual(errors, []);
    await close();
  });

test("a comparison is printed without its controls, its images below each other", options,
  async () => {
    const { page, close } = await openComparison();
    await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
    await page.emulateMedia({ media: "print" });
    for (const control of ["#order", ".chip", ".toolbar button", ".tick"]) {
      assert.equal(await page.locator(`${control}:visible`).count(), 0, control);
    }
    const { stage } = await stageOf(page);
    const [baseline, current] = await Promise.all([0, 1].map((index) =>
      stage.locator(".view").nth(index).boundingBox()));
    assert.equal(current.x, baseline.x);
    assert.ok(current.y >= baseline.y + baseline.height);
    for (const elements of await page.locator("[id^=table-svg-]").all()) {
      assert.match(await elements.locator("h3").innerText(), /\d changes?$/);
      assert.equal(await elements.locator("table:visible").count(), 0);
    }
    await close();
  });

// The size of the smallest words of each image of a figure of ours that the page shows, in CSS pixels:
// those of an SVG by its glyphs; a PNG of a figure is 600 pt wide, with words of 11 pt.
const wordsOfImages = (page) => page.evaluate(() => {
  const kUnitsOfFont = 2048;
  const images = [...document.querySelectorAll(".change img, .drawn .canvas img")];
  return images.filter((image) => image.getClientRects().length > 0).map((image) => {
    const [, format, data] = /^data:image\/([a-z]+)[^,]*,(.*)$/.exec(image.currentSrc);
    let share = 11 / 600;
    if (format === "svg") {
      const svg = new DOMParser().parseFromString(new TextDecoder().decode(
        Uint8Array.from(atob(data), (sign) => sign.charCodeAt(0))), "image/svg+xml").documentElement;
      const sizes = [...svg.querySelectorAll('g[transform*="scale("]')].map((words) =>
        kUnitsOfFont * Number(/scale\(([\d.]+)/.exec(words.getAttribute("transform"))[1]));
      share = Math.min(...sizes) / svg.viewBox.baseVal.width;
    }
    const { naturalWidth, naturalHeight, clientWidth, clientHeight } = image;
    const shown = Math.min(clientWidth, clientHeight * naturalWidth / naturalHeight);
    const { top, bottom } = image.getBoundingClientRect();
    return { of: image.alt, size: share * shown, top, bottom };
  });
});
const kRounding_px = .05;

for (const file of kPages) {
  test(`${file}: printed images of figures stand below each other, with words of 8 pt`, options,
    async () => {
      const { page, close } = await openWhole(file, "print", kPaper_px);
      const images = await wordsOfImages(page), kLeast_px = 8 / .75;
      assert.ok(images.length > 0);
      images.forEach(({ of, size, top }, i) => {
        assert.ok(size > kLeast_px - kRounding_px, `${of}: ${.75 * size} pt`);
        assert.ok(i === 0 || top >= images[i - 1].bottom, of);
      });
      await close();
    });

  test(`${file}: on a phone images of figures have words of 10 px`, options, async () => {
    const { page, close } = await openWhole(file, "screen", 390);
    const images = await wordsOfImages(page);
    assert.ok(images.length > 0);
    for (const { of, size } of images) assert.ok(size > 10 - kRounding_px, `${of}: ${size} px`);
    const wider = await page.locator(".change").evaluateAll((all) =>
      all.filter((each) => each.scrollWidth > each.clientWidth).length);
    assert.equal(wider, 0);
    assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 390);
    await close();
  });

  test(`${file}: no comparison is wider than paper, which would shrink the page`, options, async () => {
    const { page, close } = await openWhole(file, "print", kPaper_px);
    const { width, wider } = await page.evaluate((most) => ({
      width: document.documentElement.scrollWidth,
      wider: [...document.querySelectorAll("table, img")]
        .filter((each) => each.getBoundingClientRect().right > most + 1)
        .map((each) => each.alt ?? each.closest("[id]").id) }), kPaper_px);
    assert.deepEqual(wider, []);
    assert.ok(width <= kPaper_px, `${width} px`);
    await close();
  });
}
