// On paper the title of a drawing is text above it, as wide as the page: drawn, it would take two
// lines and more of the height, and two figures would not stand on one page.

// The part of a drawing below its title and its notes; null where they are not at its head.
function belowTitle(svg, parts) {
  const heads = parts.rest.filter((part) => /^(title|note)$/.test(kindOf(part)));
  const feet = heads.map((part) => part.getBBox()).map(({ y, height }) => y + height);
  const top = Math.max(...feet) + 3;
  const { x, y, width, height } = parts.whole;
  const isHead = heads.length > 0 && top > y && parts.frames.every((frame) => frame.y >= top);
  return isHead ? { heads, box: { x, y: top, width, height: y + height - top } } : null;
}

function setTitleAsText(svg) {
  const drawing = svg.parentElement;
  if (drawing.matches(".stacked, .stepped, .zoomed")) return () => {};
  const parts = partsOf(svg), shown = svg.getAttribute("viewBox"), below = belowTitle(svg, parts);
  if (!below) return () => {};
  addDrawnTitle(svg, parts);
  for (const part of below.heads) part.classList.add("off");
  setViewBox(svg, below.box);
  drawing.style.setProperty("--paper", below.box.width / below.box.height);
  return () => {
    for (const part of below.heads) part.classList.remove("off");
    svg.setAttribute("viewBox", shown);
    drawing.style.removeProperty("--paper");
    drawing.parentElement.querySelector(".drawn-title")?.remove();
  };
}

function setTitlesOnPaper() {
  let undo = [];
  addEventListener("beforeprint", () => {
    undo = [...document.querySelectorAll(".drawing > svg")].map(setTitleAsText);
  });
  addEventListener("afterprint", () => {
    for (const each of undo) each();
    undo = [];
  });
}
