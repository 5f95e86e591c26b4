// A reader can save and copy what the page holds; links lead to the other files.

function svgUrl(text) {
  return `data:image/svg+xml;charset=utf-8,${encodeURIComponent(text)}`;
}

// It has as many pixels as the PNG file of the report: two per point.
async function pngOf(text) {
  const image = new Image();
  image.src = svgUrl(text);
  await image.decode();
  const [, width, height] = /viewBox="0 0 ([\d.]+) ([\d.]+)"/.exec(text);
  const canvas = document.createElement("canvas");
  canvas.width = Math.round(2 * Number(width));
  canvas.height = Math.round(2 * Number(height));
  canvas.getContext("2d").drawImage(image, 0, 0, canvas.width, canvas.height);
  return new Promise((resolve) => canvas.toBlob(resolve, "image/png"));
}

async function saveDrawing(figure, format) {
  const text = withoutDarkPalettes(sourceOf(figure));
  const blob = format === "png" ? await pngOf(text) : new Blob([text], { type: "image/svg+xml" });
  save(`${figure.dataset.id}.${format}`, blob);
}

// Links to files that the page can make itself save them from the page.
function linkFiles(figure) {
  const links = figure.querySelectorAll("a[data-format]");
  if (links.length === 0 || sourceOf(figure) === "") return;
  const where = figure.querySelector(".files .where");
  where.textContent = "SVG and PNG are made by this page; PDF and data are in the folder " +
    `${where.dataset.folder}/ next to it.`;
  for (const link of links) {
    link.download = `${figure.dataset.id}.${link.dataset.format}`;
    link.addEventListener("click", (event) => {
      event.preventDefault();
      saveDrawing(figure, link.dataset.format);
    });
  }
}

// Where a page has no access to the clipboard, the older command may still work.
function copyByHand(text) {
  const area = document.createElement("textarea");
  area.value = text;
  area.className = "visually-hidden";
  document.body.append(area);
  area.select();
  const done = document.execCommand("copy");
  area.remove();
  return done;
}

async function copyText(text, button) {
  let done = true;
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    done = copyByHand(text);
  }
  button.dataset.label ??= button.textContent;
  button.textContent = done ? "Copied" : "Copying not allowed";
  announce(done ? `${button.dataset.label}: copied`
    : "The browser does not allow this page to copy");
  button.focus();
  setTimeout(() => { button.textContent = button.dataset.label; }, 2000);
}

function addCopyButton(parent, text, label) {
  addButton(parent, "Copy", label, (button) => copyText(text, button));
}

// The command of a figure is the one under "A figure alone", with the ID of this figure.
function addCommand(figure, command) {
  const files = figure.querySelector("details.files");
  if (!files) return;
  const id = figure.dataset.id;
  files.querySelector("summary").firstChild.data = "Files and command";
  files.addEventListener("toggle", () => {
    const line = document.createElement("p"), code = document.createElement("code");
    line.className = "command";
    code.textContent = command.replace(/ID$/, () => id);
    line.append(code);
    addCopyButton(line, code.textContent, `Copy the command of ${id}`);
    files.append(line);
  }, { once: true });
}

// The lines that search a commit.
function addSearchesOfCommits() {
  for (const code of document.querySelectorAll(".opening .finding > code, .worsening pre > code")) {
    if (!code.textContent.startsWith("git bisect ")) continue;
    addCopyButton(code.closest(".finding, .fold"), code.textContent,
      "Copy the search for the commit");
  }
}

// Copy buttons for the commands under "Provenance", below figures and of what got worse.
function addCommands(figures) {
  addSearchesOfCommits();
  const names = new Map([["Command", "of this report"], ["A figure alone", "of a figure"]]);
  let single = "";
  for (const fact of document.querySelectorAll('[id$="provenance"] .facts > div')) {
    const value = fact.querySelector("dd"), code = value.querySelector(":scope > code");
    const name = fact.querySelector("dt").textContent;
    if (!code || !names.has(name)) continue;
    if (name === "A figure alone") single ||= code.textContent;
    addCopyButton(value, code.textContent, `Copy the command ${names.get(name)}`);
  }
  if (single) figures.forEach((figure) => addCommand(figure, single));
}
