#include "core/base/text/unit_text.hpp"

#include <algorithm>
#include <array>

namespace mapproof {
namespace {

constexpr std::string_view kNoBreakSpace = "\u00A0";

}  // namespace

std::string with_unit(std::string_view number, std::string_view unit) {
  std::string text(number);
  if (!unit.empty() && unit != "\u00B0") text += kNoBreakSpace;
  return text.append(unit);
}

std::string with_units_kept(std::string_view text) {
  constexpr std::array<std::string_view, 6> kUnits = {"km", "mm", "ms", "m", "s", "%"};
  const auto is_digit = [&](std::size_t i) { return text[i] >= '0' && text[i] <= '9'; };
  const auto ends_word = [&](std::size_t i) {
    return i >= text.size() || std::string_view(" ;,.:)").find(text[i]) != std::string_view::npos;
  };
  std::string kept;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool binds =
        text[i] == ' ' && i > 0 && is_digit(i - 1) &&
        std::ranges::any_of(kUnits, [&](std::string_view unit) {
          return text.substr(i + 1).starts_with(unit) && ends_word(i + 1 + unit.size());
        });
    if (binds)
      kept += kNoBreakSpace;
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
