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
  if (link) addImage(link, link.dataset.alt, (text) => text);
}
