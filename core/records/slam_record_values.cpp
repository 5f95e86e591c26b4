#include <cmath>
#include <limits>

#include "core/base/not_finite.hpp"
#include "core/json/text_input.hpp"
#include "core/records/certainty_values.hpp"
#include "core/records/json_values.hpp"
#include "core/records/slam_values.hpp"

namespace mapproof {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostAlignments = 4;

/// [[xx, xy, yy], null, ...]: null where it is not finite.
std::vector<Eigen::Matrix2d> read_covariances(const JsonCursor& value, std::size_t least,
                                              std::size_t most) {
  std::vector<Eigen::Matrix2d> covariances;
  for (const JsonCursor& item : value.elements(least, most)) {
    Eigen::Matrix2d cov = Eigen::Matrix2d::Constant(std::numeric_limits<double>::quiet_NaN());
    if (!item.is_null()) {
      const Eigen::VectorXd entries = read_finite(item, 3);
      cov << entries(0), entries(1), entries(1), entries(2);
    }
    covariances.push_back(cov);
  }
  return covariances;
}

std::vector<Eigen::Index> read_rows(const JsonCursor& value, Eigen::Index size) {
  std::vector<Eigen::Index> rows;
  for (const JsonCursor& item : value.elements()) {
    rows.push_back(item.integer(0, size - 1));
    if (rows.size() > 1 && rows.back() <= rows[rows.size() - 2])
      item.fail("expected ascending rows");
  }
  return rows;
}

Json error_value(const TrajectoryError& error) {
  return {{"alignment", name(error.alignment)},
          {"path_mean_m", error.mean_m},
          {"path_rmse_m", error.rmse_m},
          {"last_tenth_m", error.last_tenth_m},
          {"best_tenth_m", error.best_tenth_m},
          {"worst_tenth_m", error.worst_tenth_m},
          {"landmarks_m", optional_value(error.landmarks_m)}};
}

TrajectoryError read_error(const JsonCursor& value) {
  value.allow_only({"alignment", "path_mean_m", "path_rmse_m", "last_tenth_m", "best_tenth_m",
                    "worst_tenth_m", "landmarks_m"});
  const JsonCursor alignment = value.at("alignment");
  const std::optional<Alignment> known = alignment_named(alignment.text());
  if (!known) alignment.fail("unknown alignment " + in_quotes(alignment.text()));
  const auto metres = [&](const char* key) { return value.at(key).number(0.0, kInfinity); };
  return {.alignment = *known,
          .mean_m = metres("path_mean_m"),
          .rmse_m = metres("path_rmse_m"),
          .last_tenth_m = metres("last_tenth_m"),
          .best_tenth_m = metres("best_tenth_m"),
          .worst_tenth_m = metres("worst_tenth_m"),
          .landmarks_m = read_optional(value.at("landmarks_m"))};
}

void put_estimate(Json& value, const SlamEstimate& estimate) {
  value["range_scale"] = number_value(estimate.range_scale);
  value["condition"] = optional_value(estimate.condition);
  value["iterations"] = estimate.iterations;
  value["cost"] = optional_value(estimate.cost);
  value["singular_values"] = numbers_value(estimate.singular_values);
  value["noise_level"] = optional_value(estimate.noise_level);
  value["landmarks_m"] = points_value(estimate.landmarks_m);
  value["landmark_cov_m2"] = covariances_value(estimate.landmark_cov_m2);
  value["path"] = path_value(estimate.path);
  value["position_cov_rows"] = indices_value(estimate.position_cov_rows);
  value["position_cov_m2"] = covariances_value(estimate.position_cov_m2);
}

SlamEstimate read_estimate(const JsonCursor& value, Eigen::Index landmarks) {
  SlamEstimate estimate;
  estimate.range_scale = value.at("range_scale").number(-kInfinity, kInfinity);
  estimate.condition = read_optional(value.at("condition"));
  estimate.iterations = value.at("iterations").integer32(0, std::numeric_limits<int>::max());
  estimate.cost = read_optional(value.at("cost"));
  estimate.singular_values = read_finite(value.at("singular_values"));
  estimate.noise_level = read_optional(value.at("noise_level"));
  estimate.landmarks_m = read_points(value.at("landmarks_m"));
  if (estimate.landmarks_m.rows() != landmarks)
    value.at("landmarks_m").fail("expected a place, or null, for each landmark");
  const auto most = static_cast<std::size_t>(landmarks);
  estimate.landmark_cov_m2 = read_covariances(value.at("landmark_cov_m2"), 0, most);
  estimate.path = read_path(value.at("path"));
  estimate.position_cov_rows = read_rows(value.at("position_cov_rows"), estimate.path.size());
  const std::size_t rows = estimate.position_cov_rows.size();
  estimate.position_cov_m2 = read_covariances(value.at("position_cov_m2"), rows, rows);
  estimate.statuses = read_statuses(value.at("statuses"));
  return estimate;
}

}  // namespace

Json slam_record_value(const SlamRecord& record) {
  Json value = {{"method", info(record.method).name}};
  value["statuses"] = statuses_value(record.estimate.statuses);
  value["errors"] = Json::array();
  for (const TrajectoryError& error : record.errors) value["errors"].push_back(error_value(error));
  put_estimate(value, record.estimate);
  value["error_m"] = Json::array();
  for (const double error : record.error_m)
    value["error_m"].push_back(std::isfinite(error) ? number_value(error) : Json(nullptr));
  return value;
}

SlamRecord read_slam_record(const JsonCursor& value, Eigen::Index landmarks) {
  value.allow_only({"method", "statuses", "errors", "range_scale", "condition", "iterations",
                    "cost", "singular_values", "noise_level", "landmarks_m", "landmark_cov_m2",
                    "path", "position_cov_rows", "position_cov_m2", "error_m"});
  SlamRecord record;
  record.method = read_slam_method(value.at("method"));
  record.estimate = read_estimate(value, landmarks);
  for (const JsonCursor& error : value.at("errors").elements(0, kMostAlignments))
    record.errors.push_back(read_error(error));
  record.error_m = value.at("error_m").numbers_or_null(0.0, kInfinity);
  if (!record.error_m.empty() && std::ssize(record.error_m) != record.estimate.path.size())
    value.at("error_m").fail("expected an error a pose");
  return record;
}

}  // namespace mapproof
