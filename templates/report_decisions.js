// Decisions on what got worse, saved as a file that the program reads; the command that compares any
// two nightly runs.

function option(value, text) {
  const one = document.createElement("option");
  one.value = value;
  one.textContent = text;
  return one;
}

function addDecision(finding) {
  const box = document.createElement("div");
  box.className = "decision";
  const kind = document.createElement("select");
  kind.setAttribute("aria-label", `Decision on ${finding.querySelector("h3").textContent}`);
  kind.append(option("", "No decision"), option("known", "Known: fail no nightly run by it"),
    option("note", "Note"), option("accepted", "Accept the whole nightly run as reference"));
  const text = document.createElement("input");
  text.type = "text";
  text.maxLength = 1000;
  text.placeholder = "Why";
  text.setAttribute("aria-label", "Why");
  box.append(kind, text);
  finding.append(box);
  return { kind, text, keys: finding.dataset.keys.split(" ") };
}

// One entry per finding; a nightly run is accepted once, as a whole.
function decisionsIn(boxes) {
  const all = new Map();
  for (const { kind, text, keys } of boxes) {
    if (!kind.value || !text.value.trim()) continue;
    for (const key of keys) {
      const target = kind.value === "accepted" ? key.split(".")[0] : key;
      all.set(`${kind.value} ${target}`,
        { target, decision: kind.value, text: text.value.trim() });
    }
  }
  return [...all.values()];
}

// The command that compares two nightly runs, as the program wrote it.
function comparingCommand() {
  return document.querySelector("#section-nightly-runs > p > code, .compare > p > code");
}

function addCompare() {
  const code = comparingCommand();
  const numbers = Array.from(document.querySelectorAll("#table-nightly-runs tbody tr th"),
    (cell) => cell.textContent.trim());
  if (!code || numbers.length < 2) return;
  const box = document.createElement("div");
  box.className = "compare";
  const selects = ["Compare nightly run", "with"].map((words, i) => {
    const label = document.createElement("label");
    const select = document.createElement("select");
    for (const number of numbers) select.append(option(number, number));
    select.selectedIndex = 1 - i;
    label.append(`${words} `, select);
    box.append(label);
    return select;
  });
  const update = () => {
    const chosen = selects.map((select) => select.value).join(" ");
    code.textContent = code.textContent.replace(/\d+ \d+$/, chosen);
  };
  for (const select of selects) select.addEventListener("change", update);
  update();
  box.append(code.parentElement);
  addButton(box, "Copy", "Copy the command that compares them",
    (button) => copyText(code.textContent, button));
  document.querySelector("#table-nightly-runs").before(box);
}

function addDecisions() {
  addCompare();
  const boxes = Array.from(document.querySelectorAll(".worsening[data-keys]"), addDecision);
  if (boxes.length === 0) return;
  const bar = document.createElement("div");
  bar.className = "decisions";
  const said = document.createElement("span");
  said.setAttribute("role", "status");
  addButton(bar, "Save decisions", "", () => {
    const decisions = decisionsIn(boxes);
    if (decisions.length === 0) {
      said.textContent = "Choose a decision and say why.";
      return;
    }
    const file = { schema: { name: "mapproof.decisions", version: 1 }, decisions };
    save("mapproof-decisions.json",
      new Blob([JSON.stringify(file, null, 2) + "\n"], { type: "application/json" }));
    const command = comparingCommand()?.textContent ?? "mapproof history STORE --compare";
    said.textContent =
      `Next, run: ${command.replace(/--compare.*/, "--from mapproof-decisions.json")}`;
  });
  bar.append(said);
  boxes.at(-1).kind.closest(".worsening").after(bar);
}
