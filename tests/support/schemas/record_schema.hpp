#pragma once

#include <cmath>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/json/record_outline.hpp"
#include "core/json/record_writer.hpp"

namespace mapproof {

// The schema of a record, made of its fields() (core/json/fields.hpp).

namespace record_json {

/// Of the types that have a name, by it.
using Definitions = std::map<std::string, Json>;

Json number_schema(const char* type, const FieldRule& rule);
Json text_schema(const FieldRule& rule);
Json array_schema(Json items, std::size_t least, std::size_t most);
Json reference(std::string_view name);
Json or_null(Json schema);
Json described(Json schema, std::string_view description);
Json file_schema(Json object, const Definitions& definitions);

template <typename T>
Json value_schema(const FieldRule& rule, Definitions& definitions);

class SchemaMaker : public FieldVisitor {
 public:
  explicit SchemaMaker(Definitions& definitions) : definitions_(definitions) {}

  void type(std::string_view name) { type_ = name; }
  void about(std::string_view description) { about_ = description; }
  void file(std::string_view name, std::string_view description) {
    title_ = name;
    about_ = description;
    put("schema", file_head(name), true);
  }
  void tag(std::string_view key, std::string_view name) {
    type_ = name;
    put(key, {{"description", "The kind of the object."}, {"const", name}}, true);
  }
  template <typename T>
  void field(std::string_view key, T& value, const FieldRule& rule = {}) {
    Json schema = described(value_schema<T>(rule, definitions_), rule.description);
    // What a key keeps that is left out; beside a reference nothing counts.
    if constexpr (std::is_arithmetic_v<T>)
      if (rule.key == Key::kOptional && rule.written && std::isfinite(static_cast<double>(value)))
        schema["default"] = value;
    put(key, std::move(schema), is_required(rule) && rule.when);
  }

  template <typename Fields>
  void group(std::string_view key, Fields visit, const FieldRule& rule = {}) {
    SchemaMaker maker(definitions_);
    visit(maker);
    put(key, described(maker.take({}), rule.description), is_required(rule) && rule.when);
  }
  void key_count(std::size_t least, std::size_t most) {
    bounds_ = {{"minProperties", least}, {"maxProperties", most}};
  }

  /// The schema, or a reference to it. `choices` may be empty.
  Json take(Json choices);

 private:
  static Json file_head(std::string_view name);
  void put(std::string_view key, Json schema, bool is_required);

  Definitions& definitions_;
  std::string type_, about_, title_;
  Json properties_ = Json::object(), required_ = Json::array(), bounds_ = Json::object();
};

using Keys = std::vector<std::pair<std::string_view, bool>>;

/// Sets the field that decides to one of its values and notes which keys then have to be there, and
/// which must not.
struct Decision : FieldVisitor {
  explicit Decision(std::size_t choice) : index(choice) {}

  std::size_t index;
  std::string_view key;   ///< That decides; none: nothing is decided.
  std::string_view name;  ///< Its value; empty: any other than the known ones.
  std::size_t count = 0;  ///< Of its values.
  Keys keys;              ///< And whether each has to be there.
  std::vector<std::string_view> barred;

  template <typename T>
  void field(std::string_view field_key, T& value, const FieldRule& rule = {}) {
    if constexpr (Enumeration<T>) {
      if (rule.decides) {
        value = static_cast<T>(index);
        decide(field_key, enum_names(value));
      }
    } else if constexpr (std::same_as<T, std::string>) {
      if (rule.decides) {
        value = index < rule.known.size() ? rule.known[index] : "";
        key = field_key;
        name = index < rule.known.size() ? rule.known[index] : "";
        count = rule.known.size() + 1;
      }
    } else if constexpr (Kind<T>::is_optional) {
      if constexpr (Enumeration<typename T::value_type>)
        if (rule.decides) {
          value = static_cast<typename T::value_type>(index);
          decide(field_key, enum_names(*value));
        }
    }
    if (!rule.when) barred.push_back(field_key);
    if (rule.when) keys.emplace_back(field_key, is_required(rule));
  }

 private:
  void decide(std::string_view field_key, const EnumNames& names) {
    key = field_key;
    count = names.names.size();
    name = names.names[index];
  }
};

/// What each choice asks for: the alternatives of the schema's "anyOf"; empty: nothing is decided.
Json choices_schema(const std::vector<Decision>& decisions);

template <typename T>
Json record_schema(Definitions& definitions) {
  SchemaMaker maker(definitions);
  T value{};
  fields(maker, value);
  std::vector<Decision> decisions;
  for (std::size_t i = 0; i == 0 || i < decisions[0].count; ++i) {
    T chosen{};
    fields(decisions.emplace_back(i), chosen);
  }
  return maker.take(choices_schema(decisions));
}

/// Turns each property of a record's schema, or of the definition that it refers to, into an array.
Json columns_schema(Json record, const FieldRule& rule, const Definitions& definitions);

template <typename... T>
Json variant_schema(const std::variant<T...>*, Definitions& definitions) {
  return {{"oneOf", Json::array({record_schema<T>(definitions)...})}};
}

Json enum_schema(const EnumNames& names, Definitions& definitions);

template <Matrix T>
Json matrix_schema(const FieldRule& rule) {
  constexpr auto kRows = T::RowsAtCompileTime, kColumns = T::ColsAtCompileTime;
  FieldRule one = rule;
  one.nullable = Vector<T> ? rule.nullable : rule.nullable_entries;
  Json item = number_schema("number", one);
  const auto array_of = [](Json of, std::size_t size) {
    return array_schema(std::move(of), size, size);
  };
  if (rule.upper_triangle) {
    item = array_of(std::move(item), triangle_size<T>());
    return rule.nullable ? or_null(std::move(item)) : item;
  }
  if (!Vector<T>) {
    const std::size_t columns =
        kColumns == Eigen::Dynamic ? rule.columns : static_cast<std::size_t>(kColumns);
    item = columns == 0 ? array_schema(std::move(item), rule.not_empty, FieldRule{}.max_items)
                        : array_of(std::move(item), columns);
  }
  if (!Vector<T> && rule.nullable) item = or_null(std::move(item));
  return kRows == Eigen::Dynamic ? array_schema(std::move(item), rule.min_items, rule.max_items)
                                 : array_of(std::move(item), static_cast<std::size_t>(kRows));
}

template <typename T>
Json value_schema(const FieldRule& rule, Definitions& definitions) {
  const auto of_items = [&]<typename Item>(const Item*) {
    return value_schema<Item>(item_rule(rule), definitions);
  };
  if constexpr (std::same_as<T, bool>) {
    return {{"type", "boolean"}};
  } else if constexpr (std::floating_point<T>) {
    return number_schema(rule.integer ? "integer" : "number", rule);
  } else if constexpr (std::integral<T>) {
    FieldRule bounds = rule;
    bounds.nullable = false;
    if (std::unsigned_integral<T>) bounds.minimum = std::max(bounds.minimum, 0.0);
    return number_schema("integer", bounds);
  } else if constexpr (std::same_as<T, std::string>) {
    return text_schema(rule);
  } else if constexpr (Enumeration<T>) {
    return enum_schema(enum_names(T{}), definitions);
  } else if constexpr (Kind<T>::is_optional) {
    Json schema = value_schema<typename T::value_type>(rule, definitions);
    return is_never_null(rule) ? schema : or_null(std::move(schema));
  } else if constexpr (Kind<T>::is_variant) {
    return variant_schema(static_cast<const T*>(nullptr), definitions);
  } else if constexpr (Matrix<T>) {
    return matrix_schema<T>(rule);
  } else if constexpr (List<T>) {
    Json item = of_items(static_cast<const typename T::value_type*>(nullptr));
    if (rule.as_columns) return columns_schema(std::move(item), rule, definitions);
    Json schema = array_schema(item, rule.min_items, rule.max_items);
    if (rule.unique || rule.ascending) schema["uniqueItems"] = true;
    return rule.or_one ? Json{{"oneOf", {std::move(item), std::move(schema)}}} : schema;
  } else if constexpr (Kind<T>::is_map) {
    Json schema = {{"type", "object"}};
    schema["additionalProperties"] = value_schema<typename T::mapped_type>(rule, definitions);
    if (rule.max_keys != FieldRule{}.max_keys) schema["maxProperties"] = rule.max_keys;
    return schema;
  } else if constexpr (Kind<T>::is_tuple || AsTuple<T>) {
    T value{};
    Json items = Json::array();
    for_each_element(value,
                     [&]<typename Item>(const Item& one) { items.push_back(of_items(&one)); });
    const bool are_alike =
        std::ranges::all_of(items, [&](const Json& one) { return one == items[0]; });
    return array_schema(are_alike ? Json(items[0]) : std::move(items), element_count<T>(),
                        element_count<T>());
  } else {
    return record_schema<T>(definitions);
  }
}

}  // namespace record_json

/// The schema of a file (JSON Schema, draft 7) that holds one record.
template <typename T>
nlohmann::ordered_json json_schema() {
  record_json::Definitions definitions;
  nlohmann::ordered_json object = record_json::record_schema<T>(definitions);
  return record_json::file_schema(std::move(object), definitions);
}

}  // namespace mapproof
