#include "render/svg/xml_text.hpp"

#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "core/base/utf8.hpp"

namespace mapproof {
namespace {

bool forbidden(char32_t code) {
  return (code < 0x20 && code != '\t' && code != '\n' && code != '\r') || code == 0xFFFE ||
         code == 0xFFFF;
}

}  // namespace

void append_xml(std::string& out, std::string_view text) {
  while (!text.empty()) {
    const char first = text[0];
    const std::string_view rest = text;
    const std::optional<char32_t> code = take_code_point(text);
    if (!code || forbidden(*code)) {
      out += "\xEF\xBF\xBD";
    } else if (first == '&') {
      out += "&amp;";
    } else if (first == '<') {
      out += "&lt;";
    } else if (first == '>') {
      out += "&gt;";
    } else if (first == '"') {
      out += "&quot;";
    } else if (is_hidden(*code)) {
      fmt::format_to(std::back_inserter(out), "&#x{:X};", static_cast<std::uint32_t>(*code));
    } else {
      out += rest.substr(0, rest.size() - text.size());
    }
  }
}

void append_number(std::string& out, double value) {
  // A whole number of hundredths, its digits written out: far faster than a general conversion.
  if (!(std::abs(value) < 1e13)) value = std::copysign(1e13, value);
  long long hundredths = std::llround(value * 100.0);
  if (hundredths < 0) {
    out += '-';
    hundredths = -hundredths;
  }
  const long long whole = hundredths / 100;
  const auto part = static_cast<int>(hundredths % 100);
  if (whole != 0 || part == 0) out += fmt::format_int(whole).c_str();
  if (part == 0) return;
  out += '.';
  out += static_cast<char>('0' + part / 10);
  if (part % 10 != 0) out += static_cast<char>('0' + part % 10);
}

}  // namespace mapproof
