#include "reports/diff/svg/svg_units.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "reports/diff/svg/svg_path.hpp"

namespace mapproof {
namespace {

std::string_view value_of(const SvgElement& element, const std::string& name) {
  const auto found = element.values.find(name);
  return found == element.values.end() ? std::string_view() : std::string_view(found->second);
}

/// A length in pixels; empty for shares of something that is not known.
std::optional<double> pixels(std::string_view length) {
  using Unit = std::pair<std::string_view, double>;
  constexpr std::array kUnits = {Unit{"", 1.0},          Unit{"px", 1.0},  Unit{"pt", 96.0 / 72.0},
                                 Unit{"pc", 16.0},       Unit{"in", 96.0}, Unit{"cm", 96.0 / 2.54},
                                 Unit{"mm", 96.0 / 25.4}};
  double number = 0.0;
  const std::size_t used = read_number(length, number);
  if (used == 0) return std::nullopt;
  for (const auto& [unit, size] : kUnits)
    if (length.substr(used) == unit) return number * size;
  return std::nullopt;
}

/// Width and height of the viewBox; zero: none.
std::array<double, 2> view_box(std::string_view text) {
  std::array<double, 4> box{};
  for (double& number : box) {
    while (text.starts_with(' ') || text.starts_with(',')) text.remove_prefix(1);
    const std::size_t used = read_number(text, number);
    if (used == 0) return {};
    text.remove_prefix(used);
  }
  return {box[2], box[3]};
}

double root_unit(const SvgElement& root) {
  const std::array<double, 2> box = view_box(value_of(root, "viewBox"));
  double unit = 0.0;
  for (const auto& [side, length] : {std::pair("width", box[0]), {"height", box[1]}}) {
    const std::optional<double> size = pixels(value_of(root, side));
    if (!size || *size <= 0.0 || length <= 0.0) continue;
    unit = unit > 0.0 ? std::min(unit, *size / length) : *size / length;
  }
  return unit > 0.0 ? unit : 1.0;
}

/// How much longer the transform makes what it makes longest.
double scale_of(std::string_view transform) {
  const auto matrix = matrix_numbers(transform);
  if (!matrix) return 1.0;
  const std::vector<double>& m = matrix->numbers;
  return std::max(std::hypot(m[0], m[1]), std::hypot(m[2], m[3]));
}

}  // namespace

SvgUnits svg_units(const SvgTree& tree) {
  SvgUnits units;
  for (const SvgElement& element : tree.elements) {
    const bool is_root = element.parent < 0;
    const double outer = is_root ? 1.0 : units.inner[static_cast<std::size_t>(element.parent)];
    units.outer.push_back(outer);
    units.inner.push_back(is_root ? root_unit(element)
                                  : outer * scale_of(value_of(element, "transform")));
  }
  return units;
}

std::optional<TransformDistance> transform_distance(std::string_view a, std::string_view b) {
  const auto first = matrix_numbers(a), second = matrix_numbers(b);
  if (!first || !second) return std::nullopt;
  const auto apart = [&](std::size_t i) { return first->numbers[i] - second->numbers[i]; };
  TransformDistance distance{.shift = std::hypot(apart(4), apart(5))};
  for (const std::size_t i : {0U, 1U, 2U, 3U})
    distance.linear = std::max(distance.linear, std::abs(apart(i)));
  return distance;
}

}  // namespace mapproof
