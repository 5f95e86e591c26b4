// A large simulated world as a long table, written step by step:
//   mapproof_large_world FOLDER M N visibility|bearing SHARE
// M landmarks as dense as in the paper's room, N steps of a walk; a landmark is observed within a
// radius that makes SHARE of all entries observed. Bearings have noise of 1 degree. Writes
// observations.csv, and of the landmarks that were observed ground_truth.csv and anchors.csv (8).
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "core/base/angle.hpp"
#include "core/base/random.hpp"
#include "core/model/sensor.hpp"
#include "core/simulate/landmark_grid.hpp"
#include "core/simulate/robot_walk.hpp"
#include "core/simulate/sensors.hpp"
#include "core/simulate/world.hpp"

namespace mapproof {
namespace {

constexpr std::uint64_t kSeed = 2007;
constexpr double kNoise_rad = std::numbers::pi / 180.0;

/// The landmarks within a radius, ascending.
std::vector<Eigen::Index> within(const World& world, const LandmarkGrid& grid,
                                 const Eigen::RowVector2d& position, double radius_m) {
  std::vector<Eigen::Index> near;
  grid.any_near(position.x(), position.y(), radius_m, [&](Eigen::Index i) {
    if ((world.landmarks_m.row(i) - position).norm() <= radius_m) near.push_back(i);
    return false;
  });
  std::ranges::sort(near);
  return near;
}

/// The radius within which that share of the landmarks lies on average, by bisection.
double radius_of(const World& world, const Path& path, double share) {
  const Eigen::Index every = std::max<Eigen::Index>(path.positions_m.rows() / 200, 1);
  double low = 0.0, high = 2.0 * world.side_m;
  for (int round = 0; round < 30; ++round) {
    const double radius = (low + high) / 2.0;
    double seen = 0.0, all = 0.0;
    for (Eigen::Index t = 0; t < path.positions_m.rows(); t += every) {
      seen += static_cast<double>(
          ((world.landmarks_m.rowwise() - path.positions_m.row(t)).rowwise().norm().array() <=
           radius)
              .count());
      all += static_cast<double>(world.landmarks_m.rows());
    }
    (seen < share * all ? low : high) = radius;
  }
  return (low + high) / 2.0;
}

void write_points(const std::filesystem::path& file, const World& world,
                  const std::vector<Eigen::Index>& rows) {
  std::string text = "name,x,y\n";
  for (const Eigen::Index i : rows)
    fmt::format_to(std::back_inserter(text), "L{},{},{}\n", i + 1, world.landmarks_m(i, 0),
                   world.landmarks_m(i, 1));
  std::FILE* out = std::fopen(file.c_str(), "w");
  std::fwrite(text.data(), 1, text.size(), out);
  std::fclose(out);
}

void write_world(const std::filesystem::path& folder, int landmarks, int steps, Sensor sensor,
                 double share) {
  Random random(kSeed);
  WorldOptions room;
  room.landmarks = landmarks;
  room.side_m *= std::sqrt(landmarks / 50.0);
  const World world = scatter_landmarks(room, random);
  // Straighter than in the paper, so that the robot gets everywhere.
  const Path path = random_walk(world, {.heading_change_rad = 0.15}, steps, random);
  const double radius = radius_of(world, path, share);
  const LandmarkGrid grid(world.landmarks_m, world.side_m, radius / 4.0);

  std::FILE* out = std::fopen((folder / "observations.csv").c_str(), "w");
  std::string text = sensor == Sensor::kBearing ? "step,landmark,bearing\n" : "step,landmark\n";
  long long observed = 0;
  std::vector<bool> is_seen(static_cast<std::size_t>(landmarks));
  for (Eigen::Index t = 0; t < steps; ++t) {
    const Eigen::RowVector2d position = path.positions_m.row(t);
    for (const Eigen::Index i : within(world, grid, position, radius)) {
      ++observed;
      is_seen[static_cast<std::size_t>(i)] = true;
      if (sensor != Sensor::kBearing) {
        fmt::format_to(std::back_inserter(text), "{},L{}\n", t + 1, i + 1);
        continue;
      }
      const Eigen::RowVector2d offset = world.landmarks_m.row(i) - position;
      const double bearing = wrapped(std::atan2(offset.y(), offset.x()) - path.headings_rad(t) +
                                     kNoise_rad * random.normal());
      fmt::format_to(std::back_inserter(text), "{},L{},{:.5f}\n", t + 1, i + 1, bearing);
    }
    std::fwrite(text.data(), 1, text.size(), out);
    text.clear();
  }
  std::fclose(out);

  std::vector<Eigen::Index> seen;
  for (Eigen::Index i = 0; i < world.landmarks_m.rows(); ++i)
    if (is_seen[static_cast<std::size_t>(i)]) seen.push_back(i);
  write_points(folder / "ground_truth.csv", world, seen);
  World seen_world = world;
  seen_world.landmarks_m = world.landmarks_m(seen, Eigen::all);
  std::vector<Eigen::Index> anchors;
  for (const Eigen::Index row : place_anchors(seen_world, 8, AnchorPlacement::kWalls, random))
    anchors.push_back(seen[static_cast<std::size_t>(row)]);
  write_points(folder / "anchors.csv", world, anchors);
  fmt::print("{} observations, {:.3f} % of {} x {}; radius {:.2f} m in a room of {:.1f} m\n",
             observed, 100.0 * static_cast<double>(observed) / landmarks / steps, landmarks, steps,
             radius, world.side_m);
}

}  // namespace
}  // namespace mapproof

int main(int argc, char** argv) {
  const auto sensor = argc == 6 ? mapproof::sensor_named(argv[4]) : std::nullopt;
  if (!sensor || *sensor == mapproof::Sensor::kRange) return 2;
  mapproof::write_world(argv[1], std::stoi(argv[2]), std::stoi(argv[3]), *sensor,
                        std::stod(argv[5]));
}
