// Images for the links at the head of the page, from the drawings that the page holds.

// What surrounds the data of a figure: a small image has no room for it.
const surroundings = ["title", "note", "tick", "tick-label", "axis-label", "legend-sample",
  "legend-text", "legend-box", "frame"].map((name) => `g.${name}`).join();

// Whether both axes of a panel count in one scale.
function isMap({ x = "", y = "" }, [, , width, height]) {
  const [kind, low, high] = x.split(" "), [other, bottom, top] = y.split(" ");
  const across = (high - low) / width, up = (top - bottom) / height;
  return kind === "linear" && other === "linear" && Math.abs(across - up) < .001 * up;
}

// Lines and marks that can be seen in a small image. Curves and heat maps fill it; maps keep their
// proportions.
function strengthen(svg, keepsProportions) {
  const kTimes = 2;
  for (const grid of svg.querySelectorAll("g.grid")) grid.remove();
  for (const words of svg.querySelectorAll("g.mark-label, g.cell-text")) words.remove();
  for (const line of svg.querySelectorAll("[stroke-width]")) {
    line.setAttribute("stroke-width", kTimes * Number(line.getAttribute("stroke-width")));
  }
  if (keepsProportions || !svg.querySelector("[data-curve] path, g.cells")) return;
  svg.setAttribute("preserveAspectRatio", "none");
  for (const path of svg.querySelectorAll("path")) {
    path.setAttribute("vector-effect", "non-scaling-stroke");
  }
  for (const marker of svg.querySelectorAll("use")) marker.remove();
  svg.setAttribute("height", Number(svg.getAttribute("width")) / 2);  // As the box, see report.css.
}

// The axes of a view are lines and words over its image.
function removeAround(image, svg) {
  for (const group of svg.querySelectorAll("g")) if (!group.contains(image)) group.remove();
}

// The first panel of a figure or its image, without titles, axes and legend.
function cropped(text) {
  const svg = new DOMParser().parseFromString(text, "image/svg+xml").documentElement;
  const panel = svg.querySelector("image") ?? svg.querySelector("clipPath > rect");
  if (!panel) return text;
  const box = ["x", "y", "width", "height"].map((name) => Number(panel.getAttribute(name)));
  if (!box.every(Number.isFinite)) return text;
  for (const group of svg.querySelectorAll(surroundings)) group.remove();
  svg.setAttribute("viewBox", box.join(" "));
  svg.setAttribute("width", box[2]);
  svg.setAttribute("height", box[3]);
  if (panel.localName === "image") removeAround(panel, svg);
  else strengthen(svg, isMap(panel.dataset, box));
  return new XMLSerializer().serializeToString(svg);
}

// The drawing as a narrow page shows it (see report_stack.js), for a box of that width and, if it can
// be, of that height. Returns what to show, and the notes that are left out.
function narrowed(text, width_px, height_px) {
  const shown = arrangedIn(text, width_px, height_px), excess_px = shown.height_px - height_px;
  // Only what is drawn shows how high its legend is.
  return excess_px > 0 ? arrangedIn(text, width_px, height_px - excess_px) : shown;
}

function arrangedIn(text, width_px, height_px) {
  const box = document.createElement("div");
  box.className = "measured";
  box.style.width = `${width_px}px`;
  box.append(drawingOf(text));
  document.body.append(box);
  const svg = box.firstChild, parts = partsOf(svg);
  const arrangement = arrangementOf(svg, parts, width_px, height_px);
  const notes = arrangement ? wordsOfParts(parts, ["note"]) : [];
  let drawn_px = 0;
  if (arrangement) {
    const whole = stack(svg, parts, arrangement);
    // What is too high gets smaller, as far as its words can be read.
    const most = mostWidth(svg, width_px);
    const width = Math.max(whole.width, Math.min(most, whole.height * width_px / height_px));
    whole.x -= (width - whole.width) / 2;
    whole.width = width;
    setViewBox(svg, whole);
    for (const hidden of svg.querySelectorAll(".off")) hidden.remove();
    svg.setAttribute("width", whole.width);
    svg.setAttribute("height", whole.height);
    drawn_px = whole.height * width_px / whole.width;
  }
  box.remove();
  return { text: arrangement ? new XMLSerializer().serializeToString(svg) : text, notes,
    height_px: drawn_px };
}

const kLeastOpening_px = 9;  // Of words in the figure of the first screen.

// The first panel of a drawing with its axes, the legend below it.
function firstPanel(svg, parts) {
  const rooms = roomsOf(svg, parts);
  if (!rooms) return null;
  const labels = sharedAxes(svg, parts, 0);  // Measures what is shown.
  const box = stepBox(rooms, parts.frames[0]);
  movePanel(parts.panels[0], { x: -box.x, y: -box.y });
  shifts.set(labels, { x: -box.x, y: -box.y });
  // Legends that stand in other panels are of these.
  const { own, shared } = legendsOf(svg, parts, true);
  for (const part of own.slice(1).flat(2)) {
    part.remove();
    parts.rest = parts.rest.filter((each) => each !== part);
  }
  const layers = [];
  const foot = placeEntries(svg, [...own[0], ...shared], box.width, box.height + 4, layers);
  for (const part of [...parts.panels.slice(1).flat(), ...parts.axes.map((name) => name.parentElement),
    ...parts.rest.filter((each) => !/^legend-(sample|text)$/.test(kindOf(each)))]) part.remove();
  svg.append(labels, ...layers);
  placePart(labels);
  return { x: 0, y: 0, width: box.width, height: foot };
}

// The drawing for a wide page: of several panels the first one alone, where in all of them words were
// too small to be read in the box. Returns what to show, whether its title is left out, the height at
// which its words can be read, if it can be, and that of the whole drawing on paper.
function readable(text, width_px, height_px) {
  const box = document.createElement("div");
  box.className = "measured";
  box.style.width = `${width_px}px`;
  box.append(drawingOf(text));
  document.body.append(box);
  const svg = box.firstChild, parts = partsOf(svg), least = leastWords(svg);
  const words = ({ width, height }) => least * Math.min(width_px / width, height_px / height);
  const isSmall = words(parts.whole) < kLeastOpening_px && parts.panels.length > 1;
  const first = isSmall ? firstPanel(svg, parts) : null;
  const isBetter = first !== null && words(first) > words(parts.whole);
  if (isBetter) {
    setViewBox(svg, first);
    svg.setAttribute("width", first.width);
    svg.setAttribute("height", first.height);
  }
  box.remove();
  const shown = isBetter ? first : parts.whole;
  return { text: isBetter ? new XMLSerializer().serializeToString(svg) : text, untitled: isBetter,
    least_px: kLeastOpening_px / least * shown.height,
    paper_px: kPaperWords_px / least * parts.whole.height };
}

const openingDrawings = new WeakMap();  // Each image → its drawing.

function setDrawing(image, text) {
  openingDrawings.set(image, inPageColours(text));
  image.src = svgUrl(highlighted(openingDrawings.get(image)));
}

function addImage(link, alt, drawing) {
  const figure = document.getElementById(link.hash.slice(1));
  const text = figure ? sourceOf(figure) : "";
  if (text === "") return;
  const image = link.querySelector("img") ?? new Image();
  image.alt = alt;
  setDrawing(image, drawing(text));
  link.prepend(image);
}

// A second image, which paper shows in place of one panel of a drawing: there is room for all of them.
function addWholeOnPaper(link, text) {
  const image = new Image();
  image.className = "whole";
  image.alt = "";
  setDrawing(image, text);
  link.append(image);
}

// The method that is chosen, in the images.
function highlightImages() {
  for (const image of document.querySelectorAll(".thumbnails img, .main-figure img")) {
    const drawing = openingDrawings.get(image);
    if (drawing) image.src = svgUrl(highlighted(drawing));
  }
}

const kLeastDrawn = .02;  // Of the pixels of a small image.

// The share of a drawing's pixels that differ from their commonest colour. The drawing has an image of
// its own, since that of the page gets another source once a method is chosen.
async function drawnShare(drawing) {
  const image = new Image();
  image.src = svgUrl(drawing);
  await image.decode();
  const canvas = new OffscreenCanvas(120, 60), kStep = 32;
  const context = canvas.getContext("2d");
  context.drawImage(image, 0, 0, canvas.width, canvas.height);
  const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
  const counts = new Map();
  for (let i = 0; i < data.length; i += 4) {
    const colour = data.slice(i, i + 4).map((value) => value / kStep).join();
    counts.set(colour, (counts.get(colour) ?? 0) + 1);
  }
  return 1 - 4 * Math.max(...counts.values()) / data.length;
}

// Small images that show next to nothing are left out.
async function dropEmpty(link) {
  const drawing = openingDrawings.get(link.querySelector("img"));
  if (!drawing || await drawnShare(drawing) >= kLeastDrawn) return;
  const list = link.closest(".thumbnails");
  link.closest("li").remove();
  if (list?.childElementCount === 0) list.remove();
}

// Waits until an image is decoded, whatever source it gets meanwhile.
async function waitForImage(image) {
  let src;
  do {
    ({ src } = image);
    await image.decode().catch(() => {});
  } while (image.src !== src);
}

const kThumbnail_px = 200;  // What small images have of width, if they are to be looked at.

// The small images stand beside the figure, below the words, as large as the figure's height leaves
// room for; where that is too little, in a row below both, as far as the first screen shows it. Where
// long sentences leave the first screen no room for all of them, the first ones are shown, a map in
// space before all, beside the figure or under it, where more of them are seen: fewer, rather than
// smaller, as long as there is room for any.
function placeThumbnails() {
  const list = document.querySelector(".thumbnails"), beside = document.querySelector(".glance > .beside");
  const figure = document.querySelector(".main-figure");
  if (!list || !beside) return;
  const place = (append, columns) => {
    append(list);
    list.style.setProperty("--columns", columns);
  };
  const toSide = (each) => beside.append(each);
  const fits = (append, columns, end) => {
    place(append, columns);
    return list.getBoundingClientRect().bottom <= end;
  };
  list.style.removeProperty("--columns");
  const items = [...list.children];
  for (const element of [list, ...items]) element.hidden = false;
  toSide(list);
  if (narrowPage.matches) return;
  const count = items.length, kSlack_px = 4;
  const foot = figure?.getBoundingClientRect().bottom ?? 0;
  const most = Math.max(1, Math.round(beside.clientWidth / kThumbnail_px));
  for (let columns = 1; columns <= most && columns <= count; ++columns) {
    if (fits(toSide, columns, foot + kSlack_px)) return;
  }
  const screenEnd = innerHeight - scrollY;
  const inRow = Math.max(count, most + 1);
  if (inRow * kThumbnail_px <= beside.parentElement.clientWidth &&
      fits((each) => beside.parentElement.after(each), inRow, screenEnd)) return;
  const end = Math.max(foot, screenEnd);
  if (fits(toSide, most, end)) return;
  const inSpace = items.find((item) => item.querySelector('a[href^="#figure-scene-"]'));
  if (inSpace) list.prepend(inSpace);
  const seenAt = (append, columns) => {
    place(append, columns);
    return { append, columns, seen: items.filter((item) => item.getBoundingClientRect().bottom <= end) };
  };
  let best = seenAt(toSide, most);
  if (figure) {
    const wide = Math.max(1, Math.floor(figure.clientWidth / kThumbnail_px));
    const under = seenAt((each) => figure.parentElement.append(each), wide);
    if (under.seen.length > best.seen.length) best = under;
  }
  if (best.seen.length === 0) best = seenAt(toSide, most + 1);
  if (best.seen.length === 0) {
    list.hidden = true;
    return;
  }
  place(best.append, best.columns);
  for (const item of items) item.hidden = !best.seen.includes(item);
}

// The small images are placed when those that show next to nothing are left out, and when the figure
// has its height.
async function addOpeningImages() {
  const links = [...document.querySelectorAll(".thumbnails a")];
  for (const link of links) addImage(link, "", cropped);  // The link has the title.
  addMainFigure();
  const figures = [...document.querySelectorAll(".main-figure img")];
  await Promise.all([...links.map(dropEmpty), ...figures.map(waitForImage)]);
  placeThumbnails();
}

// The figure is arranged again whenever its box has another width, as when a phone is turned.
function fitMainFigure() {
  const box = document.querySelector(".main-figure");
  if (!box) return;
  let width = box.clientWidth;
  new ResizeObserver(() => {
    if (box.clientWidth === width || matchMedia("print").matches) return;
    width = box.clientWidth;
    addOpeningImages();
  }).observe(box);
}

// Notes of a drawing as text below its image and its title.
function addNotesBelow(link, notes) {
  link.after(...notes.map((words) => {
    const note = document.createElement("small");
    note.textContent = words;
    return note;
  }));
}

function addMainFigure() {
  const link = document.querySelector(".main-figure a");
  if (!link) return;
  for (const old of link.parentElement.querySelectorAll("small, img.whole")) old.remove();
  const kBelow_px = 8, kBorders_px = 2, kTitleGap_px = 5;
  const kLeastHeight_px = 272, kMostHeight_px = 640;
  const { clientWidth } = link.parentElement;
  const left = innerHeight - link.getBoundingClientRect().top - scrollY - kBelow_px;
  if (clientWidth === 0) return;
  if (narrowPage.matches) {
    addImage(link, link.dataset.alt, (text) => {
      const shown = narrowed(text, clientWidth - kBorders_px, left);
      addNotesBelow(link, shown.notes);
      return shown.text;
    });
    return;
  }
  // As high as the first screen has room for, and higher where words could not be read.
  const height = Math.min(Math.max(left, kLeastHeight_px), kMostHeight_px);
  link.querySelector("img")?.classList.add("untitled");
  const title_px = height - kBorders_px - link.querySelector("bdi").offsetHeight - kTitleGap_px;
  let isUntitled = false;
  addImage(link, link.dataset.alt, (text) => {
    const whole = readable(text, clientWidth - kBorders_px, height - kBorders_px);
    const shown = whole.untitled ? readable(text, clientWidth - kBorders_px, title_px) : whole;
    isUntitled = shown.untitled;
    if (isUntitled) addWholeOnPaper(link, text);
    const most_px = Math.max(isUntitled ? title_px : height - kBorders_px, shown.least_px);
    link.parentElement.style.setProperty("--most",
      `${Math.min(most_px, kMostHeight_px) + kBorders_px}px`);
    link.parentElement.style.setProperty("--paper-height", `${shown.paper_px + kBorders_px}px`);
    return shown.text;
  });
  link.querySelector("img")?.classList.toggle("untitled", isUntitled);
}
