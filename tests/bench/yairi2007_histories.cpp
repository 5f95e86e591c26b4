// Writes what the robot observed in one run of a study, for yairi2007_python.py:
//   mapproof_yairi2007_histories STUDY LAYOUT POSE FOLDER
// One file a sensor, FOLDER/layout-L-pose-P.SENSOR.f64: landmarks of step 1, of step 2, and so on.
#include <algorithm>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <string_view>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/random.hpp"
#include "core/experiment/seeds.hpp"
#include "core/records/studies/study_store.hpp"
#include "core/simulate/robot_walk.hpp"
#include "core/simulate/sensors.hpp"

namespace mapproof {
namespace {

const Run& run_of(const Study& study, const RunId& id) {
  const auto found = std::ranges::find(study.runs, id, &Run::id);
  if (found == study.runs.end()) throw InvalidInput("the study has no " + slug(id));
  return *found;
}

void write_histories(const Study& study, const RunId& id, const std::filesystem::path& folder) {
  const Experiment& experiment = study.experiment;
  const World& world = run_of(study, id).world;
  const auto layout = static_cast<std::uint64_t>(id.layout);
  const auto pose = static_cast<std::uint64_t>(id.pose);
  int steps = 1;
  for (const SensorStudy& sensor : experiment.sensors)
    steps = std::max(steps, sensor.checkpoints.back());
  Random wander(derive_seed(experiment.seed, {kWalk, layout, pose}));
  const Path path = random_walk(world, experiment.walk, steps, wander);
  for (const SensorStudy& study_of : experiment.sensors) {
    const Sensor sensor = study_of.sensor.sensor;
    const auto key = static_cast<std::uint64_t>(sensor);
    Random noise(derive_seed(experiment.seed, {kNoise, layout, pose, key}));
    const Eigen::MatrixXd values = observe(world, path, study_of.sensor, noise).values;
    write_file(folder / fmt::format("{}.{}.f64", slug(id), name(sensor)),
               std::string_view(reinterpret_cast<const char*>(values.data()),
                                static_cast<std::size_t>(values.size()) * sizeof(double)));
  }
}

}  // namespace
}  // namespace mapproof

int main(int argc, char** argv) {
  if (argc != 5) return 2;
  try {
    mapproof::write_histories(mapproof::read_study(argv[1]),
                              {std::atoi(argv[2]), std::atoi(argv[3])}, argv[4]);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
