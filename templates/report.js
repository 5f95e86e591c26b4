// Starts the parts of the script (report_*.js); the table of contents follows the reader.

// Scrolls a list that is longer than the window, without moving the page.
function keepInSight(link) {
  const list = link.closest(".contents");
  const { top, bottom } = link.getBoundingClientRect(), box = list.getBoundingClientRect();
  if (top < box.top) list.scrollTop -= box.top - top;
  if (bottom > box.bottom) list.scrollTop += bottom - box.bottom;
}

// Marks the section that is being read in the table of contents.
function followReading() {
  const links = new Map();
  for (const link of document.querySelectorAll(".contents a")) {
    links.set(link.getAttribute("href").slice(1), link);
  }
  const observer = new IntersectionObserver((entries) => {
    for (const entry of entries) {
      if (!entry.isIntersecting) continue;
      for (const link of links.values()) link.removeAttribute("aria-current");
      const link = links.get(entry.target.id);
      link?.setAttribute("aria-current", "true");
      if (link) keepInSight(link);
    }
  }, { rootMargin: "-10% 0px -80% 0px" });
  for (const section of document.querySelectorAll("main > section")) observer.observe(section);
}

const figures = document.querySelectorAll("figure[data-id]");
const held = Array.from(figures).filter((figure) => figure.querySelector(".drawing"));
whenPutIn.push(addTools, addSteps, followLandmarks);
for (const table of document.querySelectorAll("main table")) makeSortable(table);
for (const table of document.querySelectorAll("main .table")) addTableTools(table);
for (const figure of figures) linkFiles(figure);
addThumbnails();
addCommands(figures);
addThemeSwitch(document.querySelector(".masthead"));
putInWhenNear(held);
followReading();
foldOnScreen();
