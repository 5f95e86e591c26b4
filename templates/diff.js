// A comparison: modes, zoom, keyboard, filter, approvals. Nothing here makes markup of a text.
const root = document.documentElement;
const main = document.querySelector("main");
const items = Array.from(document.querySelectorAll("article.item"));
const modes = ["side", "slider", "blink", "overlay", "heat"];
const by = (id) => document.getElementById(id);
let atHand = items[0] ?? null;
let blinking = null;

const shown = (element) => !element.hidden;
const entryOf = new Map(Array.from(document.querySelectorAll(".index li"),
  (entry) => [entry.querySelector("a").getAttribute("href").slice(1), entry]));

// ---- Zoom: one view a stage, so that all of its pictures move in step.

const mostZoom = 64;
const views = new Map();
const clamp = (value, low, high) => Math.min(high, Math.max(low, value));

function viewOf(stage) {
  if (!views.has(stage)) views.set(stage, { zoom: 1, x: 0, y: 0 });
  return views.get(stage);
}

const stageAtHand = () => atHand?.querySelector(".stage") ?? null;

function largestSize(stage) {
  const images = Array.from(stage.querySelectorAll("img"));
  const side = (name, natural) => Math.max(1, ...images.map((image) =>
    image[natural] || Number(image.getAttribute(name)) || 0));
  return { width: side("width", "naturalWidth"), height: side("height", "naturalHeight") };
}

// Every picture at one scale, so that a difference of size is seen as one.
function arrange(stage) {
  const size = largestSize(stage);
  stage.style.setProperty("--ratio", size.width / size.height);
  for (const image of stage.querySelectorAll("img")) {
    const width = image.naturalWidth || Number(image.getAttribute("width")) || size.width;
    image.style.width = `${100 * width / size.width}%`;
  }
}

function applyView(stage) {
  const view = viewOf(stage);
  view.zoom = clamp(view.zoom, 1, mostZoom);
  view.x = clamp(view.x, 1 - view.zoom, 0);
  view.y = clamp(view.y, 1 - view.zoom, 0);
  for (const name of ["zoom", "x", "y"]) stage.style.setProperty(`--${name}`, view[name]);
  stage.classList.toggle("zoomed", view.zoom > 1);
  const canvas = stage.querySelector(".canvas");
  const magnified = view.zoom * canvas.offsetWidth / largestSize(stage).width;
  stage.classList.toggle("pixels", stage.dataset.format === "png" && magnified > 2.5);
  if (stage === stageAtHand()) by("zoom").value = `${Math.round(100 * view.zoom)} %`;
}

// Keeps the point (x, y), in shares of the unmoved picture, where it is.
function zoomBy(stage, factor, x = 0.5, y = 0.5) {
  const view = viewOf(stage);
  const zoom = clamp(view.zoom * factor, 1, mostZoom);
  view.x = x - (x - view.x) * zoom / view.zoom;
  view.y = y - (y - view.y) * zoom / view.zoom;
  view.zoom = zoom;
  applyView(stage);
}

function moveBy(stage, x, y) {
  const view = viewOf(stage);
  view.x += x;
  view.y += y;
  applyView(stage);
}

function fit(stage) {
  Object.assign(viewOf(stage), { zoom: 1, x: 0, y: 0 });
  for (const marks of stage.querySelectorAll(".marks")) marks.remove();
  applyView(stage);
}

// Shows a box of pixels at the middle, with a frame around it.
function showBox(stage, [x, y, width, height]) {
  const size = largestSize(stage);
  const zoom = clamp(0.4 / Math.max(width / size.width, height / size.height), 1, 24);
  fit(stage);
  const shares = {
    left: x / size.width, top: y / size.height,
    width: width / size.width, height: height / size.height,
  };
  for (const view of stage.querySelectorAll(".view")) {
    const marks = document.createElement("div");
    marks.className = "marks";
    const frame = document.createElement("span");
    frame.className = "frame";
    for (const [name, share] of Object.entries(shares)) frame.style.setProperty(`--${name}`, share);
    marks.append(frame);
    view.append(marks);
  }
  Object.assign(viewOf(stage), {
    zoom,
    x: 0.5 - zoom * (x + width / 2) / size.width,
    y: 0.5 - zoom * (y + height / 2) / size.height,
  });
  applyView(stage);
}

// Where a pointer is, in shares of the unmoved picture under it.
function place(event, view) {
  const canvas = view.querySelector(".canvas");
  const box = view.getBoundingClientRect();
  return {
    x: (event.clientX - box.left - view.clientLeft - canvas.offsetLeft) / canvas.offsetWidth,
    y: (event.clientY - box.top - view.clientTop - canvas.offsetTop) / canvas.offsetHeight,
  };
}

// Drag moves, two fingers zoom, a wheel zooms where it was clicked before or with Ctrl.
function followPointers(stage) {
  const pointers = new Map();
  const spread = (points) => Math.hypot(points[0].x - points[1].x, points[0].y - points[1].y);
  const middle = (points, axis) => (points[0][axis] + points[1][axis]) / 2;

  stage.addEventListener("pointerdown", (event) => {
    const view = event.target.closest(".view");
    if (!view || event.button !== 0) return;
    setAtHand(stage.closest("article"));
    stage.focus({ preventScroll: true });
    pointers.set(event.pointerId, place(event, view));
    if (event.pointerType === "mouse") event.preventDefault();
    try { view.setPointerCapture(event.pointerId); } catch { /* a pointer that is gone */ }
  });
  stage.addEventListener("pointermove", (event) => {
    const view = event.target.closest(".view");
    if (!view || !pointers.has(event.pointerId)) return;
    const before = Array.from(pointers.values());
    const from = pointers.get(event.pointerId);
    const to = place(event, view);
    pointers.set(event.pointerId, to);
    if (pointers.size === 1) moveBy(stage, to.x - from.x, to.y - from.y);
    if (pointers.size !== 2) return;
    const after = Array.from(pointers.values());
    moveBy(stage, middle(after, "x") - middle(before, "x"), middle(after, "y") - middle(before, "y"));
    const factor = spread(after) / Math.max(1e-6, spread(before));
    zoomBy(stage, factor, middle(after, "x"), middle(after, "y"));
  });
  for (const name of ["pointerup", "pointercancel"]) {
    stage.addEventListener(name, (event) => pointers.delete(event.pointerId));
  }
  stage.addEventListener("touchmove", (event) => {
    if (event.touches.length > 1 || viewOf(stage).zoom > 1) event.preventDefault();
  }, { passive: false });
  stage.addEventListener("wheel", (event) => {
    const view = event.target.closest(".view");
    if (!view || !(event.ctrlKey || stage.contains(document.activeElement))) return;
    event.preventDefault();
    const at = place(event, view);
    zoomBy(stage, Math.exp(-clamp(event.deltaY, -200, 200) / 250), at.x, at.y);
  }, { passive: false });
  stage.addEventListener("dragstart", (event) => event.preventDefault());
}

// The line between the two of the slider.
function addDivider(stage) {
  const view = stage.querySelector(".baseline .view");
  if (!view || !stage.classList.contains("both")) return;
  const divider = document.createElement("div");
  divider.className = "divider";
  divider.setAttribute("aria-hidden", "true");
  divider.addEventListener("pointerdown", (event) => {
    divider.setPointerCapture(event.pointerId);
    event.stopPropagation();
    event.preventDefault();
  });
  divider.addEventListener("pointermove", (event) => {
    if (!divider.hasPointerCapture(event.pointerId)) return;
    const box = view.getBoundingClientRect();
    setCut(100 * (event.clientX - box.left) / box.width);
  });
  stage.append(divider);
}

// ---- Modes

function setCut(percent) {
  by("cut").value = clamp(percent, 0, 100);
  root.style.setProperty("--cut", `${by("cut").value}%`);
}

function setShown(side) {
  root.dataset.shown = side;
  by("shown").value = side;
}

const flip = () => setShown(root.dataset.shown === "baseline" ? "current" : "baseline");

// Never by itself: only a button or a key starts it, and 0.7 flips a second are no flashing.
function setBlinking(on) {
  clearInterval(blinking);
  blinking = on ? setInterval(flip, 1400) : null;
  by("play").setAttribute("aria-pressed", String(on));
  by("play").textContent = on ? "Stop" : "Blink";
}

function setMode(mode) {
  root.dataset.mode = mode;
  for (const button of document.querySelectorAll(".modes button")) {
    button.setAttribute("aria-pressed", String(button.dataset.mode === mode));
  }
  for (const tools of document.querySelectorAll("[data-for]")) tools.hidden = tools.dataset.for !== mode;
  if (mode !== "blink") setBlinking(false);
  if (stageAtHand()) applyView(stageAtHand());
}

function chooseMode(mode) {
  setMode(mode);
  if (atHand) history.replaceState(null, "", `#${linkTo(atHand)}`);
}

const nextMode = () => chooseMode(modes[(modes.indexOf(root.dataset.mode) + 1) % modes.length]);

// ---- The item at hand, and links to it

const linkTo = (item) => item.id + (root.dataset.mode === "side" ? "" : `:${root.dataset.mode}`);

function setAtHand(item) {
  if (!item || item === atHand && item.classList.contains("at-hand")) return;
  atHand?.classList.remove("at-hand");
  entryOf.get(atHand?.id)?.querySelector("a").removeAttribute("aria-current");
  atHand = item;
  item.classList.add("at-hand");
  const link = entryOf.get(item.id)?.querySelector("a");
  link?.setAttribute("aria-current", "true");
  link?.scrollIntoView({ block: "nearest" });
  const stage = item.querySelector(".stage");
  by("zoom").value = `${Math.round(100 * (stage ? viewOf(stage).zoom : 1))} %`;
}

let held = false;  // Scrolling by a program says nothing about what is read.

function show(item) {
  if (!shown(item)) clearFilter();
  if (item.matches("article")) setAtHand(item);
  held = true;
  item.scrollIntoView({ block: "start" });
  // What lies above is laid out only now, and may have another height than was guessed.
  requestAnimationFrame(() => item.scrollIntoView({ block: "start" }));
  (item.querySelector("h2") ?? item).focus({ preventScroll: true });
}

function followHash() {
  const [anchor, mode] = location.hash.slice(1).split(":");
  const item = anchor === "" ? null : by(anchor);
  if (!item?.matches("article.item, .identical li")) return;
  if (items.length > 0) setMode(modes.includes(mode) ? mode : "side");
  show(item);
}

function step(count) {
  const visible = items.filter(shown);
  const at = visible.indexOf(atHand);
  // From above the first item, "next" is the first one.
  const above = count > 0 && at === 0 && location.hash === "" && !held;
  const target = at < 0 || above ? visible[0] : visible[at + count];
  if (!target) return;
  const hash = `#${linkTo(target)}`;
  if (location.hash === hash) show(target);
  else location.hash = hash;
}

function followReading() {
  for (const name of ["wheel", "touchmove", "pointerdown"]) {
    addEventListener(name, () => { held = false; }, { passive: true });
  }
  const observer = new IntersectionObserver((entries) => {
    if (held) return;
    const read = entries.find((entry) => entry.isIntersecting);
    if (read) setAtHand(read.target);
  }, { rootMargin: "-20% 0px -75% 0px" });
  for (const item of items) observer.observe(item);
}

// ---- Filter by verdict, search by id

const wanted = new Set();

function applyFilter() {
  const words = by("search").value.trim().toLowerCase();
  const fits = (element) => (wanted.size === 0 || wanted.has(element.dataset.verdict)) &&
    element.dataset.name.toLowerCase().includes(words);
  const entries = document.querySelectorAll(".item, .index li, .identical li");
  for (const element of entries) element.hidden = !fits(element);
  const all = document.querySelectorAll(".item, .identical li");
  const count = Array.from(all).filter(shown).length;
  document.querySelector(".found").textContent = count === all.length ? "" : `${count} of ${all.length} shown`;
  const identical = by("identical");
  if (identical) identical.hidden = !identical.querySelector("li:not([hidden])");
  if (atHand && !shown(atHand)) {
    const first = items.find(shown);
    if (first) setAtHand(first);
  }
}

function clearFilter() {
  wanted.clear();
  by("search").value = "";
  for (const chip of document.querySelectorAll(".counts button")) chip.setAttribute("aria-pressed", "false");
  applyFilter();
}

function makeChips() {
  for (const entry of document.querySelectorAll(".counts li")) {
    const button = document.createElement("button");
    const verdict = entry.dataset.verdict;
    button.type = "button";
    button.setAttribute("aria-pressed", "false");
    button.append(...entry.querySelector(".chip").childNodes);
    button.addEventListener("click", () => {
      if (!wanted.delete(verdict)) wanted.add(verdict);
      button.setAttribute("aria-pressed", String(wanted.has(verdict)));
      applyFilter();
    });
    entry.replaceChildren(button);
  }
}

// ---- Approvals

// Names travel byte by byte; one that is no UTF-8 cannot stand in a file of JSON.
function decoded(text) {
  try {
    return decodeURIComponent(text);
  } catch {
    return null;
  }
}

// One word of a POSIX shell; control characters, which a terminal might act on, by $'…'.
function quoted(word) {
  if (/^[A-Za-z0-9_.\/=,:+@%-]+$/.test(word)) return word;
  if (!/[\u0000-\u001f\u007f-\u009f]/.test(word)) return `'${word.replaceAll("'", "'\\''")}'`;
  const bytes = Array.from(new TextEncoder().encode(word), (byte) =>
    byte >= 0x20 && byte < 0x7f && byte !== 0x27 && byte !== 0x5c ? String.fromCharCode(byte)
      : `\\${byte.toString(8).padStart(3, "0")}`);
  return `$'${bytes.join("")}'`;
}

// A folder whose name looks like an option.
const path = (text) => quoted(text.startsWith("-") ? `./${text}` : text);

const tickOf = (item) => item.querySelector(".tick input");
const tickedItems = () => items.filter((item) => tickOf(item)?.checked);

function command() {
  const ids = tickedItems().map((item) => decoded(item.dataset.code));
  const sides = [main.dataset.baseline, main.dataset.current].map(decoded);
  if (sides.includes(null)) return "";
  const words = ["mapproof approve", ...sides.map(path)];
  if ("files" in main.dataset) return words.join(" ");
  if (ids.length > 20) return [...words, "--from mapproof-approvals.json"].join(" ");
  const dashed = ids.some((id) => id.startsWith("-"));
  return [...words, ...(dashed ? ["--"] : []), ...ids.map(quoted)].join(" ");
}

function tellTicks() {
  const count = tickedItems().length;
  by("ticked").value = String(count);
  document.querySelector(".approvals").hidden = items.every((item) => !tickOf(item));
  by("download").hidden = "files" in main.dataset;
  for (const id of ["download", "copy", "untick"]) by(id).disabled = count === 0;
  by("command").textContent = count === 0 ? "" : command();
  by("command").hidden = by("command").textContent === "";
  document.querySelector(".approvals").classList.toggle("some", count > 0);
  by("told").textContent = "";
}

function approvals() {
  return JSON.stringify({
    schema: { name: "mapproof.approvals", version: 1 },
    baseline: decoded(main.dataset.baseline) ?? "",
    current: decoded(main.dataset.current) ?? "",
    ids: tickedItems().map((item) => decoded(item.dataset.code)),
  }, null, 2) + "\n";
}

function download() {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([approvals()], { type: "application/json" }));
  link.download = "mapproof-approvals.json";
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  by("told").textContent = "Then: mapproof approve BASELINE CURRENT --from mapproof-approvals.json";
}

async function copy() {
  try {
    await navigator.clipboard.writeText(by("command").textContent);
    by("told").textContent = "Copied.";
  } catch {
    getSelection().selectAllChildren(by("command"));
    by("told").textContent = "Selected: press Ctrl+C.";
  }
}

function tickAll(all, value) {
  for (const item of all) if (tickOf(item) && !tickOf(item).disabled) tickOf(item).checked = value;
  tellTicks();
}

function makeTicks() {
  for (const item of items) {
    const tick = tickOf(item);
    if (!tick) continue;
    tick.closest("label").hidden = false;
    tick.disabled = decoded(item.dataset.code) === null;
    if (tick.disabled) tick.title = "Its name is no UTF-8: approve it by hand";
    tick.addEventListener("change", tellTicks);
  }
  by("tick-shown").addEventListener("click", () => tickAll(items.filter(shown), true));
  by("untick").addEventListener("click", () => tickAll(items, false));
  by("download").addEventListener("click", download);
  by("copy").addEventListener("click", copy);
  tellTicks();
}

// ---- Keyboard

function onKey(event) {
  if (event.ctrlKey || event.metaKey || event.altKey || by("keys").open) return;
  const target = event.target;
  if (target.matches?.("input:not([type=checkbox]):not([type=range]), textarea, select")) {
    if (event.key === "Escape") target.blur();
    return;
  }
  const stage = stageAtHand();
  const acts = {
    j: () => step(1), n: () => step(1), k: () => step(-1), p: () => step(-1),
    m: nextMode,
    a: () => tickOf(atHand)?.click(),
    b: () => { if (root.dataset.mode !== "blink") chooseMode("blink"); setBlinking(!blinking); },
    f: () => { if (root.dataset.mode !== "blink") chooseMode("blink"); flip(); },
    "+": () => stage && zoomBy(stage, 1.5), "=": () => stage && zoomBy(stage, 1.5),
    "-": () => stage && zoomBy(stage, 1 / 1.5), 0: () => stage && fit(stage),
    "/": () => by("search").focus(),
    "?": () => by("keys").showModal(),
  };
  modes.forEach((mode, index) => { acts[index + 1] = () => chooseMode(mode); });
  if (stage && viewOf(stage).zoom > 1 && !target.matches?.("input, .scroll, .long, pre")) {
    Object.assign(acts, {
      ArrowLeft: () => moveBy(stage, 0.1, 0), ArrowRight: () => moveBy(stage, -0.1, 0),
      ArrowUp: () => moveBy(stage, 0, 0.1), ArrowDown: () => moveBy(stage, 0, -0.1),
    });
  }
  if (!Object.hasOwn(acts, event.key)) {
    held = held && !["PageDown", "PageUp", "ArrowDown", "ArrowUp", " "].includes(event.key);
    return;
  }
  event.preventDefault();
  acts[event.key]();
}

// ---- Start

function makeStage(stage) {
  stage.tabIndex = 0;
  arrange(stage);
  for (const image of stage.querySelectorAll("img")) {
    image.addEventListener("load", () => arrange(stage));
  }
  followPointers(stage);
  addDivider(stage);
}

function makeClusterButton(cluster) {
  const stage = cluster.closest("article").querySelector(".stage");
  const button = document.createElement("button");
  button.type = "button";
  button.textContent = "Show it";
  button.addEventListener("click", () => {
    setAtHand(cluster.closest("article"));
    showBox(stage, cluster.dataset.box.split(" ").map(Number));
    stage.scrollIntoView({ block: "nearest" });
  });
  cluster.append(button);
}

function makeToolbar() {
  document.querySelector(".toolbar").hidden = false;
  by("previous").addEventListener("click", () => step(-1));
  by("next").addEventListener("click", () => step(1));
  for (const button of document.querySelectorAll(".modes button")) {
    button.addEventListener("click", () => chooseMode(button.dataset.mode));
  }
  const withStage = (act) => () => { if (stageAtHand()) act(stageAtHand()); };
  by("zoom-in").addEventListener("click", withStage((stage) => zoomBy(stage, 1.5)));
  by("zoom-out").addEventListener("click", withStage((stage) => zoomBy(stage, 1 / 1.5)));
  by("fit").addEventListener("click", withStage(fit));
  by("cut").addEventListener("input", () => setCut(Number(by("cut").value)));
  by("opacity").addEventListener("input", () => root.style.setProperty("--opacity", by("opacity").value / 100));
  by("difference").addEventListener("change", () => root.toggleAttribute("data-difference", by("difference").checked));
  by("play").addEventListener("click", () => setBlinking(!blinking));
  by("flip").addEventListener("click", flip);
  by("help").addEventListener("click", () => by("keys").showModal());
}

root.classList.add("scripted");
document.querySelector(".search").hidden = false;
addThemeSwitch(document.querySelector(".masthead"));
for (const table of document.querySelectorAll("main table")) makeSortable(table);
foldOnScreen();
makeChips();
by("search").addEventListener("input", applyFilter);
by("close-keys").addEventListener("click", () => by("keys").close());
if (items.length > 0) {
  makeToolbar();
  for (const stage of document.querySelectorAll(".stage")) makeStage(stage);
  for (const cluster of document.querySelectorAll(".cluster")) makeClusterButton(cluster);
  makeTicks();
  setCut(50);
  setShown("baseline");
  setMode("side");
  setAtHand(items[0]);
  followReading();
  addEventListener("keydown", onKey);
}
addEventListener("hashchange", followHash);
followHash();
