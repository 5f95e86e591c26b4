// The current item ("at hand"), and links to it.

const linkTo = (item) => item.id + (root.dataset.mode === "side" ? "" : `:${root.dataset.mode}`);

function setAtHand(item) {
  if (!item || item === atHand && item.classList.contains("at-hand")) return;
  atHand?.classList.remove("at-hand");
  entryOf.get(atHand?.id)?.querySelector("a").removeAttribute("aria-current");
  atHand = item;
  item.classList.add("at-hand");
  const link = entryOf.get(item.id)?.querySelector("a");
  link?.setAttribute("aria-current", "true");
  link?.scrollIntoView({ block: "nearest" });
  showZoom(stageAtHand());
}

let held = false;  // While the script scrolls, the position does not show what is being read.

function show(item) {
  if (!shown(item)) clearFilter();
  unfold(item);
  if (item.matches("article")) setAtHand(item);
  held = true;
  item.scrollIntoView({ block: "start" });
  // The browser lays out what is above only now; its height may differ from the estimate.
  requestAnimationFrame(() => item.scrollIntoView({ block: "start" }));
  (item.querySelector("h2") ?? item).focus({ preventScroll: true });
}

function followHash() {
  const [anchor, mode] = location.hash.slice(1).split(":");
  const item = anchor === "" ? null : by(anchor);
  if (!item?.matches("article.item, .identical li")) return;
  if (items.length > 0) setMode(modes.includes(mode) ? mode : "side");
  show(item);
}

function step(count) {
  const visible = items.filter(shown);
  const at = visible.indexOf(atHand);
  // Above the first item, "next" leads to the first item.
  const above = count > 0 && at === 0 && location.hash === "" && !held;
  const target = at < 0 || above ? visible[0] : visible[at + count];
  if (!target) return;
  const hash = `#${linkTo(target)}`;
  if (location.hash === hash) show(target);
  else location.hash = hash;
}

function followReading() {
  for (const name of ["wheel", "touchmove", "pointerdown"]) {
    addEventListener(name, () => { held = false; }, { passive: true });
  }
  const observer = new IntersectionObserver((entries) => {
    if (held) return;
    const read = entries.find((entry) => entry.isIntersecting);
    if (read) setAtHand(read.target);
  }, { rootMargin: "-20% 0px -75% 0px" });
  for (const item of items) observer.observe(item);
}
