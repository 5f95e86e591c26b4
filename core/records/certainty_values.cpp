#include "core/records/certainty_values.hpp"

#include <cmath>
#include <limits>

#include "core/records/limits.hpp"

namespace mapproof {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kMostReplicates = 1'000'000;

Eigen::Matrix2d read_covariance(const JsonCursor& value) {
  if (value.is_null()) return Eigen::Matrix2d::Constant(std::numeric_limits<double>::quiet_NaN());
  constexpr double kMost = 1e300;
  const std::vector<JsonCursor> entries = value.elements(3, 3);
  const double xx = entries[0].number(0.0, kMost);
  const double xy = entries[1].number(-kMost, kMost);
  const double yy = entries[2].number(0.0, kMost);
  // Rounding leaves a covariance on one line a little less than singular.
  if (std::abs(xy) > std::sqrt(xx) * std::sqrt(yy) * (1.0 + 1e-9))
    value.fail("expected a covariance, xy^2 <= xx yy");
  Eigen::Matrix2d C;
  C << xx, xy, xy, yy;
  return C;
}

}  // namespace

Json covariances_value(const std::vector<Eigen::Matrix2d>& covariances) {
  Json values = Json::array();
  for (const Eigen::Matrix2d& C : covariances)
    values.push_back(C.allFinite() ? Json::array({C(0, 0), C(0, 1), C(1, 1)}) : Json(nullptr));
  return values;
}

Json certainty_value(const MapCertainty& certainty) {
  return {{"confidence", certainty.confidence},   {"squared_radius", certainty.squared_radius},
          {"replicates", certainty.replicates},   {"maps", certainty.maps},
          {"block_steps", certainty.block_steps}, {"covariances", covariances_value(certainty.covariances)}};
}

MapCertainty read_certainty(const JsonCursor& value, std::size_t landmarks) {
  value.allow_only(
      {"confidence", "squared_radius", "replicates", "maps", "block_steps", "covariances"});
  MapCertainty certainty;
  certainty.confidence = value.at("confidence").number(0.0, 1.0);
  certainty.squared_radius = value.at("squared_radius").number(0.0, 1e300);
  certainty.replicates = value.at("replicates").integer32(0, kMostReplicates);
  certainty.maps = value.at("maps").integer32(0, certainty.replicates);
  certainty.block_steps = value.at("block_steps").integer32(1, kMostSteps);
  for (const JsonCursor& entry : value.at("covariances").elements(landmarks, landmarks))
    certainty.covariances.push_back(read_covariance(entry));
  return certainty;
}

}  // namespace mapproof
