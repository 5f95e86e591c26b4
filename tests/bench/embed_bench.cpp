// Processor seconds of each mapping method, from the matrix of observation vectors to the map.
//   mapproof_embed_bench write FOLDER M     N = 2000 bearings of M simulated landmarks, as vectors
//   mapproof_embed_bench run FOLDER M WHAT  a line "M WHAT mapproof SECONDS PEAK_MIB ITERATIONS"
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
#include "core/observe/features.hpp"
#include "core/simulate/robot_walk.hpp"
#include "core/simulate/sensors.hpp"
#include "core/simulate/world.hpp"

namespace mapproof {
namespace {

constexpr int kSteps = 2000;
constexpr double kNeighbours = 8;
constexpr double kVariance = 4000.0;

std::filesystem::path vectors_file(const std::string& folder, int landmarks) {
  return std::filesystem::path(folder) / fmt::format("vectors-{}.f64", landmarks);
}

ObservationHistory bearings_of(int landmarks, int steps) {
  Random random(static_cast<std::uint64_t>(landmarks));
  WorldOptions room;
  room.landmarks = landmarks;
  room.side_m = 2.5 * std::sqrt(landmarks / 50.0);
  const World world = scatter_landmarks(room, random);
  const Path path = random_walk(world, {}, steps, random);
  return observe(world, path, {.sensor = Sensor::kBearing}, random);
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

void write_vectors(const std::string& folder, int landmarks) {
  const Features X = features(bearings_of(landmarks, kSteps), kSteps);
  std::ofstream out(vectors_file(folder, landmarks), std::ios::binary);
  out.write(reinterpret_cast<const char*>(X.values.data()),
            X.values.size() * static_cast<std::streamsize>(sizeof(double)));
}

Features read_vectors(const std::string& folder, int landmarks) {
  Features X{.values = Eigen::MatrixXd(landmarks, 2 * kSteps), .observed = {}};
  std::ifstream in(vectors_file(folder, landmarks), std::ios::binary);
  in.read(reinterpret_cast<char*>(X.values.data()),
          X.values.size() * static_cast<std::streamsize>(sizeof(double)));
  return X;
}

MethodSetting setting_of(const std::string& what) {
  const MethodInfo& method = info(method_named(what).value());
  if (!method.parameter) return {method.method, std::nullopt};
  if (method.parameter->counts_neighbours) return {method.method, kNeighbours};
  return {method.method, method.method == Method::kKpcaGaussian ? kVariance : 2.0};
}

/// The work once; how many iterations it took.
int work(const Features& X, const std::string& what) {
  if (what == "lpca" && is_faster_by_vectors(X.values.rows(), X.values.cols())) {
    lpca_of_vectors(X.values);
    return 0;
  }
  Proximities data = proximities(X, Sensor::kBearing);
  if (what == "gram") return 0;
  return Embedder(std::move(data)).embed(setting_of(what)).iterations;
}

void run(const std::string& folder, int landmarks, const std::string& what) {
  const Features X = read_vectors(folder, landmarks);
  double best = std::numeric_limits<double>::infinity();
  double total = 0.0;
  int iterations = 0;
  for (int round = 0; round < 3 || (total < 0.3 && round < 100); ++round) {
    const std::clock_t start = std::clock();
    iterations = work(X, what);
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    best = std::min(best, seconds);
    total += seconds;
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  fmt::print("{} {} mapproof {:.6f} {:.0f} {}\n", landmarks, what, best,
             static_cast<double>(usage.ru_maxrss) / 1024.0, iterations);
}

}  // namespace
}  // namespace mapproof

int main(int argc, char** argv) {
  if (argc == 4 && std::strcmp(argv[1], "write") == 0) {
    mapproof::write_vectors(argv[2], std::stoi(argv[3]));
  } else if (argc == 6 && std::strcmp(argv[1], "csv") == 0) {
    mapproof::write_csv(argv[2], std::stoi(argv[3]), std::stoi(argv[4]),
                        std::strcmp(argv[5], "transposed") == 0);
  } else if (argc == 5 && std::strcmp(argv[1], "run") == 0) {
    mapproof::run(argv[2], std::stoi(argv[3]), argv[4]);
  } else {
    return 2;
  }
}
