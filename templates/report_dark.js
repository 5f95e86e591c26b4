// Figures in the dark: the colours of their SVG, each with the one that it has on a dark page. The
// files keep their own.

const kDarkColours = {
  "#ffffff": "#15181c", "#1a1a1a": "#e6e9ed", "#000000": "#ffffff",  // Paper, text, lines.
  "#757575": "#9aa3ad", "#bababa": "#656b73", "#e4e4e4": "#2b3138",  // Muted, faint, grid.
  "#0072b2": "#4ba6e0", "#d55e00": "#f08a3c", "#009e73": "#2cc79a", "#7a3300": "#ffef66",
  "#332288": "#a37294", "#c66fa1": "#de9cc2", "#cc2244": "#ee4455", "#9977ff": "#8866ff",
  "#006666": "#55eeff", "#a33c00": "#f3ac72",  // The last: warnings.
};

// Lines with gaps are paler than their colour: muted ones have a stronger one in the dark.
const kMuted = "#757575", kDarkDashed = "#c8cdd3";

function isDarkPage() {
  const theme = document.documentElement.dataset.theme;
  return theme ? theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
}

// The style of the drawings in the page follows the theme by itself, and paper has the light one.
// The rules name no ancestors: markers, which <use> repeats, have none there.
function addFigureColours() {
  const { sheet } = document.querySelector("style");
  const add = (rule) => sheet.insertRule(rule, sheet.cssRules.length);
  for (const [light, dark] of Object.entries(kDarkColours)) {
    for (const name of ["fill", "stroke"]) {
      add(`[${name}="${light}"] { ${name}: light-dark(${light}, ${dark}); }`);
    }
    add(`.cell-text[fill="${light}"] { fill: ${light}; }`);  // The cells below keep theirs, too.
  }
  add(`[stroke="${kMuted}"][stroke-dasharray] { stroke: light-dark(${kMuted}, ${kDarkDashed}); }`);
  add(".drawing { background: light-dark(#ffffff, #15181c); }");
}

const kCrcTable = Array.from({ length: 256 }, (_, byte) => {
  let value = byte;
  for (let bit = 0; bit < 8; ++bit) value = value & 1 ? 0xEDB88320 ^ (value >>> 1) : value >>> 1;
  return value;
});

function crcOf(bytes) {
  let crc = -1;
  for (const byte of bytes) crc = kCrcTable[(crc ^ byte) & 255] ^ (crc >>> 8);
  return ~crc;
}

const bytesOf = (base64) => Uint8Array.from(atob(base64), (sign) => sign.charCodeAt(0));

function base64Of(bytes) {
  const kAtOnce = 8192, signs = [];
  for (let at = 0; at < bytes.length; at += kAtOnce) {
    signs.push(String.fromCharCode(...bytes.subarray(at, at + kAtOnce)));
  }
  return btoa(signs.join(""));
}

// A PNG with another palette, all in base64.
function inPalette(png, palette) {
  const bytes = bytesOf(png), view = new DataView(bytes.buffer), colours = bytesOf(palette);
  for (let at = 8; at < bytes.length;) {
    const length = view.getUint32(at), data = at + 8;
    if (String.fromCharCode(...bytes.subarray(at + 4, data)) === "PLTE") {
      bytes.set(colours.subarray(0, length), data);
      view.setInt32(data + length, crcOf(bytes.subarray(at + 4, data + length)));
      break;
    }
    at = data + length + 4;
  }
  return base64Of(bytes);
}

// The image of a 3-D figure has a palette for each theme: with both there are two images, of which
// the style shows one.
function addDarkImages(svg) {
  const kPng = "data:image/png;base64,";
  for (const image of svg.querySelectorAll("image[data-dark]")) {
    const dark = image.cloneNode(false);
    dark.setAttribute("href",
      kPng + inPalette(image.getAttribute("href").slice(kPng.length), image.dataset.dark));
    image.setAttribute("class", "in-light");
    dark.setAttribute("class", "in-dark");
    image.after(dark);
  }
}

// Files have the light one.
function withoutDarkPalettes(text) {
  return text.replace(/ data-dark="[^"]*"/g, "");
}

// The text of an SVG in the colours of the page, for images.
function inPageColours(text) {
  if (!isDarkPage()) return withoutDarkPalettes(text);
  return text.replace(/base64,([^"]*)" data-dark="([^"]*)"/g,
    (all, png, palette) => `base64,${inPalette(png, palette)}"`)
    .replaceAll(new RegExp(`stroke="${kMuted}"(?=[^>]* stroke-dasharray)`, "g"),
      `stroke="${kDarkDashed}"`)
    .replace(/(class="cell-text" )?(fill|stroke)="(#[0-9a-f]{6})"/g,
      (all, cell, name, colour) => (cell ? all : `${name}="${kDarkColours[colour] ?? colour}"`));
}
