// The modes in which the two images of an item are shown.

const modes = ["side", "slider", "blink", "overlay", "heat"];
let blinking = null;

function setCut(percent) {
  by("cut").value = clamp(percent, 0, 100);
  root.style.setProperty("--cut", `${by("cut").value}%`);
}

function setShown(side) {
  root.dataset.shown = side;
  by("shown").value = side;
}

const flip = () => setShown(root.dataset.shown === "baseline" ? "current" : "baseline");

// Only a button or a key starts it. At 0.7 flips per second it does not flash.
function setBlinking(on) {
  clearInterval(blinking);
  blinking = on ? setInterval(flip, 1400) : null;
  by("play").setAttribute("aria-pressed", String(on));
  by("play").textContent = on ? "Stop" : "Blink";
}

function setMode(mode) {
  root.dataset.mode = mode;
  for (const button of document.querySelectorAll(".modes button")) {
    button.setAttribute("aria-pressed", String(button.dataset.mode === mode));
  }
  for (const tools of document.querySelectorAll("[data-for]")) {
    tools.hidden = tools.dataset.for !== mode;
  }
  if (mode !== "blink") setBlinking(false);
  if (stageAtHand()) viewOf(stageAtHand()).show();
}

function chooseMode(mode) {
  setMode(mode);
  if (atHand) history.replaceState(null, "", `#${linkTo(atHand)}`);
}

const nextMode = () => chooseMode(modes[(modes.indexOf(root.dataset.mode) + 1) % modes.length]);

// The line between the two images in slider mode.
function addDivider(stage) {
  const view = stage.querySelector(".baseline .view");
  if (!view || !stage.classList.contains("both")) return;
  const divider = document.createElement("div");
  divider.className = "divider";
  divider.setAttribute("aria-hidden", "true");
  divider.addEventListener("pointerdown", (event) => {
    divider.setPointerCapture(event.pointerId);
    event.stopPropagation();
    event.preventDefault();
  });
  divider.addEventListener("pointermove", (event) => {
    if (!divider.hasPointerCapture(event.pointerId)) return;
    const box = view.getBoundingClientRect();
    setCut(100 * (event.clientX - box.left) / box.width);
  });
  stage.append(divider);
}
