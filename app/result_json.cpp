#include "app/result_json.hpp"

#include <cmath>
#include <cstdint>

#include "core/json/record_writer.hpp"
#include "core/records/fit_fields.hpp"
#include "render/figures/status_text.hpp"
#include "reports/sections/fit_text.hpp"

namespace mapproof {

nlohmann::ordered_json number_or_null(double value) {
  if (!std::isfinite(value)) return nullptr;
  return value;
}

nlohmann::ordered_json statuses_json(const std::vector<Status>& statuses) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const Status& status : statuses)
    all.emplace_back(to_json_value(status))["detail"] = status_text(status);
  return all;
}

nlohmann::ordered_json fit_json(const Fit& fit) {
  nlohmann::ordered_json object = to_json_value(fit);
  object["detail"] = verdict_text(fit);
  for (std::size_t i = 0; i < fit.causes.size(); ++i)
    object["causes"][i]["detail"] = cause_text(fit.causes[i]);
  return object;
}

nlohmann::ordered_json parameter_json(const MethodSetting& setting) {
  if (!setting.parameter) return nullptr;
  if (info(setting.method).parameter->integer) return static_cast<std::int64_t>(*setting.parameter);
  return number_or_null(*setting.parameter);
}

}  // namespace mapproof
