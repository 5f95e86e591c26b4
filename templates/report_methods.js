// A method that is chosen, from the list or by a click on its curve, is highlighted in all figures
// and tables; the curves of a figure can be hidden one by one, by its legend or by a list.

const methods = new Map();  // Key, as in the ids of marks → name, as in tables.
let chosenMethod = "";
const kMostRead = 100;  // Figures whose curves name the methods: a page may hold thousands.

// "SMACOF, kNN weights, K = 5" is a curve of "SMACOF, kNN weights".
function methodOf(label) {
  return label.replaceAll("\u00a0", " ").replace(/, \S+ = \S+( × \S+)?$/, "");
}

function keyOfMethod(name) {
  return name.toLowerCase().replace(/[^a-z0-9]+/g, "-");
}

// The method of a label: "NAME, K = 8, whole" is of NAME; labels of none are their own.
const namesOfLabels = new Map();
function nameOf(label) {
  if (namesOfLabels.has(label)) return namesOfLabels.get(label);
  const own = methodOf(label), names = [...methods.values()];
  const within = names.filter((name) => `, ${own}, `.includes(`, ${name}, `));
  const longest = within.reduce((a, b) => (b.length > a.length ? b : a), "");
  namesOfLabels.set(label, longest || own);
  return longest || own;
}

// The ids of curves hold the keys of their methods: "fig-4-smacof-knn-mean". Those of results count
// the curves of their figure, "errors-line-2-mean": there a method's name is its key.
function readMethods(figure) {
  const id = figure.dataset.id.replace(/[^a-z0-9-]/g, "");
  const pattern = new RegExp(` id="${id}-([a-z0-9-]+)-mean" data-curve="([^"]*)"`, "g");
  for (const [, key, label] of sourceOf(figure).matchAll(pattern)) {
    const name = methodOf(decoded(label));
    methods.set(/^line-\d+$/.test(key) ? name : key, name);
  }
}

function labelOfMark(mark) {
  const { curve, setting, method } = mark.dataset;
  if (curve ?? setting) return nameOf(curve ?? setting);
  if (method === undefined) return "";
  const key = /^(?:ours|published)-\d+-(.+)$/.exec(mark.id.slice(mark.ownerSVGElement.id.length + 1));
  return methods.get(key?.[1]) ?? nameOf(method);
}

// The method that words name; a diagram of ranks has a method's mean rank behind it, "EKF 2.17".
function labelOfWords(words, ranked) {
  const mark = ranked.find(({ dataset: { method, rank } }) =>
    words.startsWith(`${method} `) && Math.abs(words.slice(method.length) - rank) < .01);
  return mark ? labelOfMark(mark) : nameOf(words);
}

const kOfMethods = "[data-curve], [data-setting], [data-method]";
const kNamesOfMethods = ["legend-text", "mark-label", "tick-label"].map(
  (kind) => `.${kind} [data-words]`).join();

// The method that a panel's heading names: "KPCA Gauss, σ² = 4000" is of "KPCA, Gaussian".
function methodOfPanel(parts) {
  const heading = parts.find((part) => kindOf(part) === "panel-title");
  const words = heading?.querySelector("[data-words]")?.dataset.words ?? heading?.dataset.words ?? "";
  const key = keyOfMethod(nameOf(words));
  if (key === "") return "";
  const alike = [...methods.keys()].filter((each) => each.startsWith(key));
  return methods.get(key) ?? (alike.length === 1 ? methods.get(alike[0]) : "");
}

// Of panels of one method each the others are dimmed.
function highlightPanels(svg) {
  const { panels } = partsOf(svg), names = panels.length > 1 ? panels.map(methodOfPanel) : [];
  const isHere = chosenMethod !== "" && names.includes(chosenMethod);
  for (const [i, name] of names.entries()) {
    const isDim = isHere && name !== "" && name !== chosenMethod;
    for (const part of panels[i]) part.classList.toggle("dim", isDim);
  }
}

function highlightIn(svg) {
  highlightPanels(svg);
  const marks = [...svg.querySelectorAll(kOfMethods)];
  const isHere = chosenMethod !== "" && marks.some((mark) => labelOfMark(mark) === chosenMethod);
  for (const mark of marks) mark.classList.toggle("dim", isHere && labelOfMark(mark) !== chosenMethod);
  const labels = new Set(marks.map(labelOfMark)), ranked = marks.filter((mark) => mark.dataset.rank);
  for (const words of svg.querySelectorAll(kNamesOfMethods)) {
    const name = labelOfWords(words.dataset.words, ranked);
    words.classList.toggle("dim", isHere && name !== chosenMethod && labels.has(name));
  }
  for (const entry of legendEntries({ rest: [...svg.children] })) {
    const isDim = entry.at(-1).querySelector("[data-words]")?.classList.contains("dim") ?? false;
    for (const sample of entry.slice(0, -1)) sample.classList.toggle("dim", isDim);
  }
}

// A drawing for an image, which has no style sheet of the page.
function highlighted(text) {
  if (chosenMethod === "") return text;
  const box = document.createElement("div");
  box.append(drawingOf(text));
  const svg = box.firstChild;
  highlightIn(svg);
  for (const part of svg.querySelectorAll(".dim")) {
    part.setAttribute("opacity", part.dataset.words === undefined ? .15 : .35);  // As report.css has it.
  }
  return new XMLSerializer().serializeToString(svg);
}

function chooseMethod(label) {
  chosenMethod = label === chosenMethod ? "" : label;
  const list = document.querySelector("select.method");
  if (list) list.value = chosenMethod;
  for (const svg of document.querySelectorAll(".drawing > svg")) highlightIn(svg);
  highlightImages();
  nameMethodInLinks();
  for (const head of document.querySelectorAll("main tbody th[scope=row]")) {
    const isChosen = chosenMethod !== "" && head.textContent.trim() === chosenMethod;
    head.parentElement.classList.toggle("chosen", isChosen);
  }
  const keys = [...methods].filter(([, name]) => name === chosenMethod).map(([key]) => key);
  for (const figure of document.querySelectorAll("figure[data-id]")) {
    figure.classList.toggle("chosen", keys.some((key) => figure.dataset.id.endsWith(`-${key}`)));
  }
}

// What the columns "Method" of all tables name.
function namedMethods() {
  const names = [];
  for (const table of document.querySelectorAll("main .table table")) {
    const head = [...table.tHead.querySelectorAll("th[data-column]")].find(
      (each) => /^Methods?$/.test(each.textContent.trim()));
    if (!head) continue;
    for (const row of table.tBodies[0].rows) {
      names.push(row.cells[Number(head.dataset.column)].textContent.trim());
    }
  }
  return names;
}

// Of figures without curves of means: what both a table and the marks or headings of figures name.
function readNamedMethods(figures, rows) {
  const shown = new Set();
  for (const figure of figures) {
    const pattern = / (?:data-(?:curve|setting|method)|aria-label)="([^"]*)"/g;
    for (const [, label] of sourceOf(figure).matchAll(pattern)) shown.add(methodOf(decoded(label)));
  }
  for (const row of rows) {
    const name = methodOf(row);
    if (shown.has(name)) methods.set(keyOfMethod(name), name);
  }
}

// Puts the list behind an element.
function addMethodList(before) {
  const figures = [...document.querySelectorAll("figure[data-id]")].slice(0, kMostRead);
  figures.forEach(readMethods);
  // Other curves, such as published ones or kinds of noise, are not in columns of methods. A further
  // page of a report may have no tables.
  const rows = new Set(namedMethods());
  for (const [key, name] of methods) {
    const isInTable = [...rows].some((row) => row === name || row.startsWith(`${name}, `));
    if (rows.size > 0 && !isInTable) methods.delete(key);
  }
  if (methods.size === 0) readNamedMethods(figures, rows);
  namesOfLabels.clear();
  const names = [...new Set(methods.values())];
  const chosen = new URLSearchParams(location.search).get("method") ?? "";
  if (chosen !== "" && !names.includes(chosen)) {  // From a page that knows more methods.
    methods.set(keyOfMethod(chosen), chosen);
    names.push(chosen);
  }
  if (names.length < (chosen === "" ? 2 : 1)) return;
  const list = document.createElement("select");
  list.className = "method";
  list.setAttribute("aria-label", "Highlight a method in all figures and tables");
  list.append(new Option("Highlight a method", ""), ...names.map((name) => new Option(name, name)));
  list.addEventListener("change", () => {
    chosenMethod = "";
    chooseMethod(list.value);
  });
  before.after(list);
  if (chosen !== "") chooseMethod(chosen);
}

// A method that is chosen is highlighted on the report's further pages, too: links to them name it,
// however they are followed.
function nameMethodInLinks() {
  const query = chosenMethod === "" ? "" : `?${new URLSearchParams({ method: chosenMethod })}`;
  for (const link of document.querySelectorAll("a[href^='./']")) {
    const page = /^([^?#]*\.html)(?:\?[^#]*)?(#.*)?$/.exec(link.getAttribute("href"));
    if (page) link.setAttribute("href", `${page[1]}${query}${page[2] ?? ""}`);
  }
}

// The curves of a figure, each with its parts, by label.
function curvesOf(svg) {
  const curves = new Map();
  for (const part of svg.querySelectorAll("[data-curve]")) {
    curves.set(part.dataset.curve, [...curves.get(part.dataset.curve) ?? [], part]);
  }
  return curves;
}

// A click on words of the legend shows or hides their curve. The drawing captures the pointer, so
// that the words are found by where they are.
function followLegend(box, svg, boxes) {
  const entries = [...svg.querySelectorAll("g.legend-text [data-words]")]
    .filter((words) => boxes.has(words.dataset.words));
  for (const words of entries) {
    const curve = boxes.get(words.dataset.words);
    words.classList.add("toggle");
    curve.addEventListener("change", () => words.classList.toggle("dim", !curve.checked));
  }
  box.addEventListener("click", ({ clientX, clientY }) => {
    const hit = entries.find((words) => {
      const { left, right, top, bottom } = words.getBoundingClientRect();
      return left <= clientX && clientX <= right && top <= clientY && clientY <= bottom;
    });
    if (hit) boxes.get(hit.dataset.words).click();
  });
}

// "1.3e+15" as "1.3 × 10¹⁵".
function powerWords(text) {
  const kDigits = "-0123456789", kRaised = "⁻⁰¹²³⁴⁵⁶⁷⁸⁹";
  const raised = (digits) => [...digits].map((digit) => kRaised[kDigits.indexOf(digit)]);
  return text.replace(/e\+?(-?)0*(\d+)$/,
    (all, sign, power) => ` × 10${raised(sign + power).join("")}`);
}

function addCurveBoxes(figure, svg) {
  highlightIn(svg);
  const curves = curvesOf(svg), boxes = new Map();
  if (curves.size < 2) return;
  const details = document.createElement("details"), summary = document.createElement("summary");
  details.className = "curves";
  summary.textContent = "Curves";
  details.append(summary);
  for (const [name, parts] of curves) {
    const label = document.createElement("label"), box = document.createElement("input");
    Object.assign(box, { type: "checkbox", checked: true });
    box.addEventListener("change", () => {
      for (const part of parts) part.classList.toggle("off", !box.checked);
    });
    boxes.set(name, box);
    label.append(box, name);
    details.append(label);
  }
  figure.querySelector(".tools").after(details);
  followLegend(figure.querySelector(".drawing"), svg, boxes);
}
