// The keyboard of a comparison.

function onKey(event) {
  if (event.ctrlKey || event.metaKey || event.altKey || by("keys").open) return;
  const target = event.target;
  if (target.matches?.("input:not([type=checkbox]):not([type=range]), textarea, select")) {
    if (event.key === "Escape") target.blur();
    return;
  }
  const stage = stageAtHand();
  const acts = {
    j: () => step(1), n: () => step(1), k: () => step(-1), p: () => step(-1),
    m: nextMode,
    a: () => tickOf(atHand)?.click(),
    b: () => { if (root.dataset.mode !== "blink") chooseMode("blink"); setBlinking(!blinking); },
    f: () => { if (root.dataset.mode !== "blink") chooseMode("blink"); flip(); },
    0: () => stage && fit(stage),
    "/": () => by("search").focus(),
    "?": () => by("keys").showModal(),
  };
  modes.forEach((mode, index) => { acts[index + 1] = () => chooseMode(mode); });
  const zoomAct = stage && actOfKey(event.key, viewOf(stage));
  const scrolls = event.key.startsWith("Arrow") && target.matches?.("input, .scroll, .long, pre");
  if (zoomAct && !scrolls && !Object.hasOwn(acts, event.key)) {
    acts[event.key] = () => zoomAct(viewOf(stage));
  }
  if (!Object.hasOwn(acts, event.key)) {
    held = held && !["PageDown", "PageUp", "ArrowDown", "ArrowUp", " "].includes(event.key);
    return;
  }
  event.preventDefault();
  acts[event.key]();
}
