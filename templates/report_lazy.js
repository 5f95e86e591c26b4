// Drawings stand in the page as text, within <noscript>, and are put in when the reader comes near:
// a page of hundreds opens as fast as one of a few. Without a script the browser shows them itself.

const sources = new WeakMap();  // A figure → the text of its SVG.
const whenPutIn = [];  // Called with each figure and its <svg>.

// The text of a figure's SVG, as in its file; empty if the page does not hold it.
function sourceOf(figure) {
  if (!sources.has(figure)) {
    sources.set(figure, figure.querySelector(".drawing > noscript")?.textContent.trim() ?? "");
  }
  return sources.get(figure);
}

// Gives a drawing that is not yet in its place, so that nothing moves when it comes.
function reservePlace(figure) {
  const size = /viewBox="0 0 ([\d.]+) ([\d.]+)"/.exec(sourceOf(figure).slice(0, 500));
  if (size) figure.querySelector(".drawing").style.aspectRatio = `${size[1]} / ${size[2]}`;
}

function putIn(figure) {
  const holder = figure.querySelector(".drawing > noscript");
  if (!holder) return;
  const text = sourceOf(figure);
  const svg = new DOMParser().parseFromString(text, "image/svg+xml").documentElement;
  if (svg.localName !== "svg") return;
  // A drawing is one image with a title and a description: its words are not elements of their own.
  for (const words of svg.querySelectorAll("g[aria-label]")) words.removeAttribute("aria-label");
  holder.replaceWith(document.adoptNode(svg));
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
    reservePlace(figure);
    observer.observe(figure);
  }
  // Paper shows all.
  addEventListener("beforeprint", () => figures.forEach(putIn));
}
