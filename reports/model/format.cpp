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
    return format_number(cell.low, cell.decimals) + " to " +
           format_number(cell.high, cell.decimals);
  }
  std::string operator()(const MissingCell&) const { return kMissingText; }
};

/// "1.23e+11" as "1.23 × 10¹¹"; other texts as they are.
std::string with_power(const std::string& text) {
  const std::size_t at = text.find('e');
  if (at == std::string::npos) return text;
  return text.substr(0, at) + "\u00A0×\u00A010" + raised(std::stoi(text.substr(at + 1)));
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

std::string part_text(long long part, long long whole, std::string_view noun) {
  return fmt::format("{} of {}", count_text(part, whole), counted(whole, noun));
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
