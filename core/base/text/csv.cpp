#include "core/base/text/csv.hpp"

#include <cmath>

#include <fmt/format.h>

namespace mapproof {

std::string csv_field(const std::string& text) {
  const bool is_plain = text.find_first_of(",;\t\"\r\n#") == std::string::npos &&
                        (text.empty() || (text.front() != ' ' && text.back() != ' '));
  if (is_plain) return text;
  std::string field = "\"";
  for (const char c : text) {
    if (c == '"') field += '"';
    field += c;
  }
  return field + '"';
}

std::string csv_number(double value) {
  return std::isfinite(value) ? fmt::format("{}", value) : "";
}

}  // namespace mapproof
