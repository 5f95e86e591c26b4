"use strict";
// Runs beside the page of a comparison in a frame, uses every control of it, and writes one
// "name=value" line a finding into <pre id="findings">. diff_browser_test.cpp says what they must be.
const findings = [];
const say = (name, value) => findings.push(`${name}=${value}`);
const pause = (ms = 60) => new Promise((done) => setTimeout(done, ms));

let frame, page, view;
const all = (selector, within = page) => Array.from(within.querySelectorAll(selector));
const one = (selector, within = page) => within.querySelector(selector);
const style = (element) => view.getComputedStyle(element);
const seen = (element) => style(element).display !== "none" && style(element).visibility !== "hidden" &&
  element.getClientRects().length > 0;
const item = (name) => page.getElementById(`figure-${name}`);
const atHand = () => one(".item.at-hand")?.id ?? "";

async function press(key, target = page.activeElement ?? page.body) {
  target.dispatchEvent(new view.KeyboardEvent("keydown", { key, bubbles: true, cancelable: true }));
  await pause();
}

const transforms = (stage) => new Set(all(".canvas", stage).filter(seen).map((each) => style(each).transform));
const scale = (stage) => new view.DOMMatrix(style(one(".canvas", stage)).transform).a.toFixed(3);
const shift = (stage) => {
  const matrix = new view.DOMMatrix(style(one(".canvas", stage)).transform);
  return `${Math.round(matrix.e)},${Math.round(matrix.f)}`;
};

function checkTexts(expected) {
  const text = page.body.textContent + "\n" + page.title;
  say("texts", expected.texts.length);
  const missing = expected.texts.filter((each) => !text.includes(each));
  say("missing-texts", missing.length);
  if (missing.length > 0) say("first-missing", missing[0]);
}

function checkTraps() {
  const every = all("*");
  say("scripts", page.scripts.length);
  say("handlers", every.flatMap((each) => Array.from(each.attributes, (attribute) => attribute.name))
    .filter((name) => name.startsWith("on")).length);
  say("foreign-images", all("img").filter((image) => !image.src.startsWith("data:image/")).length);
  say("embedded", all("iframe, object, embed, svg, video, audio").length);
  say("pwned", page.title.startsWith("pwned") || document.title.startsWith("pwned"));
  const ids = every.map((each) => each.id).filter((id) => id !== "");
  say("repeated-ids", ids.length - new Set(ids).size);
  say("fetched", view.performance.getEntriesByType("resource")
    .filter((entry) => !entry.name.startsWith("data:")).length);
}

const named = (element) => (element.textContent.trim() || element.getAttribute("aria-label") ||
  Array.from(element.labels ?? [], (label) => label.textContent).join("")).trim() !== "";

function checkNames() {
  say("nameless", all("button, input, output, dialog, [role=toolbar], [role=group]")
    .filter((each) => !named(each) && !each.getAttribute("aria-labelledby")).length);
  say("without-alt", all("img:not(.thumbnail)").filter((image) => image.alt.trim() === "").length);
  say("lang", page.documentElement.lang);
  say("h1", all("h1").length);
}

async function checkModes() {
  const stage = one(".stage", item("moved"));
  const visible = () => ["baseline", "current", "heat"].filter((side) => seen(one(`.${side} .view`, stage))).join();
  say("mode-1", visible());
  const [before, after] = ["baseline", "current"].map((side) => one(`.${side} .view`, stage));
  const apart = () => after.getBoundingClientRect().left - before.getBoundingClientRect().left > 20;
  say("apart-1", apart());
  await press("2");
  say("apart-2", apart());
  say("slider", style(after).clipPath);
  one("#cut").value = "25";
  one("#cut").dispatchEvent(new view.Event("input"));
  say("slider-moved", style(after).clipPath);
  await press("3");
  say("blink-starts-by-itself", one("#play").getAttribute("aria-pressed"));
  say("blink-first", visible());
  await pause(2000);
  say("blink-still", visible());
  await press("f");
  say("blink-flipped", visible());
  await press("b");
  say("blinking", one("#play").getAttribute("aria-pressed"));
  await pause(1500);
  say("blink-changed", one("#shown").value);
  await press("4");
  say("blink-stopped", one("#play").getAttribute("aria-pressed"));
  say("opacity", style(after).opacity);
  one("#opacity").value = "80";
  one("#opacity").dispatchEvent(new view.Event("input"));
  say("opacity-moved", style(after).opacity);
  one("#difference").click();
  say("blend", style(after).mixBlendMode);
  one("#difference").click();
  await press("5");
  say("mode-5", visible());
  say("heat-without", seen(one(".baseline .view", item("resized"))));
  await press("m");
  say("mode-m", view.document.documentElement.dataset.mode);
  one(".modes [data-mode=overlay]").click();
  say("mode-button", one(".modes [aria-pressed=true]").dataset.mode);
  say("link-with-mode", view.location.hash.endsWith(":overlay"));
  await press("1");
}

async function checkZoom() {
  const stage = one(".stage", item("moved"));
  one("h2", item("moved")).focus();
  await press("+");
  say("zoomed", scale(stage));
  say("in-step", transforms(stage).size);
  say("others-zoomed", scale(one(".stage", item("drawn"))));
  const before = shift(stage);
  await press("ArrowRight");
  say("arrow-moves", shift(stage) !== before);
  await press("-");
  await press("0");
  say("fitted", `${scale(stage)} ${shift(stage)}`);
  const box = one(".current .view", stage).getBoundingClientRect();
  const at = (x, y) => ({ clientX: box.left + x * box.width, clientY: box.top + y * box.height });
  const send = (type, id, x, y) => one(".current .view img", stage).dispatchEvent(new view.PointerEvent(type,
    { pointerId: id, bubbles: true, button: 0, pointerType: "touch", ...at(x, y) }));
  one(".current .view", stage).dispatchEvent(new view.WheelEvent("wheel",
    { deltaY: -200, ctrlKey: true, bubbles: true, cancelable: true, ...at(0.5, 0.5) }));
  say("wheel-zooms", Number(scale(stage)) > 1.5);
  const still = shift(stage);
  send("pointerdown", 1, 0.5, 0.5);
  send("pointermove", 1, 0.4, 0.4);
  send("pointerup", 1, 0.4, 0.4);
  say("drag-moves", shift(stage) !== still && transforms(stage).size === 1);
  one("#fit").click();
  send("pointerdown", 1, 0.4, 0.5);
  send("pointerdown", 2, 0.6, 0.5);
  send("pointermove", 1, 0.2, 0.5);
  send("pointermove", 2, 0.8, 0.5);
  send("pointerup", 1, 0.2, 0.5);
  send("pointerup", 2, 0.8, 0.5);
  say("pinch", Math.abs(Number(scale(stage)) - 3) < 0.1);
  one("#fit").click();
  one("#zoom-in").click();
  say("zoom-button", one("#zoom").value);
  one("#zoom-out").click();
  one(".cluster button", item("moved")).click();
  say("cluster-zooms", Number(scale(stage)) > 1);
  say("cluster-frames", all(".frame", stage).length);
  const marked = one(".current .frame", stage).getBoundingClientRect();
  say("cluster-in-view", marked.left > box.left - 1 && marked.right < box.right + 1);
  one("#fit").click();
}

async function checkSteps() {
  view.location.hash = "";
  await pause();
  const order = all("article.item").map((each) => each.id);
  view.location.hash = `#${order[0]}`;
  await pause();
  await press("j");
  say("next", atHand() === order[1]);
  say("next-focus", page.activeElement === one("h2", page.getElementById(order[1])));
  await press("n");
  say("next-again", atHand() === order[2]);
  await press("k");
  await press("p");
  say("back-to-first", atHand() === order[0]);
  one("#next").click();
  await pause();
  one("#previous").click();
  await pause();
  say("buttons-step", atHand() === order[0]);
  view.location.hash = "#figure-drawn:slider";
  await pause();
  say("deep-link", `${atHand()} ${page.documentElement.dataset.mode}`);
  view.history.back();
  await pause(300);
  say("history", `${atHand() === order[0]} ${page.documentElement.dataset.mode}`);
  const typed = one("#search");
  typed.focus();
  await press("j", typed);
  say("typing-does-not-step", atHand() === order[0]);
  typed.blur();
}

async function checkFilter() {
  const shown = () => all("article.item, .identical li").filter((each) => !each.hidden).map((each) => each.dataset.name).join();
  const chip = (verdict) => one(`.counts [data-verdict="${verdict}"] button`);
  chip("new").click();
  say("filter-one", shown());
  say("filter-said", one(".found").textContent);
  chip("missing").click();
  say("filter-two", shown());
  chip("new").click();
  chip("missing").click();
  const search = one("#search");
  search.value = "SAME-2";
  search.dispatchEvent(new view.Event("input"));
  say("search", shown());
  say("index-follows", all(".index li").filter((each) => !each.hidden).length);
  view.location.hash = "#figure-gone";
  await pause();
  say("link-clears-filter", `${atHand()} ${search.value === ""}`);
}

async function checkApprovals() {
  const texts = [];
  view.URL.createObjectURL = (blob) => { texts.push(blob.text()); return "data:,"; };
  view.HTMLAnchorElement.prototype.click = function () { say("download-name", this.download); };
  say("download-off", one("#download").disabled);
  one("#tick-shown").click();
  say("ticked-all", one("#ticked").value);
  say("tickable", all(".tick input").length);
  one("#untick").click();
  view.location.hash = "#figure-moved";
  await pause();
  await press("a");
  one(".tick input", item("added")).click();
  say("ticked", one("#ticked").value);
  say("command", one("#command").textContent.replaceAll(/\S*\/(?=[ab] )/g, ""));
  one("#download").click();
  say("approvals", JSON.stringify(JSON.parse(await texts[0]).ids) + JSON.parse(await texts[0]).schema.name);
  one("#untick").click();
}

// Articles and the list are in the same order; the thumbnails are of the images on the stages.
async function checkOrder() {
  const names = () => all(".item").map((each) => each.dataset.name).join();
  const listed = () => all(".index bdi").map((each) => each.textContent.trim()).join();
  const first = names();
  const choose = async (order) => {
    one("#order").value = order;
    one("#order").dispatchEvent(new view.Event("change"));
    await pause();
  };
  await choose("name");
  say("by-name", names() === names().split(",").sort().join(",") && listed() === names());
  await choose("share");
  const shares = all(".item").map((each) => Number(each.dataset.share));
  say("by-share", shares.every((share, i) => i === 0 || share <= shares[i - 1]) && shares[0] > 0);
  await choose("verdict");
  say("by-verdict", names() === first && listed() === first);
  say("thumbnails", all(".index .thumbnail").filter((image) => image.naturalWidth > 0).length);
}

async function checkHelp() {
  await press("?");
  say("help", one("#keys").open);
  one("#close-keys").click();
  say("help-closed", !one("#keys").open);
}

function luminance(colour) {
  const linear = (value) => value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4;
  const [r, g, b] = colour.match(/[\d.]+/g).map((value) => linear(Number(value) / 255));
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

function backgroundOf(element) {
  for (let each = element; each; each = each.parentElement) {
    const colour = style(each).backgroundColor;
    if (colour !== "rgba(0, 0, 0, 0)" && colour !== "transparent") return colour;
  }
  return "rgb(255, 255, 255)";
}

function leastContrast() {
  let least = 21;
  for (const element of all("body *:not(script, dialog, dialog *)")) {
    const own = Array.from(element.childNodes).some(
      (node) => node.nodeType === Node.TEXT_NODE && node.data.trim() !== "");
    if (!own) continue;
    const [text, behind] = [luminance(style(element).color), luminance(backgroundOf(element))];
    least = Math.min(least, (Math.max(text, behind) + 0.05) / (Math.min(text, behind) + 0.05));
  }
  return least.toFixed(2);
}

function checkLooks() {
  say("light-contrast", leastContrast());
  one("button.theme").click();
  say("dark-contrast", leastContrast());
  for (const width of [390, 768, 1400]) {
    frame.style.width = `${width}px`;
    say(`overflow-${width}`, page.documentElement.scrollWidth - width);
  }
}

// Without its script the page shows all images and tables.
function checkBare() {
  say("bare-images", all("img").filter((image) => seen(image) && image.offsetWidth > 20).length);
  say("bare-tables", all("table").filter(seen).length);
  say("bare-controls", all("button, input").filter(seen).length);
}

async function check(expected) {
  checkTexts(expected);
  checkTraps();
  checkNames();
  if (!page.documentElement.classList.contains("scripted")) return checkBare();
  say("start", `${atHand()} ${page.documentElement.dataset.mode}`);
  if (view.location.hash !== "") return null;
  if (item("moved")) {
    item("moved").scrollIntoView();
    await pause(200);
    view.location.hash = "#figure-moved";
    await pause();
    for (const each of [checkModes, checkZoom, checkSteps, checkFilter, checkOrder, checkApprovals]) await each();
  }
  await checkHelp();
  checkLooks();
  return null;
}

window.addEventListener("load", async () => {
  frame = document.querySelector("iframe");
  page = frame.contentDocument;
  view = frame.contentWindow;
  try {
    await check(JSON.parse(document.querySelector("#expected").textContent));
    say("done", true);
  } catch (error) {
    say("error", `${error.message} ${error.stack}`.replaceAll("\n", " "));
  }
  frame.remove();
  document.querySelector("#findings").textContent = findings.join("\n");
});
