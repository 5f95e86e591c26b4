// Frames that are wider than a narrow page get narrower, with their ticks, marks and words: lines and
// words keep their size. Maps and images keep their proportions.

const widths = new WeakMap();  // A narrowed <svg> → what to put back: attributes and frames.

function keepAndSet(svg, element, name, value) {
  widths.get(svg).attributes.push([element, name, element.getAttribute(name)]);
  element.setAttribute(name, value);
}

// Undoes narrowFrames().
function widenFrames(svg, parts) {
  const kept = widths.get(svg);
  if (!kept) return;
  for (const [element, name, value] of kept.attributes.reverse()) {
    if (value === null) element.removeAttribute(name);
    else element.setAttribute(name, value);
  }
  parts.frames.forEach((frame, i) => Object.assign(frame, kept.frames[i]));
  widths.delete(svg);
}

// The data of a path as mapproof writes it: relative commands, of which the first names a point.
function scaledPath(data, at, across, down) {
  let isFirst = true;
  return data.replace(/([mlqc])([^a-z]*)/g, (all, command, numbers) => {
    const values = (numbers.match(/-?(?:\d+\.?\d*|\.\d+)/g) ?? []).map(Number);
    const pairs = [];
    for (let i = 0; i + 1 < values.length; i += 2) {
      const [x, y] = values.slice(i, i + 2);
      const point = isFirst ? at({ x, y }) : { x: across * x, y: down * y };
      isFirst = false;
      pairs.push(`${Number(point.x.toFixed(2))} ${Number(point.y.toFixed(2))}`);
    }
    return command + pairs.join(" ");
  });
}

// Whether both axes of a frame have one scale, as those of maps, or it is an image.
function hasOneScale(panel, { axes: [x, y], width, height }) {
  if (panel.some((part) => kindOf(part) === "image")) return true;
  if (x?.scale !== "linear" || y?.scale !== "linear") return false;
  const across = (x.high - x.low) / width, up = (y.high - y.low) / height;
  return Math.abs(across - up) < .001 * up;
}

const isWords = (element) => /scale\(/.test(element.getAttribute("transform") ?? "");

function moveWords(svg, words, right, down) {
  const { x, y } = positionOf(words);
  keepAndSet(svg, words, "transform", words.getAttribute("transform")
    .replace(/translate\([^)]*\)/, `translate(${x + right} ${y + down})`));
}

// Where words are held: by their side that is nearer to that of the frame, or by their middle.
function holdOf(box, frame) {
  const middle = box.x + box.width / 2, share = (middle - frame.x) / frame.width;
  return { x: share < 1 / 3 ? box.x : share > 2 / 3 ? box.x + box.width : middle,
    y: box.y + box.height / 2 };
}

// Marks and ellipses about them.
function shapesOfMarks(panel) {
  return panel.filter((part) => kindOf(part) === "marker").flatMap(
    (part) => (part.localName === "g" ? [...part.querySelectorAll("use, path")] : [part]));
}

// The lines that lead from marks to their names, each with its ends.
function leadersOf(panel) {
  const kLine = /^m(-?[\d.]+) (-?[\d.]+)l(-?[\d.]+) ?(-?[\d.]+)$/;
  const paths = panel.filter((part) => kindOf(part) === "leader")
    .flatMap((part) => [...part.querySelectorAll("path")]);
  return paths.flatMap((path) => {
    const [x, y, right, down] = (kLine.exec(path.getAttribute("d")) ?? []).slice(1).map(Number);
    return down === undefined ? [] : [{ path, from: { x, y }, to: { x: x + right, y: y + down } }];
  });
}

// Of points, or what has one, the nearest to a box within a reach; null without one.
function nearestTo(box, all, reach, pointOfOne = (one) => one) {
  const off = (one) => {
    const { x, y } = pointOfOne(one);
    return Math.hypot(Math.max(0, box.x - x, x - box.x - box.width),
      Math.max(0, box.y - y, y - box.y - box.height));
  };
  const nearest = all.reduce((best, one) => (best && off(best) <= off(one) ? best : one), null);
  return nearest && off(nearest) < reach ? nearest : null;
}

// The mark that words stand beside: the one that a line leads to them from, else the nearest one
// within a line of text.
function markBeside(box, marks, leader) {
  if (leader) return nearestTo({ ...leader.from, width: 0, height: 0 }, marks, Infinity);
  return nearestTo(box, marks, box.height);
}

// How far words move that stand in a frame or beside it: with their mark, if they have one.
function shiftOfWords(box, mark, { before, after, at }) {
  const hold = holdOf(box, before);
  if (isBesideFrame(box, before)) {
    return { x: hold.x < before.x ? 0 : after.right - before.right, y: at(hold).y - hold.y };
  }
  const held = mark ?? hold, moved = at(held);
  return { x: moved.x - held.x, y: moved.y - held.y };
}

function isBesideFrame(box, frame) {
  const { x } = holdOf(box, frame);
  return x > frame.right || x < frame.x;
}

const touches = (a, b) => a.x < b.x + b.width && b.x < a.x + a.width && a.y + 1 < b.y + b.height &&
  b.y + 1 < a.y + a.height;

// Where a name stands that moves with its mark: as far from it as before, on the first side of it
// where it is on no mark and no other name, moved along into the frame; a line leads also to one that
// is farther. Null if there is none.
function placeOfName(box, mark, leader, { after, at, taken }) {
  const kLine = 1.2;
  const moved = at(mark), { width, height } = box;
  const right = box.x - mark.x, below = box.y - mark.y;
  const farther = (below + height / 2 < 0 ? -1 : 1) * kLine * height;
  const rows = (leader ? [0, farther] : [0]).flatMap((off) => [below + off, -below - height - off]);
  const places = rows.flatMap((y) => [right, -right - width].map(
    (x) => ({ x: Math.max(after.x, Math.min(moved.x + x, after.right - width)),
      y: moved.y + y, width, height })));
  return places.find((place) => place.y >= after.y && place.y + height <= after.bottom &&
    !taken.some((other) => touches(place, other))) ?? null;
}

// Leads a line from a mark to where its name stands now.
function leadTo(svg, { path, from }, mark, moved, place) {
  const to = { x: Math.min(Math.max(moved.x, place.x), place.x + place.width),
    y: Math.min(Math.max(moved.y, place.y), place.y + place.height) };
  const x = to.x - moved.x, y = to.y - moved.y, length = Math.max(Math.hypot(x, y), 1e-9);
  const rim = Math.min(1, Math.hypot(from.x - mark.x, from.y - mark.y) / length), rest = 1 - rim;
  keepAndSet(svg, path, "d",
    `m${moved.x + rim * x} ${moved.y + rim * y}l${rest * x} ${rest * y}`);
}

// Hides words that would be on others, the later ones, with the lines that lead to them.
function hideCrowded(svg, words, leaderOf) {
  const taken = [];
  for (const each of words) {
    const box = boxIn(svg, each);
    if (taken.some((other) => touches(box, other))) {
      for (const one of [each, leaderOf.get(each)?.path].filter(Boolean)) {
        keepAndSet(svg, one, "display", "none");
      }
    } else taken.push(box);
  }
}

// Every second tick label below a frame, or every third, so that none touches the next one.
function thinLabels(svg, labels) {
  const kApart = 5;
  const boxes = labels.map((label) => boxIn(svg, label));
  const isApart = (stride) => boxes.filter((box, i) => i % stride === 0).every(
    (box, i, all) => i === 0 || all[i - 1].x + all[i - 1].width + kApart < box.x);
  let stride = 1;
  while (stride < labels.length && !isApart(stride)) ++stride;
  labels.forEach((label, i) => {
    if (i % stride !== 0) keepAndSet(svg, label, "display", "none");
  });
}

// What moves words back that end right of `end`, as far as there is room in the frame.
function backInto(frame, end, x, width) {
  const over = x + width - end;
  return over <= 0 ? 0 : Math.max(-over, Math.min(0, frame.x - x));
}

// Moves the name of a mark, or other words in a frame or beside it.
function moveLabel(svg, part, words, box, change) {
  const { before, after, at, marks, leaders, leaderOf, beside, taken } = change;
  const isName = kindOf(part) === "mark-label";
  const leader = isName ? nearestTo(box, leaders, box.height, ({ to }) => to) : null;
  const mark = isBesideFrame(box, before) ? null : markBeside(box, marks, leader);
  const shift = shiftOfWords(box, mark, change);
  let place = { ...box, x: box.x + shift.x, y: box.y + shift.y };
  if (isName) {
    // Names that stood in the frame stay in it, those beside it in the room there.
    const end = after.right + (box.x + box.width <= before.right ? 0 : beside);
    place.x += backInto(after, end, place.x, place.width);
    if (mark) place = placeOfName(box, mark, leader, change) ?? place;
    taken.push(place);
  }
  moveWords(svg, words, place.x - box.x, place.y - box.y);
  if (!leader || !mark) return;
  leaderOf.set(words, leader);
  leadTo(svg, leader, mark, at(mark), place);
}

function narrowPart(svg, part, change) {
  const { before, after, across, down, at } = change;
  const elements = [part, ...part.querySelectorAll("*")];
  for (const element of elements.filter((each) => !each.closest("[transform*='scale(']"))) {
    if (element.localName === "path") {
      keepAndSet(svg, element, "d", scaledPath(element.getAttribute("d"), at, across, down));
    } else if (element.hasAttribute("x")) {
      const point = at({ x: Number(element.getAttribute("x")), y: Number(element.getAttribute("y")) });
      for (const name of ["x", "y"]) keepAndSet(svg, element, name, point[name]);
      if (element.localName !== "image") continue;
      for (const [name, factor] of [["width", across], ["height", down]]) {
        keepAndSet(svg, element, name, factor * Number(element.getAttribute(name)));
      }
    }
  }
  for (const words of elements.filter(isWords)) {
    const box = boxIn(svg, words), middle = { x: box.x + box.width / 2, y: box.y + box.height / 2 };
    let shift;
    if (kindOf(part) === "panel-title") {
      const isCentred = Math.abs(middle.x - before.x - before.width / 2) < 3;
      shift = { x: isCentred ? (after.width - before.width) / 2 : 0, y: 0 };
    } else if (kindOf(part) === "tick-label") {
      shift = isBelowFrame(words, before)
        ? { x: at(middle).x - middle.x, y: after.bottom - before.bottom }
        : { x: middle.x > before.right ? after.right - before.right : 0, y: at(middle).y - middle.y };
    } else {
      moveLabel(svg, part, words, box, change);
      continue;
    }
    moveWords(svg, words, shift.x, shift.y);
  }
}

// How low a frame can get with its tick labels one above the other.
function leastShare(svg, { left }) {
  const kLine = 1.05;
  const boxes = left.map((label) => boxIn(svg, label)).sort((a, b) => a.y - b.y);
  const shares = boxes.slice(1).map((box, i) => kLine * box.height / (box.y - boxes[i].y));
  return Math.min(1, Math.max(.3, ...shares));
}

// How low the frame of a panel can get that should be no higher than `height`; `owners` are the
// frames of the axis labels.
function lowestShare(svg, parts, owners, i, height) {
  const frame = parts.frames[i];
  const beside = parts.axes.filter((label, k) => isUpright(label) && owners[k] === frame);
  const longest = Math.max(0, ...beside.map((label) => boxIn(svg, label).height));
  return Math.max(Math.min(1, Math.max(height, longest) / frame.height),
    leastShare(svg, tickLabelsOf(parts.panels[i], frame)));
}

// Makes frames so narrow that they need no more than `most` with what is around them, and so wide that
// they need `least`; those whose axes have scales of their own also as low as `height`, if that is less.
function narrowFrames(svg, parts, rooms, most, height = Infinity, least = 0) {
  widths.set(svg, { attributes: [], frames: parts.frames.map((frame) => ({ ...frame })) });
  const around = rooms.left + rooms.right;
  const owners = parts.axes.map((label) => frameOfLabel(label, parts.frames));  // Before any moves.
  // Frames that share an axis have its labels beside one of them: all get as low as that one can.
  const lowest = height === Infinity ? 1 : Math.max(
    ...parts.frames.map((frame, i) => lowestShare(svg, parts, owners, i, height)));
  parts.frames.forEach((frame, i) => {
    const panel = parts.panels[i];
    const across = Math.min(Math.max(1, (least - around) / frame.width), (most - around) / frame.width);
    const down = hasOneScale(panel, frame) ? across : height < frame.height ? lowest : 1;
    const before = { ...frame };
    const at = ({ x, y }) => ({ x: before.x + across * (x - before.x),
      y: before.y + down * (y - before.y) });
    const after = { ...at(before), width: across * before.width, height: down * before.height };
    after.right = after.x + after.width;
    after.bottom = after.y + after.height;
    const { marks } = contentOf(panel, before);
    const change = { before, after, across, down, at, beside: rooms.right - kEdge,
      marks: marks.map(({ element, x, y }) => ({ element, x, y })), leaders: leadersOf(panel),
      leaderOf: new Map(), taken: [] };
    const axes = parts.axes.filter((label, k) => owners[k] === frame)
      .map((label) => ({ label, box: boxIn(svg, label) }));
    const isLabel = (part) => kindOf(part) === "mark-label";
    for (const part of panel.filter((each) => !isLabel(each))) narrowPart(svg, part, change);
    change.taken.push(...shapesOfMarks(panel).map((shape) => boxIn(svg, shape)));
    for (const part of panel.filter(isLabel)) narrowPart(svg, part, change);
    for (const { label, box } of axes) {
      const middle = { x: box.x + box.width / 2, y: box.y + box.height / 2 };
      const moved = at(middle);
      moveWords(svg, label, isUpright(label) ? 0 : moved.x - middle.x,
        isUpright(label) ? moved.y - middle.y : after.bottom - before.bottom);
    }
    for (const name of ["width", "height"]) keepAndSet(svg, frame.clip, name, after[name]);
    Object.assign(frame, after);
    thinLabels(svg, tickLabelsOf(panel, frame).below);
    hideCrowded(svg, panel.filter((part) => kindOf(part) === "mark-label")
      .flatMap((part) => [part, ...part.querySelectorAll("*")].filter(isWords)), change.leaderOf);
  });
}
