#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/json/json_text.hpp"
#include "core/json/record_outline.hpp"

namespace mapproof {
namespace record_json {

using Json = nlohmann::ordered_json;

Json number_json(double number, const FieldRule& rule);

template <typename T>
Json value_json(const T& value, const FieldRule& rule);

template <typename T>
bool is_none(const T& value) {
  if constexpr (Kind<T>::is_optional)
    return !value;
  else if constexpr (requires { value.empty(); })
    return value.empty();
  else
    return false;
}

struct Writer : FieldVisitor {
  Json json = Json::object();

  void file(std::string_view name, std::string_view) { json["schema"] = schema_value(name); }
  void tag(std::string_view key, std::string_view name) { json[std::string(key)] = name; }
  template <typename T>
  void field(std::string_view key, T& value, const FieldRule& rule = {}) {
    if (rule.when && rule.written && !(is_never_null(rule) && is_none(value)))
      json[std::string(key)] = value_json(value, rule);
  }
  template <typename Fields>
  void group(std::string_view key, Fields visit, const FieldRule& rule = {}) {
    if (!rule.when || !rule.written) return;
    Writer writer;
    visit(writer);
    json[std::string(key)] = std::move(writer.json);
  }
};

template <Matrix T>
Json matrix_json(const T& matrix, const FieldRule& rule) {
  Json rows = Json::array();
  if (rule.upper_triangle) {
    if (rule.nullable && !matrix.allFinite()) return nullptr;
    for (Eigen::Index i = 0; i < matrix.rows(); ++i)
      for (Eigen::Index k = i; k < matrix.cols(); ++k)
        rows.push_back(number_json(matrix(i, k), rule));
    return rows;
  }
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    if constexpr (Vector<T>) {
      rows.push_back(number_json(matrix(i), rule));
    } else if (rule.nullable && !matrix.row(i).allFinite()) {
      rows.push_back(nullptr);
    } else {
      Json& row = rows.emplace_back(Json::array());
      for (const double number : matrix.row(i)) row.push_back(number_json(number, rule));
    }
  }
  return rows;
}

template <List T>
Json list_json(const T& list, const FieldRule& rule) {
  Json items = Json::array();
  for (const auto& item : list) items.push_back(value_json(item, item_rule(rule)));
  if constexpr (Record<typename T::value_type>)
    if (rule.as_columns) {
      Json columns = Json::object();
      typename T::value_type none{};
      for (const std::string_view key : outline_of(none).keys)
        for (Json& column = columns[std::string(key)] = Json::array(); const Json& item : items)
          column.push_back(item[std::string(key)]);
      return columns;
    }
  return items;
}

template <typename T>
Json value_json(const T& value, const FieldRule& rule) {
  if constexpr (std::floating_point<T>) {
    return number_json(value, rule);
  } else if constexpr (std::is_arithmetic_v<T> || std::same_as<T, std::string>) {
    return value;
  } else if constexpr (Enumeration<T>) {
    return name_in_files(value);
  } else if constexpr (Kind<T>::is_optional) {
    return value ? value_json(*value, rule) : Json();
  } else if constexpr (Kind<T>::is_variant) {
    return std::visit([&](const auto& one) { return value_json(one, rule); }, value);
  } else if constexpr (Matrix<T>) {
    return matrix_json(value, rule);
  } else if constexpr (List<T>) {
    return list_json(value, rule);
  } else if constexpr (Kind<T>::is_map) {
    Json members = Json::object();
    for (const auto& [key, member] : value) members[key] = value_json(member, rule);
    return members;
  } else if constexpr (Kind<T>::is_tuple || AsTuple<T>) {
    Json items = Json::array();
    for_each_element(const_cast<T&>(value),
                     [&](const auto& item) { items.push_back(value_json(item, item_rule(rule))); });
    return items;
  } else {
    Writer writer;
    visit_fields(writer, value);
    return std::move(writer.json);
  }
}

}  // namespace record_json

/// The JSON of a record: keys in the order of its fields.
template <typename T>
nlohmann::ordered_json to_json_value(const T& record) {
  return record_json::value_json(record, {});
}

/// The text of a file that holds one record.
template <typename T>
std::string to_json_text(const T& record) {
  return json_text(to_json_value(record));
}

/// Every value of a JSON by its pointer, as text; an array of plain values is one value.
std::vector<std::pair<std::string, std::string>> flattened(const nlohmann::ordered_json& value);

}  // namespace mapproof
