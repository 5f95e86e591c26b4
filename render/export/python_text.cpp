#include "render/export/python_text.hpp"

#include <cmath>

#include <fmt/format.h>

#include "core/base/text/csv.hpp"
#include "core/base/text/utf8.hpp"

namespace mapproof {
namespace {

std::string in_lines(const std::vector<std::string>& items) {
  constexpr std::size_t kLongest = 96;
  std::string out = "[";
  std::size_t begin = 0;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i > 0) out += ",";
    if (i > 0 && out.size() - begin + items[i].size() + 2 > kLongest) {
      begin = out.size() + 1;
      out += "\n    ";
    } else if (i > 0) {
      out += " ";
    }
    out += items[i];
  }
  return out + "]";
}

}  // namespace

std::string python_text(std::string_view text) {
  std::string out = "\"";
  while (!text.empty()) {
    const auto byte = static_cast<unsigned char>(text[0]);
    const std::optional<char32_t> code = take_code_point(text);
    if (!code)
      out += fmt::format("\\x{:02x}", byte);
    else if (*code == '"' || *code == '\\')
      out += fmt::format("\\{}", static_cast<char>(*code));
    else if (*code == '$')
      out += "\\\\$";
    else if (*code == '\n')
      out += "\\n";
    else if (*code < 0x20 || (*code >= 0x7F && *code < 0xA0) || (*code >= 0x2028 && *code <= 0x202E) ||
             (*code >= 0x2066 && *code <= 0x2069))
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(*code));
    else
      append_utf8(out, *code);
  }
  return out + "\"";
}

std::string python_number(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  return csv_number(value);
}

std::string python_list(const std::vector<double>& values) {
  std::vector<std::string> items;
  for (const double value : values) items.push_back(python_number(value));
  return in_lines(items);
}

std::string python_list(const std::vector<std::string>& texts) {
  std::vector<std::string> items;
  for (const std::string& text : texts) items.push_back(python_text(text));
  return in_lines(items);
}

}  // namespace mapproof
