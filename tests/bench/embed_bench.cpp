// Processor seconds of each mapping method, from the observations to the map.
//   mapproof_embed_bench write FOLDER SENSOR M  N = 2000 observations of M simulated landmarks:
//       bearings as vectors, visibility as 0 and 1 (a landmark is seen within a third of the room)
//   mapproof_embed_bench run FOLDER SENSOR M WHAT  a line "M WHAT mapproof SECONDS PEAK_MIB
//       ITERATIONS": of bearings from the vectors, of visibility from the values
//   mapproof_embed_bench csv FILE M N LAYOUT  N bearings of M simulated landmarks as CSV with four
//                                             decimals; LAYOUT is wide or transposed
// WHAT is a method, or "gram": the products and distances alone, which every method begins with.
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "core/base/random.hpp"
#include "core/embed/embedder.hpp"
#include "core/embed/pca.hpp"
#include "core/model/observation_history.hpp"
#include "core/model/sensor.hpp"
#include "core/observe/features.hpp"
#include "core/observe/proximities.hpp"
#include "core/simulate/robot_walk.hpp"
#include "core/simulate/sensors.hpp"
#include "core/simulate/world.hpp"

namespace mapproof {
namespace {

constexpr int kSteps = 2000;
constexpr double kNeighbours = 8;
constexpr double kVariance = 4000.0;         // Of vectors of bearings.
constexpr double kVisibilityVariance = 0.5;  // Of vectors of length 1.
constexpr double kSeenWithin = 1.0 / 3.0;    // Of the room's side.

std::filesystem::path data_file(const std::string& folder, Sensor sensor, int landmarks) {
  return std::filesystem::path(folder) / fmt::format("{}-{}.f64", name(sensor), landmarks);
}

World room_of(int landmarks, Random& random) {
  WorldOptions room;
  room.landmarks = landmarks;
  room.side_m = 2.5 * std::sqrt(landmarks / 50.0);
  return scatter_landmarks(room, random);
}

ObservationHistory bearings_of(int landmarks, int steps) {
  Random random(static_cast<std::uint64_t>(landmarks));
  const World world = room_of(landmarks, random);
  const Path path = random_walk(world, {}, steps, random);
  return observe(world, path, {.sensor = Sensor::kBearing}, random);
}

/// M x N: 1 within kSeenWithin of the room's side, else 0. The robot walks straighter than in the
/// paper, so that it gets everywhere.
Eigen::MatrixXd visibility_of(int landmarks, int steps) {
  Random random(static_cast<std::uint64_t>(landmarks));
  const World world = room_of(landmarks, random);
  const Path path = random_walk(world, {.heading_change_rad = 0.15}, steps, random);
  Eigen::MatrixXd seen(landmarks, steps);
  for (Eigen::Index t = 0; t < steps; ++t)
    seen.col(t) =
        ((world.landmarks_m.rowwise() - path.positions_m.row(t)).rowwise().norm().array() <=
         kSeenWithin * world.side_m)
            .cast<double>();
  return seen;
}

void write_csv(const std::string& file, int landmarks, int steps, bool is_transposed) {
  const ObservationHistory history = bearings_of(landmarks, steps);
  std::ofstream out(file, std::ios::binary);
  std::string row = is_transposed ? "step" : "";
  if (is_transposed)
    for (int i = 0; i < landmarks; ++i) row += fmt::format(",L{}", i + 1);
  if (is_transposed) out << row << '\n';
  for (int r = 0; r < (is_transposed ? steps : landmarks); ++r) {
    row = is_transposed ? fmt::format("{}", r) : fmt::format("L{}", r + 1);
    for (int c = 0; c < (is_transposed ? landmarks : steps); ++c)
      fmt::format_to(std::back_inserter(row), ",{:.4f}",
                     is_transposed ? history.values(c, r) : history.values(r, c));
    out << row << '\n';
  }
}

void write_data(const std::string& folder, Sensor sensor, int landmarks) {
  const Eigen::MatrixXd values = sensor == Sensor::kVisibility
                                     ? visibility_of(landmarks, kSteps)
                                     : features(bearings_of(landmarks, kSteps), kSteps).values;
  std::ofstream out(data_file(folder, sensor, landmarks), std::ios::binary);
  out.write(reinterpret_cast<const char*>(values.data()),
            values.size() * static_cast<std::streamsize>(sizeof(double)));
}

Eigen::MatrixXd read_data(const std::string& folder, Sensor sensor, int landmarks) {
  Eigen::MatrixXd values(landmarks, sensor == Sensor::kVisibility ? kSteps : 2 * kSteps);
  std::ifstream in(data_file(folder, sensor, landmarks), std::ios::binary);
  in.read(reinterpret_cast<char*>(values.data()),
          values.size() * static_cast<std::streamsize>(sizeof(double)));
  return values;
}

MethodSetting setting_of(const std::string& what, Sensor sensor) {
  const MethodInfo& method = info(method_named(what).value());
  if (!method.parameter) return {method.method, std::nullopt};
  if (method.parameter->counts_neighbours) return {method.method, kNeighbours};
  if (method.method != Method::kKpcaGaussian) return {method.method, 2.0};
  return {method.method, sensor == Sensor::kVisibility ? kVisibilityVariance : kVariance};
}

/// The work once, from vectors of bearings; how many iterations it took.
int work(const Features& X, const std::string& what) {
  if (what == "lpca" && is_faster_by_vectors(X.values.rows(), X.values.cols())) {
    lpca_of_vectors(X.values);
    return 0;
  }
  Proximities data = proximities(X, Sensor::kBearing);
  if (what == "gram") return 0;
  return Embedder(std::move(data)).embed(setting_of(what, Sensor::kBearing)).iterations;
}

/// The work once, from visibility.
int work(const ObservationHistory& history, const std::string& what) {
  if (what == "gram") {
    proximities(history, history.steps());
    return 0;
  }
  MethodSetting setting = setting_of(what, Sensor::kVisibility);
  return embed_history(history, history.steps(), setting).iterations;
}

template <typename Data>
void time_work(const Data& data, int landmarks, const std::string& what) {
  double best = std::numeric_limits<double>::infinity();
  double total = 0.0;
  int iterations = 0;
  for (int round = 0; round < 3 || (total < 0.3 && round < 100); ++round) {
    const std::clock_t start = std::clock();
    iterations = work(data, what);
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    best = std::min(best, seconds);
    total += seconds;
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  fmt::print("{} {} mapproof {:.6f} {:.0f} {}\n", landmarks, what, best,
             static_cast<double>(usage.ru_maxrss) / 1024.0, iterations);
}

void run(const std::string& folder, Sensor sensor, int landmarks, const std::string& what) {
  Eigen::MatrixXd values = read_data(folder, sensor, landmarks);
  if (sensor == Sensor::kVisibility)
    time_work(ObservationHistory{sensor, landmark_names(landmarks), std::move(values)}, landmarks,
              what);
  else
    time_work(Features{.values = std::move(values), .observed = {}}, landmarks, what);
}

}  // namespace
}  // namespace mapproof

int main(int argc, char** argv) {
  using mapproof::sensor_named;
  if (argc == 5 && std::strcmp(argv[1], "write") == 0) {
    mapproof::write_data(argv[2], sensor_named(argv[3]).value(), std::stoi(argv[4]));
  } else if (argc == 6 && std::strcmp(argv[1], "csv") == 0) {
    mapproof::write_csv(argv[2], std::stoi(argv[3]), std::stoi(argv[4]),
                        std::strcmp(argv[5], "transposed") == 0);
  } else if (argc == 6 && std::strcmp(argv[1], "run") == 0) {
    mapproof::run(argv[2], sensor_named(argv[3]).value(), std::stoi(argv[4]), argv[5]);
  } else {
    return 2;
  }
}
