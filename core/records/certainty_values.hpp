#pragma once

#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "core/json/json_cursor.hpp"
#include "core/model/map_certainty.hpp"

namespace mapproof {

/// [[xx, xy, yy], null, ...]: null where one is not finite.
nlohmann::ordered_json covariances_value(const std::vector<Eigen::Matrix2d>& covariances);

nlohmann::ordered_json certainty_value(const MapCertainty& certainty);

/// @param landmarks  As many covariances as it must have.
/// @throws IoError with the place, for covariances that are not positive semidefinite too.
MapCertainty read_certainty(const JsonCursor& value, std::size_t landmarks);

}  // namespace mapproof
