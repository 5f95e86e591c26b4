#include "core/base/errors.hpp"

#include <fmt/format.h>

namespace mapproof {
namespace {

struct CodePoint {
  char32_t value;
  std::size_t bytes;  ///< 0: not UTF-8.
};

CodePoint decode(const std::string& text, std::size_t at) {
  const auto byte = [&](std::size_t i) -> unsigned {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
  };
  const unsigned lead = byte(at);
  if (lead < 0x80) return {lead, 1};
  const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : lead >= 0xC2 ? 2 : 0;
  if (length == 0 || lead > 0xF4) return {lead, 0};
  char32_t value = lead & (0xFFU >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(at + i) & 0xC0U) != 0x80U) return {lead, 0};
    value = value << 6 | (byte(at + i) & 0x3FU);
  }
  return {value, length};
}

/// Moves the cursor, turns the direction of writing, or shows nothing.
bool is_unprintable(char32_t c) {
  return c < 0x20 || (c >= 0x7F && c < 0xA0) || c == 0x61C || (c >= 0x200B && c <= 0x200F) ||
         (c >= 0x2028 && c <= 0x202E) || (c >= 0x2060 && c <= 0x206F) || c == 0xFEFF;
}

}  // namespace

IoError::IoError(const std::string& path, const std::string& what)
    : std::runtime_error(printable(path, 300) + ": " + what) {}

IoError::IoError(const std::string& path, const std::string& place, const std::string& what)
    : std::runtime_error(printable(path, 300) + ": " + place + ": " + what) {}

std::string printable(const std::string& text, std::size_t limit) {
  std::string out;
  std::size_t shown = 0;
  for (std::size_t at = 0; at < text.size(); ++shown) {
    if (shown == limit) return out + "...";
    const CodePoint c = decode(text, at);
    if (c.bytes == 0) {
      out += fmt::format("\\x{:02X}", static_cast<unsigned>(c.value));
    } else if (is_unprintable(c.value)) {
      out += fmt::format("\\u{{{:04X}}}", static_cast<unsigned>(c.value));
    } else {
      out.append(text, at, c.bytes);
    }
    at += c.bytes == 0 ? 1 : c.bytes;
  }
  return out;
}

}  // namespace mapproof
