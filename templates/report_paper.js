// On paper the title of a drawing is text above it, as wide as the page: drawn, it would take two
// lines and more of the height, and two figures would not stand on one page.

// The part of a drawing below its title and its notes, without what is empty at its foot; null where
// they are not at its head.
function belowTitle(svg, parts) {
  const heads = parts.rest.filter((part) => /^(title|note)$/.test(kindOf(part)));
  const feet = heads.map((part) => part.getBBox()).map(({ y, height }) => y + height);
  const kGap = 3, top = Math.max(...feet) + kGap;
  const { x, y, width, height } = parts.whole;
  const ends = [...svg.querySelectorAll(":scope > g")].map((part) => {
    const box = part.getBBox();
    return box.y + box.height + shiftOf(part).y;
  });
  const end = Math.min(y + height, Math.max(...ends) + kGap);
  const isHead = heads.length > 0 && top > y && parts.frames.every((frame) => frame.y >= top);
  return isHead ? { heads, box: { x, y: top, width, height: end - top } } : null;
}

const kPaperDrawing_px = 582;  // 154 mm.
const kMostDrawn_px = 340;  // With its heading two fifths of a page: so much can be left empty.

// Where the rows of panels begin, below the first one: above the titles of their panels.
function rowTops(parts) {
  const rows = [], kAboveFrame = 5;  // The upper half of a tick's label.
  for (const [i, frame] of parts.frames.entries()) {
    const title = (parts.panels[i] ?? []).find((part) => kindOf(part) === "panel-title");
    const top = title ? title.getBBox().y - 1 : frame.y - kAboveFrame;
    const row = rows.find(({ middle, bottom }) => frame.y < bottom && middle < frame.bottom);
    if (!row) rows.push({ middle: frame.y + frame.height / 2, top, bottom: frame.bottom });
    else {
      row.top = Math.min(row.top, top);
      row.bottom = Math.max(row.bottom, frame.bottom);
    }
  }
  return rows.map(({ top }) => top).sort((a, b) => a - b).slice(1);
}

// What stands below all frames, as a legend: it moves with them.
function partsBelow(parts) {
  const bottom = Math.max(...parts.frames.map((frame) => frame.bottom));
  return parts.rest.filter((part) => part.getBBox().y >= bottom);
}

// Makes the frames of one row lower by up to `excess`, maps and images also narrower, as far as all
// words keep their room. Returns what undoes it.
function lowerRow(svg, parts, excess) {
  const rooms = parts.panels.length > 0 && rowTops(parts).length === 0 ? roomsOf(svg, parts) : null;
  if (!rooms || excess <= 0) return () => {};
  const greatest = (name) => Math.max(...parts.frames.map((frame) => frame[name]));
  const width = greatest("width"), height = greatest("height"), below = partsBelow(parts);
  const bottom = greatest("bottom"), kMostLower = .3;
  const undo = () => {
    widenFrames(svg, parts);
    movePanel(below, kNoShift);
  };
  for (const share of [1, .75, .5, .25]) {
    const lower = height - share * Math.min(excess, kMostLower * height);
    const hasMaps = parts.frames.some((frame, i) => hasOneScale(parts.panels[i], frame));
    const most = hasMaps ? width * lower / height + rooms.left + rooms.right : Infinity;
    narrowFrames(svg, parts, rooms, most, lower);
    const isWhole = widths.get(svg).attributes.every(([, name]) => name !== "display");
    movePanel(below, { x: 0, y: greatest("bottom") - bottom });
    if (isWhole) return undo;
    undo();
  }
  return () => {};
}

// The box of a drawing in slices of whole rows of panels, about as high as each other.
function slicesOf(parts, box, width_px) {
  const count = Math.ceil(box.height * width_px / box.width / kMostDrawn_px);
  const ends = [], tops = rowTops(parts);
  for (let i = 1; i < count; ++i) {
    const middle = box.y + i * box.height / count;
    const nearest = tops.filter((top) => !ends.includes(top))
      .sort((a, b) => Math.abs(a - middle) - Math.abs(b - middle))[0];
    if (nearest !== undefined) ends.push(nearest);
  }
  const edges = [box.y, ...ends.sort((a, b) => a - b), box.y + box.height];
  return edges.slice(1).map((end, i) => ({ ...box, y: edges[i], height: end - edges[i] }));
}

// Shows a part of a drawing in place of all of it.
function showOnPaper(svg, box, width_px) {
  setViewBox(svg, box);
  svg.parentElement.style.setProperty("--paper-ratio", box.width / box.height);
  svg.parentElement.style.setProperty("--paper-width", `${width_px}px`);
}

// Shows a drawing in slices that may stand on two pages, each a copy below the one before it.
function showSlices(svg, slices, width_px) {
  const [first, ...others] = slices;
  let last = svg.parentElement;
  for (const box of others) {
    const copy = svg.parentElement.cloneNode(false);
    copy.classList.add("slice");
    copy.append(svg.cloneNode(true));
    last.after(copy);
    showOnPaper(copy.firstElementChild, box, width_px);
    last = copy;
  }
  showOnPaper(svg, first, width_px);
  svg.closest("figure")?.classList.toggle("sliced", others.length > 0);
}

function setTitleAsText(svg) {
  const drawing = svg.parentElement;
  if (drawing.matches(".stacked, .stepped, .zoomed")) return () => {};
  const parts = partsOf(svg), shown = svg.getAttribute("viewBox"), drawn = belowTitle(svg, parts);
  if (!drawn) return () => {};
  addDrawnTitle(svg, parts);
  // The smallest words have 8 pt: a wider drawing would take the room of a second one.
  const words_px = kPaperWords_px / leastWords(svg) * drawn.box.width;
  const width_px = Math.min(words_px > 0 ? words_px : kPaperDrawing_px, kPaper_px);
  const widen = lowerRow(svg, parts,
    drawn.box.height - kMostDrawn_px * drawn.box.width / width_px);
  const below = belowTitle(svg, parts);
  for (const part of below.heads) part.classList.add("off");
  showSlices(svg, slicesOf(parts, below.box, width_px), width_px);
  return () => {
    widen();
    for (const copy of drawing.parentElement.querySelectorAll(".slice")) copy.remove();
    svg.closest("figure")?.classList.remove("sliced");
    for (const part of below.heads) part.classList.remove("off");
    svg.setAttribute("viewBox", shown);
    for (const name of ["--paper-ratio", "--paper-width"]) drawing.style.removeProperty(name);
    drawing.parentElement.querySelector(".drawn-title")?.remove();
  };
}

function setTitlesOnPaper() {
  let undo = [];
  addEventListener("beforeprint", () => {
    for (const each of undo) each();
    undo = [...document.querySelectorAll(".drawing > svg")].map(setTitleAsText);
  });
  addEventListener("afterprint", () => {
    for (const each of undo) each();
    undo = [];
  });
}
