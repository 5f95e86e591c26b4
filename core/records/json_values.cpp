#include "core/records/json_values.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/json/record_json.hpp"
#include "core/json/text_input.hpp"
#include "core/records/text_forms.hpp"
#include "core/records/value_fields.hpp"

namespace mapproof {

using Json = nlohmann::ordered_json;

Sensor read_sensor(const JsonCursor& value) { return from_json_value<Sensor>(value); }

Json run_id_value(const RunId& run) { return to_json_value(run); }

RunId read_run_id(const JsonCursor& value) { return from_json_value<RunId>(value); }

Json statuses_value(const std::vector<Status>& statuses) { return to_json_value(statuses); }

std::vector<Status> read_statuses(const JsonCursor& value) {
  std::vector<Status> statuses;
  record_json::read_value(value, statuses, record_rules::kStatuses);
  return statuses;
}

Method read_method(const std::string& name, const JsonCursor& place) {
  const std::optional<Method> method = method_named(name);
  if (!method)
    place.fail(fmt::format("unknown method {}: did you mean \"{}\"?", in_quotes(name),
                           nearest_method_name(name)));
  return *method;
}

double read_parameter(const ParameterInfo& parameter, const JsonCursor& value) {
  if (!parameter.integer) return value.number(parameter.minimum, parameter.maximum);
  return static_cast<double>(value.integer(static_cast<std::int64_t>(parameter.minimum),
                                           static_cast<std::int64_t>(parameter.maximum)));
}

void put_setting(Json& object, const MethodSetting& setting) {
  const MethodInfo& method = info(setting.method);
  object["method"] = method.name;
  if (method.parameter && setting.parameter)
    object[std::string(method.parameter->symbol)] = number_value(*setting.parameter);
}

MethodSetting read_setting(const JsonCursor& object, std::vector<std::string_view>& keys) {
  const JsonCursor name = object.at("method");
  MethodSetting setting{.method = read_method(name.text(), name), .parameter = std::nullopt};
  keys.push_back("method");
  if (const auto& parameter = info(setting.method).parameter) {
    setting.parameter = read_parameter(*parameter, object.at(std::string(parameter->symbol)));
    keys.push_back(parameter->symbol);
  }
  return setting;
}

Json number_value(double number) {
  return record_json::number_json(number, {.whole_as_integers = true});
}

bool is_plain_id(std::string_view text) {
  constexpr std::string_view kAllowed = "abcdefghijklmnopqrstuvwxyz0123456789-";
  return !text.empty() && text.find_first_not_of(kAllowed) == std::string_view::npos;
}

std::string read_id(const JsonCursor& value) {
  return record_json::read_text(value, record_rules::kId);
}

std::string read_study_name(const JsonCursor& value) {
  const std::string text = value.text(64);
  const auto is_allowed = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '-' ||
           c == '_';
  };
  if (text.empty() || !std::ranges::all_of(text, is_allowed))
    value.fail("expected letters, digits, '-' and '_', got " + in_quotes(text));
  return text;
}

void read_if_there(const JsonCursor& object, const char* key, double least, double most,
                   double& value) {
  if (const auto found = object.find(key)) value = found->number(least, most);
}

void read_if_there(const JsonCursor& object, const char* key, int least, int most, int& value) {
  if (const auto found = object.find(key)) value = found->integer32(least, most);
}

std::vector<std::string> read_names(const JsonCursor& value) {
  std::vector<std::string> names;
  record_json::read_value(value, names, record_rules::kNames);
  return names;
}

}  // namespace mapproof
