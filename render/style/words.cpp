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
        if constexpr (requires { one.bar_label; }) use(one.bar_label);
      },
      layer);
  if (auto* texts = std::get_if<Texts>(&layer))
    for (std::string& text : texts->text) use(text);
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
    const Words::value_type* longest = nullptr;
    if (is_border(text, at))
      for (const Words::value_type& word : words)
        if (!word.first.empty() && text.substr(at).starts_with(word.first) &&
            is_border(text, at + word.first.size()) &&
            (longest == nullptr || word.first.size() > longest->first.size()))
          longest = &word;
    made += longest == nullptr ? std::string(1, text[at]) : longest->second;
    at += longest == nullptr ? 1 : longest->first.size();
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
  for (Part& part : scene.parts) std::visit([&](auto& one) { use(one.label); }, part);
  for (Shot& view : scene.views) {
    use(view.title);
    for (Rule& rule : view.rules) use(rule.label);
  }
}

void replace_words(Figure& figure, const Words& words) {
  if (!words.empty())
    for_each_text(figure, [&](std::string& text) { text = replaced(text, words); });
}

void replace_words(Scene& scene, const Words& words) {
  if (!words.empty())
    for_each_text(scene, [&](std::string& text) { text = replaced(text, words); });
}

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
