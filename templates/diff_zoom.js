// Zoom: one view a stage, so that all of its pictures move in step.

const mostZoom = 64;
const views = new Map();
const clamp = (value, low, high) => Math.min(high, Math.max(low, value));

function viewOf(stage) {
  if (!views.has(stage)) views.set(stage, { zoom: 1, x: 0, y: 0 });
  return views.get(stage);
}

const stageAtHand = () => atHand?.querySelector(".stage") ?? null;

function largestSize(stage) {
  const images = Array.from(stage.querySelectorAll("img"));
  const side = (name, natural) => Math.max(1, ...images.map((image) =>
    image[natural] || Number(image.getAttribute(name)) || 0));
  return { width: side("width", "naturalWidth"), height: side("height", "naturalHeight") };
}

// Every picture at one scale, so that a difference of size is seen as one.
function arrange(stage) {
  const size = largestSize(stage);
  stage.style.setProperty("--ratio", size.width / size.height);
  for (const image of stage.querySelectorAll("img")) {
    const width = image.naturalWidth || Number(image.getAttribute("width")) || size.width;
    image.style.width = `${100 * width / size.width}%`;
  }
}

function applyView(stage) {
  const view = viewOf(stage);
  view.zoom = clamp(view.zoom, 1, mostZoom);
  view.x = clamp(view.x, 1 - view.zoom, 0);
  view.y = clamp(view.y, 1 - view.zoom, 0);
  for (const name of ["zoom", "x", "y"]) stage.style.setProperty(`--${name}`, view[name]);
  stage.classList.toggle("zoomed", view.zoom > 1);
  const canvas = stage.querySelector(".canvas");
  const magnified = view.zoom * canvas.offsetWidth / largestSize(stage).width;
  stage.classList.toggle("pixels", stage.dataset.format === "png" && magnified > 2.5);
  if (stage === stageAtHand()) by("zoom").value = `${Math.round(100 * view.zoom)} %`;
}

// Keeps the point (x, y), in shares of the unmoved picture, where it is.
function zoomBy(stage, factor, x = 0.5, y = 0.5) {
  const view = viewOf(stage);
  const zoom = clamp(view.zoom * factor, 1, mostZoom);
  view.x = x - (x - view.x) * zoom / view.zoom;
  view.y = y - (y - view.y) * zoom / view.zoom;
  view.zoom = zoom;
  applyView(stage);
}

function moveBy(stage, x, y) {
  const view = viewOf(stage);
  view.x += x;
  view.y += y;
  applyView(stage);
}

function fit(stage) {
  Object.assign(viewOf(stage), { zoom: 1, x: 0, y: 0 });
  for (const marks of stage.querySelectorAll(".marks")) marks.remove();
  applyView(stage);
}

// Shows a box of pixels at the middle, with a frame around it.
function showBox(stage, [x, y, width, height]) {
  const size = largestSize(stage);
  const zoom = clamp(0.4 / Math.max(width / size.width, height / size.height), 1, 24);
  fit(stage);
  const shares = {
    left: x / size.width, top: y / size.height,
    width: width / size.width, height: height / size.height,
  };
  for (const view of stage.querySelectorAll(".view")) {
    const marks = document.createElement("div");
    marks.className = "marks";
    const frame = document.createElement("span");
    frame.className = "frame";
    for (const [name, share] of Object.entries(shares)) frame.style.setProperty(`--${name}`, share);
    marks.append(frame);
    view.append(marks);
  }
  Object.assign(viewOf(stage), {
    zoom,
    x: 0.5 - zoom * (x + width / 2) / size.width,
    y: 0.5 - zoom * (y + height / 2) / size.height,
  });
  applyView(stage);
}
