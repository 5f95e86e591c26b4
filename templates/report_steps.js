// A figure whose panels are one map at several times can be gone through step by step: each panel
// fills the box in turn, so that the map forms in one place.

// Frames of the panels, in their order, with room for what stands above them.
function panelBoxes(figure, svg, count) {
  const boxes = [];
  for (let i = 0; i < count; ++i) {
    const rect = svg.querySelector(`#${CSS.escape(`${figure.dataset.id}-c${i}`)} > rect`);
    if (!rect) return [];
    const [x, y, width, height] = ["x", "y", "width", "height"].map(
      (name) => Number(rect.getAttribute(name)));
    boxes.push({ x: x - 6, y: y - 34, width: width + 12, height: height + 40 });
  }
  return boxes;
}

function addSteps(figure, svg) {
  const words = Array.from(figure.querySelectorAll(".steps > li"), (item) => item.textContent);
  const boxes = panelBoxes(figure, svg, words.length);
  if (boxes.length < 2) return;
  const { home } = viewOf(svg);
  const label = document.createElement("label");
  label.className = "step";
  const slider = document.createElement("input");
  Object.assign(slider, { type: "range", min: 0, max: boxes.length, value: 0 });
  const said = document.createElement("output");
  const show = () => {
    const step = Number(slider.value);
    setHome(svg, step === 0 ? home : boxes[step - 1]);
    said.textContent = step === 0 ? "All side by side" : words[step - 1];
    slider.setAttribute("aria-valuetext", said.textContent);
  };
  slider.addEventListener("input", show);
  label.append("Step ", slider, said);
  figure.querySelector(".tools").after(label);
  show();
}
