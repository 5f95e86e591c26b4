#pragma once

#include <array>
#include <concepts>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "core/json/fields.hpp"
#include "core/json/json_cursor.hpp"

namespace mapproof {

// What the writer (record_writer.hpp) and the reader (record_reader.hpp) of records have in common:
// the kinds of values, and the keys of a record. tests/support/schemas/record_schema.hpp makes the
// schema.

namespace record_json {

template <typename T>
concept Enumeration = requires(T value) {
  enum_names(value);
};
template <typename T>
concept AsTuple = requires(T& value) {
  as_tuple(value);
};
template <typename T>
concept List = requires(T& value) {
  value.clear();
  value.emplace_back();
  value.begin();
}
&&!std::same_as<T, std::string>;
template <typename T>
concept Matrix = std::derived_from<T, Eigen::MatrixBase<T>>;
template <typename T>
concept Vector = Matrix<T> &&(T::ColsAtCompileTime == 1);

template <typename T>
struct Kind {
  static constexpr bool is_optional = false, is_tuple = false, is_variant = false, is_map = false;
};
template <typename T>
struct Kind<std::optional<T>> : Kind<void> {
  static constexpr bool is_optional = true;
};
template <typename T, std::size_t N>
struct Kind<std::array<T, N>> : Kind<void> {
  static constexpr bool is_tuple = true;
};
template <typename A, typename B>
struct Kind<std::pair<A, B>> : Kind<void> {
  static constexpr bool is_tuple = true;
};
template <typename... T>
struct Kind<std::variant<T...>> : Kind<void> {
  static constexpr bool is_variant = true;
};
template <typename T>
struct Kind<std::map<std::string, T>> : Kind<void> {
  static constexpr bool is_map = true;  // An object of any keys.
};

template <Matrix T>
constexpr std::size_t triangle_size() {
  return static_cast<std::size_t>(T::RowsAtCompileTime * (T::RowsAtCompileTime + 1) / 2);
}

/// Calls `use(element)` for each element of an array, a pair or what has as_tuple().
template <typename T, typename Use>
void for_each_element(T& value, Use use) {
  const auto all = [&](auto&... elements) { (use(elements), ...); };
  if constexpr (AsTuple<T>) {
    auto elements = as_tuple(value);
    std::apply(all, elements);
  } else {
    std::apply(all, value);
  }
}

template <typename T>
constexpr std::size_t element_count() {
  if constexpr (AsTuple<T>)
    return std::tuple_size_v<decltype(as_tuple(std::declval<T&>()))>;
  else
    return std::tuple_size_v<T>;
}

inline bool is_required(const FieldRule& rule) {
  return rule.key == Key::kRequired || rule.key == Key::kNotNull;
}
inline bool is_never_null(const FieldRule& rule) {
  return rule.key == Key::kIfAny || rule.key == Key::kNotNull;
}

/// For the items of what the rule holds for.
FieldRule item_rule(const FieldRule& rule);

/// The keys of a record, and what it is.
struct Outline : FieldVisitor {
  std::vector<std::string_view> keys;
  std::string_view file_schema, tag_key, tag_name;
  std::size_t least_keys = 0, most_keys = std::numeric_limits<std::size_t>::max();

  void file(std::string_view name, std::string_view) {
    file_schema = name;
    keys.push_back("schema");
  }
  void tag(std::string_view key, std::string_view name) {
    keys.push_back(tag_key = key);
    tag_name = name;
  }
  template <typename T>
  void field(std::string_view key, T&, const FieldRule& = {}) {
    keys.push_back(key);
  }
  template <typename Fields>
  void group(std::string_view key, Fields, const FieldRule& = {}) {
    keys.push_back(key);
  }
  void key_count(std::size_t least, std::size_t most) {
    least_keys = least;
    most_keys = most;
  }

  /// @param nested  Keys of the objects within it, for an error.
  /// @throws IoError unless the object has such keys.
  void check(
      const JsonCursor& json, const std::function<JsonCursor::NestedKeys()>& nested = [] {
        return JsonCursor::NestedKeys();
      }) const;
};

template <typename T>
concept Record = requires(Outline& outline, T& value) {
  fields(outline, value);
};

template <typename T>
Outline outline_of(T& value) {
  Outline outline;
  fields(outline, value);
  return outline;
}

/// The keys of the records that a record holds, with the key of each.
struct NestedOutline : FieldVisitor {
  JsonCursor::NestedKeys keys;

  template <typename T>
  void field(std::string_view key, T& value, const FieldRule& = {}) {
    if constexpr (Record<T>)
      for (const std::string_view inner : outline_of(value).keys) keys.emplace_back(key, inner);
  }
  template <typename Fields>
  void group(std::string_view key, Fields visit, const FieldRule& = {}) {
    Outline outline;
    visit(outline);
    for (const std::string_view inner : outline.keys) keys.emplace_back(key, inner);
  }
};

}  // namespace record_json
}  // namespace mapproof
