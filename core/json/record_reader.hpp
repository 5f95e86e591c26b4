#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <Eigen/Core>

#include "core/base/not_finite.hpp"
#include "core/json/json_cursor.hpp"
#include "core/json/json_document.hpp"
#include "core/json/record_outline.hpp"

namespace mapproof {
namespace record_json {

double read_number(const JsonCursor& json, const FieldRule& rule);
std::string read_text(const JsonCursor& json, const FieldRule& rule);
std::vector<double> read_numbers(const JsonCursor& json, const FieldRule& rule,
                                 std::optional<std::size_t> size = std::nullopt);
std::size_t read_name(const JsonCursor& json, const EnumNames& names);
JsonItems read_items(const JsonCursor& json, const FieldRule& rule);
std::int64_t read_integer(const JsonCursor& json, const FieldRule& rule, std::int64_t least,
                          std::int64_t most);
/// Below `json` as far as the pointer leads: a key that was left out is not there.
JsonCursor location_of(const JsonCursor& json, std::string_view pointer);
[[noreturn]] void refuse_order(const JsonCursor& json, double number, double before);
[[noreturn]] void refuse_tag(const JsonCursor& tag, const std::vector<std::string_view>& known);

template <typename T>
void read_value(const JsonCursor& json, T& value, const FieldRule& rule);

class Reader : public FieldVisitor {
 public:
  static constexpr bool kReads = true;

  explicit Reader(const JsonCursor& json) : json_(json) {}

  template <typename T>
  void field(std::string_view key, T& value, const FieldRule& rule = {}) {
    if (const auto found = find(key, rule)) read_value(*found, value, rule);
  }
  template <typename Fields>
  void group(std::string_view key, Fields visit, const FieldRule& rule = {}) {
    const auto object = find(key, rule);
    if (!object) return;
    Outline outline;
    visit(outline);
    outline.check(*object);
    Reader reader(*object);
    visit(reader);
  }
  void refuse(std::string_view pointer, std::string_view what) {
    location_of(json_, pointer).fail(std::string(what));
  }
  void refuse(std::string_view pointer, std::size_t item, std::string_view what) {
    location_of(json_, pointer).element(item).fail(std::string(what));
  }

 private:
  /// @throws IoError if the key has to be there and is not, or the other way round.
  std::optional<JsonCursor> find(std::string_view key, const FieldRule& rule) const;

  const JsonCursor& json_;
};

template <typename T>
void read_record(const JsonCursor& json, T& value) {
  const Outline outline = outline_of(value);
  if (!outline.file_schema.empty()) expect_schema(json, outline.file_schema);
  outline.check(json, [&] {
    NestedOutline nested;
    fields(nested, value);
    return nested.keys;
  });
  Reader reader(json);
  fields(reader, value);
}

template <typename... T>
void read_variant(const JsonCursor& json, std::variant<T...>& value) {
  std::vector<std::string_view> known;
  std::string given;
  const auto reads = [&](auto one) {
    const Outline outline = outline_of(one);
    if (known.empty()) given = json.at(outline.tag_key).text();
    known.push_back(outline.tag_name);
    if (given != outline.tag_name) return false;
    read_record(json, one);
    value = std::move(one);
    return true;
  };
  std::variant_alternative_t<0, std::variant<T...>> first;
  if (!(reads(T{}) || ...)) refuse_tag(json.at(outline_of(first).tag_key), known);
}

/// @throws IoError at the first item that stood there before.
/// @note 4 bytes an item besides the list.
template <typename T>
void refuse_repeated(const JsonCursor& json, const T& items) {
  std::vector<std::uint32_t> ascending(items.size());
  std::iota(ascending.begin(), ascending.end(), 0U);
  std::ranges::sort(ascending, [&](std::uint32_t a, std::uint32_t b) {
    return std::tie(items[a], a) < std::tie(items[b], b);
  });
  // Of items that are equal, the second is the first that stood there before.
  std::optional<std::pair<std::uint32_t, std::uint32_t>> repeated;
  for (std::size_t i = 1; i < ascending.size(); ++i) {
    const std::uint32_t before = ascending[i - 1], item = ascending[i];
    if (items[before] == items[item] && (!repeated || item < repeated->second))
      repeated = {before, item};
  }
  if (repeated)
    json.element(repeated->second)
        .fail("is there twice: at " + json.element(repeated->first).pointer() + " before");
}

/// Reads one record out of arrays of the same length, one for each of its fields.
struct RowReader : FieldVisitor {
  static constexpr bool kReads = true;

  std::vector<JsonItems::Iterator>& columns;  ///< At the row; behind it afterwards.
  std::size_t column = 0;

  explicit RowReader(std::vector<JsonItems::Iterator>& all) : columns(all) {}

  template <typename T>
  void field(std::string_view, T& value, const FieldRule& rule = {}) {
    read_value(*columns[column], value, rule);
    ++columns[column++];
  }
};

/// @throws IoError at the first item that is not above the one before it.
template <typename T>
void refuse_descending(const JsonCursor& json, const T& items) {
  for (std::size_t i = 1; i < items.size(); ++i)
    if (!(items[i] > items[i - 1]))
      refuse_order(json.element(i), static_cast<double>(items[i]),
                   static_cast<double>(items[i - 1]));
}

template <List T>
void read_columns(const JsonCursor& json, T& list, const FieldRule& rule) {
  typename T::value_type none{};
  const Outline outline = outline_of(none);
  json.allow_only(outline.keys);
  std::vector<JsonItems::Iterator> columns;
  FieldRule same = rule;
  std::size_t rows = 0;
  for (const std::string_view key : outline.keys) {
    const JsonItems items = read_items(json.at(key), same);
    columns.push_back(items.begin());
    same.min_items = same.max_items = rows = items.size();
  }
  for (std::size_t row = 0; row < rows; ++row) {
    RowReader reader(columns);
    fields(reader, list.emplace_back());
  }
}

template <Matrix T>
void read_matrix(const JsonCursor& json, T& matrix, const FieldRule& rule) {
  constexpr auto kRows = T::RowsAtCompileTime, kColumns = T::ColsAtCompileTime;
  if constexpr (Vector<T>) {
    const auto size = kRows == Eigen::Dynamic ? std::nullopt : std::optional<std::size_t>(kRows);
    const std::vector<double> numbers = read_numbers(json, rule, size);
    matrix = Eigen::Map<const T>(numbers.data(), std::ssize(numbers));
  } else if (rule.upper_triangle) {
    matrix.setConstant(kNaN);
    if (rule.nullable && json.is_null()) return;
    FieldRule entries_rule = rule;
    entries_rule.nullable = false;
    const std::vector<double> numbers = read_numbers(json, entries_rule, triangle_size<T>());
    auto number = numbers.begin();
    for (Eigen::Index i = 0; i < matrix.rows(); ++i)
      for (Eigen::Index k = i; k < matrix.cols(); ++k) matrix(i, k) = matrix(k, i) = *number++;
  } else {
    FieldRule rows_rule = rule;
    if (kRows != Eigen::Dynamic) rows_rule.min_items = rows_rule.max_items = kRows;
    const JsonItems rows = read_items(json, rows_rule);
    std::size_t columns =
        kColumns == Eigen::Dynamic ? rule.columns : static_cast<std::size_t>(kColumns);
    if (kColumns == Eigen::Dynamic && columns == 0 && !rows.empty())
      columns = (*rows.begin()).size();
    if constexpr (kRows == Eigen::Dynamic)
      matrix.resize(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(columns));
    FieldRule row_rule = item_rule(rule);
    row_rule.nullable = rule.nullable_entries;
    if (rule.not_empty) row_rule.min_items = 1;
    Eigen::Index i = 0;
    for (const JsonCursor& row : rows) {
      matrix.row(i).setConstant(kNaN);
      if (!rule.nullable || !row.is_null()) {
        const std::vector<double> numbers = read_numbers(row, row_rule, columns);
        for (Eigen::Index k = 0; k < matrix.cols(); ++k)
          matrix(i, k) = numbers[static_cast<std::size_t>(k)];
      }
      ++i;
    }
  }
}

template <typename T>
void read_value(const JsonCursor& json, T& value, const FieldRule& rule) {
  if constexpr (std::same_as<T, bool>) {
    value = json.boolean();
  } else if constexpr (std::floating_point<T>) {
    value = read_number(json, rule);
  } else if constexpr (std::same_as<T, std::uint64_t>) {
    value = rule.maximum == kInfinity ? json.unsigned_integer()
                                      : static_cast<T>(read_integer(json, rule, 0, INT64_MAX));
  } else if constexpr (std::integral<T>) {
    value = static_cast<T>(
        read_integer(json, rule, std::numeric_limits<T>::min(), std::numeric_limits<T>::max()));
  } else if constexpr (std::same_as<T, std::string>) {
    value = read_text(json, rule);
  } else if constexpr (Enumeration<T>) {
    value = static_cast<T>(read_name(json, enum_names(T{})));
  } else if constexpr (Kind<T>::is_optional) {
    value.reset();
    FieldRule given = rule;
    given.key = Key::kRequired;
    if (is_never_null(rule) || !json.is_null()) read_value(json, value.emplace(), given);
  } else if constexpr (Kind<T>::is_variant) {
    read_variant(json, value);
  } else if constexpr (Matrix<T>) {
    read_matrix(json, value, rule);
  } else if constexpr (std::same_as<T, std::vector<double>>) {
    if (rule.or_one && !json.is_array())
      value = {read_number(json, rule)};
    else
      value = read_numbers(json, rule);
    if (rule.ascending) refuse_descending(json, value);
  } else if constexpr (List<T>) {
    value.clear();
    if constexpr (Record<typename T::value_type>)
      if (rule.as_columns) return read_columns(json, value, rule);
    for (const JsonCursor& item : read_items(json, rule))
      read_value(item, value.emplace_back(), item_rule(rule));
    using Item = typename T::value_type;
    if constexpr (std::integral<Item> || std::same_as<Item, std::string> || Enumeration<Item>)
      if (rule.unique) refuse_repeated(json, value);
    if constexpr (std::integral<Item>)
      if (rule.ascending) refuse_descending(json, value);
  } else if constexpr (Kind<T>::is_map) {
    value.clear();
    const JsonItems members = json.entries();
    if (members.size() > rule.max_keys)
      json.fail(fmt::format("expected at most {} keys, got {}", rule.max_keys, members.size()));
    for (auto member = members.begin(); member != members.end(); ++member)
      read_value(*member, value[member.key()], rule);
  } else if constexpr (Kind<T>::is_tuple || AsTuple<T>) {
    auto item = json.elements(element_count<T>(), element_count<T>()).begin();
    for_each_element(value, [&](auto& one) {
      read_value(*item, one, item_rule(rule));
      ++item;
    });
  } else {
    read_record(json, value);
  }
}

}  // namespace record_json

/// The record that a JSON value holds. @throws IoError with the file and the pointer.
template <typename T>
T from_json_value(const JsonCursor& json) {
  T value{};
  record_json::read_value(json, value, {});
  return value;
}

/// The record of a file that holds one. @throws IoError as from_json_value().
template <typename T>
T from_json_text(std::string_view text, const std::string& source) {
  const JsonDocument document = parse_json(text, source);
  return from_json_value<T>(document.cursor());
}

}  // namespace mapproof
