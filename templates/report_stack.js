// On a narrow page the panels of a drawing stand one below the other, or as many side by side as
// have words of a readable size; those that are too wide get narrower (see report_narrow.js). The
// heading is text of the page, the legend is below.

const kLeastWords_px = 10;
const narrowPage = matchMedia("(max-width: 36rem)");

// The size of the smallest words of a drawing, in its units.
function leastWords(svg) {
  const kUnitsOfFont = 2048;
  const sizes = [...svg.querySelectorAll('g[transform*="scale("]')].map(
    (words) => kUnitsOfFont * Number(/scale\(([\d.]+)/.exec(words.getAttribute("transform"))[1]));
  return Math.min(...sizes.filter((size) => size > 0));
}

// A sample of the legend with its words, or several samples before one text.
function legendEntries(parts) {
  const entries = [];
  let isOpen = false;
  for (const part of parts.rest.filter((each) => /^legend-(sample|text)$/.test(kindOf(each)))) {
    const isText = part.classList.contains("legend-text");
    if (!isOpen) entries.push([]);
    entries.at(-1).push(part);
    isOpen = !isText;
  }
  return entries;
}

function boxOfAll(svg, parts) {
  const boxes = parts.map((part) => boxIn(svg, part));
  const x = Math.min(...boxes.map((box) => box.x)), y = Math.min(...boxes.map((box) => box.y));
  return { x, y, width: Math.max(...boxes.map((box) => box.x + box.width)) - x,
    height: Math.max(...boxes.map((box) => box.y + box.height)) - y };
}

// Puts the entries of the legend in lines from `top` on. Returns their foot.
function placeLegend(svg, parts, width, top) {
  const kGap = 14;
  let x = 6, foot = top, lineTop = top;
  for (const entry of legendEntries(parts)) {
    const box = boxOfAll(svg, entry);
    if (x > 6 && x + box.width > width - 6) {
      x = 6;
      lineTop = foot + 4;
    }
    movePanel(entry, { x: x - box.x, y: lineTop - box.y });
    x += box.width + kGap;
    foot = Math.max(foot, lineTop + box.height);
  }
  return foot + 8;
}

// The heading and the notes of a drawing as text of the page, above it.
function addDrawnTitle(svg, parts) {
  const lines = parts.rest.filter((part) => /^(title|note)$/.test(kindOf(part)))
    .flatMap((part) => [...part.children].map((line) => line.dataset.words));
  const title = document.createElement("p");
  title.className = "drawn-title";
  title.setAttribute("aria-hidden", "true");  // The drawing has it as its name.
  title.textContent = [...new Set(lines)].join(" \u00b7 ");
  svg.parentElement.before(title);
}

// How the panels are arranged in a box of that width, and if they can be in one of that height; null
// if they are to stay as they are drawn.
function arrangementOf(svg, parts, width_px, height_px = Infinity) {
  if (parts.panels.length === 0 || !(width_px > 0)) return null;
  const most = width_px * leastWords(svg) / kLeastWords_px;
  if (parts.whole.width <= most) return null;
  const rooms = roomsOf(svg, parts);
  if (!rooms) return null;
  const greatest = (name) => Math.max(...parts.frames.map((frame) => frame[name]));
  const around = { width: rooms.left + rooms.right, height: rooms.above + rooms.below };
  const width = Math.min(most, greatest("width") + around.width);
  const columns = Math.max(1, Math.min(parts.panels.length, Math.floor(most / width)));
  const rows = Math.ceil(parts.panels.length / columns);
  const kLegend_px = 60;
  const row = (height_px - kLegend_px) * columns * width / width_px / rows;
  if (greatest("width") + around.width > most || greatest("height") + around.height > row) {
    narrowFrames(svg, parts, rooms, most, row - around.height);
  }
  return { rooms, columns, width, height: greatest("height") + around.height };
}

// Makes the drawing as wide as its box, in place of a box to be moved sideways.
function fillWidth(svg, box) {
  svg.parentElement.classList.add("stacked");
  svg.parentElement.style.setProperty("--stack", box.width / box.height);
  return box;
}

function unstack(svg, parts) {
  for (const layer of svg.querySelectorAll(":scope > .step-axes")) layer.remove();
  svg.parentElement.parentElement.querySelector(".drawn-title")?.remove();
  svg.parentElement.classList.remove("stacked", "stepped");
  for (const panel of [...parts.panels, parts.rest]) movePanel(panel, kNoShift);
}

// Returns the box of the drawing that holds all.
function stack(svg, parts, { rooms, columns, width, height }) {
  const layers = [];
  parts.frames.forEach((frame, i) => {
    const left = (i % columns) * width + rooms.left, top = Math.floor(i / columns) * height +
      rooms.above;
    const shift = { x: left - frame.x, y: top - frame.y };
    layers.push(sharedAxes(svg, parts, i, shift));
    movePanel(parts.panels[i], shift);
  });
  for (const label of parts.axes) label.parentElement.classList.add("off");
  const rows = Math.ceil(parts.frames.length / columns);
  const foot = placeLegend(svg, parts, columns * width, rows * height + 4);
  for (const part of parts.rest) {
    const isLegend = /^legend-(sample|text)$/.test(kindOf(part));
    part.classList.toggle("off", !isLegend);
  }
  svg.append(...layers);
  return { x: 0, y: 0, width: columns * width, height: foot };
}

// Shows the whole drawing: as it was drawn, or on a narrow page with its panels in a column.
function showWhole(svg, whole) {
  const parts = partsOf(svg);
  unstack(svg, parts);
  for (const part of [...parts.panels.flat(), ...parts.rest,
    ...parts.axes.map((label) => label.parentElement)]) part.classList.remove("off");
  setHome(svg, whole);
  const wasNarrow = widths.has(svg);
  widenFrames(svg, parts);
  const arrangement = narrowPage.matches
    ? arrangementOf(svg, parts, svg.parentElement.clientWidth) : null;
  if (zoomedParts.has(svg) && (wasNarrow || widths.has(svg))) {
    zoomedParts.set(svg, readZoomedParts(svg));
  }
  if (!arrangement) return;
  addDrawnTitle(svg, parts);
  setHome(svg, fillWidth(svg, stack(svg, parts, arrangement)));
}

// A drawing is arranged again whenever its box has another width, as when a phone is turned.
function stackOnNarrowPages(figure, svg) {
  const { whole } = partsOf(svg), box = svg.parentElement;
  let width = 0, wasNarrow = false;
  const show = () => {
    const isNarrow = narrowPage.matches;
    if (box.clientWidth === 0 || (box.clientWidth === width && isNarrow === wasNarrow)) return;
    const isOther = isNarrow || wasNarrow;
    width = box.clientWidth;
    wasNarrow = isNarrow;
    const slider = figure.querySelector(".step input");
    if (!isOther) return;
    if (Number(slider?.value ?? 0) === 0) showWhole(svg, whole);
    else slider.dispatchEvent(new Event("input"));
  };
  show();
  new ResizeObserver(show).observe(box);
}
