// Images for the links at the head of the page, from the drawings that the page holds.

// What surrounds the data of a figure: a small image has no room for it.
const surroundings = ["title", "note", "tick", "tick-label", "axis-label", "legend-sample",
  "legend-text", "frame"].map((name) => `g.${name}`).join();

// The first panel of a figure or its image, without titles, axes and legend.
function cropped(text) {
  const svg = new DOMParser().parseFromString(text, "image/svg+xml").documentElement;
  const panel = svg.querySelector("image") ?? svg.querySelector("clipPath > rect");
  if (!panel) return text;
  const box = ["x", "y", "width", "height"].map((name) => Number(panel.getAttribute(name)));
  if (!box.every(Number.isFinite)) return text;
  for (const group of svg.querySelectorAll(surroundings)) group.remove();
  svg.setAttribute("viewBox", box.join(" "));
  svg.setAttribute("width", box[2]);
  svg.setAttribute("height", box[3]);
  return new XMLSerializer().serializeToString(svg);
}

// The drawing as a narrow page shows it (see report_stack.js), for a box of that width and, if it can
// be, of that height.
function narrowed(text, width_px, height_px) {
  const box = document.createElement("div");
  box.className = "measured";
  box.style.width = `${width_px}px`;
  box.append(drawingOf(text));
  document.body.append(box);
  const svg = box.firstChild, parts = partsOf(svg);
  const arrangement = arrangementOf(svg, parts, width_px, height_px);
  if (arrangement) {
    const whole = stack(svg, parts, arrangement);
    // What is too high gets smaller, as far as its words can be read.
    const most = width_px * leastWords(svg) / kLeastWords_px;
    const width = Math.max(whole.width, Math.min(most, whole.height * width_px / height_px));
    whole.x -= (width - whole.width) / 2;
    whole.width = width;
    setViewBox(svg, whole);
    for (const hidden of svg.querySelectorAll(".off")) hidden.remove();
    svg.setAttribute("width", whole.width);
    svg.setAttribute("height", whole.height);
  }
  box.remove();
  return arrangement ? new XMLSerializer().serializeToString(svg) : text;
}

function addImage(link, alt, drawing) {
  const figure = document.getElementById(link.hash.slice(1));
  const text = figure ? sourceOf(figure) : "";
  if (text === "") return;
  const image = link.querySelector("img") ?? new Image();
  image.alt = alt;
  image.src = svgUrl(inPageColours(drawing(text)));
  link.prepend(image);
}

function addOpeningImages() {
  for (const link of document.querySelectorAll(".thumbnails a")) {
    addImage(link, "", cropped);  // The link has the title.
  }
  const link = document.querySelector(".main-figure a");
  if (!link) return;
  const kBelow_px = 8;
  const { clientWidth } = link.parentElement;
  const top = link.getBoundingClientRect().top + scrollY;
  addImage(link, link.dataset.alt, (text) => (narrowPage.matches && clientWidth > 0
    ? narrowed(text, clientWidth, innerHeight - top - kBelow_px) : text));
}
