// Ticks, the file of approvals, and the command that approves the same items.

// The page holds names byte by byte; JSON cannot hold one that is not UTF-8.
function decoded(text) {
  try {
    return decodeURIComponent(text);
  } catch {
    return null;
  }
}

// Quotes one word for a POSIX shell. Control characters, on which a terminal might act, are written
// as $'…'.
function quoted(word) {
  if (word.startsWith("~/")) return `~/${word.length > 2 ? quoted(word.slice(2)) : ""}`;
  if (/^[A-Za-z0-9_.\/=,:+@%-]+$/.test(word)) return word;
  if (!/[\u0000-\u001f\u007f-\u009f]/.test(word)) return `'${word.replaceAll("'", "'\\''")}'`;
  const bytes = Array.from(new TextEncoder().encode(word), (byte) =>
    byte >= 0x20 && byte < 0x7f && byte !== 0x27 && byte !== 0x5c ? String.fromCharCode(byte)
      : `\\${byte.toString(8).padStart(3, "0")}`);
  return `$'${bytes.join("")}'`;
}

// Quotes a folder, also one whose name looks like an option.
const path = (text) => quoted(text.startsWith("-") ? `./${text}` : text);

const tickOf = (item) => item.querySelector(".tick input");
const isRecords = (item) => /^records(\/|$)/.test(item.dataset.code);
const tickedItems = () => items.filter((item) => tickOf(item)?.checked);

function command() {
  const ids = tickedItems().map((item) => decoded(item.dataset.code));
  const sides = [main.dataset.baseline, main.dataset.current].map(decoded);
  if (sides.includes(null)) return "";
  const words = ["mapproof approve", ...sides.map(path)];
  if ("files" in main.dataset) return words.join(" ");
  if (ids.length > 20) return [...words, "--from mapproof-approvals.json"].join(" ");
  const dashed = ids.some((id) => id.startsWith("-"));
  return [...words, ...(dashed ? ["--"] : []), ...ids.map(quoted)].join(" ");
}

// Some items can be approved only together with the records, some not at all: the page offers no
// command that would fail.
function updateTicks() {
  const whole = tickedItems().some(isRecords);
  for (const item of items) {
    const tick = tickOf(item);
    if (!tick || tick.dataset.needs === undefined) continue;
    const isReadable = decoded(item.dataset.code) !== null;
    tick.disabled = !whole || tick.dataset.needs !== "records" || !isReadable;
    if (tick.disabled) tick.checked = false;
    by(tick.getAttribute("aria-describedby")).hidden = !tick.disabled;
  }
}

function updateApprovals() {
  updateTicks();
  const count = tickedItems().length;
  by("ticked").value = String(count);
  document.querySelector(".approvals").hidden = items.every((item) => !tickOf(item));
  by("download").hidden = "files" in main.dataset;
  for (const id of ["download", "copy", "untick"]) by(id).disabled = count === 0;
  by("command").textContent = count === 0 ? "" : command();
  by("command").hidden = by("command").textContent === "";
  document.querySelector(".approvals").classList.toggle("some", count > 0);
  by("notice").textContent = "";
}

function approvals() {
  return JSON.stringify({
    schema: { name: "mapproof.approvals", version: 1 },
    baseline: decoded(main.dataset.baseline) ?? "",
    current: decoded(main.dataset.current) ?? "",
    ids: tickedItems().map((item) => decoded(item.dataset.code)),
  }, null, 2) + "\n";
}

function download() {
  save("mapproof-approvals.json", new Blob([approvals()], { type: "application/json" }));
  by("notice").textContent =
    "Next, run: mapproof approve BASELINE CURRENT --from mapproof-approvals.json";
}

async function copy() {
  try {
    await navigator.clipboard.writeText(by("command").textContent);
    by("notice").textContent = "Copied.";
  } catch {
    getSelection().selectAllChildren(by("command"));
    by("notice").textContent = "Selected: press Ctrl+C.";
  }
}

function tickAll(all, value) {
  for (const some of [all.filter(isRecords), all]) {
    for (const tick of some.map(tickOf)) if (tick && !tick.disabled) tick.checked = value;
    updateTicks();
  }
  updateApprovals();
}

function makeTicks() {
  for (const item of items) {
    const tick = tickOf(item);
    if (!tick) continue;
    tick.closest("label").hidden = false;
    tick.disabled = decoded(item.dataset.code) === null;
    if (tick.disabled) tick.title = "The name is not UTF-8: approve this item by hand";
    tick.addEventListener("change", updateApprovals);
  }
  by("tick-shown").addEventListener("click", () => tickAll(items.filter(shown), true));
  by("untick").addEventListener("click", () => tickAll(items, false));
  by("download").addEventListener("click", download);
  by("copy").addEventListener("click", copy);
  updateApprovals();
}
