// Thumbnails for the links at the head of the page, from the drawings that the page holds.

function addThumbnails() {
  for (const link of document.querySelectorAll(".thumbnails a")) {
    const figure = document.getElementById(link.hash.slice(1));
    const text = figure ? sourceOf(figure) : "";
    if (text === "") continue;
    const image = new Image();
    image.alt = "";  // The link has the title.
    image.src = svgUrl(text);
    link.prepend(image);
  }
}
