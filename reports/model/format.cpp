#include "reports/model/format.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace mapproof {
namespace {

constexpr const char* kMinus = "\u2212";
constexpr const char* kReplacement = "\uFFFD";
constexpr double kLargest = 1e6;  ///< From here on an exponent reads better.

struct CellFormatter {
  std::string operator()(const TextCell& cell) const { return displayable(cell.text); }
  std::string operator()(const NumberCell& cell) const {
    return format_number(cell.value, cell.decimals, cell.with_sign);
  }
  std::string operator()(const IntervalCell& cell) const {
    if (!std::isfinite(cell.low) || !std::isfinite(cell.high)) return kMissingText;
    const char* joint = cell.low < 0.0 ? " to " : "\u2013";
    return format_number(cell.low, cell.decimals) + joint + format_number(cell.high, cell.decimals);
  }
  std::string operator()(const MissingCell&) const { return kMissingText; }
};

/// Bytes of the UTF-8 character at `at`; 0 if there is none (also overlong forms, surrogates).
std::size_t utf8_length(const std::string& text, std::size_t at) {
  const auto byte = [&](std::size_t i) -> unsigned {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
  };
  const unsigned lead = byte(at);
  if (lead < 0x80) return 1;
  const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(at + i) & 0xC0U) != 0x80U) return 0;
  const unsigned second = byte(at + 1);
  if ((lead == 0xE0 && second < 0xA0) || (lead == 0xED && second > 0x9F)) return 0;
  if ((lead == 0xF0 && second < 0x90) || (lead == 0xF4 && second > 0x8F)) return 0;
  return length;
}

}  // namespace

std::string format_number(double value, int decimals, bool with_sign) {
  if (!std::isfinite(value)) return kMissingText;
  const double size = std::abs(value);
  const std::string digits =
      size >= kLargest ? fmt::format("{:.2e}", size) : fmt::format("{:.{}f}", size, decimals);
  const bool zero = digits.find_first_of("123456789") == std::string::npos;
  if (zero) return digits;
  if (value < 0) return kMinus + digits;
  return with_sign ? "+" + digits : digits;
}

std::string format_cell(const Cell& cell) { return std::visit(CellFormatter{}, cell); }

std::string full_heading(const Column& column) {
  std::string text = column.group.empty() ? column.title : column.group + ": " + column.title;
  if (!column.unit.empty()) text += " [" + column.unit + "]";
  return text;
}

std::string count_of(long count, const std::string& noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string format_duration(double seconds) {
  if (!std::isfinite(seconds) || seconds < 0.0) return kMissingText;
  if (seconds < 0.9995) return fmt::format("{:.3g} ms", seconds * 1e3);
  if (seconds < 59.95) return fmt::format("{:.1f} s", seconds);
  if (seconds >= 1e9) return fmt::format("{:.2e} s", seconds);
  const long whole = std::lround(seconds);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  const long minutes = std::lround(seconds / 60.0);
  return fmt::format("{} h {} min", minutes / 60, minutes % 60);
}

std::string displayable(const std::string& text) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = utf8_length(text, at);
    const auto byte = static_cast<unsigned char>(text[at]);
    if (length == 0) {
      out += kReplacement;
    } else if (length == 1 && ((byte < 0x20 && byte != '\t' && byte != '\n') || byte == 0x7F)) {
      const unsigned picture = byte == 0x7F ? 0x21 : byte;  // U+2400 + picture
      out += {'\xE2', '\x90', static_cast<char>(0x80 + picture)};
    } else {
      out.append(text, at, length);
    }
    at += std::max<std::size_t>(length, 1);
  }
  return out;
}

}  // namespace mapproof
