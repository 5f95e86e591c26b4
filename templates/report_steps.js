// A figure whose panels are one map at several times has a slider. Each step fills the box with one
// panel and the axes that all panels share, so that the map forms in front of the reader.

const kStepTime_ms = 900;
const kRoomAbove = 40, kRoomBelow = 24, kRoomRight = 10;  // Around a panel's frame, in points.

// The frames of the panels in their order; empty if one is missing.
function panelFrames(figure, svg, count) {
  const frames = [];
  for (let i = 0; i < count; ++i) {
    const rect = svg.querySelector(`#${CSS.escape(`${figure.dataset.id}-c${i}`)} > rect`);
    if (!rect) return [];
    const [x, y, width, height] = ["x", "y", "width", "height"].map(
      (name) => Number(rect.getAttribute(name)));
    frames.push({ x, y, width, height, right: x + width, bottom: y + height });
  }
  return frames;
}

// The parts of a drawing: those of each panel, from its heading on; the labels of the axes; others.
function partsOf(svg) {
  const parts = { panels: [], axes: [], rest: [] };
  for (const part of svg.querySelectorAll(":scope > g")) {
    const kind = part.getAttribute("class") ?? "";
    if (kind === "axis-label") parts.axes.push(...part.children);
    else if (kind === "panel-title") parts.panels.push([part]);
    else if (kind.startsWith("legend") || parts.panels.length === 0) parts.rest.push(part);
    else parts.panels.at(-1).push(part);
  }
  return parts;
}

function positionOf(label) {
  const pattern = /translate\(([-\d.]+)(?:[ ,]([-\d.]+))?\)/;
  const [, x, y] = pattern.exec(label.getAttribute("transform")) ?? [];
  return { x: Number(x ?? 0), y: Number(y ?? 0) };
}

// The tick labels of a panel: those left of its frame, and those below it.
function tickLabelsOf(panel, frame) {
  const all = panel.filter((part) => part.classList.contains("tick-label"))
    .flatMap((part) => [...part.children]);
  const isBelow = (label) => positionOf(label).y > frame.bottom + 8;
  return { left: all.filter((label) => !isBelow(label)), below: all.filter(isBelow) };
}

function addCopy(layer, label, right, down) {
  const moved = layer.appendChild(document.createElementNS(layer.namespaceURI, "g"));
  moved.setAttribute("transform", `translate(${right} ${down})`);
  moved.setAttribute("fill", label.parentElement.getAttribute("fill") ?? "currentColor");
  moved.append(label.cloneNode(true));
}

// The labels of the axes that a panel shares with others, moved to this panel.
function sharedAxes(svg, parts, frames, step) {
  const layer = document.createElementNS(svg.namespaceURI, "g");
  layer.setAttribute("class", "step-axes");
  const frame = frames[step];
  const numbers = parts.panels.map((panel, i) => tickLabelsOf(panel, frames[i]));
  for (const side of ["left", "below"]) {
    const from = numbers.findIndex((each) => each[side].length > 0);
    if (from < 0 || numbers[step][side].length > 0) continue;
    for (const label of numbers[from][side]) {
      addCopy(layer, label, frame.x - frames[from].x, frame.y - frames[from].y);
    }
  }
  const left = Math.min(...frames.map((each) => each.x));
  const top = Math.min(...frames.map((each) => each.y));
  const right = Math.max(...frames.map((each) => each.right));
  const bottom = Math.max(...frames.map((each) => each.bottom));
  for (const name of parts.axes) {
    const upright = /rotate/.test(name.getAttribute("transform"));
    addCopy(layer, name, upright ? frame.x - left : (frame.x + frame.right - left - right) / 2,
      upright ? (frame.y + frame.bottom - top - bottom) / 2 : frame.bottom - bottom);
  }
  return layer;
}

// The box of the drawing that holds one panel with its heading and its axes.
function stepBox(parts, frames, step) {
  const frame = frames[step];
  const left = Math.min(...frames.map((each) => each.x));
  const bottom = Math.max(...frames.map((each) => each.bottom));
  const lowest = Math.max(bottom + kRoomBelow, ...parts.axes.map((name) => positionOf(name).y + 6));
  return { x: frame.x - left, y: frame.y - kRoomAbove, width: left + frame.width + kRoomRight,
    height: kRoomAbove + frame.height + lowest - bottom };
}

// Shows one panel alone, or with -1 all side by side.
function showStep(svg, parts, frames, home, step) {
  svg.querySelector(":scope > .step-axes")?.remove();
  parts.panels.forEach((panel, i) => panel.forEach(
    (part) => part.classList.toggle("off", step >= 0 && i !== step)));
  const others = [...parts.rest, ...new Set(parts.axes.map((name) => name.parentElement))];
  for (const part of others) part.classList.toggle("off", step >= 0);
  if (step < 0) return setHome(svg, home);
  svg.append(sharedAxes(svg, parts, frames, step));
  return setHome(svg, stepBox(parts, frames, step), frames[step]);
}

// Goes through the steps from the one that is shown, or from the first one, and stops at the last.
function addPlayButton(parent, slider, show) {
  let timer = 0;
  const stop = (button) => {
    clearInterval(timer);
    timer = 0;
    button.textContent = "Play";
  };
  addButton(parent, "Play", "", (button) => {
    if (timer !== 0) return stop(button);
    if (slider.value === slider.max) slider.value = 0;
    button.textContent = "Stop";
    const next = () => {
      slider.value = Number(slider.value) + 1;
      show();
      if (slider.value === slider.max) stop(button);
    };
    timer = setInterval(next, kStepTime_ms);
    return next();
  });
}

function addSteps(figure, svg) {
  const steps = Array.from(figure.querySelectorAll(".steps > li"), (item) => item.textContent);
  const frames = panelFrames(figure, svg, steps.length);
  const parts = partsOf(svg);
  if (frames.length < 2 || parts.panels.length !== frames.length) return;
  const { home } = viewOf(svg);
  const label = document.createElement("label");
  const slider = document.createElement("input");
  Object.assign(slider, { type: "range", min: 0, max: frames.length, value: 0 });
  const shown = document.createElement("output");
  const show = () => {
    const step = Number(slider.value);
    showStep(svg, parts, frames, home, step - 1);
    shown.textContent = step === 0 ? "All steps side by side" : steps[step - 1];
    slider.setAttribute("aria-valuetext", shown.textContent);
  };
  slider.addEventListener("input", show);
  label.append("Step ", slider, shown);
  const row = document.createElement("div");
  row.className = "step";
  row.append(label);
  addPlayButton(row, slider, show);
  figure.querySelector(".tools").after(row);
  show();
}
