// Zoom and pan, the same on every page. A view is the box of some content that its frame shows, in
// the content's own units. Wheel, drag, pinch, keys and buttons change the box; an adapter puts it
// on the screen:
//   most             greatest magnification
//   apply(view)      shows the box view.now
//   surface(event)   the element under the pointer that shows the content; null if there is none
//   position(event)  where a pointer is, { x, y } in units that zooming does not change
//   point(position)  what the content shows there, { x, y } in the content's units
//   isActive()       whether the wheel zooms without Ctrl
//   grab(event)      called when a pointer goes down on a surface

const kZoomStep = 1.5;  // Of one key or button.
const kMoveStep = 0.1;  // Of one arrow key, as a share of what is shown.

class View {
  // `home` is the box that "fit" shows.
  constructor(home, adapter) {
    this.adapter = adapter;
    this.home = { ...home };
    this.now = { ...home };
  }

  get magnification() {
    return this.home.width / this.now.width;
  }

  get isZoomed() {
    return this.now.width < this.home.width;
  }

  show() {
    const { home, now } = this;
    now.x = clamp(now.x, home.x, home.x + home.width - now.width);
    now.y = clamp(now.y, home.y, home.y + home.height - now.height);
    this.adapter.apply(this);
  }

  setHome(home) {
    this.home = { ...home };
    this.fit();
  }

  fit() {
    this.now = { ...this.home };
    this.show();
  }

  // Keeps a point of the content, by default the middle of what is shown, where it is.
  zoom(factor, about = this.middle()) {
    const magnification = Math.min(this.adapter.most, this.magnification * factor);
    if (magnification < 1 + 1e-9) return this.fit();
    const { home, now } = this;
    const change = this.magnification / magnification;
    now.x = about.x - (about.x - now.x) * change;
    now.y = about.y - (about.y - now.y) * change;
    now.width = home.width / magnification;
    now.height = home.height / magnification;
    return this.show();
  }

  // In the content's units.
  moveBy(right, down) {
    this.now.x += right;
    this.now.y += down;
    this.show();
  }

  // In shares of what is shown.
  moveByShare(right, down) {
    this.moveBy(right * this.now.width, down * this.now.height);
  }

  middle() {
    const { x, y, width, height } = this.now;
    return { x: x + width / 2, y: y + height / 2 };
  }
}

const views = new WeakMap();
const viewOf = (element) => views.get(element);

function clamp(value, low, high) {
  return Math.min(high, Math.max(low, value));
}

function middle(points) {
  const mean = (name) => points.reduce((sum, point) => sum + point[name], 0) / points.length;
  return { x: mean("x"), y: mean("y") };
}

const spread = ([a, b]) => Math.max(1e-6, Math.hypot(a.x - b.x, a.y - b.y));

// One pointer drags, two pinch.
function followPointers(element, view) {
  const { adapter } = view;
  const pointers = new Map();
  element.addEventListener("pointerdown", (event) => {
    const surface = adapter.surface(event);
    if (!surface || event.button !== 0) return;
    adapter.grab(event);
    pointers.set(event.pointerId, adapter.position(event));
    try { surface.setPointerCapture(event.pointerId); } catch { /* a pointer that is gone */ }
  });
  element.addEventListener("pointermove", (event) => {
    if (!pointers.has(event.pointerId) || !adapter.surface(event)) return;
    const before = [...pointers.values()];
    pointers.set(event.pointerId, adapter.position(event));
    const after = [...pointers.values()];
    const from = adapter.point(middle(before)), to = adapter.point(middle(after));
    view.moveBy(from.x - to.x, from.y - to.y);
    if (after.length !== 2) return;
    view.zoom(spread(after) / spread(before), adapter.point(middle(after)));
  });
  for (const name of ["pointerup", "pointercancel", "lostpointercapture"]) {
    element.addEventListener(name, (event) => pointers.delete(event.pointerId));
  }
  element.addEventListener("touchmove", (event) => {
    if (event.touches.length > 1 || view.isZoomed) event.preventDefault();
  }, { passive: false });
  element.addEventListener("dragstart", (event) => event.preventDefault());
}

// The wheel scrolls the page until the content was clicked, or Ctrl is held.
function followWheel(element, view) {
  const { adapter } = view;
  element.addEventListener("wheel", (event) => {
    const isWanted = event.ctrlKey || event.metaKey || adapter.isActive();
    if (!isWanted || !adapter.surface(event)) return;
    event.preventDefault();
    const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 20 : 1;
    const factor = Math.exp(-clamp(event.deltaY * lines, -200, 200) / 300);
    view.zoom(factor, adapter.point(adapter.position(event)));
  }, { passive: false });
}

const zoomKeys = new Map([
  ["+", (view) => view.zoom(kZoomStep)], ["=", (view) => view.zoom(kZoomStep)],
  ["-", (view) => view.zoom(1 / kZoomStep)], ["0", (view) => view.fit()],
]);
const arrowKeys = new Map([
  ["ArrowLeft", (view) => view.moveByShare(-kMoveStep, 0)],
  ["ArrowRight", (view) => view.moveByShare(kMoveStep, 0)],
  ["ArrowUp", (view) => view.moveByShare(0, -kMoveStep)],
  ["ArrowDown", (view) => view.moveByShare(0, kMoveStep)],
]);

// What a key does to a view. Arrows scroll the page while the content is not zoomed.
function actOfKey(key, view) {
  return zoomKeys.get(key) ?? (view.isZoomed ? arrowKeys.get(key) : undefined);
}

function addView(element, home, adapter) {
  const view = new View(home, adapter);
  views.set(element, view);
  return view;
}
