// Every drawing can be looked at closely: wheel, drag, two fingers, keys and buttons change the part
// of it that its box shows.

// <svg> → { home, now, marks }, all { x, y, width, height } in its units: what "fit" shows, what is
// shown, and where marks are looked for.
const views = new WeakMap();
const kClosest = 40;

function viewOf(svg) {
  if (!views.has(svg)) {
    const { x, y, width, height } = svg.viewBox.baseVal;
    const box = { x, y, width, height };
    views.set(svg, { home: { ...box }, now: { ...box }, marks: { ...box } });
  }
  return views.get(svg);
}

function showView(svg) {
  const { home, now } = viewOf(svg);
  now.x = Math.min(Math.max(now.x, home.x), home.x + home.width - now.width);
  now.y = Math.min(Math.max(now.y, home.y), home.y + home.height - now.height);
  svg.setAttribute("viewBox", [now.x, now.y, now.width, now.height].join(" "));
  svg.parentElement.classList.toggle("zoomed", now.width < home.width);
  svg.parentElement.dispatchEvent(new CustomEvent("viewchange"));
}

// Another part of the drawing is what "fit" shows.
function setHome(svg, box, marks = box) {
  views.set(svg, { home: { ...box }, now: { ...box }, marks: { ...marks } });
  showView(svg);
}

function fitView(svg) {
  setHome(svg, viewOf(svg).home, viewOf(svg).marks);
}

// Zooms about a point of the drawing, by default the middle of what is shown.
function zoomView(svg, factor, about) {
  const { home, now } = viewOf(svg);
  const width = Math.min(home.width, Math.max(home.width / kClosest, now.width / factor));
  if (width === home.width) return fitView(svg);
  const k = width / now.width;
  const point = about ?? { x: now.x + now.width / 2, y: now.y + now.height / 2 };
  now.x = point.x - (point.x - now.x) * k;
  now.y = point.y - (point.y - now.y) * k;
  now.width *= k;
  now.height *= k;
  return showView(svg);
}

// Shares of what is shown.
function moveView(svg, right, down) {
  const { now } = viewOf(svg);
  now.x += right * now.width;
  now.y += down * now.height;
  showView(svg);
}

// Where an event is, in the drawing's units.
function pointOf(svg, event) {
  return new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
}

function middle(points) {
  const mean = (name) => points.reduce((sum, point) => sum + point[name], 0) / points.length;
  return { clientX: mean("clientX"), clientY: mean("clientY") };
}

function spread(points) {
  return Math.hypot(points[0].clientX - points[1].clientX, points[0].clientY - points[1].clientY);
}

// One pointer drags what is zoomed, two pinch.
function followPointers(box, svg) {
  const pointers = new Map();
  const of = ({ clientX, clientY }) => ({ clientX, clientY });
  box.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    pointers.set(event.pointerId, of(event));
    if (pointers.size > 1 || box.classList.contains("zoomed")) box.setPointerCapture(event.pointerId);
  });
  box.addEventListener("pointermove", (event) => {
    if (!pointers.has(event.pointerId)) return;
    const before = [...pointers.values()];
    pointers.set(event.pointerId, of(event));
    const after = [...pointers.values()];
    const from = pointOf(svg, middle(before)), to = pointOf(svg, middle(after));
    const { now } = viewOf(svg);
    moveView(svg, (from.x - to.x) / now.width, (from.y - to.y) / now.height);
    if (after.length === 2 && spread(before) > 0) {
      zoomView(svg, spread(after) / spread(before), pointOf(svg, middle(after)));
    }
  });
  for (const name of ["pointerup", "pointercancel", "lostpointercapture"]) {
    box.addEventListener(name, (event) => pointers.delete(event.pointerId));
  }
}

// The wheel scrolls the page until the drawing was clicked, or Ctrl is held.
function followWheel(box, svg) {
  box.addEventListener("wheel", (event) => {
    const figure = box.closest("figure");
    const wanted = event.ctrlKey || event.metaKey || box === document.activeElement ||
      document.fullscreenElement === figure || figure.classList.contains("filling");
    if (!wanted) return;
    event.preventDefault();
    const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 20 : 1;
    zoomView(svg, Math.exp(-event.deltaY * lines / 400), pointOf(svg, event));
  }, { passive: false });
}

const viewKeys = new Map([
  ["+", (svg) => zoomView(svg, 1.4)], ["=", (svg) => zoomView(svg, 1.4)],
  ["-", (svg) => zoomView(svg, 1 / 1.4)], ["0", fitView],
  ["ArrowLeft", (svg) => moveView(svg, -0.1, 0)], ["ArrowRight", (svg) => moveView(svg, 0.1, 0)],
  ["ArrowUp", (svg) => moveView(svg, 0, -0.1)], ["ArrowDown", (svg) => moveView(svg, 0, 0.1)],
]);

function followKeys(box, svg) {
  box.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const act = viewKeys.get(event.key);
    // Arrows scroll the page while there is nothing to move.
    if (!act || (event.key.startsWith("Arrow") && !box.classList.contains("zoomed"))) return;
    event.preventDefault();
    act(svg);
  });
}

// Where the browser has no full screen, or refuses, the figure fills the window.
async function toggleFullScreen(figure) {
  if (document.fullscreenElement === figure) return document.exitFullscreen();
  const filled = figure.classList.contains("filling");
  figure.classList.remove("filling");
  try {
    if (!filled) await figure.requestFullscreen();
  } catch {
    figure.classList.add("filling");
  }
  return sayFullScreen(figure);
}
