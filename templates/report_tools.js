// The row of controls under a drawing.

function addButton(place, text, label, act) {
  const button = document.createElement("button");
  button.type = "button";
  button.textContent = text;
  if (label) button.setAttribute("aria-label", label);
  button.addEventListener("click", () => act(button));
  place.append(button);
  return button;
}

// The page's one voice for what happens without a word on the screen.
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

function leaveOnEscape(figure) {
  figure.addEventListener("keydown", (event) => {
    if (event.key !== "Escape") return;
    figure.classList.remove("filling");
    sayFullScreen(figure);
  });
}

// The button says what it does now.
function sayFullScreen(figure) {
  const fills = document.fullscreenElement === figure || figure.classList.contains("filling");
  figure.querySelector("button.full").textContent = fills ? "Leave full screen" : "Full screen";
  showView(figure.querySelector(".drawing > svg"));
}

function addTools(figure, svg) {
  const box = figure.querySelector(".drawing");
  box.tabIndex = 0;
  box.setAttribute("role", "group");
  box.setAttribute("aria-label", `${titleOf(figure)}: + and - zoom, 0 fits, arrows move, ` +
    "n and p go through the landmarks");
  const tools = document.createElement("div");
  tools.className = "tools";
  tools.setAttribute("role", "toolbar");
  tools.setAttribute("aria-label", `View of ${titleOf(figure)}`);
  addButton(tools, "\u2212", "Zoom out", () => zoomView(svg, 1 / 1.4));
  addButton(tools, "+", "Zoom in", () => zoomView(svg, 1.4));
  addButton(tools, "Fit", "Fit the whole figure", () => fitView(svg));
  addButton(tools, "Full screen", "", () => toggleFullScreen(figure)).className = "full";
  figure.addEventListener("fullscreenchange", () => sayFullScreen(figure));
  box.after(tools);
  followPointers(box, svg);
  followWheel(box, svg);
  followKeys(box, svg);
  leaveOnEscape(figure);
}
