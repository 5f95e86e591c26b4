#include "render/scene/error_field_scene.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "render/figures/words.hpp"
#include "render/scene/room.hpp"
#include "render/theme/ticks.hpp"

namespace mapproof {
namespace {

constexpr double kHighest = 0.35;           // The surface at the ramp's end, of the room's side.
constexpr double kErrorFieldAspect = 1.35;  // Several views share a page.
constexpr double kLift = 0.004;             // Of the side: no error still lies above the floor.
constexpr double kErrorPercentile = 0.95;
constexpr int kMostLevels = 6;

/// A landmark that has a truth and a place.
struct Sample {
  Eigen::RowVector2d at_m;
  double error_m = 0.0;
};

std::vector<Sample> samples_of(const MapRecord& map) {
  std::vector<Sample> samples;
  if (!map.truth_m || map.frame != Frame::kTruth || map.truth_m->rows() != map.estimate.rows())
    return samples;
  for (Eigen::Index i = 0; i < map.estimate.rows(); ++i) {
    const Eigen::RowVector2d at = map.truth_m->row(i);
    const double error = (map.estimate.row(i) - at).norm();
    const auto above = [&at](const Sample& one) { return one.at_m == at; };
    if (at.allFinite() && std::isfinite(error) && std::ranges::none_of(samples, above))
      samples.push_back({at, error});
  }
  return samples;
}

/// Whether some three of the places span an area.
bool spans_area(const std::vector<Sample>& samples, double side_m) {
  for (std::size_t i = 1; i < samples.size(); ++i)
    for (std::size_t j = i + 1; j < samples.size(); ++j) {
      const Eigen::RowVector2d a = samples[i].at_m - samples[0].at_m;
      const Eigen::RowVector2d b = samples[j].at_m - samples[0].at_m;
      if (std::abs(a.x() * b.y() - a.y() * b.x()) > 1e-9 * side_m * side_m) return true;
    }
  return false;
}

/// Ends of the ramp, and where its contours are.
struct ErrorRamp {
  double most_m = 0.0;
  std::vector<double> levels;

  explicit ErrorRamp(std::vector<double> errors_m) {
    std::ranges::sort(errors_m);
    const auto rank = static_cast<std::size_t>(
        std::lround(kErrorPercentile * static_cast<double>(errors_m.size() - 1)));
    most_m = std::max(errors_m[rank], 1e-6);
    const double step = tick_step(0.0, most_m, kMostLevels);
    for (double level = step; level < most_m; level += step) levels.push_back(level);
  }
};

Field field_of(const std::vector<Sample>& samples, const ErrorRamp& scale, double side_m) {
  Field field{.label = fmt::format(
                  "position error, 0 to {} m or more; a line every {} m", significant(scale.most_m),
                  significant(scale.levels.empty() ? scale.most_m : scale.levels[0], 2)),
              .levels = scale.levels,
              .contour_radius = 0.0025 * side_m};
  field.tones.limits = {0.0, scale.most_m};
  for (const Sample& sample : samples) {
    const double shown = std::min(sample.error_m, scale.most_m);
    const double height = (kLift + kHighest * shown / scale.most_m) * side_m;
    field.points.push_back(on_floor(sample.at_m, height));
    field.tones.values.push_back(sample.error_m);
  }
  return field;
}

}  // namespace

bool has_error_field(const MapRecord& map, double side_m) {
  return is_room_side(side_m) && spans_area(samples_of(map), side_m);
}

Scene error_field_scene(const ErrorFieldSpec& spec) {
  if (spec.maps.empty()) throw InvalidInput("error_field_scene: no map");
  if (!is_room_side(spec.side_m))
    throw InvalidInput("error_field_scene: the room's side is not a length");
  std::vector<std::vector<Sample>> samples;
  std::vector<double> errors_m;
  for (const ErrorFieldSpec::One& one : spec.maps) {
    samples.push_back(samples_of(one.map));
    if (!spans_area(samples.back(), spec.side_m))
      throw InvalidInput("error_field_scene: a map without an error field");
    for (const Sample& sample : samples.back()) errors_m.push_back(sample.error_m);
  }
  const ErrorRamp scale(errors_m);
  Scene scene{.id = spec.id,
              .title = spec.title,
              .caption = fmt::format(
                  "Position error over the floor, interpolated between the "
                  "landmarks; heights are errors, {} times as high, cut at {} m, "
                  "the 95th percentile of all.",
                  significant(kHighest * spec.side_m / scale.most_m, 2), significant(scale.most_m)),
              .lights = usual_lights(),
              .columns = spec.columns};
  scene.parts = {floor_of(spec.side_m), walls_of(spec.side_m)};
  for (std::size_t i = 0; i < spec.maps.size(); ++i) {
    Shot view = room_view(spec.side_m, kHighest * spec.side_m, {}, kErrorFieldAspect);
    view.title = spec.maps[i].title;
    view.parts = {0, 1, scene.parts.size()};
    scene.parts.emplace_back(field_of(samples[i], scale, spec.side_m));
    scene.views.push_back(std::move(view));
    scene.record_ids.push_back(spec.maps[i].map.id);
    double sum = 0.0;
    for (const Sample& sample : samples[i]) sum += sample.error_m;
    scene.alt += fmt::format("{}{}: mean error {} m", i == 0 ? "" : "; ", spec.maps[i].title,
                             significant(sum / static_cast<double>(samples[i].size())));
  }
  scene.alt += ".";
  require_valid(scene);
  return scene;
}

}  // namespace mapproof
