#include "tests/support/schemas/record_schema.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

namespace mapproof::record_json {
namespace {

/// A bound in the schema: an integer where it is one.
Json bound(double number) { return number_json(number, {.whole_as_integers = true}); }

}  // namespace

Json number_schema(const char* type, const FieldRule& rule) {
  Json schema = {{"type", type}};
  if (rule.minimum != -kInfinity)
    schema[rule.above_minimum ? "exclusiveMinimum" : "minimum"] = bound(rule.minimum);
  if (rule.maximum != kInfinity) schema["maximum"] = bound(rule.maximum);
  return rule.nullable ? or_null(std::move(schema)) : schema;
}

Json text_schema(const FieldRule& rule) {
  Json schema = {{"type", "string"}};
  if (rule.form != nullptr) schema["pattern"] = rule.form->pattern;
  if (rule.not_empty) schema["minLength"] = 1;
  if (rule.max_bytes < FieldRule{}.max_bytes) schema["maxLength"] = rule.max_bytes;
  return schema;
}

Json array_schema(Json items, std::size_t least, std::size_t most) {
  Json schema = {{"type", "array"}};
  if (least > 0) schema["minItems"] = least;
  if (most != std::numeric_limits<std::size_t>::max()) schema["maxItems"] = most;
  schema["items"] = std::move(items);
  return schema;
}

Json reference(std::string_view name) { return {{"$ref", fmt::format("#/definitions/{}", name)}}; }

Json or_null(Json schema) {
  if (schema.contains("type") && schema["type"].is_string()) {
    schema["type"] = {schema["type"], "null"};
    return schema;
  }
  if (schema.contains("type")) return schema;  // With null already.
  return {{"anyOf", {{{"type", "null"}}, std::move(schema)}}};
}

Json described(Json schema, std::string_view description) {
  if (!description.empty()) schema["description"] = description;
  return schema;
}

Json enum_schema(const EnumNames& names, Definitions& definitions) {
  definitions[std::string(names.type)] = {
      {"enum", std::vector<std::string>(names.names.begin(), names.names.end())}};
  return reference(names.type);
}

Json SchemaMaker::file_head(std::string_view name) {
  return {{"description", "The format of the file."},
          {"type", "object"},
          {"additionalProperties", false},
          {"required", {"name", "version"}},
          {"properties",
           {{"name", {{"description", "Of the format."}, {"const", name}}},
            {"version", {{"description", "Of the format."}, {"const", 1}}}}}};
}

void SchemaMaker::put(std::string_view key, Json schema, bool is_required) {
  properties_[std::string(key)] = std::move(schema);
  if (is_required) required_.push_back(key);
}

Json choices_schema(const std::vector<Decision>& decisions) {
  Json choices = Json::array();
  std::vector<std::pair<std::vector<std::string_view>, Keys>> seen;
  for (const Decision& decision : decisions) {
    if (decision.key.empty()) return choices;
    const std::string decider(decision.key);
    const auto same = std::ranges::find(seen, std::pair(decision.barred, decision.keys));
    if (same != seen.end()) {
      choices[static_cast<std::size_t>(same - seen.begin())]["properties"][decider]["enum"]
          .push_back(decision.name);
      continue;
    }
    seen.emplace_back(decision.barred, decision.keys);
    Json& choice = choices.emplace_back(Json::object());
    if (!decision.name.empty())
      choice["properties"][decider]["enum"] = Json::array({decision.name});
    for (const auto& [key, is_needed] : decision.keys) {
      const auto is_free = [&key = key](const Decision& other) {
        return std::ranges::find(other.keys, std::pair(key, true)) == other.keys.end();
      };
      if (is_needed && std::ranges::any_of(decisions, is_free)) choice["required"].push_back(key);
    }
    for (const std::string_view key : decision.barred)
      choice["not"]["anyOf"].push_back({{"required", Json::array({key})}});
  }
  return choices;
}

Json SchemaMaker::take(Json choices) {
  Json schema = Json::object();
  if (!title_.empty()) schema["title"] = title_ + ", version 1";
  if (!about_.empty()) schema["description"] = about_;
  schema["type"] = "object";
  schema["additionalProperties"] = false;
  Json always = Json::array();  // What a choice requires, another may bar.
  for (const Json& key : required_)
    if (std::ranges::none_of(choices, [&](const Json& choice) {
          return choice.contains("required") &&
                 std::ranges::find(choice["required"], key) != choice["required"].end();
        }))
      always.push_back(key);
  if (!always.empty()) schema["required"] = std::move(always);
  schema["properties"] = std::move(properties_);
  schema.update(bounds_);
  if (choices.size() > 1) schema["anyOf"] = std::move(choices);
  if (type_.empty()) return schema;
  const auto [known, is_new] = definitions_.emplace(type_, schema);
  if (!is_new && known->second != schema) throw std::logic_error("two types are called " + type_);
  return reference(type_);
}

Json columns_schema(Json record, const FieldRule& rule, const Definitions& definitions) {
  if (record.contains("$ref")) {
    const auto path = record["$ref"].get<std::string>();
    record = definitions.at(path.substr(path.rfind('/') + 1));
  }
  for (auto& [key, schema] : record["properties"].items())
    schema = array_schema(std::move(schema), rule.min_items, rule.max_items);
  return record;
}

Json file_schema(Json object, const Definitions& definitions) {
  Json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"}};
  schema.update(object);
  for (const auto& [name, definition] : definitions) schema["definitions"][name] = definition;
  return schema;
}

}  // namespace mapproof::record_json
