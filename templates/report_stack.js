// On a narrow page the panels of a drawing stand one below the other, or as many side by side as
// have words of a readable size; those that are too wide get narrower (see report_narrow.js). The
// heading is text of the page, and legends are below (see report_stack_legend.js).

const kLeastWords_px = 10, kUnitsOfFont = 2048;
const narrowPage = matchMedia("(max-width: 36rem)");

// The size of the smallest words of a drawing, in its units.
function leastWords(svg) {
  const sizes = [...svg.querySelectorAll('g[transform*="scale("]')].map(
    (words) => kUnitsOfFont * Number(/scale\(([\d.]+)/.exec(words.getAttribute("transform"))[1]));
  return Math.min(...sizes.filter((size) => size > 0));
}

// The words of the parts of those kinds, each once, however many lines they take.
function wordsOfParts(parts, kinds) {
  return [...new Set(parts.rest.filter((part) => kinds.includes(kindOf(part)))
    .flatMap((part) => [...part.children].map((line) => line.dataset.words)))];
}

// The heading and the notes of a drawing as text of the page, above it.
function addDrawnTitle(svg, parts) {
  const title = document.createElement("p");
  title.className = "drawn-title";
  title.setAttribute("aria-hidden", "true");  // The drawing has it as its name.
  title.textContent = wordsOfParts(parts, ["title", "note"]).join(" \u00b7 ");
  svg.parentElement.before(title);
}

// The width, in units of a drawing, of the widest one whose words can be read in a box of that width.
function mostWidth(svg, width_px) {
  return width_px * leastWords(svg) / kLeastWords_px;
}

// Whether the words of a drawing could not be read in a box of that width.
function isTooWide(svg, parts, width_px) {
  return parts.whole.width > mostWidth(svg, width_px);
}

// Of height: in lower frames marks of single runs hide each other, and two of these with their axes and
// a legend are on the first screen of a phone.
const kLeastFrame_px = 115;

// How the panels are arranged in a box of that width, and if they can be in one of that height; null
// if they are to stay as they are drawn. Where the height is limited, frames take the whole width, but
// those of maps and images, and are lower only if they are drawn so than kLeastFrame_px.
function arrangementOf(svg, parts, width_px, height_px = Infinity) {
  if (parts.panels.length === 0 || !(width_px > 0)) return null;
  if (!isTooWide(svg, parts, width_px)) return null;
  const most = mostWidth(svg, width_px), rooms = roomsOf(svg, parts);
  if (!rooms) return null;
  const greatest = (name) => Math.max(...parts.frames.map((frame) => frame[name]));
  const around = { width: rooms.left + rooms.right, height: rooms.above + rooms.below };
  if (most <= around.width) return null;  // No room for a frame.
  const drawn = Math.min(most, greatest("width") + around.width);
  const columns = Math.max(1, Math.min(parts.panels.length, Math.floor(most / drawn)));
  const rows = Math.ceil(parts.panels.length / columns);
  const isStretched = height_px < Infinity &&
    !parts.panels.some((panel, i) => hasOneScale(panel, parts.frames[i]));
  const width = isStretched ? most / columns : drawn;
  const kLegend_px = 60, perPixel = columns * width / width_px;
  const height = Math.max((height_px - kLegend_px) * perPixel / rows - around.height,
    kLeastFrame_px * perPixel);
  if (isStretched) narrowFrames(svg, parts, rooms, width, height, width);
  else if (greatest("width") + around.width > most || greatest("height") > height) {
    narrowFrames(svg, parts, rooms, most, height);
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
  restoreLegend(svg);
  svg.parentElement.classList.remove("stacked", "stepped");
  for (const panel of [...parts.panels, parts.rest]) movePanel(panel, kNoShift);
}

// Returns the box of the drawing that holds all.
function stack(svg, parts, { rooms, columns, width }) {
  const layers = [], { own, shared } = legendsOf(svg, parts, columns === 1);
  // Before legends are placed, which takes away what they copy.
  for (const part of parts.rest) {
    part.classList.toggle("off", !/^legend-(sample|text)$/.test(kindOf(part)));
  }
  let top = 0;
  parts.frames.forEach((frame, i) => {
    const row = parts.frames.slice(i - i % columns, i - i % columns + columns);
    const height = rooms.above + Math.max(...row.map((one) => one.height)) + rooms.below;
    const shift = { x: (i % columns) * width + rooms.left - frame.x, y: top + rooms.above - frame.y };
    layers.push(sharedAxes(svg, parts, i, shift));
    movePanel(parts.panels[i], shift);
    if (own[i].length > 0) top = placeEntries(svg, own[i], width, top + height + 4, layers);
    else if (i % columns === columns - 1 || i + 1 === parts.frames.length) top += height;
  });
  for (const label of parts.axes) label.parentElement.classList.add("off");
  const foot = placeEntries(svg, shared, columns * width, top + 4, layers);
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
  if (arrangement) {
    addDrawnTitle(svg, parts);
    setHome(svg, fillWidth(svg, stack(svg, parts, arrangement)));
  } else if (narrowPage.matches && isTooWide(svg, parts, svg.parentElement.clientWidth)) {
    // The box is moved sideways, its heading is not.
    const below = belowTitle(svg, parts);
    if (!below) return;
    addDrawnTitle(svg, parts);
    for (const part of below.heads) part.classList.add("off");
    setHome(svg, below.box);
  }
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
