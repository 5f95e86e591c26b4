// A drawing with axes is zoomed in its frames (see report_axes.js), another by its viewBox, so that it
// stays sharp; it can also fill the screen.

const panels = new WeakMap();  // <svg> → the box of the panel that a step shows alone.
const panelOf = (svg) => panels.get(svg) ?? viewBoxOf(svg);

function viewBoxOf(svg) {
  const { x, y, width, height } = svg.viewBox.baseVal;
  return { x, y, width, height };
}

function setViewBox(svg, { x, y, width, height }) {
  svg.setAttribute("viewBox", [x, y, width, height].join(" "));
}

// Where a client position is, in the drawing's units.
function pointOf(svg, { x, y }) {
  return new DOMPoint(x, y).matrixTransform(svg.getScreenCTM().inverse());
}

function drawingAdapter(box, svg) {
  const figure = box.closest("figure");
  return {
    most: 40,
    apply(view) {
      setViewBox(svg, view.now);
      box.classList.toggle("zoomed", view.isZoomed);
      box.dispatchEvent(new CustomEvent("viewchange"));
    },
    surface: () => box,
    position: (event) => ({ x: event.clientX, y: event.clientY }),
    point: (position) => pointOf(svg, position),
    isActive: () => box === document.activeElement || document.fullscreenElement === figure ||
      figure.classList.contains("filling"),
    grab() {},
  };
}

function makeZoomable(box, svg) {
  const isOfAxes = hasAxes(svg);
  if (isOfAxes) zoomedParts.set(svg, readZoomedParts(svg));
  const view = isOfAxes ? addView(svg, kWholeFrame, axesAdapter(box, svg))
    : addView(svg, viewBoxOf(svg), drawingAdapter(box, svg));
  followPointers(box, view);
  followWheel(box, view);
  box.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const act = actOfKey(event.key, view);
    if (!act) return;
    event.preventDefault();
    act(view);
    if (isOfAxes) announce(wordsOfView(svg, view.now));
  });
}

// "Fit" then shows `home`; landmarks are looked for within `panel`.
function setHome(svg, home, panel = home) {
  panels.set(svg, panel);
  if (!zoomedParts.has(svg)) return viewOf(svg).setHome(home);
  setViewBox(svg, home);
  return viewOf(svg).fit();
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
  return updateFullScreen(figure);
}

// The button names what it does now.
function updateFullScreen(figure) {
  const fills = document.fullscreenElement === figure || figure.classList.contains("filling");
  figure.querySelector("button.full").textContent = fills ? "Leave full screen" : "Full screen";
  viewOf(figure.querySelector(".drawing > svg")).show();
}

function leaveOnEscape(figure) {
  figure.addEventListener("keydown", (event) => {
    if (event.key !== "Escape") return;
    figure.classList.remove("filling");
    updateFullScreen(figure);
  });
}
