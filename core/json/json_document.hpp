#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/json/json_cursor.hpp"

namespace mapproof {

/// Checks and indexes a JSON text, which must outlive the document.
/// @throws IoError with line and column for broken or truncated JSON, repeated keys, numbers beyond
///         a double, nesting deeper than 64, NUL bytes and bytes that are not UTF-8; for more than
///         4 GiB.
/// @note O(n log n) for an object of n keys, else linear.
JsonDocument parse_json(std::string_view text, const std::string& source);
inline JsonDocument parse_json(const char* text, const std::string& source) {
  return parse_json(std::string_view(text), source);
}

/// The same of a text that the document keeps.
template <std::same_as<std::string> Text>
JsonDocument parse_json(Text&& text, const std::string& source) {
  auto owned = std::make_unique<const std::string>(std::forward<Text>(text));
  JsonDocument document = parse_json(std::string_view(*owned), source);
  document.owned_ = std::move(owned);
  return document;
}

/// The name of the schema that a JSON text names, before anything else is known of it: the
/// text may be cut off, or wrong behind the name. Empty if there is none.
std::string schema_name_in(std::string_view text);

}  // namespace mapproof
