import assert from "node:assert/strict";
import { readFileSync, statSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { comparison, figure, kinds, open, openingPlaced, study, until, violations } from "./support.mjs";

// One figure in six: axe-core examines each element of a drawing.
const insertSome = (page) => page.evaluate(() =>
  document.querySelectorAll("figure[data-id]").forEach((figure, i) => {
    if (i % 6 === 0) putIn(figure);
  }));

const insertAll = (page) => page.evaluate(() => dispatchEvent(new Event("beforeprint")));

test("the first screen has the verdict, the figure it rests on, what is wrong and the rest", async () => {
  const { page, errors, requests, close } = await open({ viewport: { width: 1280, height: 800 } });
  await openingPlaced(page);
  const opening = page.locator("#opening"), text = await opening.innerText();
  assert.match(text, /simulated robot.+10 methods.+runs?\./);  // What was done.
  assert.match(text, /published errors inside our 95\s% intervals\s+\d+ of \d+/);  // Is it good?
  assert.match(text, /best published: [\d.]+\sm/);  // Compared with what.
  assert.match(text, /Warnings: /);
  assert.match(text, /Compared with: /);
  assert.match(await page.locator(".made").innerText(), /mapproof \S+ \(.+\)\. \d{4}-\d\d-\d\d/);
  // All of it, the images too, is seen without scrolling.
  const { y, height } = await opening.boundingBox();
  assert.ok(y + height <= 800, `the opening ends at ${y + height}`);
  const figureLink = opening.locator(".main-figure a");
  assert.equal(await figureLink.getAttribute("href"), "#figure-published-errors");
  assert.ok((await figureLink.locator("img").getAttribute("alt")).length > 40);
  const links = opening.locator(".thumbnails a");
  assert.ok(await links.count() >= 3, `${await links.count()} small figures`);
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

test("the first screen of a phone has the verdict and the figure it rests on", async () => {
  const { page, close } = await open({ viewport: { width: 390, height: 844 } });
  await openingPlaced(page);
  const { numbers, figure, words } = await page.evaluate(() => {
    const box = (selector) => document.querySelector(selector).getBoundingClientRect().toJSON();
    return { numbers: box(".opening .highlights"), figure: box(".main-figure img"),
      words: box(".opening .finding") };
  });
  assert.ok(numbers.bottom < 500, `${numbers.bottom}`);
  assert.ok(figure.top >= numbers.bottom && figure.bottom <= 844, `${figure.top} ${figure.bottom}`);
  assert.ok(words.top >= figure.bottom);
  await close();
});

test("a method that is chosen before the first screen is decoded leaves its small images in place",
  async () => {
    const { page, errors, close } = await open({ viewport: { width: 1280, height: 800 } });
    await page.locator("select.method").waitFor({ state: "attached" });
    await openingPlaced(page);
    const placed = () => page.locator(".thumbnails").evaluate(
      (list) => [list.style.getPropertyValue("--columns"), list.childElementCount]);
    const before = await placed();
    await page.evaluate(() => {
      document.querySelector(".thumbnails").style.removeProperty("--columns");
      addOpeningImages();
      chooseMethod("ISOMAP");  // Gives each image another source.
    });
    await openingPlaced(page);
    assert.deepEqual(await placed(), before);
    assert.deepEqual(errors, []);
    await close();
  });

test("small figures of the first screen are at least 200 px wide", async () => {
  const { page, close } = await open({ viewport: { width: 1400, height: 900 } });
  await openingPlaced(page);
  const widths = await page.locator(".thumbnails img:visible").evaluateAll(
    (images) => images.map((each) => each.getBoundingClientRect().width));
  assert.ok(widths.length > 0);
  assert.ok(widths.every((width) => width >= 200), `${widths}`);
  await close();
});

test("long sentences take the room of the small figures beside the figure, which come back with it", async () => {
  const { page, close } = await open({ viewport: { width: 1280, height: 800 } });
  await openingPlaced(page);
  // The sentences get longer by twice the height of the window, or are not there.
  const isShownWith = async (isLong) => {
    await page.evaluate((long) => {
      document.querySelector(".opening .finding").style.paddingBottom = long ? "1600px" : "";
      for (const other of document.querySelectorAll(".beside > :not(.thumbnails)")) other.hidden = !long;
      document.querySelector(".thumbnails").style.removeProperty("--columns");
      addOpeningImages();
    }, isLong);
    await openingPlaced(page);
    return page.locator(".beside .thumbnails").isVisible();
  };
  assert.equal(await isShownWith(true), false);
  assert.equal(await isShownWith(false), true);
  await close();
});

test("where sentences are long and the figure is low, the small figures stand under it", async () => {
  const { page, close } = await open({ viewport: { width: 1280, height: 800 } });
  await openingPlaced(page);
  const placed = (more_px, figure_px) => page.evaluate(([longer, most]) => {
    document.querySelector(".opening .finding").style.paddingBottom = `${longer}px`;
    for (const other of document.querySelectorAll(".beside > :not(.thumbnails)")) {
      other.hidden = longer === 0;
    }
    document.querySelector(".main-figure").style.setProperty("--most", `${most}px`);
    placeThumbnails();
    const figure = document.querySelector(".main-figure"), list = document.querySelector(".thumbnails");
    const shown = [...list.children].filter((each) => each.checkVisibility());
    return { isUnder: list.parentElement === figure.parentElement, shown: shown.length,
      end: Math.max(0, ...shown.map((each) => each.getBoundingClientRect().bottom)),
      foot: figure.getBoundingClientRect().bottom,
      top: Math.min(...shown.map((each) => each.getBoundingClientRect().top)) };
  }, [more_px, figure_px]);
  const under = await placed(1600, 250);
  assert.ok(under.isUnder && under.shown > 0, JSON.stringify(under));
  assert.ok(under.top >= under.foot && under.end <= 800, JSON.stringify(under));
  assert.equal((await placed(0, 500)).isUnder, false);
  await close();
});

test("where sentences leave room for some small figures, a map in space is one of them", async () => {
  const { page, close } = await open({ viewport: { width: 1280, height: 800 } });
  await openingPlaced(page);
  const shown = (more_px) => page.evaluate((px) => {
    document.querySelector(".opening .finding").style.paddingBottom = `${px}px`;
    placeThumbnails();
    return [...document.querySelectorAll(".thumbnails a")].map((link) =>
      [link.checkVisibility(), link.hash.startsWith("#figure-scene-")]);
  }, more_px);
  let some = 0;
  for (let more_px = 0; more_px < 800; more_px += 20) {
    const figures = await shown(more_px);
    const visible = figures.filter(([isVisible]) => isVisible);
    if (visible.length === 0 || visible.length === figures.length) continue;
    ++some;
    assert.ok(visible.some(([, isInSpace]) => isInSpace), `${more_px}`);
  }
  assert.ok(some > 0);
  await close();
});

for (const [name, folder] of kinds) {
  for (const viewport of [{ width: 1280, height: 800 }, { width: 390, height: 844 }]) {
    test(`${name}: the first screen of ${viewport.width} px cuts no words, and repeats no small figure`,
      async () => {
        const { page, close } = await open({ viewport }, folder);
        await openingPlaced(page);
        const { cut, titles, links, images } = await page.evaluate(() => ({
          cut: [...document.querySelectorAll(".masthead *, #opening *")]
            .filter((each) => getComputedStyle(each).overflow === "hidden" &&
              each.clientHeight > 1 &&  // Else it is for screen readers.
              each.scrollHeight > each.clientHeight + 1).map((each) => each.textContent),
          links: [...document.querySelectorAll(".main-figure a, .thumbnails a")].map((each) => each.hash),
          images: [...document.querySelectorAll(".main-figure img, .thumbnails img")].map((each) => each.src),
          titles: [...document.querySelectorAll(".thumbnails bdi")].map((each) => each.textContent) }));
        assert.deepEqual(cut, []);
        assert.equal(new Set(links).size, links.length, links.join("; "));
        assert.equal(new Set(images).size, images.length, links.join("; "));
        assert.equal(new Set(titles).size, titles.length, titles.join("; "));
        for (const title of titles) assert.doesNotMatch(title, /no usable map/);
        await close();
      });
  }

  test(`${name}: on a phone the main figure has words of 10 px at least, none of them cut`,
    async () => {
      const { page, close } = await open({ viewport: { width: 390, height: 844 } }, folder);
      await openingPlaced(page);
      const found = await page.evaluate(() => {
        const image = document.querySelector(".main-figure img");
        if (!image) return null;
        const box = document.createElement("div");
        box.className = "measured";
        box.append(drawingOf(decodeURIComponent(image.src.slice(image.src.indexOf(",") + 1))));
        document.body.append(box);
        const svg = box.firstChild, { width, height } = viewBoxOf(svg);
        const shown = image.getBoundingClientRect(), whole = svg.getBoundingClientRect();
        const words = [...svg.querySelectorAll('g[transform*="scale("]')]
          .map((one) => one.getBoundingClientRect()).filter((one) => one.width > 0);
        return { least: leastWords(svg) * Math.min(shown.width / width, shown.height / height),
          cut: words.filter((one) => one.top < whole.top - 1 || one.bottom > whole.bottom + 1 ||
            one.left < whole.left - 1 || one.right > whole.right + 1).length };
      });
      if (found) assert.ok(found.least >= 9.99 && found.cut === 0, JSON.stringify(found));
      await close();
    });

  test(`${name}: the first screen has a figure that can be read, and the page 15.5 screens at most`,
    async () => {
      const { page, errors, close } = await open({ viewport: { width: 1280, height: 800 } }, folder);
      await openingPlaced(page);
      const { screens, opening, words, bottom, made } = await page.evaluate(async () => {
        const image = document.querySelector(".main-figure img");
        const found = { screens: document.documentElement.scrollHeight / innerHeight,
          opening: document.querySelector("#opening").getBoundingClientRect().bottom,
          made: document.querySelector("header").textContent };
        if (!image) return found;
        await image.decode();
        const { width, height, bottom } = image.getBoundingClientRect();
        const text = decodeURIComponent(image.src.replace(/^data:[^,]*,/, ""));
        const [, , wide, high] = /viewBox="([^"]+)"/.exec(text)[1].split(" ").map(Number);
        const sizes = [...text.matchAll(/scale\(([\d.]+)/g)].map((one) => 2048 * Number(one[1]));
        return { ...found, bottom, words: Math.min(width / wide, height / high) *
          Math.min(...sizes.filter((size) => size > 3)) };
      });
      assert.ok(screens <= 15.5, `${screens} screens`);
      if (words !== undefined) {
        assert.ok(words >= 9, `words of ${words} px`);
        assert.ok(bottom <= 800, `the figure ends at ${bottom}`);
      }
      assert.ok(opening <= 900, `the opening ends at ${opening}`);
      assert.match(made, /mapproof \d\S+ \(.+\)/);
      // The page of a map, made once more, has the same bytes.
      if (name !== "map") assert.match(made, /\d{4}-\d\d-\d\d/);
      assert.deepEqual(errors, []);
      await close();
    });
}

test("a report opens at 15.5 screens or less, and folds the rest, whole on paper", async () => {
  const { page, close } = await open({ viewport: { width: 1440, height: 900 } });
  const height = await page.evaluate(() => document.documentElement.scrollHeight);
  assert.ok(height <= 15.5 * 900, `${height / 900} screens`);
  const folds = page.locator("details.fold");
  assert.ok(await folds.count() > 8);
  assert.equal(await page.locator("details.fold[open]").count(), 0);
  await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
  assert.equal(await page.locator("details.fold:not([open])").count(), 0);
  await page.evaluate(() => dispatchEvent(new Event("afterprint")));
  assert.equal(await page.locator("details.fold[open]").count(), 0);
  await close();
});

test("a link to what is folded opens it, as in another tab", async () => {
  const hash = "#figure-map-bearing-isomap";
  const { page, close } = await open({}, undefined, undefined, hash);
  await page.locator(`${hash} .drawing > svg`).waitFor();
  const { y } = await page.locator(hash).boundingBox();
  assert.ok(y >= -1 && y < 900, `${y}`);
  await page.evaluate(() => { location.hash = "#table-durations"; });
  await page.locator("#table-durations tbody tr").first().waitFor();
  await close();
});

test("a link whose name is not UTF-8 leaves the page as it is", async () => {
  const { page, errors, close } = await open({}, undefined, undefined, "#%FF");
  await page.locator("html.folds").waitFor({ state: "attached" });
  await page.evaluate(() => { location.hash = "#table-durations"; });
  await page.locator("#table-durations tbody tr").first().waitFor();
  assert.deepEqual(errors, []);
  await close();
});

test("every section and figure gives a link to itself", async () => {
  const { page, close } = await open();
  const links = await page.locator("main > section[id^=section-] h2 a.anchor").evaluateAll(
    (all) => all.map((link) => [link.hash.slice(1), link.closest("section").id]));
  assert.ok(links.length > 8);
  for (const [target, id] of links) assert.equal(target, id);
  const figures = await page.locator("figure[data-id]").count();
  assert.equal(await page.locator('figure[data-id] a[href^="#figure-"]').count(), figures);
  await close();
});

test("the search finds figures by words that are outlines, and opens what is folded", async () => {
  const { page, close } = await open();
  const field = page.getByRole("searchbox", { name: "Search this page" });
  await field.fill("eigenvalues bearing");
  const found = page.locator(".found a");
  assert.ok(await found.count() >= 1);
  const target = await found.first().getAttribute("href");
  await field.press("Enter");
  assert.ok(await page.locator(target).isVisible());
  await field.fill("no such words");
  assert.equal(await found.count(), 0);
  assert.equal(await page.locator(".contents > output").textContent(), "0 found");
  await close();
});

test("the search lists words of one's own before parts of words, all hits if asked, and Enter leads on",
  async () => {
    const { page, close } = await open();
    const field = page.getByRole("searchbox", { name: "Search this page" });
    const found = page.locator(".found a"), more = page.locator(".contents > button");
    await field.fill("ma");  // Maps, and SMACOF.
    assert.ok(await found.count() > 1);
    await more.click();
    const texts = await found.evaluateAll((all) => all.map((each) => each.title.toLowerCase()));
    const counted = Number(/^\d+/.exec(await page.locator(".contents > output").textContent())[0]);
    assert.equal(texts.length, counted);
    assert.equal(await more.isVisible(), false);
    const marked = await found.evaluateAll((all) => all.map((each) => {
      const before = each.querySelector("mark")?.previousSibling?.textContent ?? "";
      return each.querySelector("mark") !== null && !/[\p{L}\p{N}]$/u.test(before);
    }));
    // Hits in names come in this order; those in captions alone have no mark.
    const first = marked.indexOf(true);
    assert.ok(first >= 0 && first < 3, `${marked}`);
    const places = [];
    for (let i = 0; i < 3; ++i) {
      await field.press("Enter");
      places.push(await page.evaluate(() => location.hash));
    }
    assert.equal(new Set(places).size, 3, places.join());
    await close();
  });

test("the search finds the texts of the page, and leads to them", async () => {
  const { page, close } = await open();
  const field = page.getByRole("searchbox", { name: "Search this page" });
  await field.fill("that no person estimated");
  assert.equal(await page.locator(".found a").count(), 0);
  const words = await page.locator("#opening .finding").first().textContent();
  await field.fill(words.trim().split(/\s+/).slice(0, 4).join(" "));
  const found = page.locator(".found a");
  assert.ok(await found.count() >= 1);
  assert.match(await found.first().textContent(), new RegExp(words.trim().split(/\s+/)[0]));
  await found.first().click();
  assert.equal(await page.locator(await found.first().getAttribute("href")).count(), 1);
  await close();
});

test("the list of methods has methods alone", async () => {
  const { page, close } = await open();
  const list = page.locator("select.method");
  await list.waitFor({ state: "attached" });
  const names = (await list.locator("option").allTextContents()).slice(1);
  const rows = await page.locator("main tbody th[scope=row]").allTextContents();
  assert.ok(names.length >= 9, `${names}`);
  for (const name of names) assert.ok(rows.some((row) => row.includes(name)), name);
  await close();
});

test("a method that is chosen lights in figures with a panel for each method", async () => {
  const { page, close } = await open();
  const maps = await figure(page, "maps-bearing");
  await page.locator("select.method").selectOption("KPCA, Gaussian");
  const lit = await maps.evaluate((each) => [...each.querySelectorAll("g.panel-title:not(.dim)")]
    .map((heading) => heading.querySelector("[data-words]").dataset.words));
  assert.equal(lit.length, 1);
  assert.match(lit[0], /^KPCA Gauss/);
  await page.locator("select.method").selectOption("");
  assert.equal(await maps.locator("g.dim").count(), 0);
  await close();
});

test("a method that is chosen lights in the figure of the first screen", async () => {
  const { page, close } = await open();
  const list = page.locator("select.method"), image = page.locator(".main-figure img");
  await list.waitFor({ state: "attached" });
  const shown = async () => decodeURIComponent(await image.getAttribute("src"));
  const before = await shown();
  await list.selectOption("ISOMAP");
  const words = (await shown()).match(/<g [^>]*class="dim"[^>]*>/g) ?? [];
  assert.ok(words.some((tag) => tag.includes("SDE")), "the names of others");
  assert.ok(words.every((tag) => !tag.includes("ISOMAP")), "not its own");
  const bars = (await shown()).match(/<path [^>]*data-kind="interval"[^>]*>/g);
  const lit = bars.filter((tag) => !/opacity/.test(tag));
  assert.ok(lit.length > 0 && lit.length < bars.length, "its intervals");
  assert.ok(lit.every((tag) => tag.includes('data-method="ISOMAP"')));
  await list.selectOption("");
  assert.equal(await shown(), before);
  await close();
});

test("a step fills the box also on a wide page", async () => {
  const { page, close } = await open();
  const film = await figure(page, "forming-bearing");
  await film.getByRole("slider").fill("2");
  const { frame, box } = await film.evaluate((each) => ({
    frame: [...each.querySelectorAll("svg > g.frame")].map((one) => one.getBoundingClientRect())
      .find((one) => one.width > 0).width,
    box: each.querySelector(".drawing").clientWidth }));
  assert.ok(frame >= .55 * box, `${frame} of ${box}`);
  await film.getByRole("slider").fill("0");
  assert.equal(await page.locator(".stepped").count(), 0);
  await close();
});

test("a cell of the matrix of warnings opens the runs that it counts", async () => {
  const { page, close } = await open();
  const cells = page.locator("table.warnings a");
  assert.ok(await cells.count() >= 1);
  for (const cell of await cells.all()) assert.match(await cell.textContent(), /^[\d.]+\s%$/);
  const runs = page.locator(await cells.first().getAttribute("href"));
  assert.equal(await runs.isVisible(), false);
  await cells.first().click();
  await runs.locator("li").first().waitFor();
  assert.match(await runs.innerText(), /layout-\d+-pose-\d+/);
  await close();
});

test("a note of several tables is said once, and the others link to it", async () => {
  const { page, close } = await open();
  const notes = await page.locator(".notes li").evaluateAll(
    (all) => all.map((note) => note.textContent).filter((text) => !text.startsWith("See note")));
  assert.equal(new Set(notes).size, notes.length);
  for (const link of await page.locator('.notes a[href^="#note-"]').all()) {
    const said = page.locator(`.notes ${await link.getAttribute("href")}`);
    assert.match(await said.textContent(), new RegExp(`^${await link.textContent()}: `, "i"));
  }
  await close();
});

// How white the whitest pixel of an image is, 0 to 255.
const whitest = (page, image) => page.evaluate(async (bytes) => {
  const bitmap = await createImageBitmap(new Blob([new Uint8Array(bytes)], { type: "image/png" }));
  const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d");
  context.drawImage(bitmap, 0, 0);
  const { data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
  let most = 0;
  for (let i = 0; i < data.length; i += 4) most = Math.max(most, Math.min(...data.slice(i, i + 3)));
  return most;
}, [...image]);

test("a theme that was chosen is there after a reload, and figures follow it", async () => {
  const { page, close } = await open();
  await page.getByRole("button", { name: "Use dark colours" }).click();
  await page.reload();
  assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), "dark");
  const map = await figure(page, "fig-4");
  const brightness = (selector) => map.locator(selector).first().evaluate((each) => {
    const [red, green, blue] = getComputedStyle(each).fill.match(/\d+/g).map(Number);
    return (red + green + blue) / 765;
  });
  assert.ok(await brightness("g.title") > 0.7);
  assert.ok(await brightness("svg > path") < 0.3);
  // Markers are as dark inside as the paper: on a screen, since <use> has styles of its own.
  const wall = await figure(page, "maps-bearing");
  const inside = await wall.locator("svg").evaluate((svg) => {
    const mark = svg.querySelector('use[data-kind="true"]');
    const { left, right, top, bottom } = mark.getBoundingClientRect();
    return { x: (left + right) / 2 - 1, y: (top + bottom) / 2 - 1, width: 2, height: 2 };
  });
  const image = await page.screenshot({ clip: inside });
  assert.ok(await whitest(page, image) < 100, "a marker is white inside");
  const text = await map.evaluate((each) => sourceOf(each));
  assert.match(text, /fill="#ffffff"/);  // Files keep their colours.
  await page.emulateMedia({ media: "print" });
  assert.ok(await brightness("g.title") < 0.3);
  await close();
});

test("3-D figures have an image for each theme, of one computation, and paper has the light one",
  async () => {
    const { page, close } = await open({ colorScheme: "dark" });
    const scene = await figure(page, "scene-world-bearing");
    const shown = () => scene.locator("image").evaluateAll((images) => images
      .filter((image) => getComputedStyle(image).display !== "none")
      .map((image) => image.getAttribute("class")));
    assert.deepEqual(await shown(), ["in-dark"]);
    // Its ground is that of the page; nothing but a palette distinguishes it from the light image.
    const { corners, equal, title } = await scene.locator("svg").evaluate(async (svg) => {
      const pixels = async (image) => {
        const loaded = new Image();
        loaded.src = image.getAttribute("href");
        await loaded.decode();
        const context = new OffscreenCanvas(loaded.width, loaded.height).getContext("2d");
        context.drawImage(loaded, 0, 0);
        return [...context.getImageData(0, 0, 1, 1).data.slice(0, 3)];
      };
      const chunks = (image) => {
        const bytes = bytesOf(image.getAttribute("href").split(",")[1]);
        const view = new DataView(bytes.buffer), found = [];
        for (let at = 8; at < bytes.length; at += view.getUint32(at) + 12) {
          const type = String.fromCharCode(...bytes.subarray(at + 4, at + 8));
          if (type !== "PLTE") found.push(bytes.subarray(at, at + view.getUint32(at) + 12).join());
        }
        return found.join();
      };
      const light = svg.querySelector(".in-light"), dark = svg.querySelector(".in-dark");
      return { corners: [await pixels(light), await pixels(dark)],
        equal: chunks(light) === chunks(dark),
        title: getComputedStyle(svg.querySelector("g.title")).fill };
    });
    assert.deepEqual(corners, [[255, 255, 255], [0x15, 0x18, 0x1c]]);
    assert.ok(equal);
    assert.equal(title, "rgb(230, 233, 237)");
    const files = await scene.evaluate((each) => withoutDarkPalettes(sourceOf(each)));
    assert.doesNotMatch(files, /data-dark/);
    await page.emulateMedia({ media: "print" });
    assert.deepEqual(await shown(), ["in-light"]);
    await page.emulateMedia({ media: "screen", colorScheme: "light" });
    assert.deepEqual(await shown(), ["in-light"]);
    await page.getByRole("button", { name: "Use dark colours" }).click();
    assert.deepEqual(await shown(), ["in-dark"]);
    await close();
  });

test("on a phone no figure is moved sideways, and its words have 10 px at least", async () => {
  const { page, close } = await open({ viewport: { width: 390, height: 844 } });
  const ids = await page.evaluate(() => held.map((figure) => figure.dataset.id));
  assert.ok(ids.length > 40, `${ids.length}`);
  for (const id of ids) {
    const { least, wider, outside } = await page.locator(`#figure-${id}`).evaluate((each) => {
      unfold(each);
      putIn(each);
      const box = each.querySelector(".drawing"), svg = box.querySelector("svg");
      const words = [...svg.querySelectorAll('g[transform*="scale("]')]
        .filter((one) => one.getBoundingClientRect().width > 0);
      const { left, right } = box.getBoundingClientRect();
      return { wider: box.scrollWidth - box.clientWidth,
        least: svg.getScreenCTM().a * Math.min(...words.map((one) =>
          2048 * Number(/scale\(([\d.]+)/.exec(one.getAttribute("transform"))[1]))),
        outside: words.map((one) => one.getBoundingClientRect())
          .filter((one) => one.left < left - 1 || one.right > right + 1).length };
    });
    assert.ok(wider <= 1, `${id}: ${wider}`);  // Both widths are rounded.
    assert.equal(outside, 0, id);
    assert.ok(least >= 9.99, `${id}: ${least}`);
  }
  const opening = await page.locator(".main-figure").evaluate(
    (each) => each.scrollWidth - each.clientWidth);
  assert.equal(opening, 0);
  await close();
});

test("a figure that got narrower on a phone keeps its data where its axes count them", async () => {
  const shares = async (options) => {
    const { page, close } = await open(options);
    const shown = await figure(page, "fig-4");
    const found = await shown.locator("svg").evaluate((svg) => {
      const frame = svg.querySelector("g.frame").getBoundingClientRect();
      return [...svg.querySelectorAll("use.marker, .marker use")].map((mark) => {
        const { left, right, top, bottom } = mark.getBoundingClientRect();
        return [((left + right) / 2 - frame.left) / frame.width,
          ((top + bottom) / 2 - frame.top) / frame.height];
      });
    });
    await close();
    return found.flat();
  };
  const wide = await shares({}), narrow = await shares({ viewport: { width: 390, height: 844 } });
  assert.ok(wide.length > 20);
  assert.equal(wide.length, narrow.length);
  wide.forEach((share, i) => assert.ok(Math.abs(share - narrow[i]) < .01, `${share} ${narrow[i]}`));
});

test("on a phone every method has its name beside a diagram of ranks, and no line through it", async () => {
  const { page, close } = await open({ viewport: { width: 390, height: 844 } });
  for (const id of ["ranks-bearing", "ranks-visibility"]) {
    const shown = await figure(page, id);
    const names = await shown.locator(".drawing > svg").evaluate((svg) => {
      const box = svg.parentElement.getBoundingClientRect();
      const lines = [...svg.querySelectorAll("g.line path")].map((each) => each.getBoundingClientRect());
      const from = Math.min(...lines.map(({ left }) => left));
      const to = Math.max(...lines.map(({ right }) => right));
      return [...svg.querySelectorAll('.mark-label g[transform*="scale("]')]
        .filter((words) => /^(?!CD).* \d+\.\d\d$/.test(words.dataset.words))
        .map((words) => [words.dataset.words, words.getBoundingClientRect()])
        .map(([words, { left, right, width }]) => ({ words,
          isShown: width > 0 && left >= box.left && right <= box.right,
          isBeside: right <= from + 1 || left >= to - 1 }));
    });
    assert.equal(names.length, 10);
    assert.deepEqual(names.filter(({ isShown, isBeside }) => !isShown || !isBeside), [], id);
  }
  await close();
});

test("on a phone the tick labels of a y axis end at one line, the lowest one, too", async () => {
  const { page, close } = await open({ viewport: { width: 390, height: 844 } });
  const shown = await figure(page, "fig-4");
  const ends = await shown.locator(".drawing > svg").evaluate((svg) => {
    const { panels, frames } = partsOf(svg);
    return panels.map((panel, i) => tickLabelsOf(panel, frames[i]).left.map(
      (label) => label.getBoundingClientRect().right));
  });
  assert.ok(ends.some((labels) => labels.length > 1));
  for (const labels of ends) {
    assert.ok(Math.max(...labels) - Math.min(...labels) < 1.5, labels.join(" "));
  }
  await close();
});

test("a phone that is turned arranges its figures again", async () => {
  const { page, close } = await open({ viewport: { width: 360, height: 640 } });
  const ids = ["fig-4", "forming-bearing", "scene-world-bearing"];
  const boxes = () => Promise.all(ids.map((id) => page.locator(`#figure-${id} svg`).evaluate(
    (svg) => ({ view: svg.getAttribute("viewBox").split(" ").map((each) => Math.round(each)).join(" "),
      rows: new Set([...svg.querySelectorAll(
      ":scope > g.frame")].map((frame) => Math.round(frame.getBoundingClientRect().top))).size,
    wider: svg.parentElement.scrollWidth - svg.parentElement.clientWidth }))));
  for (const id of ids) await figure(page, id);
  const upright = await boxes();
  await page.setViewportSize({ width: 568, height: 320 });  // Still narrow, but wider.
  const widthIs = (most) => document.querySelector("#figure-forming-bearing svg").viewBox.baseVal
    .width <= most;
  await until(page, (least) => document.querySelector("#figure-forming-bearing svg").viewBox.baseVal
    .width > least, 300);
  const turned = await boxes();
  assert.ok(turned[1].rows < upright[1].rows, `${turned[1].rows} of ${upright[1].rows}`);
  for (const box of [...upright, ...turned]) assert.equal(box.wider, 0);
  await page.setViewportSize({ width: 844, height: 390 });
  await until(page, () => document.querySelectorAll(".stacked").length === 0);
  assert.ok((await boxes()).every(({ view }) => view.startsWith("0 0 6")));
  await page.setViewportSize({ width: 360, height: 640 });
  await until(page, widthIs, 300);
  assert.deepEqual(await boxes(), upright);
  await close();
});

test("a page that gets narrower arranges the figure of its first screen again", async () => {
  const { page, close } = await open({ viewport: { width: 560, height: 844 } });
  const image = page.locator(".main-figure img");
  const drawn = () => image.evaluate((one) => one.src);
  const wide = await drawn();
  await page.setViewportSize({ width: 390, height: 844 });
  await until(page, (before) => document.querySelector(".main-figure img").src !== before, wide);
  const words = await image.evaluate((one) => {
    const text = decodeURIComponent(one.src.slice(one.src.indexOf(",") + 1));
    const svg = new DOMParser().parseFromString(text, "image/svg+xml").documentElement;
    return leastWords(svg) * one.getBoundingClientRect().width / svg.getAttribute("width");
  });
  assert.ok(words >= 9.9, `words of ${words} px`);
  await close();
});

test("numbers in cells keep their colour in the dark, as the cells do", async () => {
  const { page, close } = await open({ colorScheme: "dark" });
  const found = await page.evaluate(() => {
    const cell = '<g class="cell-text" fill="#ffffff">', words = '<g class="title" fill="#ffffff">';
    const box = document.createElement("div");
    box.innerHTML = `<svg>${cell}</g>${words}</g></svg>`;
    document.body.append(box);
    const colours = [...box.querySelectorAll("g")].map((one) => getComputedStyle(one).fill);
    box.remove();
    return { colours, cell: inPageColours(cell) === cell, words: inPageColours(words) === words };
  });
  assert.equal(found.colours[0], "rgb(255, 255, 255)");
  assert.notEqual(found.colours[1], "rgb(255, 255, 255)");
  assert.deepEqual([found.cell, found.words], [true, false]);
  await close();
});

test("on a phone the panels of a figure stand below each other, and no figure is cut", async () => {
  const { page, close } = await open({ viewport: { width: 390, height: 844 } });
  for (const id of ["published-errors", "forming-bearing", "maps-bearing"]) {
    const shown = await figure(page, id);
    const { frames, box, inner, words } = await shown.evaluate((each) => {
      const svg = each.querySelector("svg"), drawing = each.querySelector(".drawing");
      const right = drawing.getBoundingClientRect().right + 1;
      const words = [...svg.querySelectorAll("[data-words]")].map(
        (word) => word.getBoundingClientRect()).filter((word) => word.width > 0);
      return { frames: [...svg.querySelectorAll(":scope > g.frame")].map(
        (frame) => frame.getBoundingClientRect().toJSON()), box: drawing.clientWidth,
        inner: drawing.scrollWidth, words: words.filter((word) => word.right > right).length };
    });
    assert.equal(inner, box, id);
    assert.equal(words, 0, id);
    const rows = new Set(frames.map((frame) => Math.round(frame.top)));
    assert.ok(rows.size >= frames.length / 2, `${id}: ${rows.size} of ${frames.length}`);
    assert.ok(await shown.locator(".drawn-title").isVisible());
  }
  // A landmark is lit in the panels where they stand now.
  const wall = await figure(page, "maps-bearing");
  await wall.getByRole("combobox").selectOption({ label: "L10" });
  const off = await wall.locator("svg").evaluate((svg) => {
    const middle = (each) => {
      const { left, right, top, bottom } = each.getBoundingClientRect();
      return [(left + right) / 2, (top + bottom) / 2];
    };
    const marks = [...svg.querySelectorAll('use[data-landmark="L10"]')].map(middle);
    return [...svg.querySelectorAll("g.lit circle")].map(middle).map(([x, y]) =>
      Math.min(...marks.map((mark) => Math.hypot(mark[0] - x, mark[1] - y))));
  });
  assert.ok(off.length >= 10 && off.every((distance) => distance < 1), `${off}`);
  // A step fills the width.
  const film = await figure(page, "forming-bearing");
  await film.getByRole("slider").fill("2");
  assert.equal(await film.locator(".drawing").evaluate((box) => box.scrollWidth - box.clientWidth), 0);
  await page.setViewportSize({ width: 1200, height: 844 });
  await film.getByRole("slider").fill("0");
  assert.equal(await page.locator(".stacked, .drawn-title, .step-axes").count(), 0);
  await close();
});

const folderOf = (kind) => kinds.find(([name]) => name === kind)?.[1];
const boots = folderOf("boots"), mrclam = folderOf("mrclam");
const phone = { viewport: { width: 390, height: 844 } };

test("on a phone each panel keeps the label of its own axis", { skip: !boots }, async () => {
  const { page, close } = await open(phone, boots);
  const shown = await figure(page, "fig-1b");
  await shown.locator(".step-axes").first().waitFor({ state: "attached" });
  const labels = await shown.locator(".step-axes").evaluateAll((layers) => layers.map(
    (layer) => [...layer.querySelectorAll("[data-words]")].map((each) => each.dataset.words)));
  assert.deepEqual(labels, [["error of \u0108", "ranges"], ["error [m]", "ranges"]]);
  await close();
});

const ofSlam = folderOf("slam");

test("on a phone the names of landmarks stand off their marks, where lines lead to them",
  { skip: !ofSlam }, async () => {
    const { page, close } = await open(phone, ofSlam);
    const shown = await figure(page, "path-own");
    const found = await shown.locator("svg").evaluate((svg) => {
      const boxOf = (each) => each.getBoundingClientRect();
      const marks = [...svg.querySelectorAll(".marker [data-landmark]")];
      const names = [...svg.querySelectorAll(".mark-label [data-words]")]
        .filter((words) => marks.some((mark) => mark.dataset.landmark === words.dataset.words));
      const leaders = [...svg.querySelectorAll(".leader path")].map(boxOf);
      const isOff = (a, b) => a.right < b.left || b.right < a.left || a.bottom < b.top + 1 ||
        b.bottom < a.top + 1;
      // A line may end at the edge of the words, whose letters begin a little later.
      const kReach_px = 4;
      const isLed = (words) => leaders.some((leader) => leader.right > words.left - kReach_px &&
        leader.left < words.right + kReach_px && leader.bottom > words.top - kReach_px &&
        leader.top < words.bottom + kReach_px);
      return names.map((words) => ({ name: words.dataset.words,
        on: marks.filter((mark) => !isOff(boxOf(words), boxOf(mark))).map((mark) => mark.id),
        isLed: isLed(boxOf(words)) }));
    });
    assert.equal(found.length, 6);
    for (const { name, on, isLed } of found) {
      assert.deepEqual(on, [], name);
      assert.ok(isLed, name);
    }
    await close();
  });

test("on a phone the main figure keeps its notes, as text below it", { skip: !mrclam }, async () => {
  const { page, close } = await open(phone, mrclam);
  const notes = page.locator(".main-figure small");
  await notes.first().waitFor();
  assert.match((await notes.allTextContents()).join(" "), /\u26a0 The landmarks are in 2 groups/);
  assert.ok(await notes.first().evaluate((each) => parseFloat(getComputedStyle(each).fontSize)) >= 10);
  await close();
});

test("on a phone the panels of the main figure have its width and a height to be read at", async () => {
  const { page, close } = await open(phone);
  const { frames, whole, least, least_px } = await page.evaluate(() => {
    const kWidth_px = 350, kLeft_px = 100;  // The first screen has room for a part of one panel.
    const { text } = narrowed(sourceOf(document.getElementById("figure-published-errors")),
      kWidth_px, kLeft_px);
    const box = document.createElement("div");
    box.className = "measured";
    box.append(drawingOf(text));
    document.body.append(box);
    const svg = box.firstChild, scale = kWidth_px / svg.getBoundingClientRect().width;
    const boxOf = (each) => {
      const { right, top, width, height } = each.getBoundingClientRect();
      return { right: scale * right, top, width: scale * width, height: scale * height };
    };
    return { frames: [...svg.querySelectorAll(":scope > g.frame")].map(boxOf), whole: boxOf(svg),
      least: leastWords(svg) * kWidth_px / viewBoxOf(svg).width, least_px: kLeastFrame_px };
  });
  assert.equal(new Set(frames.map(({ top }) => Math.round(top))).size, 2);
  for (const frame of frames) {
    assert.ok(frame.height >= least_px, `${frame.height} px high`);
    assert.ok(frame.width > .7 * whole.width && whole.right - frame.right < .05 * whole.width,
      JSON.stringify({ frame, whole }));
  }
  assert.ok(least >= 9.99, `words of ${least} px`);
  await close();
});

test("a phone shows where the head tells how to make it again", async () => {
  const { page, close } = await open(phone);
  assert.ok(await page.locator(".made a").isVisible());
  await close();
});

test("on a phone a colour bar of a single panel stands below it, and no longer beside it", async () => {
  const { page, errors, close } = await open({ viewport: { width: 390, height: 844 } });
  const found = await page.evaluate(() => {
    const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
    const add = (parent, name, attributes) => {
      const made = parent.appendChild(document.createElementNS(svg.namespaceURI, name));
      for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
      return made;
    };
    svg.setAttribute("viewBox", "0 0 400 400");
    const defs = add(svg, "defs", {}), tops = [20, 220], frame = { x: 50, width: 200, height: 150 };
    for (const y of tops) add(add(defs, "clipPath", {}), "rect", { ...frame, y });
    tops.forEach((y, i) => {
      const grid = add(svg, "g", { class: "grid", "clip-path": `url(#a-c${i})` });
      add(grid, "rect", { ...frame, y });
    });
    const kColours = 10;
    for (const top of tops) {
      for (let i = 0; i < kColours; ++i) {
        const sample = add(svg, "g", { class: "legend-sample", fill: `rgb(${25 * i},0,0)` });
        const height = i === 0 ? 150 : 15;
        add(sample, "rect", { x: 270, y: i === 0 ? top : top + 15 * i, width: 10, height });
      }
      const words = add(svg, "g", { class: "legend-text" });
      add(words, "text", { x: 285, y: top + 75, transform: "translate(0 0)" }).textContent = "1";
    }
    document.querySelector("main").append(svg);
    const rooms = { left: 40, above: 10, right: 40, below: 20 };
    stack(svg, partsOf(svg), { rooms, columns: 1, width: 300 });
    return { shown: svg.querySelectorAll(":scope > [class^=legend]:not(.off)").length,
      pieces: svg.querySelectorAll(":scope > .step-axes > rect").length };
  });
  assert.deepEqual(found, { shown: 0, pieces: 20 });
  assert.deepEqual(errors, []);
  await close();
});

test("on a phone a legend is one block below the panel, in the order of the lines", async () => {
  const { page, close } = await open({ viewport: { width: 390, height: 844 } });
  for (const id of ["fig-4", "fig-5", "fig-8"]) {
    const shown = await figure(page, id);
    const { texts, samples, frame } = await shown.locator("svg").evaluate((svg) => {
      const boxes = (selector) => [...svg.querySelectorAll(selector)].map(
        (each) => each.getBoundingClientRect().toJSON());
      return { texts: boxes("g.legend-text"), samples: boxes("g.legend-sample"),
        frame: svg.querySelector("g.frame").getBoundingClientRect().toJSON() };
    });
    assert.ok(texts.length >= 4, `${id}: ${texts.length}`);
    for (const { top } of [...texts, ...samples]) assert.ok(top > frame.bottom, id);
    for (const { height } of samples) assert.ok(height < 14, `${id}: a line slopes over ${height}`);
    // In lines from left to right, in columns below each other.
    const lefts = [...new Set(texts.map(({ left }) => Math.round(left)))].sort((a, b) => a - b);
    assert.ok(lefts.length <= 3, `${id}: ${lefts}`);
    texts.forEach((text, i) => {
      assert.ok(Math.abs(text.left - lefts[i % lefts.length]) <= 1, `${id}: ${i}`);
      if (i > 0) assert.ok(text.bottom >= texts[i - 1].bottom - 1, `${id}: ${i}`);
    });
  }
  // On a wide page the lines lead to their labels again.
  await page.setViewportSize({ width: 1200, height: 844 });
  const figure4 = page.locator("#figure-fig-4");
  await until(page, () => !document.querySelector("#figure-fig-4 .stacked"));
  assert.ok(await figure4.evaluate((each) => [...each.querySelectorAll("g.legend-sample path")]
    .some((path) => !/l[-\d.]+ ?0$/.test(path.getAttribute("d")))));
  await close();
});

test("on a phone long names in a legend are broken into lines, and whole again on a wide page",
  async () => {
    const { page, close } = await open({ viewport: { width: 1200, height: 900 } });
    const figure4 = await figure(page, "fig-4");
    const legend = () => figure4.evaluate((each) =>
      [...each.querySelectorAll("g.legend-text")].map((text) => text.outerHTML));
    await figure4.evaluate((each) => {
      // The first name four times, with spaces, which have no outline, between.
      const words = each.querySelector("g.legend-text > g"), glyphs = [...words.querySelectorAll("use")];
      const long = Number(glyphs.at(-1).getAttribute("x")) + 1500;
      for (let times = 1; times < 4; ++times) {
        const space = document.createElementNS(words.namespaceURI, "use");
        space.setAttribute("x", times * long - 600);
        words.append(space, ...glyphs.map((glyph) => {
          const copy = glyph.cloneNode();
          copy.setAttribute("x", Number(glyph.getAttribute("x") ?? 0) + times * long);
          return copy;
        }));
      }
    });
    const wide = await legend();
    await page.setViewportSize({ width: 390, height: 844 });
    await until(page, () => document.querySelector("#figure-fig-4 .stacked"));
    const { right, boxes, lines } = await figure4.evaluate((each) => ({
      right: each.querySelector("svg").getBoundingClientRect().right,
      boxes: [...each.querySelectorAll("g.legend-text")].map((text) => {
        const box = text.getBoundingClientRect();
        return { right: box.right, top: box.top, bottom: box.bottom };
      }),
      lines: new Set([...each.querySelector("g.legend-text > g").querySelectorAll("use")].map(
        (glyph) => glyph.getAttribute("y"))).size }));
    assert.ok(lines >= 2, `${lines} lines`);
    assert.ok(boxes.every((box) => box.right <= right + 1), JSON.stringify({ right, boxes }));
    const below = boxes.filter((box) => box !== boxes[0] && box.top >= boxes[0].top);
    assert.ok(below.every((box) => box.top >= boxes[0].bottom - 1), JSON.stringify(boxes));
    await page.setViewportSize({ width: 1200, height: 900 });
    await until(page, () => !document.querySelector("#figure-fig-4 .stacked"));
    assert.deepEqual(await legend(), wide);
    await close();
  });

test("hits of the search have their section, the words marked, and are whole", async () => {
  const { page, close } = await open();
  await page.getByRole("searchbox", { name: "Search this page" }).fill("orderings");
  const hits = await page.locator(".found a").evaluateAll((all) => all.map((each) => ({
    marked: each.querySelector("mark")?.textContent, place: each.querySelector("small").textContent,
    hidden: each.scrollWidth - each.clientWidth })));
  assert.ok(hits.length >= 2);
  for (const { marked, place, hidden } of hits) {
    assert.match(marked, /^orderings$/i);
    assert.match(place, /\w/);
    assert.ok(hidden <= 0, `${hidden} px`);
  }
  await close();
});

test("small images of curves show lines alone, over the whole image", async () => {
  const { page, close } = await open();
  const sources = await page.locator(".thumbnails img").evaluateAll(
    (all) => all.map((each) => decodeURIComponent(each.src.replace(/^data:[^,]*,/, ""))));
  assert.ok(sources.length >= 3);
  for (const text of sources) assert.doesNotMatch(text, /class="(legend-box|legend-text|tick-label)/);
  assert.ok(sources.some((text) => text.includes('preserveAspectRatio="none"')));
  await close();
});

test("small images of heat maps show all cells, without their numbers", async () => {
  const { page, close } = await open();
  const shown = await page.evaluate(() => cropped(`<svg xmlns="http://www.w3.org/2000/svg" width="200"
    height="160" viewBox="0 0 200 160"><defs><clipPath id="h-c0"><rect x="50" y="20" width="120"
    height="90"/></clipPath></defs><g class="cells" clip-path="url(#h-c0)" fill="#440154"><path
    d="m50 20h120v90h-120z"/></g><g class="cell-text"><path d="m60 30l9 9"/></g></svg>`));
  assert.match(shown, /class="cells"/);
  assert.doesNotMatch(shown, /cell-text/);
  // The box of small images is twice as wide as high: nothing of the frame is cut.
  assert.match(shown, /viewBox="50 20 120 90"/);
  assert.match(shown, /width="120"\s+height="60"/);
  assert.match(shown, /preserveAspectRatio="none"/);
  await close();
});

test("all methods are shown on one run with the same axes, and a landmark in all of them", async () => {
  const { page, close } = await open();
  const wall = await figure(page, "maps-bearing");
  const panels = await wall.locator("svg clipPath > rect").evaluateAll(
    (all) => all.map((rect) => [rect.getAttribute("width"), rect.getAttribute("height")].join()));
  assert.ok(panels.length >= 9, `${panels.length}`);
  assert.equal(new Set(panels).size, 1);
  await wall.getByRole("combobox").selectOption({ label: "L10" });
  assert.ok(await wall.locator("g.lit circle").count() >= panels.length);
  await close();
});

test("the contents follow the reader, also if they are longer than the window", async () => {
  const { page, close } = await open({ viewport: { width: 1400, height: 300 } });
  await page.locator("main > section").last().evaluate((section) => section.scrollIntoView());
  await until(page, () => {
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
  await until(page, () => document.querySelector(".contents").scrollTop > 0);
  await page.evaluate(() => scrollTo(0, 0));
  await until(page, () => document.querySelector(".contents").scrollTop === 0);
  assert.equal(await page.locator(".contents a[aria-current]").count(), 0);
  await close();
});

test("every entry of the contents links to its section, or to a part of it", async () => {
  const { page, close } = await open();
  const { sections, parts, lost } = await page.evaluate(() => {
    const idOf = (link) => link.getAttribute("href").slice(1);
    const links = [...document.querySelectorAll(".contents a")];
    const parts = links.filter((link) => link.closest(".parts"));
    const isIn = (link) => {
      const of = link.closest(".parts")?.parentElement.querySelector("a") ?? link;
      const section = document.querySelector(`main > section[id="${idOf(of)}"]`);
      return section && (of === link || section.querySelector(`[id="${idOf(link)}"]`));
    };
    return { sections: links.length - parts.length, parts: parts.length,
      lost: links.filter((link) => !isIn(link)).map(idOf) };
  });
  assert.ok(sections > 8 && parts > 8, `${sections}, ${parts}`);
  assert.deepEqual(lost, []);
  await close();
});

test("the contents show their second level where they stand at the side", async () => {
  const { page, close } = await open();
  const parts = page.locator(".contents .parts").first();
  assert.ok(await parts.isVisible());
  await page.setViewportSize({ width: 390, height: 844 });
  assert.ok(!await parts.isVisible());
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

// Drawings are all of the same elements: those of the first page stand for the others.
for (const [name, folder] of kinds.filter(([, each]) => each !== study)) {
  test(`${name}: axe-core finds no violation, light, dark, on paper or a phone`, async () => {
    const { page, close } = await open({}, folder);
    for (const [mode, media] of [["light", { colorScheme: "light" }],
      ["dark", { colorScheme: "dark" }], ["paper", { colorScheme: "light", media: "print" }],
      ["phone", { media: "screen" }]]) {
      await page.emulateMedia(media);
      if (mode === "phone") await page.setViewportSize({ width: 390, height: 844 });
      assert.deepEqual(await violations(page, ["figure svg"]), [], mode);
    }
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
  assert.ok((await page.locator("#figure-fig-4 svg").boundingBox()).height > 200);
  assert.equal(await page.locator(".tools").count(), 0);
  await close();
});

test("every control can be reached by Tab and has a name", async () => {
  const { page, close } = await open();
  await figure(page, "map-bearing-isomap");
  const nameless = await page.evaluate(() => {
    const isNamed = (each) => each.textContent.trim() || each.ariaLabel || each.labels?.length;
    // What is hidden gets its name when it is shown.
    return Array.from(document.querySelectorAll("button, input, select, a[href], summary"))
      .filter((each) => !each.closest("[hidden]") && (each.tabIndex < 0 || !isNamed(each))).length;
  });
  assert.equal(nameless, 0);
  const drawing = page.locator("#figure-map-bearing-isomap .drawing");
  await drawing.focus();
  await page.keyboard.press("Tab");
  const label = await page.evaluate(() => document.activeElement.getAttribute("aria-label"));
  assert.equal(label, "Zoom out");
  await close();
});

test("on paper the head of a table holds no buttons, which further pages would leave out", async () => {
  const { page, close } = await open();
  const shown = () => page.locator("thead .sort").first().evaluate(
    (button) => [getComputedStyle(button).display, button.getClientRects().length]);
  assert.notEqual((await shown())[0], "contents");
  await page.emulateMedia({ media: "print" });
  assert.deepEqual(await shown(), ["contents", 0]);
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

test("the report is one file of at most 6 MB, and 8 MB with its data, that loads nothing else", async () => {
  const report = join(study, "report.html");
  const data = /<script id="mapproof-data"[^>]*>[^<]*<\/script>/.exec(readFileSync(report, "utf8"));
  assert.ok(data, "the page carries its data");
  assert.ok(statSync(report).size - data[0].length <= 6e6);
  assert.ok(statSync(report).size <= 8e6);
  const { page, requests, errors, close } = await open();
  await insertAll(page);
  await page.waitForTimeout(500);
  assert.deepEqual(requests, []);
  assert.deepEqual(errors, []);
  await close();
});
