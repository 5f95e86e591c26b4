#include "core/records/space_values.hpp"

#include <limits>

#include "core/base/not_finite.hpp"
#include "core/records/json_values.hpp"

namespace mapproof {
namespace {

using Json = nlohmann::ordered_json;

Json cloud_value(const QuadricPoints& cloud) {
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < 4; ++i) rows.push_back(numbers_value(cloud.Q.row(i).transpose()));
  return {{"points", space_points_value(cloud.points)}, {"quadric", std::move(rows)}};
}

QuadricPoints read_cloud(const JsonCursor& value, std::size_t size) {
  value.allow_only({"points", "quadric"});
  QuadricPoints cloud;
  cloud.points = read_space_points(value.at("points"), size);
  if (!cloud.points.allFinite() || cloud.points.rows() != static_cast<Eigen::Index>(size))
    value.at("points").fail("expected a point a step");
  const std::vector<JsonCursor> rows = value.at("quadric").elements(4, 4);
  for (Eigen::Index i = 0; i < 4; ++i) {
    const std::vector<JsonCursor> entries = rows[static_cast<std::size_t>(i)].elements(4, 4);
    for (Eigen::Index j = 0; j < 4; ++j)
      cloud.Q(i, j) = entries[static_cast<std::size_t>(j)].number(-kInfinity, kInfinity);
  }
  if (cloud.Q != cloud.Q.transpose()) value.at("quadric").fail("expected a symmetric matrix");
  return cloud;
}

}  // namespace

Json space_points_value(const SpacePoints& points) {
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    rows.push_back(points.row(i).allFinite() ? numbers_value(points.row(i).transpose())
                                             : Json(nullptr));
  return rows;
}

SpacePoints read_space_points(const JsonCursor& value, std::size_t most) {
  const std::vector<JsonCursor> rows = value.elements(0, most);
  SpacePoints points(static_cast<Eigen::Index>(rows.size()), 3);
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const JsonCursor& row = rows[static_cast<std::size_t>(i)];
    if (row.is_null()) {
      points.row(i).setConstant(std::numeric_limits<double>::quiet_NaN());
      continue;
    }
    const std::vector<JsonCursor> entries = row.elements(3, 3);
    for (Eigen::Index k = 0; k < 3; ++k)
      points(i, k) = entries[static_cast<std::size_t>(k)].number(-kInfinity, kInfinity);
  }
  return points;
}

Json upgrade_value(const UpgradeClouds& upgrade) {
  return {{"steps", indices_value(upgrade.steps)},
          {"before", cloud_value(upgrade.before)},
          {"after", cloud_value(upgrade.after)}};
}

UpgradeClouds read_upgrade(const JsonCursor& value) {
  value.allow_only({"steps", "before", "after"});
  UpgradeClouds upgrade;
  upgrade.steps = read_indices(value.at("steps"), kMostSteps);
  upgrade.before = read_cloud(value.at("before"), upgrade.steps.size());
  upgrade.after = read_cloud(value.at("after"), upgrade.steps.size());
  return upgrade;
}

}  // namespace mapproof
