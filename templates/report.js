// Starts what the parts of the script (report_*.js) do; the table of contents follows its reader.

// The entry of the section being read stands out in the table of contents.
function followReading() {
  const links = new Map();
  for (const link of document.querySelectorAll(".contents a")) {
    links.set(link.getAttribute("href").slice(1), link);
  }
  const observer = new IntersectionObserver((entries) => {
    for (const entry of entries) {
      if (!entry.isIntersecting) continue;
      for (const link of links.values()) link.removeAttribute("aria-current");
      links.get(entry.target.id)?.setAttribute("aria-current", "true");
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
