#include <algorithm>
#include <cmath>

#include "core/records/json_values.hpp"
#include "core/records/slam_values.hpp"

namespace mapproof {
namespace {

using Json = nlohmann::ordered_json;

/// One field of all elements as an array.
template <typename Item, typename Field>
Json column(const std::vector<Item>& items, Field Item::*field) {
  Json values = Json::array();
  for (const Item& item : items) values.push_back(number_value(static_cast<double>(item.*field)));
  return values;
}

Json ranges_value(const std::vector<RangeReading>& ranges) {
  return {{"time_s", column(ranges, &RangeReading::time_s)},
          {"landmark", column(ranges, &RangeReading::landmark)},
          {"range_m", column(ranges, &RangeReading::range_m)}};
}

std::vector<RangeReading> read_ranges(const JsonCursor& value, std::size_t landmarks) {
  value.allow_only({"time_s", "landmark", "range_m"});
  const Eigen::VectorXd time_s = read_finite(value.at("time_s"));
  const auto size = static_cast<std::size_t>(time_s.size());
  const Eigen::VectorXd range_m = read_finite(value.at("range_m"), size);
  std::vector<RangeReading> ranges;
  const std::vector<JsonCursor> rows = value.at("landmark").elements(size, size);
  for (std::size_t i = 0; i < size; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const auto landmark = rows[i].integer(0, static_cast<std::int64_t>(landmarks) - 1);
    ranges.push_back({.time_s = time_s(row), .landmark = landmark, .range_m = range_m(row)});
  }
  return ranges;
}

Json odometry_value(const std::vector<Motion>& motions) {
  return {{"time_s", column(motions, &Motion::time_s)},
          {"distance_m", column(motions, &Motion::distance_m)},
          {"turn_rad", column(motions, &Motion::turn_rad)},
          {"sideways_m", column(motions, &Motion::sideways_m)}};
}

std::vector<Motion> read_odometry(const JsonCursor& value) {
  value.allow_only({"time_s", "distance_m", "turn_rad", "sideways_m"});
  const Eigen::VectorXd time_s = read_finite(value.at("time_s"));
  const auto size = static_cast<std::size_t>(time_s.size());
  const Eigen::VectorXd distance_m = read_finite(value.at("distance_m"), size);
  const Eigen::VectorXd turn_rad = read_finite(value.at("turn_rad"), size);
  const Eigen::VectorXd sideways_m = read_finite(value.at("sideways_m"), size);
  std::vector<Motion> motions;
  for (Eigen::Index i = 0; i < time_s.size(); ++i)
    motions.push_back({.time_s = time_s(i),
                       .distance_m = distance_m(i),
                       .turn_rad = turn_rad(i),
                       .sideways_m = sideways_m(i)});
  return motions;
}

StartPose read_start(const JsonCursor& value) {
  const Eigen::VectorXd start = read_finite(value, 4);
  return {.time_s = start(0), .x_m = start(1), .y_m = start(2), .heading_rad = start(3)};
}

}  // namespace

Json range_log_value(const RangeLog& log) {
  const StartPose& start = log.start;
  return {
      {"name", log.name},
      {"landmarks", log.landmarks},
      {"true_landmarks_m", log.true_landmarks ? points_value(*log.true_landmarks) : Json(nullptr)},
      {"remarks", log.remarks},
      {"start",
       {number_value(start.time_s), number_value(start.x_m), number_value(start.y_m),
        number_value(start.heading_rad)}},
      {"ranges", ranges_value(log.ranges)},
      {"odometry", odometry_value(log.odometry)},
      {"truth", log.truth ? path_value(*log.truth) : Json(nullptr)}};
}

RangeLog read_range_log_value(const JsonCursor& value) {
  value.allow_only(
      {"name", "landmarks", "true_landmarks_m", "remarks", "start", "ranges", "odometry", "truth"});
  RangeLog log;
  log.name = value.at("name").text(kLongestName);
  log.landmarks = read_names(value.at("landmarks"));
  if (const JsonCursor places = value.at("true_landmarks_m"); !places.is_null()) {
    log.true_landmarks = read_points(places);
    if (log.true_landmarks->rows() != std::ssize(log.landmarks))
      places.fail("expected a place, or null, for each landmark");
  }
  for (const JsonCursor& remark : value.at("remarks").elements(0, 10'000))
    log.remarks.push_back(remark.text(kLongestText));
  log.start = read_start(value.at("start"));
  log.ranges = read_ranges(value.at("ranges"), log.landmarks.size());
  log.odometry = read_odometry(value.at("odometry"));
  if (const JsonCursor truth = value.at("truth"); !truth.is_null()) log.truth = read_path(truth);
  return log;
}

}  // namespace mapproof
