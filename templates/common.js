"use strict";
// What the script adds to every page: sortable tables, a light/dark switch, whole tables on paper.
// Without it a reader still sees all content.

// A cell's sort key is the number behind its text; a missing value has an empty one and goes last.
function sortKey(row, column) {
  const cell = row.cells[column];
  const key = cell.dataset.sort;
  if (key === undefined) return { text: cell.textContent };
  return { number: key === "" ? NaN : Number(key) };
}

function compare(a, b, direction) {
  if (a.text !== undefined && b.text !== undefined) {
    return direction * a.text.localeCompare(b.text, "en", { numeric: true });
  }
  const missing = (key) => key.text === undefined && Number.isNaN(key.number);
  if (missing(a) || missing(b)) return Number(missing(a)) - Number(missing(b));
  return direction * ((a.number ?? 0) - (b.number ?? 0));
}

function sortBy(table, heading) {
  const column = Number(heading.dataset.column);
  const ascending = heading.getAttribute("aria-sort") !== "ascending";
  for (const other of table.querySelectorAll("th[aria-sort]")) other.removeAttribute("aria-sort");
  heading.setAttribute("aria-sort", ascending ? "ascending" : "descending");
  const body = table.tBodies[0];
  const rows = Array.from(body.rows, (row) => ({ row, key: sortKey(row, column) }));
  rows.sort((a, b) => compare(a.key, b.key, ascending ? 1 : -1));
  body.append(...rows.map((entry) => entry.row));
}

function makeSortable(table) {
  if (table.tBodies[0].rows.length < 2) return;
  for (const heading of table.querySelectorAll("thead th[data-column]")) {
    const button = document.createElement("button");
    button.type = "button";
    button.className = "sort";
    button.append(...heading.childNodes);
    button.addEventListener("click", () => sortBy(table, heading));
    heading.append(button);
  }
}

// The theme that a reader chose, for all pages of mapproof; a browser may forbid to keep it.
const kThemeKey = "mapproof-theme";

function remember(theme) {
  try {
    localStorage.setItem(kThemeKey, theme);
  } catch {
    // The page works without it.
  }
}

function rememberedTheme() {
  try {
    const theme = localStorage.getItem(kThemeKey);
    return theme === "light" || theme === "dark" ? theme : "";
  } catch {
    return "";
  }
}

function addThemeSwitch(parent) {
  const root = document.documentElement;
  if (rememberedTheme() !== "") root.dataset.theme = rememberedTheme();
  const system = window.matchMedia("(prefers-color-scheme: dark)");
  const isDark = () => (root.dataset.theme ?? (system.matches ? "dark" : "light")) === "dark";
  const button = document.createElement("button");
  button.type = "button";
  button.className = "theme";
  const label = () => {
    button.textContent = isDark() ? "Light" : "Dark";
    button.setAttribute("aria-label", isDark() ? "Use light colours" : "Use dark colours");
  };
  button.addEventListener("click", () => {
    root.dataset.theme = isDark() ? "light" : "dark";
    remember(root.dataset.theme);
    label();
    dispatchEvent(new Event("themechange"));
  });
  system.addEventListener("change", () => {
    label();
    dispatchEvent(new Event("themechange"));
  });
  label();
  parent.append(button);
}

// Downloads a file that the page makes itself.
function save(name, blob) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}
