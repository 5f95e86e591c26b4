// The point of a curve that is nearest to the pointer, or stepped to by keys, gets a tip: its series,
// where it is on both axes, with their names and units, and its 95 % interval if that is drawn. One
// listener of each kind serves a whole drawing; values are read when they are first asked for.

const kReachOfValues = 30;  // Greatest distance of the pointer from a point, in pixels.
const kLeastShare = 1e-4;  // Of an axis: what a drawn point cannot tell from 0.
const kMostOff = .6;  // Of what is drawn at one place, in units of the drawing.
const keptValues = new WeakMap();  // <svg> → its frames and marks as drawn, and what they say.
const shapesNow = new WeakMap();  // A path → its data and their points.
let valueShown = null;  // { svg, value, isPinned }.

// The points of a path as mapproof writes it, by relative commands; each knows if a part begins there.
function pointsOfPath(data) {
  const points = [];
  let x = 0, y = 0;
  for (const [, command, text] of data.matchAll(/([mlhvqcz])([^a-z]*)/g)) {
    const numbers = (text.match(/-?(?:\d+\.?\d*|\.\d+)/g) ?? []).map(Number);
    const size = { h: 1, v: 1, q: 4, c: 6 }[command] ?? 2;
    for (let i = 0; i + size <= numbers.length; i += size) {
      if (command !== "v") x += numbers[i + (size > 2 ? size - 2 : 0)];
      if (command !== "h") y += numbers[i + size - 1];
      points.push({ x, y, begins: command === "m" && i === 0 });
    }
  }
  return points;
}

function pathNow(path) {
  const data = path.getAttribute("d"), known = shapesNow.get(path);
  if (known?.data === data) return known.points;
  const points = pointsOfPath(data);
  shapesNow.set(path, { data, points });
  return points;
}

// "MPE [m]" as a name and a unit.
function readAxisLabel(label) {
  const text = label?.dataset.words ?? "";
  const [, name, unit] = /^(.*?)\s*\[([^\]]+)\]$/.exec(text) ?? [null, text, ""];
  return { name, unit };
}

// What the axes of a frame count; panels share the labels of their axes.
function labelsOfFrame(labels, frame) {
  const nearest = (upright) => labels.filter((label) => isUpright(label) === upright)
    .map((label) => ({ label, at: positionOf(label) }))
    .map(({ label, at }) => ({ label, off: upright
      ? Math.hypot(frame.x - at.x, Math.max(0, frame.y - at.y, at.y - frame.bottom))
      : Math.hypot(at.y - frame.bottom, Math.max(0, frame.x - at.x, at.x - frame.right)) }))
    .sort((a, b) => a.off - b.off)[0]?.label;
  return [readAxisLabel(nearest(false)), readAxisLabel(nearest(true))];
}

// Before anything is moved: the frames and their labels, and where the marks are. Returns if there
// are any.
function keepValues(figure, svg) {
  const marks = [...svg.querySelectorAll(kOfMethods)].filter(({ dataset, localName }) =>
    dataset.landmark === undefined && dataset.kind !== "interval" &&
    /^(use|path|g)$/.test(localName));
  if (marks.length === 0 || framesOf(svg).length === 0) return;
  const placeOf = (use) => ({ x: Number(use.getAttribute("x")), y: Number(use.getAttribute("y")) });
  const place = (mark) => (mark.localName === "use" ? placeOf(mark)
    : (mark.querySelector("path") ?? mark).getAttribute("d"));
  const markers = (mark) => [...mark.querySelectorAll("use.marker")]
    .map((element) => ({ element, place: placeOf(element) }));
  const bars = [...svg.querySelectorAll(
    "g.line[clip-path] > path:is(:not([data-curve]), [data-kind=interval])")];
  keptValues.set(svg, {
    frames: framesOf(svg),
    marks: marks.map((mark) => ({ mark, at: place(mark), markers: markers(mark) })),
    bars: bars.map((path) => ({ path, at: path.getAttribute("d") })),
    labels: [...svg.querySelectorAll(":scope > .axis-label > *")],
    // Bands are intervals, bars if the drawing or its caption says so.
    hasBars: /95[ \u00a0]% interval/.test([...svg.querySelectorAll(".legend-text > *")].map(
      (words) => words.dataset.words).join() + figure.querySelector("figcaption")?.textContent),
  });
}

function frameOfMark(frames, element, point) {
  const clip = element.closest("[clip-path]") ?? element.querySelector("[clip-path]");
  const number = /-c(\d+)\)$/.exec(clip?.getAttribute("clip-path") ?? "")?.[1];
  return number === undefined ? frameNear(frames, point) : Number(number);
}

// The value of an axis at a point of the drawing; none where it counts names.
function valueAt(frame, axis, point) {
  if (!frame.axes[axis]) return undefined;
  const share = axis === 0 ? (point.x - frame.x) / frame.width
    : (frame.bottom - point.y) / frame.height;
  const { scale, low, high } = frame.axes[axis], value = rangeShown(frame.axes[axis], share, share).low;
  const isZero = scale !== "log" && Math.abs(value) < kLeastShare * Math.abs(high - low);
  return isZero ? 0 : value;
}

// Bars, whose ends are two points of one path, and bands, whose outline has two at each place.
function readIntervals(path, data, isBand) {
  const points = pointsOfPath(data), found = [];
  const starts = points.flatMap((point, i) => (point.begins ? [i] : []));
  for (const [k, start] of starts.entries()) {
    const end = starts[k + 1] ?? points.length;
    if (end - start === 2) {
      found.push({ path, ends: [start, start + 1], isBar: true, x: points[start].x });
      continue;
    }
    for (let i = start; isBand && i < end; ++i) {
      const other = points.slice(i + 1, end).findIndex(
        ({ x, y }) => Math.abs(x - points[i].x) < .02 && y !== points[i].y);
      if (other >= 0) found.push({ path, ends: [i, i + 1 + other], x: points[i].x });
    }
  }
  return found.map((each) => ({ ...each, drawn: each.ends.map((end) => points[end]) }));
}

// What a tip calls a mark: lines of one name in the legend differ by their settings.
function nameInTip({ setting, curve, method }) {
  return setting ?? curve ?? method;
}

// Each point of a curve has what its mark says, or what its place does.
function readCurve({ mark, at, markers }, frames) {
  const { dataset } = mark, name = nameInTip(dataset);
  const said = (dataset.points ?? "").split(";").filter(Boolean).map((pair) => {
    const cut = pair.lastIndexOf(", ");
    return [pair.slice(0, cut), pair.slice(cut + 2)];
  });
  const kind = dataset.kind ?? /-(ours|published)-\d+-/.exec(mark.id)?.[1] ?? "";
  const values = (element, places, words) => {
    if (places.length === 0) return [];
    const number = frameOfMark(frames, element, places[0]), frame = frames[number];
    return places.map((place, i) => {
      const [x, y] = words[i] ?? [valueAt(frame, 0, place), valueAt(frame, 1, place)];
      return { name, kind, number, place, x, y, over: dataset.over };
    });
  };
  if (mark.localName === "use") {
    const words = dataset.x === undefined ? said : [[dataset.x, dataset.y]];
    return values(mark, [at], words).map((value) => ({ ...value, element: mark }));
  }
  const path = mark.localName === "path" ? mark : mark.querySelector("path");
  const isMarked = markers.length > 0 && (!path || markers.length >= said.length);
  if (!path && !isMarked) return [];
  const places = isMarked ? markers.map((each) => each.place) : pointsOfPath(at);
  return values(path ?? mark, places, said.length === places.length ? said : []).map((value, i) => (
    isMarked ? { ...value, element: markers[i].element }
      : { ...value, element: path, vertex: i }));
}

// The interval of a point: of its curve the nearest one, of a dot the bar through it.
function intervalOf(value, bands, bars) {
  const along = ({ drawn: [a, b] }) => {
    const { x, y } = value.place, within = (p, q, r) => Math.min(q, r) - kMostOff <= p &&
      p <= Math.max(q, r) + kMostOff;
    return within(x, a.x, b.x) && within(y, a.y, b.y) &&
      (Math.abs(a.x - b.x) < .02 || Math.abs(a.y - b.y) < .02);
  };
  const own = (bands.get(value.name) ?? []).filter(({ number }) => number === value.number);
  const off = (each) => Math.abs(each.x - value.place.x);
  const nearest = own.reduce((best, each) => (!best || off(each) < off(best) ? each : best), null);
  const isNear = nearest && (nearest.isBar ? off(nearest) < .5 * value.gap : off(nearest) < .05);
  return isNear ? nearest : bars.find((bar) => bar.number === value.number && along(bar));
}

// All points of a drawing, those of a curve together.
function valuesOf(svg) {
  const drawn = keptValues.get(svg);
  if (drawn.values) return drawn.values;
  const { frames, marks } = drawn;
  const isBand = ({ mark }) => mark.closest("g.band") !== null;
  const intervals = ({ path, at }, isOfBand = false) => readIntervals(path, at, isOfBand)
    .map((each) => ({ ...each, number: frameOfMark(frames, path, each.drawn[0]) }));
  const bands = new Map();
  for (const { mark, at } of marks.filter(isBand)) {
    const name = nameInTip(mark.dataset);
    bands.set(name, [...bands.get(name) ?? [], ...intervals({ path: mark, at }, true)]);
  }
  const bars = drawn.hasBars ? drawn.bars.flatMap((bar) => intervals(bar)) : [];
  drawn.values = marks.filter((each) => !isBand(each)).flatMap((each) => {
    const values = readCurve(each, frames), xs = values.map(({ place }) => place.x);
    const gaps = xs.slice(1).map((x, i) => Math.abs(x - xs[i])).filter((gap) => gap > 0);
    const gap = Math.min(40, ...gaps);
    return values.map((value) => ({ ...value, gap }));
  });
  for (const value of drawn.values) {
    if (value.kind === "" || value.kind === "ours") value.interval = intervalOf(value, bands, bars);
  }
  return drawn.values;
}

function numberOnAxis(value) {
  const number = Number(value), size = Math.abs(number);
  if (size === 0) return "0";
  if (size >= 1e6 || size < 1e-4) return powerWords(number.toExponential(2)).replace("-", "\u2212");
  const decimals = clamp(2 - Math.floor(Math.log10(size)), 0, 6);
  return number.toFixed(decimals).replace("-", "\u2212");
}

function withAxisUnit(words, unit) {
  if (unit.startsWith("10")) return `${words}\u00d7${unit}`;  // A power of ten.
  return unit === "" ? words : unit === "\u00b0" ? words + unit : `${words}\u00a0${unit}`;
}

// What the axis names at that place of the window.
function nameBelow(svg, at) {
  const labels = [...svg.querySelectorAll(".tick-label > [data-words], .tick-copy [data-words]")]
    .map((label) => ({ label, box: label.getBoundingClientRect() }))
    .filter(({ box }) => box.width > 0 && box.top > at.y)
    .map(({ label, box }) => ({ words: label.dataset.words,
      off: Math.abs((box.left + box.right) / 2 - at.x) + .01 * (box.top - at.y) }))
    .sort((a, b) => a.off - b.off);
  return labels[0]?.off < kReachOfValues ? labels[0].words : "";
}

// "nightly run 4" of a name that begins with a number.
function nameOnAxis({ name }, words) {
  return /^\d/.test(words) ? `${name.split(/[,:]/)[0]} ${words}`.trim() : words;
}

// The lines of a tip below its name.
function wordsOfValue(svg, value) {
  const { frames, labels } = keptValues.get(svg), frame = frames[value.number];
  const [across, up] = labelsOfFrame(labels, frame), lines = [];
  const isName = Number.isNaN(Number(value.x ?? NaN));
  const words = (given) => (String(given).length <= 6 ? String(given).replace("-", "\u2212")
    : numberOnAxis(given));
  const line = (label, text) => [label.name, withAxisUnit(text, label.unit)].filter(Boolean).join(" ");
  const isOver = (number) => Number(number) > Number(value.over);
  if (value.x !== undefined && isName) lines.push(value.x);
  else if (frame.axes[0]) lines.push(line(across, words(value.x)));
  else lines.push(nameOnAxis(across, nameBelow(svg, placesNow(svg).of(value))));
  if (value.y !== undefined) {
    lines.push(isOver(value.y) ? `${up.name} ${errorWords(value.y)}`
      : line(up, numberOnAxis(value.y)));
  }
  if (value.interval) {
    const [a, b] = value.interval.drawn, axis = Math.abs(a.x - b.x) < .02 ? 1 : 0;
    const unit = [across, up][axis].unit;
    const [low, high] = [a, b].map((point) => valueAt(frame, axis, point)).sort((p, q) => p - q);
    const { scale, low: least } = frame.axes[axis], isCut = scale === "log" && low < .99 * least;
    const from = isCut ? `under ${numberOnAxis(least)}` : numberOnAxis(low);
    const to = isOver(high) ? errorWords(high) : withAxisUnit(numberOnAxis(high), unit);
    lines.push(`95\u00a0% interval ${from} to ${to}`);
  }
  return lines.filter(Boolean);
}

function nameOfValue({ name, kind }) {
  return kind === "" ? name : `${name}, ${kind === "single runs" ? "a single run" : kind}`;
}

// Where points are in the window now, and if they are shown: what the points of one element share is
// read once.
function placesNow(svg) {
  const clips = svg.querySelectorAll(":scope > defs > clipPath > rect"), known = new Map();
  const once = (key, make) => {
    if (!known.has(key)) known.set(key, make());
    return known.get(key);
  };
  const isOff = (element) => element.closest(".off, .outside") !== null;
  const read = (element, number) => once(element, () => {
    const [x, y, width, height] = ["x", "y", "width", "height"].map(
      (name) => Number(clips[number].getAttribute(name)));
    return { matrix: element.getScreenCTM(), points: pathNow(element), isOff: isOff(element),
      left: x - kMostOff, right: x + width + kMostOff, top: y - kMostOff,
      bottom: y + height + kMostOff };
  });
  const moved = ({ a, b, c, d, e, f }, { x, y }) => ({ x: a * x + c * y + e, y: b * x + d * y + f });
  return {
    of({ element, vertex, number }) {
      if (vertex !== undefined) {
        const { matrix, points } = read(element, number);
        return moved(matrix, points[vertex]);
      }
      const parent = element.parentElement;
      return moved(once(parent, () => parent.getScreenCTM()),
        { x: Number(element.getAttribute("x")), y: Number(element.getAttribute("y")) });
    },
    isShown({ element, vertex, number }) {
      if (vertex === undefined) return !isOff(element);
      const path = read(element, number), { x, y } = path.points[vertex];
      return !path.isOff && path.left <= x && x <= path.right && path.top <= y && y <= path.bottom;
    },
    ends: ({ path, ends, number }) => ends.map((end) => {
      const { matrix, points } = read(path, number);
      return moved(matrix, points[end]);
    }),
  };
}

// How far the pointer is from a point, or from the bar of its interval.
function distanceTo(value, at, places) {
  const place = places.of(value), own = Math.hypot(place.x - at.x, place.y - at.y);
  if (!value.interval?.isBar) return own;
  const [a, b] = places.ends(value.interval);
  const length = Math.hypot(b.x - a.x, b.y - a.y) || 1;
  const share = clamp(((at.x - a.x) * (b.x - a.x) + (at.y - a.y) * (b.y - a.y)) / length ** 2, 0, 1);
  // The point itself comes before a bar that passes it.
  return Math.min(own, 1 + Math.hypot(a.x + share * (b.x - a.x) - at.x,
    a.y + share * (b.y - a.y) - at.y));
}

function nearestValue(svg, event) {
  const at = { x: event.clientX, y: event.clientY }, places = placesNow(svg);
  let best = null, least = kReachOfValues;
  for (const value of valuesOf(svg)) {
    if (!places.isShown(value)) continue;
    const distance = distanceTo(value, at, places);
    if (distance < least) [best, least] = [value, distance];
  }
  return best;
}

function hideValue() {
  if (!valueShown) return;
  const { svg } = valueShown;
  valueShown = null;
  svg.querySelector("g.value")?.remove();
  svg.parentElement.querySelector(".tip.value")?.remove();
}

function showValue(svg, value, isPinned) {
  hideValue();
  valueShown = { svg, value, isPinned };
  const at = placesNow(svg).of(value), layer = document.createElementNS(svg.namespaceURI, "g");
  layer.setAttribute("class", "lit value");
  const { x, y } = pointOf(svg, at);
  addElement(layer, "circle", { cx: x, cy: y, r: 6 });
  svg.append(layer);
  putTip(svg, nameOfValue(value), wordsOfValue(svg, value), at).classList.add("value");
}

// By keys: from point to point of a curve, and from curve to curve.
function stepValue(svg, count, curves = 0) {
  const places = placesNow(svg), all = valuesOf(svg).filter((value) => places.isShown(value));
  if (all.length === 0) return announce("No point of a curve is in this part of the axes.");
  const key = ({ name, kind, number }) => `${number}\n${name}\n${kind}`;
  const keys = [...new Set(all.map(key))];
  const old = valueShown?.svg === svg ? valueShown.value : null;
  const now = old ? keys.indexOf(key(old)) : 0;
  const next = keys[(now + curves + keys.length) % keys.length];
  const points = all.filter((value) => key(value) === next)
    .sort((a, b) => a.place.x - b.place.x || a.place.y - b.place.y);
  const nearest = old ? points.reduce((best, each) => (Math.abs(each.place.x - old.place.x) <
    Math.abs(best.place.x - old.place.x) ? each : best)) : points[0];
  const from = old && curves === 0 ? points.indexOf(old) : points.indexOf(nearest);
  const value = points[old && curves === 0 ? (from + count + points.length) % points.length : from];
  showValue(svg, value, true);
  return announce([nameOfValue(value), ...wordsOfValue(svg, value)].join(", "));
}

function followValues(figure, svg) {
  if (!keptValues.has(svg)) return;
  const box = svg.parentElement, hasLandmarks = landmarks.has(svg);
  // A landmark comes first.
  const under = (event) => (hasLandmarks && nearest(svg, event) ? null : nearestValue(svg, event));
  box.addEventListener("pointermove", (event) => {
    if (event.pointerType === "touch") return;
    const value = event.buttons === 0 ? under(event) : null;
    if (value && (valueShown?.svg !== svg || valueShown.value !== value)) showValue(svg, value, false);
    else if (!value && valueShown && !valueShown.isPinned) hideValue();
  });
  box.addEventListener("pointerleave", () => {
    if (valueShown?.svg === svg && !valueShown.isPinned) hideValue();
  });
  box.addEventListener("click", (event) => {
    const value = under(event);
    if (!value) return hideValue();
    showValue(svg, value, true);
    return announce([nameOfValue(value), ...wordsOfValue(svg, value)].join(", "));
  });
  box.addEventListener("dblclick", (event) => {
    const value = nearestValue(svg, event);
    if (value) chooseMethod(methodOf(value.name));
  });
  box.addEventListener("viewchange", () => {
    if (valueShown?.svg !== svg) return;
    if (placesNow(svg).isShown(valueShown.value)) showValue(svg, valueShown.value, valueShown.isPinned);
    else hideValue();
  });
  box.addEventListener("blur", () => { if (valueShown?.svg === svg) hideValue(); });
  if (hasLandmarks) return;
  box.setAttribute("aria-label", box.getAttribute("aria-label").replace("the landmarks",
    "the points of a curve, c to go to the next curve"));
  box.addEventListener("focus", () => { if (box.matches(":focus-visible")) stepValue(svg, 0); });
  box.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key === "n") stepValue(svg, 1);
    else if (event.key === "p") stepValue(svg, -1);
    else if (event.key === "c") stepValue(svg, 0, 1);
    else if (event.key === "Escape") hideValue();
  });
}
