#include "render/style/words.hpp"

#include <algorithm>
#include <functional>
#include <set>
#include <span>
#include <variant>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/errors.hpp"
#include "core/base/resource.hpp"
#include "core/base/text/spelling.hpp"
#include "core/json/record_reader.hpp"
#include "render/style/edits.hpp"
#include "render/style/figure_style_fields.hpp"

namespace mapproof {

/// A style with words each, named by its language: "de.json".
std::span<const Resource> language_resources();

namespace {

using Words = std::map<std::string, std::string>;

/// Letters and digits of any script: bytes of UTF-8 beyond ASCII count as such.
bool is_of_word(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte >= 0x80 || (byte >= '0' && byte <= '9') || (byte >= 'A' && byte <= 'Z') ||
         (byte >= 'a' && byte <= 'z') || byte == '_';
}

/// Whether no word goes on across the place before `at`.
bool is_border(std::string_view text, std::size_t at) {
  return at == 0 || at == text.size() || !is_of_word(text[at - 1]) || !is_of_word(text[at]);
}

/// Whether a phrase stands in the text, as whole words.
bool is_phrase(std::string_view text, std::size_t at, std::string_view phrase) {
  return !phrase.empty() && is_border(text, at) && text.substr(at).starts_with(phrase) &&
         is_border(text, at + phrase.size());
}

/// Of the phrases at a place of the text; 0: there is none.
std::size_t longest_phrase(std::string_view text, std::size_t at, const Words& words) {
  std::size_t length = 0;
  for (const Words::value_type& word : words)
    if (is_phrase(text, at, word.first)) length = std::max(length, word.first.size());
  return length;
}

/// Of a symbol, an abbreviation or a number that begins there; 0: it is a word of a language.
std::size_t symbol_length(std::string_view text, std::size_t at) {
  std::size_t length = 0;
  while (at + length < text.size() && is_of_word(text[at + length])) ++length;
  const std::string_view word = text.substr(at, length);
  const bool is_lower =
      word.substr(1).find_first_not_of("abcdefghijklmnopqrstuvwxyz") == std::string_view::npos;
  const bool is_number = word.front() >= '0' && word.front() <= '9';
  return length > 1 && is_lower && !is_number ? 0 : length;
}

using Use = std::function<void(std::string& text)>;

void for_each_text(std::vector<Note>& notes, const Use& use) {
  for (Note& note : notes) use(note.text);
}

void for_each_text(Axis& axis, const Use& use) {
  use(axis.label);
  for (std::string& name : axis.names) use(name);
}

void for_each_text(Layer& layer, const Use& use) {
  std::visit(
      [&](auto& one) {
        if constexpr (requires { one.label; }) use(one.label);
        if constexpr (requires { one.colour_scale; }) use(one.colour_scale.bar_label);
      },
      layer);
  if (auto* texts = std::get_if<Texts>(&layer))
    for (std::string& text : texts->text) use(text);
}

/// @param names  Of landmarks, which stay as they are.
template <typename Drawable>
void replace_words_of(Drawable& drawable, const FigureStyle& style,
                      const std::vector<std::string>& names) {
  const Words words = words_of(style);
  if (words.empty()) return;
  const auto replace = [&](std::string& text) { text = replaced(text, words); };
  if (style.language.empty() || style.language == "en") return for_each_text(drawable, replace);
  std::set<const std::string*> sentences = {&drawable.caption, &drawable.alt};
  for (const Note& note : drawable.notes) sentences.insert(&note.text);
  for_each_text(drawable, [&](std::string& text) {
    if (!sentences.contains(&text) || replaces_all(text, words, names)) replace(text);
  });
}

/// Whether a text has the phrase as replaced() finds it.
bool has_phrase(std::string_view text, const std::string& phrase) {
  return replaced(text, {{phrase, ""}}) != text;
}

}  // namespace

std::vector<std::string_view> languages() {
  std::vector<std::string_view> names = {"en"};
  for (const Resource& resource : language_resources())
    names.push_back(resource.name.substr(0, resource.name.find('.')));
  std::ranges::sort(names);
  return names;
}

Words language_words(std::string_view language) {
  if (language.empty() || language == "en") return {};
  for (const Resource& resource : language_resources())
    if (resource.name == std::string(language) + ".json")
      return from_json_text<FigureStyle>(resource.bytes, std::string(resource.name)).words;
  throw InvalidInput(fmt::format("the words of figures are not there in \"{}\"; there are {}",
                                 printable(std::string(language)), fmt::join(languages(), ", ")));
}

std::string replaced(std::string_view text, const Words& words) {
  std::string made;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = longest_phrase(text, at, words);
    made += length == 0 ? std::string(1, text[at])
                        : words.find(std::string(text.substr(at, length)))->second;
    at += std::max(length, std::size_t{1});
  }
  return made;
}

void for_each_text(Figure& figure, const Use& use) {
  for (std::string* text : {&figure.title, &figure.caption, &figure.alt}) use(*text);
  for_each_text(figure.notes, use);
  for (PanelArrow& arrow : figure.arrows) use(arrow.label);
  for (Panel& panel : figure.panels) {
    use(panel.title);
    for_each_text(panel.x, use);
    for_each_text(panel.y, use);
    for (Layer& layer : panel.layers) for_each_text(layer, use);
  }
}

void for_each_text(Scene& scene, const Use& use) {
  for (std::string* text : {&scene.title, &scene.caption, &scene.alt}) use(*text);
  for_each_text(scene.notes, use);
  for (Part& part : scene.parts)
    std::visit([&](auto& one) { use(one.label), use(one.tones.bar_label); }, part);
  for (Shot& view : scene.views) {
    use(view.title);
    for (Rule& rule : view.rules) use(rule.label);
  }
}

bool replaces_all(std::string_view text, const Words& words,
                  const std::vector<std::string>& names) {
  for (std::size_t at = 0; at < text.size();) {
    std::size_t length = 1;
    if (is_border(text, at) && is_of_word(text[at])) {
      length = longest_phrase(text, at, words);
      for (const std::string& name : names)
        if (is_phrase(text, at, name)) length = std::max(length, name.size());
      if (length == 0) length = symbol_length(text, at);
      if (length == 0) return false;
    }
    at += length;
  }
  return true;
}

void replace_words(Figure& figure, const FigureStyle& style) {
  const std::vector<std::string> names = landmarks_of(figure);
  replace_words_of(figure, style, names);
}

void replace_words(Scene& scene, const FigureStyle& style) { replace_words_of(scene, style, {}); }

void require_known_phrases(const FigureStyle& style, const std::vector<std::string>& texts,
                           const std::string& source) {
  std::set<std::string, std::less<>> known;
  for (const std::string_view language : languages())
    for (const auto& [phrase, by] : language_words(language)) known.insert(phrase);
  for (const auto& [phrase, by] : style.words) {
    const auto has_it = [&](std::string_view text) { return has_phrase(text, phrase); };
    if (std::ranges::any_of(known, has_it) || std::ranges::any_of(texts, has_it)) continue;
    known.insert(texts.begin(), texts.end());
    const std::string_view meant =
        likely_word(phrase, std::vector<std::string_view>(known.begin(), known.end()));
    throw IoError(source, "/words",
                  fmt::format("no figure says \"{}\"{}", printable(phrase),
                              meant.empty() ? "" : fmt::format("; did you mean \"{}\"?", meant)));
  }
}

std::map<std::string, std::string> words_of(const FigureStyle& style) {
  std::map<std::string, std::string> words = language_words(style.language);
  for (const auto& [phrase, by] : style.words) words[phrase] = by;
  return words;
}

}  // namespace mapproof
