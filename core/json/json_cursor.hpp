#pragma once

#include <cstdint>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace mapproof {

/// A value in a parsed JSON file, with typed getters whose errors name the file and the pointer:
/// IoError("study.json: /runs/3/layout: expected an integer from 1 to 10000, got 1e9").
/// The document must outlive it.
class JsonCursor {
 public:
  JsonCursor(const nlohmann::json& value, const std::string& source, std::string pointer = "");

  const std::string& source() const { return *source_; }
  const std::string& pointer() const { return pointer_; }
  bool is_null() const { return value_->is_null(); }
  bool is_object() const { return value_->is_object(); }
  bool is_array() const { return value_->is_array(); }

  [[noreturn]] void fail(const std::string& what) const;

  /// The value of an object's key. @throws IoError if this is not an object or lacks the key.
  JsonCursor at(const std::string& key) const;
  /// The same; empty if the key is missing.
  std::optional<JsonCursor> find(const std::string& key) const;
  /// All of an object, sorted by key.
  std::vector<std::pair<std::string, JsonCursor>> members() const;
  /// @throws IoError at the first key that is not listed, with the one that was probably meant.
  void allow_only(std::initializer_list<std::string_view> keys) const;
  void allow_only(const std::vector<std::string_view>& keys) const;

  /// All of an array of `least` to `most` elements.
  std::vector<JsonCursor> elements(
      std::size_t least = 0, std::size_t most = std::numeric_limits<std::size_t>::max()) const;
  JsonCursor element(std::size_t index) const;
  std::size_t size() const { return value_->size(); }

  std::int64_t integer(std::int64_t least, std::int64_t most) const;
  int integer32(int least, int most) const { return static_cast<int>(integer(least, most)); }
  std::uint64_t unsigned_integer() const;
  double number(double least, double most) const;
  /// As number(); null gives NaN.
  double number_or_null(double least, double most) const;
  bool boolean() const;
  /// A string of at most `most` bytes.
  std::string text(std::size_t most = 10'000) const;

  /// A whole array of numbers in one go, null as NaN; `size` empty: any.
  std::vector<double> numbers_or_null(double least, double most,
                                      std::optional<std::size_t> size = std::nullopt) const;

 private:
  std::string got() const;
  JsonCursor child(const nlohmann::json& value, std::string_view key) const;

  const nlohmann::json* value_;
  const std::string* source_;
  std::string pointer_;
};

/// A whole JSON file.
struct JsonDocument {
  std::string source;
  nlohmann::json root;

  JsonCursor cursor() const { return {root, source}; }
};

/// @throws IoError with line and column for broken or truncated JSON, repeated keys, numbers beyond
///         a double, nesting deeper than 64, NUL bytes and bytes that are not UTF-8.
JsonDocument parse_json(std::string_view text, const std::string& source);

/// The format of a file of mapproof, from its key "schema".
struct SchemaId {
  std::string name;  ///< "mapproof.study".
  int version = 0;
};

/// @throws IoError if the document does not say what it is.
SchemaId schema_of(const JsonCursor& document);

/// The name of the schema that a JSON text names, before anything else is known of it: the
/// text may be cut off, or wrong behind the name. Empty if there is none.
std::string schema_name_in(std::string_view text);

/// @throws IoError unless the document is of that schema, version 1.
void expect_schema(const JsonCursor& document, std::string_view name);

/// The value of "schema" in files that are written.
nlohmann::ordered_json schema_value(std::string_view name);

}  // namespace mapproof
