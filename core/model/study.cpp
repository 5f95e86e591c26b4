#include "core/model/study.hpp"

#include <array>
#include <cstddef>

#include <fmt/format.h>

#include "core/base/errors.hpp"

namespace mapproof {
namespace {

constexpr std::array kOutcomeNames = {std::string_view("visible"), std::string_view("hidden"),
                                      std::string_view("out_of_reach")};

}  // namespace

std::string_view name(View view) { return kOutcomeNames[static_cast<std::size_t>(view)]; }

std::string slug(const RunId& run) {
  return fmt::format("layout-{}-pose-{}", run.layout, run.pose);
}

std::string record_id(const RunId& run, Sensor sensor, const MethodSetting& setting, int step) {
  return fmt::format("{}/{}/{}/{}", slug(run), name(sensor), slug(setting), step);
}

Measurement measurement(const RunDetails& run, const SensorDetails& sensor, const World& world) {
  const Eigen::Index step = sensor.scan_step;
  if (step < 1 || step > run.path.positions_m.rows())
    throw InvalidInput("a scan at a step that the path does not have");
  return {.sensor = sensor.sensor,
          .run = run.id,
          .step = sensor.scan_step,
          .world = world,
          .path_m = run.path.positions_m.topRows(step),
          .robot_m = run.path.positions_m.row(step - 1),
          .heading_rad = run.path.headings_rad(step - 1),
          .reach_m = sensor.reach_m,
          .views = sensor.views,
          .bearings_rad = sensor.sensor == Sensor::kBearing ? sensor.values : Eigen::VectorXd()};
}

}  // namespace mapproof
