#include "core/records/slam_values.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "core/base/spelling.hpp"
#include "core/json/text_input.hpp"
#include "core/records/json_values.hpp"

namespace mapproof {

using Json = nlohmann::ordered_json;

SlamMethod read_slam_method(const JsonCursor& value) {
  const std::string text = value.text();
  if (const std::optional<SlamMethod> method = slam_method_named(text)) return *method;
  std::vector<std::string_view> names;
  for (const SlamMethodInfo& method : all_slam_methods()) names.push_back(method.name);
  value.fail(fmt::format("unknown method {}: did you mean \"{}\"?", in_quotes(text),
                         nearest_word(text, names)));
}

Eigen::VectorXd read_finite(const JsonCursor& value, std::optional<std::size_t> size) {
  const std::vector<double> numbers = value.numbers_or_null(-kInfinity, kInfinity, size);
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (!std::isfinite(numbers[i])) value.element(i).fail("expected a finite number");
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(),
                                           static_cast<Eigen::Index>(numbers.size()));
}

Json path_value(const Trajectory& path) {
  return {{"time_s", numbers_value(path.time_s)},
          {"x_m", numbers_value(path.positions_m.col(0))},
          {"y_m", numbers_value(path.positions_m.col(1))},
          {"heading_rad",
           path.heading_rad.size() > 0 ? numbers_value(path.heading_rad) : Json(nullptr)}};
}

Trajectory read_path(const JsonCursor& value) {
  value.allow_only({"time_s", "x_m", "y_m", "heading_rad"});
  Trajectory path;
  path.time_s = read_finite(value.at("time_s"));
  const auto size = static_cast<std::size_t>(path.size());
  path.positions_m.resize(path.size(), 2);
  path.positions_m.col(0) = read_finite(value.at("x_m"), size);
  path.positions_m.col(1) = read_finite(value.at("y_m"), size);
  if (const JsonCursor heading = value.at("heading_rad"); !heading.is_null())
    path.heading_rad = read_finite(heading, size);
  for (Eigen::Index i = 1; i < path.size(); ++i)
    if (!(path.time_s(i) > path.time_s(i - 1)))
      value.at("time_s").element(static_cast<std::size_t>(i)).fail("expected ascending times");
  return path;
}

Json published_drive_value(const std::optional<PublishedDrive>& drive) {
  if (!drive) return nullptr;
  return {{"length_km", drive->length_km}, {"poses", drive->poses}, {"readings", drive->readings}};
}

std::optional<PublishedDrive> read_published_drive(const JsonCursor& value) {
  if (value.is_null()) return std::nullopt;
  value.allow_only({"length_km", "poses", "readings"});
  return PublishedDrive{.length_km = value.at("length_km").number(0.0, kInfinity),
                        .poses = value.at("poses").integer(0, 1'000'000'000),
                        .readings = value.at("readings").integer(0, 1'000'000'000)};
}

Json mean_value(const MeanEstimate& mean) {
  return {{"mean", number_value(mean.mean)},
          {"values", mean.values},
          {"clusters", mean.clusters},
          {"half_width", optional_value(mean.half_width)}};
}

MeanEstimate read_mean(const JsonCursor& value) {
  constexpr int kMost = std::numeric_limits<int>::max();
  value.allow_only({"mean", "values", "clusters", "half_width"});
  return {.mean = value.at("mean").number_or_null(-kInfinity, kInfinity),
          .values = value.at("values").integer32(0, kMost),
          .clusters = value.at("clusters").integer32(0, kMost),
          .half_width = read_optional(value.at("half_width"))};
}

Json optional_value(const std::optional<double>& number) {
  return number && std::isfinite(*number) ? number_value(*number) : Json(nullptr);
}

std::optional<double> read_optional(const JsonCursor& value) {
  const double number = value.number_or_null(-kInfinity, kInfinity);
  return std::isnan(number) ? std::nullopt : std::optional(number);
}

}  // namespace mapproof
