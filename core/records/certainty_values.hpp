#pragma once

#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

namespace mapproof {

/// [[xx, xy, yy], null, ...]: null where one is not finite.
nlohmann::ordered_json covariances_value(const std::vector<Eigen::Matrix2d>& covariances);

}  // namespace mapproof
