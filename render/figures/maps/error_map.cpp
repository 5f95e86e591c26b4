#include "render/figures/maps/error_map.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/number_text.hpp"
#include "render/figures/error_ramp.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kErrorCells = 30;  // Along a side.

/// Landmarks with a true position and an estimate.
struct Errors {
  std::vector<double> x, y, error_m;

  double mean() const {
    double sum = 0.0;
    for (const double error : error_m) sum += error;
    return sum / static_cast<double>(error_m.size());
  }
};

Errors errors_of(const MapRecord& map) {
  if (!map.ground_truth_m || map.ground_truth_m->rows() != map.estimate.rows())
    throw InvalidInput("error_map_figure: a map without ground truth");
  Errors errors;
  for (Eigen::Index i = 0; i < map.estimate.rows(); ++i) {
    const double error = (map.estimate.row(i) - map.ground_truth_m->row(i)).norm();
    if (!std::isfinite(error)) continue;
    errors.x.push_back((*map.ground_truth_m)(i, 0));
    errors.y.push_back((*map.ground_truth_m)(i, 1));
    errors.error_m.push_back(error);
  }
  if (errors.error_m.empty()) throw InvalidInput("error_map_figure: a map without errors");
  return errors;
}

double error_at(const Errors& errors, double x, double y, double least) {
  double sum = 0.0, weights = 0.0;
  for (std::size_t i = 0; i < errors.error_m.size(); ++i) {
    const double distance = std::max(std::hypot(x - errors.x[i], y - errors.y[i]), least);
    const double weight = 1.0 / (distance * distance * distance);
    sum += weight * errors.error_m[i];
    weights += weight;
  }
  return sum / weights;
}

Cells cells_of(const Errors& errors, double side_m, double most_m) {
  Cells cells{.label = "position error, " + error_ramp_text(most_m),
              .x = {0.0, side_m},
              .y = {0.0, side_m},
              .columns = kErrorCells,
              .colour_scale = {.limits = {0.0, most_m}, .ramp = Ramp::kViridis}};
  const double cell = side_m / kErrorCells;
  for (std::size_t row = kErrorCells; row-- > 0;)
    for (std::size_t column = 0; column < kErrorCells; ++column)
      cells.values.push_back(error_at(errors, (static_cast<double>(column) + 0.5) * cell,
                                      (static_cast<double>(row) + 0.5) * cell, 0.1 * cell));
  return cells;
}

/// The MPE of a map, as its other figures print it; of one without a score the mean of all errors.
std::string error_words(const TitledMap& one, const Errors& errors) {
  return one.map.score ? "MPE " + error_text(one.map.score->mpe_m)
                       : fmt::format("mean {} m", significant(errors.mean()));
}

/// The error that all but a few landmarks keep below.
double most_of(const std::vector<Errors>& maps) {
  std::vector<double> all;
  for (const Errors& errors : maps)
    all.insert(all.end(), errors.error_m.begin(), errors.error_m.end());
  return end_of_error_ramp(std::move(all));
}

}  // namespace

Figure error_map_figure(const ErrorMapSpec& spec) {
  if (spec.maps.empty()) throw InvalidInput("error_map_figure: no map");
  std::vector<Errors> errors;
  for (const TitledMap& one : spec.maps) errors.push_back(errors_of(one.map));
  const double most_m = most_of(errors);
  Figure figure;
  figure.id = spec.id;
  figure.title = spec.title;
  figure.caption = fmt::format(
      "Position error over the floor: the mean of the landmarks' errors, weighted by the inverse "
      "cube of their distances. One scale for all maps; {} m is the 95th percentile of all errors. "
      "Dots: landmarks.",
      significant(most_m, 2));
  figure.shared_x = figure.shared_y = spec.maps.size() > 1;
  for (std::size_t i = 0; i < spec.maps.size(); ++i) {
    const TitledMap& one = spec.maps[i];
    Panel& panel = figure.panels.emplace_back();
    panel.title = fmt::format("{}\n{}", one.title, error_words(one, errors[i]));
    panel.x = {.label = "x [m]", .limits = Range{0.0, spec.side_m}};
    panel.y = {.label = "y [m]", .limits = Range{0.0, spec.side_m}};
    panel.equal_aspect = true;
    panel.layers.emplace_back(cells_of(errors[i], spec.side_m, most_m));
    panel.layers.emplace_back(
        Scatter{.x = errors[i].x, .y = errors[i].y, .colour = ThemeColour::kText, .size = 0.35});
    figure.record_ids.push_back(one.map.id);
    figure.alt +=
        fmt::format("{}{}: {}", i == 0 ? "" : "; ", one.title, error_words(one, errors[i]));
  }
  figure.alt += ".";
  require_valid(figure);
  return figure;
}

}  // namespace mapproof
