#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <initializer_list>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace mapproof {

class JsonCursor;
class JsonItems;

// Of JSON that is held as a tree of values (JsonDocument::tree()), which takes some 130 bytes for an
// empty object of 3.
inline constexpr std::size_t kLargestJsonTree = std::size_t{1} << 25;  ///< Bytes.
inline constexpr std::size_t kMostJsonTreeValues = 4'000'000;          ///< Containers included.

/// An array or an object in the text of a JSON file. Plain values and empty containers have none:
/// they are read where they stand.
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
  /// @throws IoError if it holds more than kLargestJsonTree bytes or kMostJsonTreeValues.
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
  std::size_t values_ = 0;  ///< Containers included.
};

enum class JsonKind { kNull, kBoolean, kNumber, kString, kArray, kObject };

/// A value in a parsed JSON file, with typed getters whose errors name the file and the pointer:
/// IoError("study.json: /runs/3/layout: expected an integer from 1 to 10000, got 1e9").
/// The document must outlive it. It is small, and copied freely; numbers and strings are read from
/// the text of the file each time that they are asked for.
class JsonCursor {
 public:
  const std::string& source() const;
  /// RFC 6901. @note Linear in the sizes of the containers around it: for messages.
  std::string pointer() const;
  JsonKind kind() const;
  bool is_null() const { return kind() == JsonKind::kNull; }
  bool is_object() const { return kind() == JsonKind::kObject; }
  bool is_array() const { return kind() == JsonKind::kArray; }

  [[noreturn]] void fail(const std::string& what) const;

  /// The value of an object's key. @throws IoError if this is not an object or lacks the key.
  JsonCursor at(std::string_view key) const;
  /// The same; empty if the key is missing.
  std::optional<JsonCursor> find(std::string_view key) const;
  /// All of an object, sorted by key.
  std::vector<std::pair<std::string, JsonCursor>> members() const;
  /// All of an object, as they stand in the file. @throws IoError if this is not an object.
  JsonItems entries() const;
  /// @throws IoError at the first key that is not listed, with the one that was probably meant.
  void allow_only(std::initializer_list<std::string_view> keys) const;
  void allow_only(const std::vector<std::string_view>& keys) const;
  /// The same; a key of an object within this one is named as such.
  /// @param nested  Asked if there is such a key: the key of the object, and the key in it.
  using NestedKeys = std::vector<std::pair<std::string_view, std::string_view>>;
  void allow_only(const std::vector<std::string_view>& keys,
                  const std::function<NestedKeys()>& nested) const;

  /// All of an array of `least` to `most` elements.
  JsonItems elements(std::size_t least = 0,
                     std::size_t most = std::numeric_limits<std::size_t>::max()) const;
  /// @note Linear in the index.
  JsonCursor element(std::size_t index) const;
  /// How many elements or members; 0 of null, 1 of any other plain value.
  std::size_t size() const;

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

  /// A plain value as it stands in the file, a string with its quotes.
  std::string_view token() const;

 private:
  friend class JsonDocument;
  friend class JsonItems;

  JsonCursor(const JsonDocument& document, std::uint32_t offset, std::uint32_t node)
      : document_(&document), offset_(offset), node_(node) {}

  std::string got() const;
  /// The number; NaN of anything else.
  double plain_number() const;

  const JsonDocument* document_;
  std::uint32_t offset_;  ///< Of the value's first byte.
  std::uint32_t node_;    ///< Of a container its own, of a plain value that of what holds it.
};

/// The elements of an array, or the members of an object, one after the other.
class JsonItems {
 public:
  class Iterator {
   public:
    using iterator_category = std::input_iterator_tag;
    using value_type = JsonCursor;
    using difference_type = std::ptrdiff_t;
    using pointer = void;
    using reference = JsonCursor;

    JsonCursor operator*() const;
    Iterator& operator++();
    bool operator==(const Iterator& other) const { return left_ == other.left_; }

    /// Of a member.
    std::string key() const;
    /// Whether a member has this key.
    bool has_key(std::string_view key) const;

   private:
    friend class JsonItems;
    Iterator(const JsonDocument& document, std::uint32_t node, std::size_t left);
    void enter_member();

    const JsonDocument* document_;
    std::uint32_t holder_;      ///< Node of the array or object.
    std::uint32_t child_;       ///< Node of the next container in it.
    std::uint32_t offset_ = 0;  ///< Of the value.
    std::uint32_t key_ = 0;     ///< Offset of the member's key.
    std::size_t left_;
  };

  Iterator begin() const { return {*document_, node_, size_}; }
  Iterator end() const { return {*document_, node_, 0}; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }

 private:
  friend class JsonCursor;
  JsonItems(const JsonDocument& document, std::uint32_t node, std::size_t size)
      : document_(&document), node_(node), size_(size) {}

  const JsonDocument* document_;
  std::uint32_t node_;
  std::size_t size_;
};

/// The format of a file of mapproof, from its key "schema".
struct SchemaId {
  std::string name;  ///< "mapproof.study".
  int version = 0;
};

/// @throws IoError if the document does not say what it is.
SchemaId schema_of(const JsonCursor& document);

/// @throws IoError unless the document is of that schema, version 1.
void expect_schema(const JsonCursor& document, std::string_view name);

/// The value of "schema" in files that are written.
nlohmann::ordered_json schema_value(std::string_view name);

}  // namespace mapproof
