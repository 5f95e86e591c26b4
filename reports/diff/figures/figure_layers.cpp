#include "reports/diff/figures/figure_layers.hpp"

#include <algorithm>
#include <array>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "render/plot/figure_fields.hpp"

namespace mapproof {
namespace {

/// The names in the comparison of fields that have a different name in files.
std::string_view word_of(std::string_view key) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 7> kWords = {
      {{"rotation_rad", "rotation"},
       {"values", "value"},
       {"limits", "limits of the ramp"},
       {"bar_label", "label of the colour bar"},
       {"clear_x", "x"},
       {"clear_y", "y"},
       {"clear_by", "half a side"}}};
  const auto found = std::ranges::find(kWords, key, [](const auto& word) { return word.first; });
  return found == kWords.end() ? key : found->second;
}

/// Sorts the fields of a layer by what they are.
struct LayerViewer : FieldVisitor {
  LayerView view;

  void tag(std::string_view, std::string_view name) { view.kind = name; }

  void field(std::string_view key, const std::string& text, const FieldRule& = {}) {
    if (key == "label")
      view.label = text;
    else
      view.styles.push_back({word_of(key), text});
  }
  /// Texts at points. The texts in cells repeat the values of the cells.
  void field(std::string_view, const std::vector<std::string>& texts, const FieldRule& = {}) {
    if (view.kind != "cells") view.texts = texts;
  }
  void field(std::string_view, const Mark& mark, const FieldRule& = {}) {
    view.marks = {&mark, 1};
    view.is_whole = true;
  }
  void field(std::string_view, const std::vector<Mark>& marks, const FieldRule& = {}) {
    view.marks = marks;
  }

  void field(std::string_view key, const std::vector<double>& values, const FieldRule& = {}) {
    if (key == "values" && view.kind == "polyline") {
      if (values.empty()) return;
      view.kind = "polyline with values";  // Compared with another one alone.
    }
    const std::string_view name = word_of(key);
    const std::size_t index = view.coordinates.size();
    if (name.starts_with('x'))
      last_x_ = index;
    else if (name.starts_with('y') || name == "low" || name == "high")
      view.locations.push_back({last_x_, index});
    view.coordinates.push_back({name, values});
  }

  void field(std::string_view key, const Range& range, const FieldRule& = {}) {
    if (key == "limits") {
      view.styles.push_back({word_of(key), fmt::format("{} to {}", range.low, range.high)});
      return;
    }
    const bool is_x = key == "x";
    view.extents.push_back({is_x ? "left edge" : "lower edge", range.low});
    view.extents.push_back({is_x ? "right edge" : "upper edge", range.high});
  }

  template <typename T>
  void field(std::string_view key, const T& value, const FieldRule& = {}) {
    std::string text;
    if constexpr (std::is_enum_v<T>)
      text = name_in_files(value);
    else if constexpr (std::is_same_v<T, bool>)
      text = value ? "yes" : "no";
    else
      text = fmt::format("{}", value);
    view.styles.push_back({word_of(key), std::move(text)});
  }

 private:
  std::size_t last_x_ = 0;
};

}  // namespace

LayerView view_of(const Layer& layer) {
  LayerViewer viewer;
  std::visit([&](const auto& one) { visit_fields(viewer, one); }, layer);
  return std::move(viewer.view);
}

std::string_view data_of(const Mark& mark, std::string_view key) {
  const auto found = std::ranges::find(
      mark.data, key, [](const auto& item) { return std::string_view(item.first); });
  return found == mark.data.end() ? std::string_view() : std::string_view(found->second);
}

}  // namespace mapproof
