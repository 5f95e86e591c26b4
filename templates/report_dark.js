// Figures in the dark: the colours of their SVG, each with the one that it has on a dark page. The
// files keep their own.

const kDarkColours = {
  "#ffffff": "#15181c", "#1a1a1a": "#e6e9ed", "#000000": "#ffffff",  // Paper, text, lines.
  "#757575": "#9aa3ad", "#bababa": "#5b646e", "#e4e4e4": "#2b3138",  // Muted, faint, grid.
  "#0072b2": "#4ba6e0", "#d55e00": "#f08a3c", "#009e73": "#2cc79a", "#8a7d00": "#c9b93a",
  "#3a90c4": "#7cc0ea", "#c66fa1": "#de9cc2",
};

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
  }
  // A 3-D figure is an image with labels on it: both keep the colours of light paper.
  add(".drawing:has(svg image) { color-scheme: light; }");
  add(".drawing { background: light-dark(#ffffff, #15181c); }");
}

// The text of an SVG in the colours of the page, for images.
function inPageColours(text) {
  if (!isDarkPage() || text.includes("<image")) return text;
  return text.replace(/(fill|stroke)="(#[0-9a-f]{6})"/g,
    (all, name, colour) => `${name}="${kDarkColours[colour] ?? colour}"`);
}
