#include "app/result_json.hpp"

#include <cmath>
#include <cstdint>

namespace mapproof {

nlohmann::ordered_json number_or_null(double value) {
  if (!std::isfinite(value)) return nullptr;
  return value;
}

nlohmann::ordered_json parameter_json(const MethodSetting& setting) {
  if (!setting.parameter) return nullptr;
  if (info(setting.method).parameter->integer) return static_cast<std::int64_t>(*setting.parameter);
  return number_or_null(*setting.parameter);
}

}  // namespace mapproof
