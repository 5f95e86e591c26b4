// Tables are filtered by their first column, and copied as they then stand.

const kFewRows = 4;  // Fewer need no filter.

function shownRows(table) {
  return Array.from(table.tBodies[0].rows).filter((row) => !row.hidden);
}

function filterRows(table, wanted) {
  const words = wanted.toLocaleLowerCase("en").trim();
  for (const row of table.tBodies[0].rows) {
    row.hidden = !row.cells[0].textContent.toLocaleLowerCase("en").includes(words);
  }
}

// Every line of the text that the tables' writer made stands with its row.
function copyOf(holder, table, format) {
  const rows = shownRows(table).map((row) => row.dataset[format]);
  const data = holder.dataset;
  if (format === "csv") return [data.csvHead, ...rows, ""].join("\r\n");
  return `${data.latexHead}${rows.map((row) => `${row}\n`).join("")}${data.latexTail}`;
}

function addFilter(place, holder, table) {
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
  const said = document.createElement("output");
  const details = holder.querySelector(":scope > details");
  field.addEventListener("input", () => {
    filterRows(table, field.value);
    const count = shownRows(table).length;
    said.textContent = count === rows.length ? "" : `${count} of ${rows.length} rows`;
    if (details && field.value !== "") details.open = true;
  });
  label.append(`${heading?.textContent.trim() || "Name"} has `, field);
  place.append(label, list, said);
}

function addTableTools(holder) {
  const table = holder.querySelector("table");
  const caption = holder.querySelector("h3");
  const place = document.createElement("div");
  place.className = "table-tools";
  if (table.tBodies[0].rows.length > kFewRows) addFilter(place, holder, table);
  if ("csvHead" in holder.dataset) {
    const name = caption.textContent;
    addButton(place, "Copy CSV", `Copy CSV of ${name}`,
      (button) => copyText(copyOf(holder, table, "csv"), button));
    addButton(place, "Copy LaTeX", `Copy LaTeX of ${name}`,
      (button) => copyText(copyOf(holder, table, "latex"), button));
  }
  caption.after(place);
  // Paper shows all rows.
  addEventListener("beforeprint", () => filterRows(table, ""));
  addEventListener("afterprint", () => filterRows(table, place.querySelector("input")?.value ?? ""));
}
