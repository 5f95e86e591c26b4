#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "render/plot/drawing.hpp"
#include "render/plot/figure.hpp"

namespace mapproof::test {

/// The layers of one type in a panel.
template <typename Kind>
std::vector<Kind> layers_of(const Panel& panel) {
  std::vector<Kind> found;
  for (const Layer& layer : panel.layers)
    if (const auto* one = std::get_if<Kind>(&layer)) found.push_back(*one);
  return found;
}

/// The layer of a type and label in a panel, if there is one.
template <typename Kind>
std::optional<Kind> labelled(const Panel& panel, const std::string& label) {
  for (const Kind& layer : layers_of<Kind>(panel))
    if (layer.label == label) return layer;
  return std::nullopt;
}

/// The texts of one class in a drawing, in order.
inline std::vector<TextLine> texts_of(const Drawing& drawing, ItemClass item_class) {
  std::vector<TextLine> lines;
  for (const Item& item : drawing.items)
    if (item.item_class == item_class) lines.push_back(std::get<TextLine>(item.what));
  return lines;
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

inline bool notes_contain(const Figure& figure, const std::string& part) {
  return std::ranges::any_of(figure.notes,
                             [&](const Note& note) { return contains(note.text, part); });
}

}  // namespace mapproof::test
