// A figure whose panels are one map at several times has a slider. Each step fills the box with one
// panel and the axes that all panels share, so that the map forms in front of the reader.

const kStepTime_ms = 900;

// The box of the drawing that holds one panel with its heading and its axes.
function stepBox({ left, above, right, below }, frame) {
  return { x: frame.x - left, y: frame.y - above, width: left + frame.width + right,
    height: above + frame.height + below };
}

// Shows one panel alone, or with -1 all of them.
function showStep(svg, parts, rooms, whole, step) {
  enlargeFrames(svg, 1);
  if (step < 0) return showWhole(svg, whole);
  unstack(svg, parts);
  const others = [...parts.rest, ...parts.axes.map((name) => name.parentElement)];
  for (const part of [...parts.panels.flat(), ...others]) part.classList.remove("off");
  const factor = narrowPage.matches ? 1 : factorOfStep(rooms, parts.frames[step], whole);
  const frame = enlarged(parts.frames[step], factor);
  const labels = sharedAxes(svg, parts, step, kNoShift, frame);  // Measures what is shown.
  parts.panels.forEach((panel, i) => panel.forEach(
    (part) => part.classList.toggle("off", i !== step)));
  for (const part of others) part.classList.add("off");
  svg.append(labels);
  enlargeFrames(svg, factor);
  const box = stepBox(rooms, frame);
  if (narrowPage.matches) {
    fillWidth(svg, box);
  } else {  // The box of all panels is too flat for one.
    svg.parentElement.classList.add("stepped");
    svg.parentElement.style.setProperty("--step", box.width / box.height);
  }
  return setHome(svg, box, frame);
}

// How many times as large the frame of a step is as that of its panel: the step is as wide as the
// drawing or as high as the box, with words of the same size.
function factorOfStep({ left, above, right, below }, frame, whole) {
  const kHighest = 480;  // In units of the drawing.
  return Math.max(1, Math.min((whole.width - left - right) / frame.width,
    (kHighest - above - below) / frame.height));
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
  const parts = partsOf(svg);
  if (steps.length < 2 || parts.panels.length !== steps.length) return;
  const { whole } = parts, rooms = roomsOf(svg, parts);
  if (!rooms) return;
  const label = document.createElement("label");
  const slider = document.createElement("input");
  Object.assign(slider, { type: "range", min: 0, max: steps.length, value: 0 });
  const shown = document.createElement("output");
  const show = () => {
    const step = Number(slider.value);
    showStep(svg, parts, rooms, whole, step - 1);
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
