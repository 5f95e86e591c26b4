#include "reports/diff/svg/svg_values.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "reports/diff/svg/css_colours.hpp"
#include "reports/diff/svg/svg_path.hpp"

namespace mapproof {
namespace {

/// A value in pieces: numbers, and what stands between them.
struct Pieces {
  std::vector<double> numbers;
  std::string rest;  ///< A '\1' for each number; blanks, commas and the unit "px" left out.
};

Pieces pieces_of(std::string_view text) {
  Pieces pieces;
  while (!text.empty()) {
    double number = 0.0;
    const std::size_t used = read_number(text, number);
    // A digit within a word, as in "Arial2", is not a number.
    const bool in_word =
        !pieces.rest.empty() &&
        (std::isalpha(static_cast<unsigned char>(pieces.rest.back())) || pieces.rest.back() == '#');
    if (used > 0 && !in_word) {
      pieces.numbers.push_back(number);
      pieces.rest += '\1';
      text.remove_prefix(used);
      if (text.starts_with("px")) text.remove_prefix(2);
      continue;
    }
    const std::size_t count = std::max<std::size_t>(used, 1);
    for (const char c : text.substr(0, count))
      if (c != ' ' && c != ',') pieces.rest += c;
    text.remove_prefix(count);
  }
  return pieces;
}

ValueDistance distance_of(const std::vector<double>& a, const std::vector<double>& b) {
  ValueDistance found{true, false, 0.0};
  for (std::size_t i = 0; i < a.size(); ++i)
    // A matrix may have overflowed.
    found.distance = a[i] == b[i]                 ? found.distance
                     : std::isfinite(a[i] - b[i]) ? std::max(found.distance, std::abs(a[i] - b[i]))
                                                  : std::numeric_limits<double>::max();
  return found;
}

bool is_colour_name(std::string_view name) {
  static const std::set<std::string_view> names = {"fill",        "stroke", "stop-color",
                                                   "flood-color", "color",  "lighting-color"};
  return names.contains(name);
}

}  // namespace

std::optional<std::array<double, 3>> css_colour(std::string_view text) {
  const auto of = [](std::uint32_t rgb) {
    return std::array<double, 3>{double(rgb >> 16), double((rgb >> 8) & 0xFF), double(rgb & 0xFF)};
  };
  std::string word(text);
  std::ranges::transform(word, word.begin(), [](unsigned char c) { return std::tolower(c); });
  if (word.starts_with('#')) {
    std::uint32_t value = 0;
    const auto [end, error] =
        std::from_chars(word.data() + 1, word.data() + word.size(), value, 16);
    if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
    if (word.size() == 7) return of(value);
    if (word.size() != 4) return std::nullopt;
    return of((value >> 8) * 0x110000 + ((value >> 4) & 0xF) * 0x1100 + (value & 0xF) * 0x11);
  }
  if (word.starts_with("rgb(")) {
    const Pieces pieces = pieces_of(std::string_view(word).substr(3));
    if (pieces.numbers.size() != 3) return std::nullopt;
    const bool is_share = pieces.rest == "(\1%\1%\1%)";
    if (!is_share && pieces.rest != "(\1\1\1)") return std::nullopt;
    std::array<double, 3> colour{};
    for (int c = 0; c < 3; ++c)
      colour[c] = std::clamp(pieces.numbers[c] * (is_share ? 255.0 : 100.0) / 100.0, 0.0, 255.0);
    return colour;
  }
  if (const auto named = css_named_colour(word)) return of(*named);
  return std::nullopt;
}

ValueDistance value_distance(std::string_view name, std::string_view a, std::string_view b) {
  if (a == b) return {true, false, 0.0};
  if (is_colour_name(name)) {
    const auto first = css_colour(a), second = css_colour(b);
    if (first && second) {
      ValueDistance found =
          distance_of({first->begin(), first->end()}, {second->begin(), second->end()});
      found.is_colour = true;
      return found;
    }
  }
  if (name == "d" || name == "transform" || name.ends_with("Transform")) {
    const auto read = name == "d" ? &path_numbers : &matrix_numbers;
    const auto first = read(a), second = read(b);
    if (first && second && first->words == second->words)
      return distance_of(first->numbers, second->numbers);
  }
  const Pieces first = pieces_of(a), second = pieces_of(b);
  if (first.rest != second.rest) return {};
  return distance_of(first.numbers, second.numbers);
}

}  // namespace mapproof
