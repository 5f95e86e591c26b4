// On paper a table that is wider than the page has each interval below the value that it belongs to,
// in one column, as papers print them; one without intervals has its longest words broken.

const kPaper_px = 688;  // Between the margins of A4, see @page.
const kPaperWords_px = 8 / .75;  // 8 pt.
const kPaperGaps_px = 8;  // At both sides of a cell.
const kPaperGap_px = 6;  // Before a group of columns.
const kPaperNames_px = 91;  // 24 mm, at which names are broken.
const kPaperShort_px = 60;  // "K = 5": so short a text is not broken.
let wordMeasure;

function widthOnPaper(text, isBold) {
  wordMeasure ??= document.createElement("canvas").getContext("2d");
  const family = getComputedStyle(document.body).fontFamily;
  wordMeasure.font = `${isBold ? 650 : 400} ${kPaperWords_px}px ${family}`;
  return wordMeasure.measureText(text).width;
}

function isShort(cell) {
  const most = cell.matches("th") ? kPaperNames_px : kPaperShort_px;
  return widthOnPaper(cell.textContent.trim(), cell.matches(".marked > *")) <= most;
}

function widestWord(cell, words = cell.textContent.trim().split(/[ \n]+/)) {
  const isBold = cell.matches("thead th, .marked > *");
  return Math.max(...words.map((word) => widthOnPaper(word, isBold)));
}

// The least width of a cell: numbers and short texts stand in one line, and names get some room.
function leastCell(cell) {
  if (cell.matches("tbody th:not(.number, .short)")) return kPaperNames_px;
  const isLine = cell.matches("tbody .number, tbody .short");
  return isLine ? widestWord(cell, [cell.textContent.trim()]) : widestWord(cell);
}

// The same with the gaps around it.
function leastRoom(heading, words) {
  return words + kPaperGaps_px + (heading.matches(".begins") ? kPaperGap_px : 0);
}

// The least width of a column.
function leastColumn(table, heading, index) {
  const cells = [...table.tBodies[0].rows].map((row) => row.cells[index]);
  return leastRoom(heading, Math.max(...[heading, ...cells].map(leastCell)));
}

// The headings of the columns in their order, below those of groups.
function columnHeads(table) {
  return [...table.tHead.querySelectorAll("th[data-column]")]
    .sort((a, b) => Number(a.dataset.column) - Number(b.dataset.column));
}

// The least width of a table. A group of columns may need more for its heading than they do.
function leastTable(table, heads) {
  const columns = heads.map((head, i) => leastColumn(table, head, i));
  let column = 0, width = 0;
  for (const head of table.tHead.rows[0].cells) {
    const below = columns.slice(column, column + head.colSpan).reduce((sum, each) => sum + each, 0);
    width += Math.max(below, leastRoom(head, leastCell(head)));
    column += head.colSpan;
  }
  return width;
}

// Puts what a cell holds below what the cell before it holds. Returns what undoes it.
function putBelow(cell, above) {
  const below = document.createElement("span");
  below.className = "below";
  below.append(...[...cell.childNodes].map((node) => node.cloneNode(true)));
  above.append(below);
  cell.hidden = true;
  return () => {
    below.remove();
    cell.hidden = false;
  };
}

// The heading of a group spans one column less. Returns what undoes it.
function narrowGroup(table, index) {
  const first = table.tHead.rows[0];
  let column = 0;
  for (const head of first.cells) {
    const { colSpan } = head;
    if (index >= column && index < column + colSpan) {
      if (colSpan === 1) return () => {};
      head.colSpan = colSpan - 1;
      return () => { head.colSpan = colSpan; };
    }
    column += colSpan;
  }
  return () => {};
}

function foldIntervals(table, heads) {
  const undo = [];
  // From the last one on, so that the groups before it span what they did.
  for (let index = heads.length - 1; index > 0; --index) {
    if (!heads[index].matches(".interval") || heads[index - 1].matches(".interval")) continue;
    undo.push(narrowGroup(table, index), putBelow(heads[index], heads[index - 1]));
    for (const row of table.tBodies[0].rows) {
      undo.push(putBelow(row.cells[index], row.cells[index - 1]));
    }
  }
  return undo;
}

// Breaks words that are wider than names, as those of files, in any place. Returns what undoes it.
function breakLongWords(table) {
  const cells = [...table.tBodies[0].querySelectorAll("td:not(.number)")]
    .filter((cell) => widestWord(cell) > kPaperNames_px);
  return cells.map((cell) => {
    cell.classList.add("broken");
    return () => cell.classList.remove("broken");
  });
}

// The room that the heading of a table needs on a page, so that it is not alone on it: that of a short
// table, which is not divided, and of the first rows of another one.
function setRoomAhead(table) {
  const kRow_px = 21, kHead_px = 60, kMostWhole = 8, kRows = 3;
  const { length } = table.tBodies[0].rows;
  const rows = length <= kMostWhole ? length : kRows;
  table.closest(".table")?.style.setProperty("--ahead", `${kHead_px + kRow_px * rows}px`);
}

function fitTablesToPaper() {
  let undo = [];
  addEventListener("beforeprint", () => {
    document.querySelectorAll(".table table").forEach(setRoomAhead);
    for (const cell of document.querySelectorAll("tbody > tr > :not(.number)")) {
      cell.classList.toggle("short", isShort(cell));
    }
    for (const table of document.querySelectorAll(".table table")) {
      const heads = columnHeads(table);
      if (leastTable(table, heads) <= kPaper_px) continue;
      const folded = foldIntervals(table, heads);
      undo.push(...folded.length > 0 ? folded : breakLongWords(table));
    }
  });
  addEventListener("afterprint", () => {
    for (const each of undo.reverse()) each();
    undo = [];
  });
}
