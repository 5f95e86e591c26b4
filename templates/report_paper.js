// On paper the title of a drawing is text above it, as wide as the page: drawn, it would take two
// lines and more of the height, and two figures would not stand on one page.

// The part of a drawing below its title and its notes, without what is empty at its foot; null where
// they are not at its head.
function belowTitle(svg, parts) {
  const heads = parts.rest.filter((part) => /^(title|note)$/.test(kindOf(part)));
  const feet = heads.map((part) => part.getBBox()).map(({ y, height }) => y + height);
  const kGap = 3, top = Math.max(...feet) + kGap;
  const { x, y, width, height } = parts.whole;
  const ends = [...svg.querySelectorAll(":scope > g")].map((part) => part.getBBox());
  const end = Math.min(y + height, Math.max(...ends.map((box) => box.y + box.height)) + kGap);
  const isHead = heads.length > 0 && top > y && parts.frames.every((frame) => frame.y >= top);
  return isHead ? { heads, box: { x, y: top, width, height: end - top } } : null;
}

const kPaperDrawing_px = 582;  // 154 mm.
const kMostDrawn_px = 450;  // Less than half of a page: a higher drawing would leave the rest empty.

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
  const parts = partsOf(svg), shown = svg.getAttribute("viewBox"), below = belowTitle(svg, parts);
  if (!below) return () => {};
  addDrawnTitle(svg, parts);
  for (const part of below.heads) part.classList.add("off");
  // The smallest words have 8 pt: a wider drawing would take the room of a second one.
  const words_px = kPaperWords_px / leastWords(svg) * below.box.width;
  const width_px = Math.min(words_px > 0 ? words_px : kPaperDrawing_px, kPaper_px);
  showSlices(svg, slicesOf(parts, below.box, width_px), width_px);
  return () => {
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
