#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace mapproof {

/// Takes the first code point off a text that is not empty; if it does not begin with well-formed
/// UTF-8 (RFC 3629: no overlong forms, no surrogates, nothing beyond U+10FFFF), takes one byte and
/// gives none.
std::optional<char32_t> take_code_point(std::string_view& text);

/// Adds the code point as UTF-8.
void append_utf8(std::string& text, char32_t code);

/// Whether a reader does not see the code point as it stands: control characters, white space other
/// than the blank, and what is invisible or turns the direction of writing.
bool is_hidden(char32_t code);

}  // namespace mapproof
