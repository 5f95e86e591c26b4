#include "core/records/certainty_values.hpp"

#include "core/json/record_json.hpp"

namespace mapproof {

nlohmann::ordered_json covariances_value(const std::vector<Eigen::Matrix2d>& covariances) {
  return record_json::value_json(covariances, {.nullable = true, .upper_triangle = true});
}

}  // namespace mapproof
