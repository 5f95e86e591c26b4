// Filter by verdict, search by ID, order.

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
  for (const fold of document.querySelectorAll("#identical, .further")) {
    fold.hidden = !fold.querySelector("li:not([hidden]), .item:not([hidden])");
    if (!isWhole) unfold(fold);
  }
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

// The order in which the page came is by verdict. Items keep their places, folded ones too.
function makeOrder() {
  const places = new Map(items.map((item, place) => [item, place]));
  const byPlace = (a, b) => places.get(a) - places.get(b);
  const compare = {
    verdict: byPlace,
    share: (a, b) => Number(b.dataset.share) - Number(a.dataset.share) || byPlace(a, b),
    name: (a, b) => a.dataset.name.localeCompare(b.dataset.name) || byPlace(a, b),
  };
  const marks = items.map((item) => document.createComment(item.id));
  items.forEach((item, i) => item.before(marks[i]));
  by("order").addEventListener("change", () => {
    items.sort(compare[by("order").value]);
    const list = document.querySelector(".index");
    items.forEach((item, i) => {
      marks[i].after(item);
      list.append(entryOf.get(item.id));
    });
    const first = items.find(shown);
    if (first) setAtHand(first);
  });
  document.querySelector(".order").hidden = false;
}

// A small image of each item in the list, of the same bytes as on its stage. Those that the program
// drew follow the theme.
function addThumbnails() {
  for (const item of items) {
    const image = item.querySelector(".current img") ?? item.querySelector(".baseline img") ??
      item.querySelector(".change img");
    if (!image) continue;
    const small = document.createElement("img");
    small.className = image.closest(".change, .drawn") ? "thumbnail drawn" : "thumbnail";
    small.alt = "";
    small.loading = "lazy";
    small.decoding = "async";
    small.src = image.src;
    entryOf.get(item.id).querySelector("a").prepend(small);
  }
}
