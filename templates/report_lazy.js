// The page holds drawings as text within <noscript>, and inserts them when the reader comes near: a
// page of hundreds opens as fast as a page of a few. Without a script the browser shows them.

const sources = new WeakMap();  // A figure → the text of its SVG.
const whenPutIn = [];  // Called with each figure and its <svg>.

// The text of a figure's SVG, as in its file; empty if the page does not hold it.
function sourceOf(figure) {
  if (!sources.has(figure)) {
    sources.set(figure, figure.querySelector(".drawing > noscript")?.textContent.trim() ?? "");
  }
  return sources.get(figure);
}

// Reserves the space of a drawing, so that nothing moves when it is inserted.
function reserveSpace(figure) {
  const size = /viewBox="0 0 ([\d.]+) ([\d.]+)"/.exec(sourceOf(figure).slice(0, 500));
  if (size) figure.querySelector(".drawing").style.setProperty("--aspect", size[1] / size[2]);
}

// The text of an SVG as an element of the page.
function drawingOf(text) {
  const svg = new DOMParser().parseFromString(text, "image/svg+xml").documentElement;
  // A drawing is one image with a title and a description; its texts are not separate elements.
  for (const words of svg.querySelectorAll("g[aria-label]")) {
    words.dataset.words = words.getAttribute("aria-label");
    words.removeAttribute("aria-label");
  }
  addDarkImages(svg);
  return document.adoptNode(svg);
}

function putIn(figure) {
  const holder = figure.querySelector(".drawing > noscript");
  if (!holder) return;
  const svg = drawingOf(sourceOf(figure));
  if (svg.localName !== "svg") return;
  holder.replaceWith(svg);
  for (const each of whenPutIn) each(figure, svg);
}

function putInWhenNear(figures) {
  const observer = new IntersectionObserver((entries) => {
    for (const entry of entries) {
      if (!entry.isIntersecting) continue;
      observer.unobserve(entry.target);
      putIn(entry.target);
    }
  }, { rootMargin: "60% 0px" });
  for (const figure of figures) {
    reserveSpace(figure);
    observer.observe(figure);
  }
  // Paper shows all drawings.
  addEventListener("beforeprint", () => figures.forEach(putIn));
}
