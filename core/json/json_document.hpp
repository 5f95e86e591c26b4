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

/// Of JSON that is held as a tree of values (JsonDocument::tree()), in bytes. Such a tree takes up
/// to 25 times the size of its text.
inline constexpr std::size_t kLargestJsonTree = std::size_t{1} << 25;

/// An array or an object in the text of a JSON file. Plain values have none: they are read where
/// they stand.
struct JsonNode {
  static constexpr std::uint32_t kNone = UINT32_MAX;

  std::uint32_t begin = 0;       ///< Offset of its bracket.
  std::uint32_t end = 0;         ///< Offset behind its last bracket.
  std::uint32_t parent = kNone;  ///< What holds it.
  std::uint32_t first = kNone;   ///< The first container in it.
  std::uint32_t next = kNone;    ///< The next container of its parent.
  std::uint32_t count = 0;       ///< Elements or members.
};

/// A whole JSON file: its text, checked, and an index of the arrays and objects in it, 24 bytes
/// each. A file takes its size once and this index.
class JsonDocument {
 public:
  std::string source;

  JsonCursor cursor() const;

  /// The file as a tree of values, for what no record describes.
  /// @throws IoError if it holds more than kLargestJsonTree bytes.
  nlohmann::json tree() const;

 private:
  friend class JsonCursor;
  friend class JsonItems;
  friend JsonDocument parse_json(std::string_view text, const std::string& source);
  template <std::same_as<std::string> Text>
  friend JsonDocument parse_json(Text&& text, const std::string& source);

  std::unique_ptr<const std::string> owned_;
  std::string_view text_;
  std::deque<JsonNode> nodes_;
};

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

/// Functions on the text of JSON that was checked.
namespace json_text_scan {

/// The offset behind blanks.
std::uint32_t skip_blanks(std::string_view text, std::uint32_t offset);
/// The offset behind the string, number or word that begins here.
std::uint32_t skip_plain(std::string_view text, std::uint32_t offset);
/// The string with its quotes that begins here, decoded.
std::string decoded(std::string_view quoted);

}  // namespace json_text_scan

}  // namespace mapproof
