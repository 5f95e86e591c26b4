// Filter by verdict, search by ID.

const wanted = new Set();

function applyFilter() {
  const words = by("search").value.trim().toLowerCase();
  const fits = (element) => (wanted.size === 0 || wanted.has(element.dataset.verdict)) &&
    element.dataset.name.toLowerCase().includes(words);
  const entries = document.querySelectorAll(".item, .index li, .identical li");
  for (const element of entries) element.hidden = !fits(element);
  const all = document.querySelectorAll(".item, .identical li");
  const count = Array.from(all).filter(shown).length;
  const isWhole = count === all.length;
  document.querySelector(".found").textContent = isWhole ? "" : `${count} of ${all.length} shown`;
  const identical = by("identical");
  if (identical) identical.hidden = !identical.querySelector("li:not([hidden])");
  if (atHand && !shown(atHand)) {
    const first = items.find(shown);
    if (first) setAtHand(first);
  }
}

function clearFilter() {
  wanted.clear();
  by("search").value = "";
  for (const chip of document.querySelectorAll(".counts button")) {
    chip.setAttribute("aria-pressed", "false");
  }
  applyFilter();
}

function makeChips() {
  for (const entry of document.querySelectorAll(".counts li")) {
    const button = document.createElement("button");
    const verdict = entry.dataset.verdict;
    button.type = "button";
    button.setAttribute("aria-pressed", "false");
    button.append(...entry.querySelector(".chip").childNodes);
    button.addEventListener("click", () => {
      if (!wanted.delete(verdict)) wanted.add(verdict);
      button.setAttribute("aria-pressed", String(wanted.has(verdict)));
      applyFilter();
    });
    entry.replaceChildren(button);
  }
}
