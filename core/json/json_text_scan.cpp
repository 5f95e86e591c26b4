#include "core/json/json_text_scan.hpp"

#include <nlohmann/json.hpp>

namespace mapproof {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; }

}  // namespace

namespace json_text_scan {

std::uint32_t skip_blanks(std::string_view text, std::uint32_t offset) {
  while (offset < text.size() && is_blank(text[offset])) ++offset;
  return offset;
}

std::uint32_t skip_plain(std::string_view text, std::uint32_t offset) {
  if (offset < text.size() && text[offset] == '"') {
    for (++offset; text[offset] != '"'; ++offset)
      if (text[offset] == '\\') ++offset;
    return offset + 1;
  }
  if (offset < text.size() && (text[offset] == '[' || text[offset] == '{'))
    return skip_blanks(text, offset + 1) + 1;
  const auto ends = [](char c) { return is_blank(c) || c == ',' || c == ']' || c == '}'; };
  while (offset < text.size() && !ends(text[offset])) ++offset;
  return offset;
}

std::string decoded(std::string_view quoted) {
  if (quoted.find('\\') == quoted.npos) return std::string(quoted.substr(1, quoted.size() - 2));
  return nlohmann::json::parse(quoted).get<std::string>();
}

}  // namespace json_text_scan

}  // namespace mapproof
