#include "render/style/words.hpp"

#include <algorithm>
#include <span>
#include <variant>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/errors.hpp"
#include "core/base/resource.hpp"
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

void replace(std::string& text, const Words& words) { text = replaced(text, words); }

void replace(std::vector<Note>& notes, const Words& words) {
  for (Note& note : notes) replace(note.text, words);
}

void replace(Axis& axis, const Words& words) {
  replace(axis.label, words);
  for (std::string& name : axis.names) replace(name, words);
}

void replace(Layer& layer, const Words& words) {
  std::visit(
      [&](auto& one) {
        if constexpr (requires { one.label; }) replace(one.label, words);
        if constexpr (requires { one.bar_label; }) replace(one.bar_label, words);
      },
      layer);
  if (auto* texts = std::get_if<Texts>(&layer))
    for (std::string& text : texts->text) replace(text, words);
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

void replace_words(Figure& figure, const Words& words) {
  if (words.empty()) return;
  for (std::string* text : {&figure.title, &figure.caption, &figure.alt}) replace(*text, words);
  replace(figure.notes, words);
  for (PanelArrow& arrow : figure.arrows) replace(arrow.label, words);
  for (Panel& panel : figure.panels) {
    replace(panel.title, words);
    replace(panel.x, words);
    replace(panel.y, words);
    for (Layer& layer : panel.layers) replace(layer, words);
  }
}

void replace_words(Scene& scene, const Words& words) {
  if (words.empty()) return;
  for (std::string* text : {&scene.title, &scene.caption, &scene.alt}) replace(*text, words);
  replace(scene.notes, words);
  for (Part& part : scene.parts) std::visit([&](auto& one) { replace(one.label, words); }, part);
  for (Shot& view : scene.views) {
    replace(view.title, words);
    for (Rule& rule : view.rules) replace(rule.label, words);
  }
}

std::map<std::string, std::string> words_of(const FigureStyle& style) {
  std::map<std::string, std::string> words = language_words(style.language);
  for (const auto& [phrase, by] : style.words) words[phrase] = by;
  return words;
}

}  // namespace mapproof
