// The legend of a drawing as one block below it, in columns, in the order of its lines: also of lines
// that are labelled at their ends. A colour bar is horizontal.

const drawnValues = new WeakMap();  // A stacked <svg> → [element, attribute, value] of its legend.

// A sample of the legend with its words, or several samples before one text.
function legendEntries(parts) {
  const entries = [];
  let isOpen = false;
  for (const part of parts.rest.filter((each) => /^legend-(sample|text)$/.test(kindOf(each)))) {
    const isText = part.classList.contains("legend-text");
    if (!isOpen) entries.push([]);
    entries.at(-1).push(part);
    isOpen = !isText;
  }
  return entries;
}

function boxOfAll(svg, parts) {
  const boxes = parts.map((part) => boxIn(svg, part));
  const x = Math.min(...boxes.map((box) => box.x)), y = Math.min(...boxes.map((box) => box.y));
  return { x, y, width: Math.max(...boxes.map((box) => box.x + box.width)) - x,
    height: Math.max(...boxes.map((box) => box.y + box.height)) - y };
}

// Which entries stand in a panel, or beside or below it in a drawing of one column, and which are of
// all panels.
function legendsOf(svg, parts, isSplit) {
  const frames = widths.get(svg)?.frames ?? parts.frames;  // As drawn, before they got narrower.
  const isColumn = frames.every((frame) => frame.x < frames[0].right && frames[0].x < frame.right);
  const own = parts.frames.map(() => []), shared = [];
  const all = legendEntries(parts).map((entry) => {
    const { x, y, width, height } = boxOfAll(svg, entry);
    return { entry, at: { x: x + width / 2, y: y + height / 2 } };
  });
  // Where a legend stands between two panels of a column, each has its own.
  const isBelow = (at, i) => at.y > frames[i].bottom &&
    (i + 1 === frames.length || at.y < frames[i + 1].y);
  const haveOwn = isColumn &&
    all.some(({ at }) => frames.slice(0, -1).some((frame, i) => isBelow(at, i)));
  for (const { entry, at } of all) {
    let panel = frames.findIndex((frame) => at.y > frame.y && at.y < frame.bottom &&
      at.x > frame.x && (isColumn || at.x < frame.right));
    if (panel < 0 && haveOwn) panel = frames.findIndex((frame, i) => isBelow(at, i));
    (isSplit && panel >= 0 && parts.frames.length > 1 ? own[panel] : shared).push(entry);
  }
  return { own, shared };
}

// Sets an attribute of a legend; restoreLegend() gives it back its value.
function setForNow(svg, element, name, value) {
  if (!drawnValues.has(svg)) drawnValues.set(svg, []);
  drawnValues.get(svg).push([element, name, element.getAttribute(name)]);
  element.setAttribute(name, value);
}

function restoreLegend(svg) {
  for (const [element, name, value] of (drawnValues.get(svg) ?? []).reverse()) {
    if (value === null) element.removeAttribute(name);
    else element.setAttribute(name, value);
  }
  drawnValues.delete(svg);
}

// The line that leads from the end of a curve to its label becomes level.
function levelSamples(svg, entry) {
  const pattern = /^m(-?[\d.]+) (-?[\d.]+)l(-?[\d.]+) ?(-?[\d.]+)$/;
  for (const path of entry.flatMap((part) => [...part.querySelectorAll("path")])) {
    const data = path.getAttribute("d"), found = pattern.exec(data);
    if (!found || Number(found[4]) === 0) continue;
    const [x, y, right, down] = found.slice(1).map(Number);
    setForNow(svg, path, "d", `m${x} ${y + down}l${right} 0`);
  }
}

// The glyphs of a text in lines of that width at most, in its units, broken after a space where there
// is one.
function brokenLines(glyphs, room) {
  const lines = [];
  let left = glyphs;
  while (left.length > 0) {
    const over = left.findIndex(({ end }) => end - left[0].at > room);
    const most = over < 0 ? left.length : Math.max(1, over);
    const space = over < 0 ? -1 : left.slice(0, most).findLastIndex(({ isSpace }) => isSpace);
    const count = space < 0 ? most : space + 1;
    lines.push(left.slice(0, count));
    left = left.slice(count);
  }
  return lines;
}

// Breaks words that are wider than their room into lines. Returns the height that this adds.
function breakWords(svg, words, room) {
  const kLineHeight = 1.2;
  const scale = Number(/scale\(([\d.]+)/.exec(words.getAttribute("transform") ?? "")?.[1]);
  if (!(scale > 0) || isUpright(words) || boxIn(svg, words).width <= room) return 0;
  const drawn = [...words.querySelectorAll("use")], text = [...words.dataset.words ?? ""];
  const isKept = (i) => text.length === drawn.length && text[i] === "\u00a0";
  const glyphs = drawn.map((glyph, i) => {
    const { x, width } = glyph.getBBox();  // A space has no outline.
    return { glyph, at: Number(glyph.getAttribute("x") ?? 0), end: x + width,
      isSpace: width === 0 && !isKept(i) };
  });
  const lines = brokenLines(glyphs, room / scale);
  lines.slice(1).forEach((line, i) => {
    for (const { glyph, at } of line) {
      setForNow(svg, glyph, "x", at - line[0].at + glyphs[0].at);
      setForNow(svg, glyph, "y", (i + 1) * kLineHeight * kUnitsOfFont);
    }
  });
  return Math.max(0, lines.length - 1) * kLineHeight * kUnitsOfFont * scale;
}

// The bar of a scale of colours: many samples above each other, the first as high as all.
function isColourBar(svg, entry) {
  const kFewestColours = 8, kUpright = 4;
  if (entry.length < kFewestColours) return false;
  const { width, height } = boxIn(svg, entry[0]);
  return height > kUpright * width;
}

// A horizontal copy of a colour bar, with its numbers below it and its name after them. Returns its
// foot.
function layColourBar(svg, entry, width, top, layers) {
  const bar = boxIn(svg, entry[0]), words = [...entry.at(-1).children];
  const colours = entry.slice(0, -1).map((part) => part.getAttribute("fill"))
    .filter((fill) => fill && fill !== "none");
  const name = words.find(isUpright), numbers = words.filter((each) => each !== name);
  const kSide = 24, long = width - 2 * kSide;
  const layer = document.createElementNS(svg.namespaceURI, "g");
  layer.setAttribute("class", "step-axes");
  colours.forEach((fill, i) => {
    const piece = document.createElementNS(svg.namespaceURI, "rect");
    const box = { x: kSide + i * long / colours.length, y: top, height: bar.width,
      width: long / colours.length + (i + 1 < colours.length ? .5 : 0), fill };
    for (const [key, value] of Object.entries(box)) piece.setAttribute(key, value);
    layer.append(piece);
  });
  let foot = top + bar.width, end = -Infinity;
  const below = foot + 4;
  const placed = numbers.map((label) => ({ label, box: boxIn(svg, label) })).map((each) => ({ ...each,
    x: kSide + long * (bar.y + bar.height - each.box.y - each.box.height / 2) / bar.height }))
    .sort((a, b) => a.x - b.x);
  for (const { label, box, x } of placed) {
    const left = x - box.width / 2;
    if (left < end + 6) continue;
    end = left + box.width;
    addCopy(layer, label, left - box.x, below - box.y);
    foot = Math.max(foot, below + box.height);
  }
  if (name) {
    const copy = addCopy(layer, name, 0, 0);
    copy.firstChild.setAttribute("transform", /scale\([^)]*\)/.exec(
      name.getAttribute("transform"))[0]);
    svg.append(layer);
    const box = boxIn(svg, copy);
    copy.setAttribute("transform",
      `translate(${(width - box.width) / 2 - box.x} ${foot + 3 - box.y})`);
    foot += box.height + 3;
  }
  for (const part of entry) part.classList.add("off");
  layers.push(layer);
  return foot + 8;
}

// Puts entries of a legend in columns from `top` on. Returns their foot.
function placeEntries(svg, entries, width, top, layers = []) {
  const kGap = 14, kLine = 4, kLeft = 6;
  const bars = entries.filter((entry) => isColourBar(svg, entry));
  const others = entries.filter((entry) => !bars.includes(entry));
  let foot = top;
  for (const bar of bars) foot = layColourBar(svg, bar, width, foot, layers);
  if (others.length === 0) return foot;
  for (const entry of others) levelSamples(svg, entry);
  // Words begin below each other, however wide the samples before them are.
  const leads = others.map((entry) => boxIn(svg, entry.at(-1)).x - boxOfAll(svg, entry).x);
  const lead = Math.max(...leads), room = width - 2 * kLeft - lead;
  const added = others.map((entry) => Math.max(0, ...[...entry.at(-1).children].map(
    (words) => breakWords(svg, words, room))));
  const boxes = others.map((entry) => boxOfAll(svg, entry));
  const column = Math.max(...boxes.map((box, i) => box.width + lead - leads[i])) + kGap;
  const row = Math.max(...boxes.map((box, i) => box.height - added[i])) + kLine;
  const columns = Math.max(1, Math.floor((width - 2 * kLeft + kGap) / column));
  for (let first = 0; first < others.length; first += columns) {
    const last = Math.min(first + columns, others.length);
    for (let i = first; i < last; ++i) {
      const { x, y, height } = boxes[i];
      movePanel(others[i], { x: kLeft + (i - first) * column + lead - leads[i] - x,
        y: foot + (row - (height - added[i])) / 2 - y });
    }
    foot += row + Math.max(...added.slice(first, last));
  }
  return foot + 8;
}
