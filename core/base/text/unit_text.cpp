#include "core/base/text/unit_text.hpp"

#include <algorithm>
#include <array>

namespace mapproof {
namespace {

constexpr std::string_view kNoBreakSpace = "\u00A0", kNoBreakHyphen = "\u2011";

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Whether the text has that form from an index on and ends a word there; 0 is any digit.
bool has_form(std::string_view text, std::size_t at, std::string_view form) {
  if (text.size() < at + form.size()) return false;
  for (std::size_t i = 0; i < form.size(); ++i)
    if (form[i] == '0' ? !is_digit(text[at + i]) : text[at + i] != form[i]) return false;
  const std::size_t end = at + form.size();
  const auto is_of_word = [](char c) { return is_digit(c) || c == '-' || c == '_' || c == '/'; };
  return (end == text.size() || !is_of_word(text[end])) && (at == 0 || !is_of_word(text[at - 1]));
}

/// Whether a hyphen is one of "2026-11-27".
bool is_in_date(std::string_view text, std::size_t hyphen) {
  constexpr std::string_view kDate = "0000-00-00";
  return (hyphen >= 4 && has_form(text, hyphen - 4, kDate)) ||
         (hyphen >= 7 && has_form(text, hyphen - 7, kDate));
}

/// Whether a hyphen is that of "4-D".
bool is_in_dimension(std::string_view text, std::size_t hyphen) {
  return has_form(text, hyphen - 1, "0-D") &&
         (hyphen + 2 == text.size() || !(text[hyphen + 2] >= 'a' && text[hyphen + 2] <= 'z'));
}

}  // namespace

std::string with_unit(std::string_view number, std::string_view unit) {
  std::string text(number);
  if (!unit.empty() && unit != "\u00B0") text += kNoBreakSpace;
  return text.append(unit);
}

std::string with_quantities_kept(std::string_view text) {
  constexpr std::array<std::string_view, 11> kUnits = {"km", "mm", "ms",  "µs",  "m", "min",
                                                       "s",  "h",  "ppm", "MiB", "%"};
  const auto ends_word = [&](std::size_t i) {
    return i >= text.size() || std::string_view(" ;,.:)").find(text[i]) != std::string_view::npos;
  };
  const auto precedes_unit = [&](std::size_t i) {
    return std::ranges::any_of(kUnits, [&](std::string_view unit) {
      return text.substr(i + 1).starts_with(unit) && ends_word(i + 1 + unit.size());
    });
  };
  // The spaces of "K = 7".
  const auto is_beside_equals = [&](std::size_t i) {
    const bool before = i > 0 && text[i - 1] != ' ' && text.substr(i).starts_with(" = ") &&
                        i + 3 < text.size() && is_digit(text[i + 3]);
    const bool behind = i >= 3 && text.substr(i - 2).starts_with(" = ") && i + 1 < text.size() &&
                        is_digit(text[i + 1]);
    return before || behind;
  };
  std::string kept;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool is_behind_digit = i > 0 && is_digit(text[i - 1]);
    if (text[i] == ' ' && (is_beside_equals(i) || (is_behind_digit && precedes_unit(i))))
      kept += kNoBreakSpace;
    else if (is_behind_digit && text[i] == '-' && (is_in_date(text, i) || is_in_dimension(text, i)))
      kept += kNoBreakHyphen;
    else
      kept += text[i];
  }
  return kept;
}

std::string with_plain_spaces(std::string text) {
  for (std::size_t at = text.find(kNoBreakSpace); at != std::string::npos;
       at = text.find(kNoBreakSpace, at))
    text.replace(at, kNoBreakSpace.size(), " ");
  return text;
}

}  // namespace mapproof
