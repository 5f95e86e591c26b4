#include "core/records/json_values.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "core/json/text_input.hpp"

namespace mapproof {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

Sensor read_sensor(const JsonCursor& value) {
  const std::string text = value.text();
  const std::optional<Sensor> sensor = sensor_named(text);
  if (!sensor) value.fail("expected visibility, bearing or range, got " + in_quotes(text));
  return *sensor;
}

Json run_id_value(const RunId& run) { return {{"layout", run.layout}, {"pose", run.pose}}; }

RunId read_run_id(const JsonCursor& value) {
  value.allow_only({"layout", "pose"});
  return {.layout = value.at("layout").integer32(1, kMostLayouts),
          .pose = value.at("pose").integer32(1, kMostPoses)};
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
  constexpr double kExact = 0x1p53;
  if (std::abs(number) < kExact && number == std::trunc(number) &&
      !(number == 0.0 && std::signbit(number)))
    return static_cast<std::int64_t>(number);
  return number;
}

Json points_value(const Points& points) {
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    if (std::isfinite(points(i, 0)) && std::isfinite(points(i, 1)))
      rows.push_back(Json::array({points(i, 0), points(i, 1)}));
    else
      rows.push_back(nullptr);
  }
  return rows;
}

Points read_points(const JsonCursor& value) {
  const std::vector<JsonCursor> rows = value.elements(0, kMostLandmarks);
  Points points(static_cast<Eigen::Index>(rows.size()), 2);
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const JsonCursor& row = rows[static_cast<std::size_t>(i)];
    if (row.is_null()) {
      points.row(i).setConstant(std::numeric_limits<double>::quiet_NaN());
      continue;
    }
    const std::vector<JsonCursor> pair = row.elements(2, 2);
    points(i, 0) = pair[0].number(-kInfinity, kInfinity);
    points(i, 1) = pair[1].number(-kInfinity, kInfinity);
  }
  return points;
}

Json numbers_value(const Eigen::VectorXd& numbers) {
  Json values = Json::array();
  for (const double number : numbers)
    values.push_back(std::isfinite(number) ? number_value(number) : Json(nullptr));
  return values;
}

Json indices_value(const std::vector<Eigen::Index>& indices) {
  Json all = Json::array();
  for (const Eigen::Index index : indices) all.push_back(static_cast<std::int64_t>(index));
  return all;
}

std::vector<Eigen::Index> read_indices(const JsonCursor& value, Eigen::Index size) {
  std::vector<Eigen::Index> indices;
  std::set<Eigen::Index> seen;
  for (const JsonCursor& item : value.elements(0, kMostLandmarks)) {
    if (size == 0) item.fail("an index into nothing");
    indices.push_back(item.integer(0, size - 1));
    if (!seen.insert(indices.back()).second) item.fail("is there twice");
  }
  return indices;
}

Json statuses_value(const std::vector<Status>& statuses) {
  Json all = Json::array();
  for (const Status& status : statuses)
    all.push_back({{"code", name(status.code)}, {"detail", status.detail}});
  return all;
}

std::vector<Status> read_statuses(const JsonCursor& value) {
  std::vector<Status> statuses;
  for (const JsonCursor& item : value.elements(0, 1000)) {
    item.allow_only({"code", "detail"});
    const std::string code = item.at("code").text();
    const std::optional<StatusCode> known = status_code_named(code);
    if (!known) item.at("code").fail("unknown status " + in_quotes(code));
    statuses.push_back({*known, item.at("detail").text(kLongestText)});
  }
  return statuses;
}

Json score_value(const Score& score) {
  return {{"mpe_m", score.mpe_m},
          {"moe_percent", score.moe_percent},
          {"mpe_all_fitted_m", score.mpe_all_fitted_m},
          {"moe_unmirrored_percent", score.moe_unmirrored_percent}};
}

Score read_score(const JsonCursor& value) {
  value.allow_only({"mpe_m", "moe_percent", "mpe_all_fitted_m", "moe_unmirrored_percent"});
  return {.mpe_m = value.at("mpe_m").number_or_null(0.0, kInfinity),
          .moe_percent = value.at("moe_percent").number_or_null(0.0, 100.0),
          .mpe_all_fitted_m = value.at("mpe_all_fitted_m").number_or_null(0.0, kInfinity),
          .moe_unmirrored_percent = value.at("moe_unmirrored_percent").number_or_null(0.0, 100.0)};
}

bool is_plain_id(std::string_view text) {
  constexpr std::string_view kAllowed = "abcdefghijklmnopqrstuvwxyz0123456789-";
  return !text.empty() && text.find_first_not_of(kAllowed) == std::string_view::npos;
}

std::string read_id(const JsonCursor& value) {
  const std::string text = value.text(64);
  if (!is_plain_id(text) || text[0] < 'a' || text[0] > 'z')
    value.fail("expected lower-case letters, digits and '-', a letter first, got " +
               in_quotes(text));
  return text;
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
  std::map<std::string, std::string> places;
  for (const JsonCursor& item : value.elements(0, kMostLandmarks)) {
    names.push_back(item.text(kLongestName));
    if (names.back().empty()) item.fail("a name must not be empty");
    const auto [first, is_new] = places.emplace(names.back(), item.pointer());
    if (!is_new) item.fail(in_quotes(names.back()) + " is already the name at " + first->second);
  }
  return names;
}

}  // namespace mapproof
