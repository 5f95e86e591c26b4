// A stage shows the images of one item; one view by CSS transforms moves them together. Its units
// are shares of the image.

const stageAtHand = () => atHand?.querySelector(".stage") ?? null;

// Not a heat map whose pixels are not those of the images.
const sizedImages = (stage) => stage.querySelectorAll(".pane:not(.heat) img, .heat img[width]");

function largestSize(stage) {
  const images = Array.from(sizedImages(stage));
  const side = (name, natural) => Math.max(1, ...images.map((image) =>
    image[natural] || Number(image.getAttribute(name)) || 0));
  return { width: side("width", "naturalWidth"), height: side("height", "naturalHeight") };
}

// All images have one scale, so that a difference of size is visible.
function arrange(stage) {
  const size = largestSize(stage);
  stage.style.setProperty("--ratio", size.width / size.height);
  for (const image of sizedImages(stage)) {
    const width = image.naturalWidth || Number(image.getAttribute("width")) || size.width;
    image.style.width = `${100 * width / size.width}%`;
  }
}

function showZoom(stage) {
  const magnification = stage ? viewOf(stage).magnification : 1;
  by("zoom").value = `${Math.round(100 * magnification)} %`;
}

function stageAdapter(stage) {
  const surface = (event) => event.target.closest(".view");
  return {
    most: 64,
    apply(view) {
      const { magnification, now } = view;
      stage.style.setProperty("--zoom", magnification);
      stage.style.setProperty("--x", -now.x * magnification);
      stage.style.setProperty("--y", -now.y * magnification);
      stage.classList.toggle("zoomed", view.isZoomed);
      const shown = stage.querySelector(".canvas").offsetWidth / largestSize(stage).width;
      const isPng = stage.dataset.format === "png";
      stage.classList.toggle("pixels", isPng && magnification * shown > 2.5);
      if (stage === stageAtHand()) showZoom(stage);
    },
    surface,
    position(event) {
      const view = surface(event), canvas = view.querySelector(".canvas");
      const box = view.getBoundingClientRect();
      return {
        x: (event.clientX - box.left - view.clientLeft - canvas.offsetLeft) / canvas.offsetWidth,
        y: (event.clientY - box.top - view.clientTop - canvas.offsetTop) / canvas.offsetHeight,
      };
    },
    point({ x, y }) {
      const { now } = viewOf(stage);
      return { x: now.x + x * now.width, y: now.y + y * now.height };
    },
    isActive: () => stage.contains(document.activeElement),
    grab(event) {
      setAtHand(stage.closest("article"));
      stage.focus({ preventScroll: true });
      if (event.pointerType === "mouse") event.preventDefault();
    },
  };
}

function makeStage(stage) {
  stage.tabIndex = 0;
  arrange(stage);
  for (const image of stage.querySelectorAll("img")) {
    image.addEventListener("load", () => arrange(stage));
  }
  const view = addView(stage, { x: 0, y: 0, width: 1, height: 1 }, stageAdapter(stage));
  followPointers(stage, view);
  followWheel(stage, view);
  addDivider(stage);
}

function fit(stage) {
  for (const marks of stage.querySelectorAll(".marks")) marks.remove();
  viewOf(stage).fit();
}

function addFrame(view, shares) {
  const marks = document.createElement("div");
  marks.className = "marks";
  const frame = document.createElement("span");
  frame.className = "frame";
  for (const [name, share] of Object.entries(shares)) frame.style.setProperty(`--${name}`, share);
  marks.append(frame);
  view.append(marks);
}

// Shows a box of pixels, of images of that size, at the middle, with a frame around it.
function showBox(stage, [x, y, width, height], [across, down]) {
  const shares = { left: x / across, top: y / down, width: width / across, height: height / down };
  fit(stage);
  for (const view of stage.querySelectorAll(".view")) addFrame(view, shares);
  const view = viewOf(stage), at = view.middle();
  view.zoom(clamp(0.4 / Math.max(shares.width, shares.height), 1, 24));
  view.moveBy(shares.left + shares.width / 2 - at.x, shares.top + shares.height / 2 - at.y);
}
