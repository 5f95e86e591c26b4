// Starts the parts of the script (report_*.js); the table of contents follows the reader.

// Scrolls a list that is longer than the window, without moving the page.
function keepInSight(link) {
  const list = link.closest(".contents");
  const { top, bottom } = link.getBoundingClientRect(), box = list.getBoundingClientRect();
  if (top < box.top) list.scrollTop -= box.top - top;
  if (bottom > box.bottom) list.scrollTop += bottom - box.bottom;
}

// Marks the section that is being read in the table of contents; at the head of the page, none.
function followReading() {
  const contents = document.querySelector(".contents");
  const links = new Map();
  for (const link of contents.querySelectorAll("a")) {
    links.set(link.getAttribute("href").slice(1), link);
  }
  const sections = [...document.querySelectorAll("main > section")];
  let current;
  // The last section that begins above a fifth of the window, by halving: there may be thousands.
  const sectionRead = () => {
    let first = 0, last = sections.length;
    while (first < last) {
      const middle = Math.floor((first + last) / 2);
      if (sections[middle].getBoundingClientRect().top <= innerHeight / 5) first = middle + 1;
      else last = middle;
    }
    return sections[first - 1];
  };
  const update = () => {
    const read = sectionRead();
    const link = links.get(read?.id);
    if (link === current) return;
    current?.removeAttribute("aria-current");
    link?.setAttribute("aria-current", "true");
    current = link;
    if (link) keepInSight(link);
    else contents.scrollTop = 0;
  };
  let isWaiting = false;
  addEventListener("scroll", () => {
    if (isWaiting) return;
    isWaiting = true;
    requestAnimationFrame(() => {
      isWaiting = false;
      update();
    });
  }, { passive: true });
  update();
}

const figures = document.querySelectorAll("figure[data-id]");
const held = Array.from(figures).filter((figure) => figure.querySelector(".drawing"));
whenPutIn.push(keepValues, addTools, addSteps, stackOnNarrowPages, followLandmarks, addCurveBoxes,
  followValues);
for (const table of document.querySelectorAll("main table")) makeSortable(table);
for (const table of document.querySelectorAll("main .table")) addTableTools(table);
for (const figure of figures) linkFiles(figure);
addFigureColours();
addEventListener("themechange", addOpeningImages);
addCommands(figures);
addThemeSwitch(document.querySelector(".masthead"));
foldDetails();
fitTablesToPaper();
putInWhenNear(held);
setTitlesOnPaper();  // Of all drawings, which are put in first.
addDecisions();
followReading();
// When there is time, or after a second: a busy machine may have none.
const whenIdle = globalThis.requestIdleCallback ?? setTimeout;
whenIdle(() => addMethodList(document.querySelector(".search")), { timeout: 1000 });
addSearch(document.querySelector(".contents"));
addOpeningImages();  // As large as what is above them leaves room for.
fitMainFigure();
