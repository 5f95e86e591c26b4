#include "reports/model/format.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/error_text.hpp"
#include "core/base/text/markup.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/raised.hpp"
#include "core/base/text/unit_text.hpp"
#include "core/base/text/utf8.hpp"
#include "core/base/text/words.hpp"

namespace mapproof {
namespace {

constexpr const char* kMinus = "\u2212";
constexpr const char* kReplacement = "\uFFFD";
constexpr double kLargest = 1e9;  ///< Beyond any coordinate on Earth, an exponent reads better.

constexpr int kDecimalsOfP = 3;   ///< As many as kLeastP has.
constexpr int kManyDecimals = 6;  ///< What has these is small as a whole.

bool is_below_least(const NumberCell& cell) { return cell.least > 0.0 && cell.value < cell.least; }

struct CellFormatter {
  std::string operator()(const TextCell& cell) const { return displayable(cell.text); }
  std::string operator()(const NumberCell& cell) const {
    if (is_below_least(cell)) return "< " + format_number(cell.least, cell.decimals);
    return format_number(cell.value, cell.decimals, cell.with_sign);
  }
  std::string operator()(const IntervalCell& cell) const {
    if (!std::isfinite(cell.low) || !std::isfinite(cell.high)) return kMissingText;
    const char* joint = cell.low < 0.0 ? " to " : "\u2013";
    return format_number(cell.low, cell.decimals) + joint + format_number(cell.high, cell.decimals);
  }
  std::string operator()(const MissingCell&) const { return kMissingText; }
};

/// "1.23e+11" as "1.23 × 10¹¹"; other texts as they are.
std::string with_power(const std::string& text) {
  const std::size_t at = text.find('e');
  if (at == std::string::npos) return text;
  return text.substr(0, at) + "\u00A0×\u00A010" + raised(std::stoi(text.substr(at + 1)));
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Whether the text begins with that form, in which 0 is any digit.
bool has_form(std::string_view text, std::string_view form) {
  if (text.size() < form.size()) return false;
  return std::ranges::equal(form, text.substr(0, form.size()), [](char of_form, char c) {
    return of_form == '0' ? is_digit(c) : of_form == c;
  });
}

/// How much of the text's beginning is a date with its time and its zone, as far as they follow.
std::size_t date_size(std::string_view text) {
  constexpr std::string_view kDay = "0000-00-00";
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
  if (!take({" 00:00", "T00:00"})) return size;
  take({":00"});
  take({"Z", " UTC", " +00:00", " \u221200:00"});
  return size;
}

/// What is said instead of an error that is no use as a number; empty if it is one.
std::string great_error(double error_m) {
  if (error_m > kGreatestError_m) return kGreatErrorText;
  return error_m < -kGreatestError_m ? kGreatGainText : "";
}

}  // namespace

std::string format_number(double value, int decimals, bool with_sign) {
  if (!std::isfinite(value)) return kMissingText;
  const double size = std::abs(value);
  const auto is_zero = [](const std::string& digits) {
    return digits.find_first_of("123456789") == std::string::npos;
  };
  std::string digits = fmt::format("{:.{}f}", size, decimals);
  const bool is_hidden = size > 0.0 && decimals >= kManyDecimals && is_zero(digits);
  if (size >= kLargest || is_hidden) digits = fmt::format("{:.2e}", size);
  if (is_zero(digits)) return digits;
  if (decimals == 0 && size < kLargest) digits = count_text(std::stoll(digits));
  if (value < 0) return kMinus + digits;
  return with_sign ? "+" + digits : digits;
}

std::string format_cell(const Cell& cell) { return std::visit(CellFormatter{}, cell); }

std::string page_number(double value, int decimals, bool with_sign) {
  return with_power(format_number(value, decimals, with_sign));
}

NumberCell p_cell(double p) { return {.value = p, .decimals = kDecimalsOfP, .least = kLeastP}; }

std::string p_words(double p) {
  if (p >= 1.0) return "p = 1";
  return (p < kLeastP ? "p " : "p = ") + format_cell(p_cell(p));
}

std::string small_p_words(double p) {
  if (p >= kLeastP) return p_words(p);
  return p < 1e-9 ? "p < 10⁻⁹" : "p = " + with_power(fmt::format("{:.1e}", p));
}

std::string page_cell(const Cell& cell, const Column& column) {
  const auto* number = std::get_if<NumberCell>(&cell);
  if (number != nullptr && is_below_least(*number)) return format_cell(cell);
  const bool errors_m =
      column.errors_m.value_or(column.unit == "m") || (number != nullptr && number->error_m);
  const auto shown = [&](double value, int decimals, bool with_sign) {
    const std::string great = errors_m ? great_error(value) : "";
    return great.empty() ? page_number(value, decimals, with_sign) : great;
  };
  if (number != nullptr) return shown(number->value, number->decimals, number->with_sign);
  const auto* interval = std::get_if<IntervalCell>(&cell);
  if (interval == nullptr || !std::isfinite(interval->low) || !std::isfinite(interval->high))
    return format_cell(cell);
  const auto end = [&](double value) { return shown(value, interval->decimals, false); };
  const std::string low = end(interval->low), high = end(interval->high);
  const bool is_plain = low == format_number(interval->low, interval->decimals) &&
                        high == format_number(interval->high, interval->decimals);
  if (is_plain) return format_cell(cell);
  if (low == high) return low;
  return (interval->low == 0.0 ? "0" : low) + " to " + high;
}

std::string part_count(long long part, long long whole) {
  constexpr long long kLeastGrouped = 10'000, kThousand = 1000;
  std::string text = count_text(part);
  if (whole >= kLeastGrouped && part >= kThousand && part < kLeastGrouped) text.insert(1, 1, ',');
  return text;
}

std::string part_text(long long part, long long whole, std::string_view noun) {
  return fmt::format("{} of {}", part_count(part, whole), counted(whole, noun));
}

std::string full_heading(const Column& column) {
  std::string text = column.group.empty() ? column.title : column.group + ": " + column.title;
  if (!column.unit.empty()) text += " [" + column.unit + "]";
  return text;
}

std::string format_duration(double seconds) {
  if (!std::isfinite(seconds) || seconds < 0.0) return kMissingText;
  if (seconds < 59.95) return seconds_text(seconds);
  if (seconds >= 1e9) return fmt::format("{:.2e} s", seconds);
  const long whole = std::lround(seconds);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  const long minutes = std::lround(seconds / 60.0);
  return fmt::format("{} h {} min", minutes / 60, minutes % 60);
}

std::string displayable(const std::string& text) {
  std::string out;
  out.reserve(text.size());
  for (std::string_view rest = text; !rest.empty();) {
    const std::string_view before = rest;
    const std::optional<char32_t> code = take_code_point(rest);
    const bool is_second_control = code && *code >= 0x80 && *code < 0xA0;  // They have no image.
    if (!code || is_second_control) {
      out += kReplacement;
    } else if ((*code < 0x20 && *code != '\t' && *code != '\n') || *code == 0x7F) {
      append_utf8(out, 0x2400 + (*code == 0x7F ? 0x21 : *code));  // Its image.
    } else {
      out += before.substr(0, before.size() - rest.size());
    }
  }
  return out;
}

bool is_date(std::string_view text) { return !text.empty() && date_size(text) == text.size(); }

std::string page_text(std::string_view text) {
  constexpr std::string_view kNoBreakSpace = "\u00a0";
  std::string kept;
  while (!text.empty()) {
    const std::size_t size = std::max<std::size_t>(date_size(text), 1);
    const bool is_found = size > 1 && (kept.empty() || !is_digit(kept.back()));
    for (const char c : text.substr(0, is_found ? size : 1))
      if (is_found && c == ' ')
        kept += kNoBreakSpace;
      else
        kept += c;
    text.remove_prefix(is_found ? size : 1);
  }
  return with_quantities_kept(kept);
}

std::string html_escaped(const std::string& text) {
  std::string out;
  for (const char c : displayable(text)) {
    if (const std::string_view reference = markup_reference(c); !reference.empty())
      out += reference;
    else if (c == '\'')
      out += "&#39;";
    else
      out += c;
  }
  return out;
}

std::string xml_line(const std::string& text) {
  std::string out = html_escaped(text);
  std::ranges::replace_if(
      out, [](char c) { return c == '\n' || c == '\t'; }, ' ');
  return out;
}

std::string markdown_text(const std::string& text, std::size_t longest) {
  std::string out;
  for (const char c : xml_line(printable(text, longest))) {
    if (std::string_view("|\\`*_[]#~@").find(c) != std::string_view::npos)
      out += fmt::format("&#{};", static_cast<int>(c));
    else
      out += c;
  }
  return out;
}

}  // namespace mapproof
