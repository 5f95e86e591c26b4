// The row of controls under a drawing.

function addButton(parent, text, label, act) {
  const button = document.createElement("button");
  button.type = "button";
  button.textContent = text;
  if (label) button.setAttribute("aria-label", label);
  button.addEventListener("click", () => act(button));
  parent.append(button);
  return button;
}

// Screen readers read this text when it changes.
function announce(text) {
  let status = document.querySelector("#status");
  if (!status) {
    status = document.createElement("p");
    status.id = "status";
    status.className = "visually-hidden";
    status.setAttribute("role", "status");
    document.body.append(status);
  }
  status.textContent = text;
}

function titleOf(figure) {
  return figure.querySelector(".drawing > svg > title")?.textContent ?? figure.dataset.id;
}

function addTools(figure, svg) {
  const box = figure.querySelector(".drawing");
  box.tabIndex = 0;
  box.setAttribute("role", "group");
  box.setAttribute("aria-label", `${titleOf(figure)}: press + and - to zoom, 0 to fit, arrows to ` +
    "move, n and p to step through the landmarks");
  const tools = document.createElement("div");
  tools.className = "tools";
  tools.setAttribute("role", "toolbar");
  tools.setAttribute("aria-label", `View of ${titleOf(figure)}`);
  addButton(tools, "\u2212", "Zoom out", () => viewOf(svg).zoom(1 / kZoomStep));
  addButton(tools, "+", "Zoom in", () => viewOf(svg).zoom(kZoomStep));
  addButton(tools, "Fit", "Fit the whole figure", () => viewOf(svg).fit());
  addButton(tools, "Full screen", "", () => toggleFullScreen(figure)).className = "full";
  figure.addEventListener("fullscreenchange", () => updateFullScreen(figure));
  box.after(tools);
  makeZoomable(box, svg);
  leaveOnEscape(figure);
}
