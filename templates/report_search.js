// One field searches the page: headings, texts, tables, the words of figures that a browser's own
// search cannot see, since their texts are outlines, and the titles of what other pages hold.

const kMostFound = 12;
const kTexts = "main p, main li, main dd";
const kNoTexts = "figure, .table, .page-links, .thumbnails, .main-figure, .affected, dialog";

// A text as it is typed: with the blanks and hyphens of a keyboard.
function typed(text) {
  return text.replaceAll("\u00a0", " ").replaceAll("\u2011", "-");
}

function searchable(element, link, name, words) {
  const section = element.closest("main > section")?.id;
  return { element, link, name, section, words: typed(`${name} ${words}`).toLocaleLowerCase("en") };
}

// The titles of the sections, by their ids.
function sectionTitles() {
  return new Map([...document.querySelectorAll(".contents a")].map(
    (link) => [link.hash.slice(1), link.textContent]));
}

// All that can be found, in the order of the page.
function searchables() {
  const found = [], titles = sectionTitles();
  const kinds = `main > section[id^=section-], .table, figure[data-id], .page-links a, ${kTexts}`;
  for (const each of document.querySelectorAll(kinds)) {
    if (each.matches(".page-links a")) {
      found.push(searchable(each, "", each.textContent, ""));
    } else if (each.matches(kTexts)) {
      if (each.closest(kNoTexts) || each.querySelector(kTexts)) continue;
      const text = typed(each.textContent.trim()).replace(/\s+/g, " ");
      found.push({ ...searchable(each, each.id, "", text), text });
    } else if (each.localName === "section") {
      found.push(searchable(each, each.id, titles.get(each.id) ?? each.id, ""));
    } else if (each.localName === "figure") {
      const drawn = sourceOf(each), caption = each.querySelector("figcaption bdi")?.textContent ?? "";
      const title = /<title[^>]*>([^<]*)/.exec(drawn)?.[1] ?? each.dataset.id;
      const words = /<desc[^>]*>([^<]*)/.exec(drawn)?.[1] ?? "";
      found.push(searchable(each, each.id, decoded(title), `${caption} ${decoded(words)}`));
    } else {
      const name = each.querySelector("h3").firstChild.textContent.trim();
      found.push(searchable(each, each.id, name, each.textContent));
    }
  }
  return found;
}

// The references that our SVG files use.
function decoded(text) {
  const characters = { lt: "<", gt: ">", quot: '"', apos: "'", amp: "&" };
  return text.replace(/&(lt|gt|quot|apos|amp);/g, (all, name) => characters[name]);
}

// Whether a text has a word there, not in another one.
function beginsWord(text, at) {
  return at === 0 || !/[\p{L}\p{N}]/u.test(text[at - 1]);
}

// Where a text has a word: at the beginning of one of its own, if there it has it; -1 if nowhere.
function placeOf(text, word) {
  for (let at = text.indexOf(word); at >= 0; at = text.indexOf(word, at + 1)) {
    if (beginsWord(text, at)) return at;
  }
  return text.indexOf(word);
}

// Some words of a text around the first one that was searched for, which is marked.
function excerpt(text, words) {
  const kBefore = 12, kMost = 80;
  const at = placeOf(text.toLocaleLowerCase("en"), words[0]);
  const from = at <= kBefore ? 0 : text.indexOf(" ", at - kBefore) + 1;
  const start = `${from > 0 ? "\u2026\u00a0" : ""}`;
  if (at < 0) return [start, text.slice(0, kMost)];
  const hit = document.createElement("mark");
  hit.textContent = text.slice(at, at + words[0].length);
  return [start, text.slice(from, at), hit, text.slice(at + words[0].length, from + kMost)];
}

// The id of an element; one that has none gets one, so that a link can lead to it.
function idOf(element) {
  if (!element.id) element.id = `text-${document.querySelectorAll("[id^=text-]").length + 1}`;
  return element.id;
}

// How well an entry is what is searched for: 2 if words of it begin with all that is typed, 1 if it
// has that, 0 if not.
function match(entry, words) {
  const places = words.map((word) => placeOf(entry.words, word));
  if (places.includes(-1)) return 0;
  return places.every((at) => beginsWord(entry.words, at)) ? 2 : 1;
}

// What is found of all entries, those with whole beginnings first, each in the order of the page.
function foundOf(all, words) {
  if (words.length === 0) return [];
  const found = [[], [], []];
  for (const entry of all) found[match(entry, words)].push(entry);
  return [...found[2], ...found[1]];
}

function addSearch(parent) {
  const label = document.createElement("label"), field = document.createElement("input");
  const list = document.createElement("ul"), count = document.createElement("output");
  label.className = "search";
  field.type = "search";
  field.placeholder = "Search this page";
  field.setAttribute("aria-label", "Search this page");
  list.className = "found";
  const more = document.createElement("button");
  more.type = "button";
  let all, titles, words = [], found = [], next = 0;
  const itemOf = (entry) => {
    const item = document.createElement("li"), link = document.createElement("a");
    link.href = entry.element.getAttribute("href") ?? `#${entry.link || idOf(entry.element)}`;
    const place = document.createElement("small");
    place.textContent = titles.get(entry.section) ?? "";
    link.append(...excerpt(entry.text ?? entry.name, words), place);
    link.title = entry.text ?? entry.name;
    link.addEventListener("click", () => unfold(entry.element));
    item.append(link);
    return item;
  };
  const show = (most) => {
    list.replaceChildren(...found.slice(0, most).map(itemOf));
    const isCut = found.length > most;
    count.textContent = words.length === 0 ? "" :
      isCut ? `${found.length} found, the first ${most} are listed` : `${found.length} found`;
    more.textContent = `Show all ${found.length}`;
    more.hidden = !isCut;
  };
  more.hidden = true;
  more.addEventListener("click", () => {
    const first = list.childElementCount;
    show(found.length);
    list.children[first].querySelector("a").focus();
  });
  field.addEventListener("input", () => {
    all ??= searchables();
    titles ??= sectionTitles();
    words = field.value.toLocaleLowerCase("en").split(/\s+/).filter(Boolean);
    found = foundOf(all, words);
    next = 0;
    show(kMostFound);
  });
  // Each press leads one hit on.
  field.addEventListener("keydown", (event) => {
    if (event.key !== "Enter" || found.length === 0) return;
    if (next >= list.childElementCount) show(found.length);
    list.children[next].querySelector("a").click();
    next = (next + 1) % found.length;
  });
  label.append(field);
  parent.prepend(label, count, list, more);
}
