#include "core/base/text/utf8.hpp"

namespace mapproof {
namespace {

/// Bytes of a sequence that starts with `lead`; 0 if none does.
std::size_t length_after(unsigned char lead) {
  if (lead < 0x80) return 1;
  if (lead < 0xC2 || lead > 0xF4) return 0;
  return lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
}

bool is_scalar(char32_t code, std::size_t length) {
  const bool overlong = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
  return !overlong && code <= 0x10FFFF && (code < 0xD800 || code > 0xDFFF);
}

}  // namespace

std::optional<char32_t> take_code_point(std::string_view& text) {
  const auto lead = static_cast<unsigned char>(text.front());
  const std::size_t length = length_after(lead);
  char32_t code = length <= 1 ? lead : lead & (0xFFU >> (length + 1));
  bool is_sound = length != 0 && length <= text.size();
  for (std::size_t i = 1; is_sound && i < length; ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    is_sound = (byte & 0xC0U) == 0x80U;
    code = code << 6 | (byte & 0x3FU);
  }
  if (!is_sound || !is_scalar(code, length)) {
    text.remove_prefix(1);
    return std::nullopt;
  }
  text.remove_prefix(length);
  return code;
}

void append_utf8(std::string& text, char32_t code) {
  const auto add = [&text](char32_t byte) { text += static_cast<char>(byte); };
  if (code < 0x80) {
    add(code);
    return;
  }
  const int rest = code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;  // Bytes behind the first.
  add((rest == 1 ? 0xC0U : rest == 2 ? 0xE0U : 0xF0U) | code >> (6 * rest));
  for (int i = rest - 1; i >= 0; --i) add(0x80U | (code >> (6 * i) & 0x3FU));
}

bool is_hidden(char32_t code) {
  return code < 0x20 || (code >= 0x7F && code < 0xA0) || code == 0xAD || code == 0x61C ||
         (code >= 0x200B && code <= 0x200F) || (code >= 0x2028 && code <= 0x202E) ||
         (code >= 0x2060 && code <= 0x206F) || code == 0xFEFF;
}

}  // namespace mapproof
