// Tables are filtered by their first column, and copied as filtered and sorted.

const kFewRows = 7;  // A table of so few rows needs no filter.

function shownRows(table) {
  return Array.from(table.tBodies[0].rows).filter((row) => !row.hidden);
}

function filterRows(table, wanted) {
  const words = wanted.toLocaleLowerCase("en").trim();
  for (const row of table.tBodies[0].rows) {
    row.hidden = !row.cells[0].textContent.toLocaleLowerCase("en").includes(words);
  }
}

// Each row holds its line of the CSV and the LaTeX file.
function copyOf(holder, table, format) {
  const rows = shownRows(table).map((row) => row.dataset[format]);
  const data = holder.dataset;
  if (format === "csv") return [data.csvHead, ...rows, ""].join("\r\n");
  return `${data.latexHead}${rows.map((row) => `${row}\n`).join("")}${data.latexTail}`;
}

function lower_case(text) {
  return /^[A-Z][a-z]/.test(text) ? text[0].toLowerCase() + text.slice(1) : text;
}

function addFilter(parent, holder, table) {
  const rows = Array.from(table.tBodies[0].rows);
  const heading = table.tHead.querySelector('th[data-column="0"]');
  const names = [...new Set(rows.map((row) => row.cells[0].textContent.trim()))];
  const list = document.createElement("datalist");
  list.id = `${holder.id}-names`;
  list.append(...names.filter((name) => name.length < 80).map((name) => new Option(name, name)));
  const label = document.createElement("label");
  const field = document.createElement("input");
  field.type = "search";
  field.setAttribute("list", list.id);
  const found = document.createElement("output");
  const details = holder.querySelector(":scope > details:not(.fold)");
  field.addEventListener("input", () => {
    filterRows(table, field.value);
    const count = shownRows(table).length;
    found.textContent = count === rows.length ? "" : `${count} of ${rows.length} rows`;
    if (details && field.value !== "") details.open = true;
  });
  const column = heading?.textContent.trim().replace(/\s+/g, " ") || "Name";
  label.append(`Filter by ${lower_case(column)} `, field);
  parent.append(label, list, found);
}

function addTableTools(holder) {
  const table = holder.querySelector("table");
  const caption = holder.querySelector("h3");
  const tools = document.createElement("div");
  tools.className = "table-tools";
  if (table.tBodies[0].rows.length > kFewRows) addFilter(tools, holder, table);
  if ("csvHead" in holder.dataset) {
    const name = caption.textContent;
    addButton(tools, "Copy CSV", `Copy CSV of ${name}`,
      (button) => copyText(copyOf(holder, table, "csv"), button));
    addButton(tools, "Copy LaTeX", `Copy LaTeX of ${name}`,
      (button) => copyText(copyOf(holder, table, "latex"), button));
  }
  (caption.closest("summary") ?? caption).after(tools);
  const filter = () => tools.querySelector("input")?.value ?? "";
  // Paper shows all rows.
  addEventListener("beforeprint", () => filterRows(table, ""));
  addEventListener("afterprint", () => filterRows(table, filter()));
}
