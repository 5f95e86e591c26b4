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

// Some words of a text around the first one that was searched for, which is marked.
function excerpt(text, words) {
  const kBefore = 12, kMost = 80;
  const at = text.toLocaleLowerCase("en").indexOf(words[0]);
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

function matches(entry, words) {
  return words.every((word) => entry.words.includes(word));
}

function addSearch(parent) {
  const label = document.createElement("label"), field = document.createElement("input");
  const list = document.createElement("ul"), count = document.createElement("output");
  label.className = "search";
  field.type = "search";
  field.placeholder = "Search this page";
  field.setAttribute("aria-label", "Search this page");
  list.className = "found";
  let all, titles;
  field.addEventListener("input", () => {
    all ??= searchables();
    titles ??= sectionTitles();
    const words = field.value.toLocaleLowerCase("en").split(/\s+/).filter(Boolean);
    const found = words.length === 0 ? [] : all.filter((entry) => matches(entry, words));
    list.replaceChildren(...found.slice(0, kMostFound).map((entry) => {
      const item = document.createElement("li"), link = document.createElement("a");
      link.href = entry.element.getAttribute("href") ?? `#${entry.link || idOf(entry.element)}`;
      const place = document.createElement("small");
      place.textContent = titles.get(entry.section) ?? "";
      link.append(...excerpt(entry.text ?? entry.name, words), place);
      link.title = entry.text ?? entry.name;
      link.addEventListener("click", () => unfold(entry.element));
      item.append(link);
      return item;
    }));
    const more = found.length - kMostFound;
    count.textContent = words.length === 0 ? "" :
      more > 0 ? `${found.length} found, the first ${kMostFound} are listed` : `${found.length} found`;
  });
  field.addEventListener("keydown", (event) => {
    if (event.key === "Enter") list.querySelector("a")?.click();
  });
  label.append(field);
  parent.prepend(label, count, list);
}
