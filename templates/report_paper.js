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

function setTitleAsText(svg) {
  const drawing = svg.parentElement;
  if (drawing.matches(".stacked, .stepped, .zoomed")) return () => {};
  const parts = partsOf(svg), shown = svg.getAttribute("viewBox"), below = belowTitle(svg, parts);
  if (!below) return () => {};
  addDrawnTitle(svg, parts);
  for (const part of below.heads) part.classList.add("off");
  setViewBox(svg, below.box);
  drawing.style.setProperty("--paper-ratio", below.box.width / below.box.height);
  // The smallest words have 8 pt: a wider drawing would take the room of a second one.
  const width_px = kPaperWords_px / leastWords(svg) * below.box.width;
  if (width_px > 0) drawing.style.setProperty("--paper-width", `${width_px}px`);
  return () => {
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
