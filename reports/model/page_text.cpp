#include "reports/model/page_text.hpp"

#include <algorithm>
#include <array>
#include <initializer_list>

#include "core/base/text/ascii.hpp"

namespace mapproof {
namespace {

constexpr std::string_view kNoBreakSpace = "\u00A0", kNoBreakHyphen = "\u2011";
constexpr std::string_view kDay = "0000-00-00";

/// What a file's name, a number or a word goes on with: "out/2026-11-27", "2026-11-270".
bool is_of_word(char c) { return is_digit(c) || c == '-' || c == '_' || c == '/'; }

/// Whether the text begins with that form, in which 0 is any digit.
bool has_form(std::string_view text, std::string_view form) {
  return text.size() >= form.size() &&
         std::ranges::equal(form, text.substr(0, form.size()), [](char of_form, char c) {
           return of_form == '0' ? is_digit(c) : of_form == c;
         });
}

/// How much of the text's beginning is a date with its time and its zone, as far as they follow.
std::size_t date_size(std::string_view text) {
  if (!has_form(text, kDay)) return 0;
  std::size_t size = kDay.size();
  const auto take = [&](std::initializer_list<std::string_view> forms) {
    for (const std::string_view form : forms)
      if (has_form(text.substr(size), form)) {
        size += form.size();
        return true;
      }
    return false;
  };
  if (!take({" 00:00", "T00:00"})) return size == text.size() || !is_of_word(text[size]) ? size : 0;
  take({":00"});
  take({"Z", " UTC", " +00:00", " \u221200:00"});
  return size;
}

/// How much of it is "4-D".
std::size_t dimension_size(std::string_view text) {
  constexpr std::string_view kDimension = "0-D";
  if (!has_form(text, kDimension)) return 0;
  const char next = text.size() > kDimension.size() ? text[kDimension.size()] : ' ';
  return is_of_word(next) || (next >= 'a' && next <= 'z') ? 0 : kDimension.size();
}

/// Whether a space is between a number and its unit.
bool is_before_unit(std::string_view text, std::size_t space) {
  constexpr std::array<std::string_view, 11> kUnits = {"km", "mm", "ms",  "µs",  "m", "min",
                                                       "s",  "h",  "ppm", "MiB", "%"};
  const std::string_view after = text.substr(space + 1);
  const auto ends_word = [&](std::size_t i) {
    return i >= after.size() || std::string_view(" ;,.:)").find(after[i]) != std::string_view::npos;
  };
  return space > 0 && is_digit(text[space - 1]) &&
         std::ranges::any_of(kUnits, [&](std::string_view unit) {
           return after.starts_with(unit) && ends_word(unit.size());
         });
}

/// Whether a space is one of "K = 7".
bool is_beside_equals(std::string_view text, std::size_t space) {
  constexpr std::string_view kEquals = " = ";
  const auto is_value_at = [&](std::size_t i) { return i < text.size() && is_digit(text[i]); };
  const bool before = space > 0 && text[space - 1] != ' ' &&
                      text.substr(space).starts_with(kEquals) &&
                      is_value_at(space + kEquals.size());
  const bool behind =
      space > 2 && text.substr(space - 2).starts_with(kEquals) && is_value_at(space + 1);
  return before || behind;
}

}  // namespace

bool is_date(std::string_view text) { return !text.empty() && date_size(text) == text.size(); }

std::string page_text(std::string_view text) {
  std::string kept;
  for (std::size_t at = 0; at < text.size();) {
    const bool begins_word = at == 0 || !is_of_word(text[at - 1]);
    const std::string_view rest = text.substr(at);
    // One of a date or of a dimension, else a character.
    const std::size_t size = begins_word ? std::max(date_size(rest), dimension_size(rest)) : 0;
    const bool is_space_kept =
        size == 0 && rest[0] == ' ' && (is_before_unit(text, at) || is_beside_equals(text, at));
    for (const char c : rest.substr(0, std::max<std::size_t>(size, 1)))
      if (c == ' ' && (size > 0 || is_space_kept))
        kept += kNoBreakSpace;
      else if (c == '-' && size > 0)
        kept += kNoBreakHyphen;
      else
        kept += c;
    at += std::max<std::size_t>(size, 1);
  }
  return kept;
}

std::string title_below(std::string_view heading, std::string_view title) {
  const std::string_view rest =
      title.starts_with(heading) ? title.substr(heading.size()) : std::string_view();
  const bool adds = rest.starts_with(", ") || rest.starts_with(": ");
  return std::string(adds ? rest.substr(2) : title);
}

}  // namespace mapproof
