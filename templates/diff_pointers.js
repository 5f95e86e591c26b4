// Pointers and wheels that move and zoom a stage.

// Where a pointer is, in shares of the unmoved picture under it.
function place(event, view) {
  const canvas = view.querySelector(".canvas");
  const box = view.getBoundingClientRect();
  return {
    x: (event.clientX - box.left - view.clientLeft - canvas.offsetLeft) / canvas.offsetWidth,
    y: (event.clientY - box.top - view.clientTop - canvas.offsetTop) / canvas.offsetHeight,
  };
}

// Drag moves, two fingers zoom, a wheel zooms where it was clicked before or with Ctrl.
function followPointers(stage) {
  const pointers = new Map();
  const spread = (points) => Math.hypot(points[0].x - points[1].x, points[0].y - points[1].y);
  const middle = (points, axis) => (points[0][axis] + points[1][axis]) / 2;

  stage.addEventListener("pointerdown", (event) => {
    const view = event.target.closest(".view");
    if (!view || event.button !== 0) return;
    setAtHand(stage.closest("article"));
    stage.focus({ preventScroll: true });
    pointers.set(event.pointerId, place(event, view));
    if (event.pointerType === "mouse") event.preventDefault();
    try { view.setPointerCapture(event.pointerId); } catch { /* a pointer that is gone */ }
  });
  stage.addEventListener("pointermove", (event) => {
    const view = event.target.closest(".view");
    if (!view || !pointers.has(event.pointerId)) return;
    const before = Array.from(pointers.values());
    const from = pointers.get(event.pointerId);
    const to = place(event, view);
    pointers.set(event.pointerId, to);
    if (pointers.size === 1) moveBy(stage, to.x - from.x, to.y - from.y);
    if (pointers.size !== 2) return;
    const after = Array.from(pointers.values());
    moveBy(stage, middle(after, "x") - middle(before, "x"), middle(after, "y") - middle(before, "y"));
    const factor = spread(after) / Math.max(1e-6, spread(before));
    zoomBy(stage, factor, middle(after, "x"), middle(after, "y"));
  });
  for (const name of ["pointerup", "pointercancel"]) {
    stage.addEventListener(name, (event) => pointers.delete(event.pointerId));
  }
  stage.addEventListener("touchmove", (event) => {
    if (event.touches.length > 1 || viewOf(stage).zoom > 1) event.preventDefault();
  }, { passive: false });
  stage.addEventListener("wheel", (event) => {
    const view = event.target.closest(".view");
    if (!view || !(event.ctrlKey || stage.contains(document.activeElement))) return;
    event.preventDefault();
    const at = place(event, view);
    zoomBy(stage, Math.exp(-clamp(event.deltaY, -200, 200) / 250), at.x, at.y);
  }, { passive: false });
  stage.addEventListener("dragstart", (event) => event.preventDefault());
}
