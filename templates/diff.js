// The page of a comparison: what its parts (diff_*.js, which precede this file in the page) share,
// and its start. None of them turns a text into markup.
const root = document.documentElement;
const main = document.querySelector("main");
const items = Array.from(document.querySelectorAll("article.item"));
const by = (id) => document.getElementById(id);
let atHand = items[0] ?? null;

const shown = (element) => !element.hidden;
const entryOf = new Map(Array.from(document.querySelectorAll(".index li"),
  (entry) => [entry.querySelector("a").getAttribute("href").slice(1), entry]));

function makeClusterButton(cluster) {
  const stage = cluster.closest("article").querySelector(".stage");
  const button = document.createElement("button");
  button.type = "button";
  button.textContent = "Show it";
  button.addEventListener("click", () => {
    setAtHand(cluster.closest("article"));
    showBox(stage, ...["box", "size"].map((name) => cluster.dataset[name].split(" ").map(Number)));
    stage.scrollIntoView({ block: "nearest" });
  });
  cluster.append(button);
}

function makeToolbar() {
  document.querySelector(".toolbar").hidden = false;
  by("previous").addEventListener("click", () => step(-1));
  by("next").addEventListener("click", () => step(1));
  for (const button of document.querySelectorAll(".modes button")) {
    button.addEventListener("click", () => chooseMode(button.dataset.mode));
  }
  const withStage = (act) => () => { if (stageAtHand()) act(stageAtHand()); };
  by("zoom-in").addEventListener("click", withStage((stage) => viewOf(stage).zoom(kZoomStep)));
  by("zoom-out").addEventListener("click", withStage((stage) => viewOf(stage).zoom(1 / kZoomStep)));
  by("fit").addEventListener("click", withStage(fit));
  by("cut").addEventListener("input", () => setCut(Number(by("cut").value)));
  by("opacity").addEventListener("input",
    () => root.style.setProperty("--opacity", by("opacity").value / 100));
  by("difference").addEventListener("change",
    () => root.toggleAttribute("data-difference", by("difference").checked));
  by("play").addEventListener("click", () => setBlinking(!blinking));
  by("flip").addEventListener("click", flip);
  by("help").addEventListener("click", () => by("keys").showModal());
}

root.classList.add("scripted");
document.querySelector(".search").hidden = false;
addThemeSwitch(document.querySelector(".masthead"));
for (const table of document.querySelectorAll("main table")) makeSortable(table);
foldDetails();
fitTablesToPaper();
makeChips();
by("search").addEventListener("input", applyFilter);
by("close-keys").addEventListener("click", () => by("keys").close());
if (items.length > 0) {
  makeToolbar();
  makeOrder();
  addThumbnails();
  for (const stage of document.querySelectorAll(".stage")) makeStage(stage);
  for (const cluster of document.querySelectorAll(".cluster")) makeClusterButton(cluster);
  makeTicks();
  setCut(50);
  setShown("baseline");
  setMode("side");
  setAtHand(items[0]);
  followReading();
  addEventListener("keydown", onKey);
}
addEventListener("hashchange", followHash);
followHash();
