// Writes observations of simulated layouts as CSV files that export_sklearn.py takes:
// mapproof_reference_inputs FOLDER FIRST_SEED LAST_SEED [LANDMARKS STEPS]
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <fmt/format.h>

#include "core/base/files/files.hpp"
#include "core/base/random.hpp"
#include "core/simulate/robot_walk.hpp"
#include "core/simulate/sensors.hpp"
#include "core/simulate/world.hpp"

namespace mapproof {
namespace {

/// Bearings and ranges to 5 decimals: files stay small, and neighbours untied.
std::string wide_csv(const ObservationHistory& history) {
  std::string text = "name";
  for (Eigen::Index step = 0; step < history.steps(); ++step) text += fmt::format(",{}", step + 1);
  text += "\n";
  for (Eigen::Index i = 0; i < history.landmarks(); ++i) {
    text += history.names[static_cast<std::size_t>(i)];
    for (Eigen::Index step = 0; step < history.steps(); ++step)
      text += fmt::format(",{:g}", std::round(history.values(i, step) * 1e5) / 1e5);
    text += "\n";
  }
  return text;
}

void write_layout(const std::filesystem::path& folder, std::uint64_t seed, int landmarks,
                  int steps) {
  Random random(seed);
  // Nothing but noise: no plane behind it.
  ObservationHistory noise{
      .sensor = Sensor::kRange,
      .names = landmark_names(landmarks),
      .values = Eigen::MatrixXd::NullaryExpr(
          landmarks, 30, [&](Eigen::Index, Eigen::Index) { return random.uniform(); })};
  write_file(folder / fmt::format("noise-{}.range.csv", seed), wide_csv(noise));

  WorldOptions room;
  room.landmarks = landmarks;
  room.side_m = 2.5 * std::sqrt(landmarks / 50.0);
  const World world = scatter_landmarks(room, random);
  const Path path = random_walk(world, {}, steps, random);
  for (const Sensor sensor : {Sensor::kVisibility, Sensor::kBearing, Sensor::kRange}) {
    const ObservationHistory history = observe(world, path, {.sensor = sensor}, random);
    // Metric distances need fewer steps.
    ObservationHistory kept = history;
    if (sensor != Sensor::kVisibility) kept.values = history.values.leftCols((steps + 9) / 10);
    write_file(folder / fmt::format("{}-{}.{}.csv", name(sensor), seed, name(sensor)),
               wide_csv(kept));
  }
}

}  // namespace
}  // namespace mapproof

int main(int argc, char** argv) {
  if (argc < 4) return 2;
  const int landmarks = argc > 4 ? std::atoi(argv[4]) : 36;
  const int steps = argc > 5 ? std::atoi(argv[5]) : 800;
  std::filesystem::create_directories(argv[1]);
  for (int seed = std::atoi(argv[2]); seed <= std::atoi(argv[3]); ++seed)
    mapproof::write_layout(argv[1], static_cast<std::uint64_t>(seed), landmarks, steps);
}
