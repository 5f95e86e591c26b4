// Waits for states of a page: how long they take depends on what else the machine does.

/// Waits until a function of the page holds; its policy forbids what waitForFunction() does.
export async function until(page, holds, argument) {
  for (let tries = 0; !await page.evaluate(holds, argument); ++tries) {
    if (tries > 300) throw new Error(`not within 30 s: ${holds}`);
    await page.waitForTimeout(100);
  }
}

/// Waits until all drawings near the window are inserted: their controls move what is below them.
export const drawingsNear = (page) => until(page, () => {
  const kNear = .6, kRounding_px = 1;  // As in putInWhenNear().
  return held.every((figure) => {
    const { top, bottom } = figure.getBoundingClientRect();
    const isNear = figure.checkVisibility() && bottom > kRounding_px - kNear * innerHeight &&
      top < (1 + kNear) * innerHeight - kRounding_px;
    return !isNear || !figure.querySelector(".drawing > noscript");
  });
});

/// Waits until the first screen has its figure, and its small images, without empty ones, are placed.
export const openingPlaced = (page) => until(page, async () => {
  const figure = document.querySelector(".main-figure img");
  const list = document.querySelector(".thumbnails");
  if (figure && !figure.complete) return false;
  const images = [...document.querySelectorAll(".thumbnails img")];
  const shares = await Promise.all(images.map((image) => drawnShare(openingDrawings.get(image))));
  const isPlaced = !list || narrowPage.matches || list.style.getPropertyValue("--columns") !== "";
  return isPlaced && shares.every((share) => share >= kLeastDrawn);
});
