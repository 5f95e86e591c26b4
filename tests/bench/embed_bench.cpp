// Seconds of each mapping method, from the matrix of observation vectors to the map.
//   mapproof_embed_bench write FOLDER M     N = 2000 bearings of M simulated landmarks, as vectors
//   mapproof_embed_bench run FOLDER M WHAT  a line "M WHAT mapproof SECONDS PEAK_MIB ITERATIONS"
// WHAT is a method, or "gram": the products and distances alone, which every method begins with.
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "core/base/random.hpp"
#include "core/embed/embedder.hpp"
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

void write_vectors(const std::string& folder, int landmarks) {
  Random random(static_cast<std::uint64_t>(landmarks));
  WorldOptions room;
  room.landmarks = landmarks;
  room.side_m = 2.5 * std::sqrt(landmarks / 50.0);
  const World world = scatter_landmarks(room, random);
  const Path path = random_walk(world, {}, kSteps, random);
  const Features X = features(observe(world, path, {.sensor = Sensor::kBearing}, random), kSteps);
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
  Proximities data = proximities(X, Sensor::kBearing);
  if (what == "gram") return 0;
  return Embedder(std::move(data)).embed(setting_of(what)).iterations;
}

void run(const std::string& folder, int landmarks, const std::string& what) {
  using Clock = std::chrono::steady_clock;
  const Features X = read_vectors(folder, landmarks);
  double best = std::numeric_limits<double>::infinity();
  double total = 0.0;
  int iterations = 0;
  for (int round = 0; round < 3 || (total < 0.3 && round < 100); ++round) {
    const Clock::time_point start = Clock::now();
    iterations = work(X, what);
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
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
  } else if (argc == 5 && std::strcmp(argv[1], "run") == 0) {
    mapproof::run(argv[2], std::stoi(argv[3]), argv[4]);
  } else {
    return 2;
  }
}
