// mapproof_range_bench WHAT ...: seconds of the range-only methods, a line each.
//   plaza FOLDER OUT EXPERIMENT.json  on each data set there; its squared ranges go to OUT for
//   numpy pairs EXPERIMENT.json             errors of all simulated worlds of the first noise model
//   stream LANDMARKS STEPS            a map of columns that are forgotten
#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <limits>

#include <fmt/format.h>

#include "core/base/files/files.hpp"
#include "core/base/random.hpp"
#include "core/experiment/slam_worlds.hpp"
#include "core/range_slam/dead_reckoning.hpp"
#include "core/range_slam/factors/incremental_spectral_map.hpp"
#include "core/range_slam/factors/spectral_slam.hpp"
#include "core/range_slam/refinement/refine.hpp"
#include "core/records/experiments/slam_experiment_json.hpp"
#include "core/studies/ranges.hpp"

namespace mapproof {
namespace {

using Clock = std::chrono::steady_clock;

/// The least of several tries.
double seconds(int tries, const std::function<void()>& work) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < tries; ++i) {
    const Clock::time_point start = Clock::now();
    work();
    least = std::min(least, std::chrono::duration<double>(Clock::now() - start).count());
  }
  return least;
}

void print(const std::string& what, double value_s) {
  fmt::print("{:<58} {:>10.4f} s\n", what, value_s);
  std::fflush(stdout);
}

SlamExperiment experiment_of(const std::string& file) {
  return parse_slam_experiment(read_file(file), file);
}

/// Rows and columns as int64, then the entries column by column.
void write_matrix(const Eigen::MatrixXd& matrix, const std::filesystem::path& path) {
  std::string bytes(
      2 * sizeof(std::int64_t) + sizeof(double) * static_cast<std::size_t>(matrix.size()), '\0');
  const std::int64_t sizes[] = {matrix.rows(), matrix.cols()};
  std::copy_n(reinterpret_cast<const char*>(sizes), sizeof sizes, bytes.begin());
  std::copy_n(reinterpret_cast<const char*>(matrix.data()), bytes.size() - sizeof sizes,
              bytes.begin() + sizeof sizes);
  write_file(path, bytes);
}

void bench_set(const RangeLog& log, const std::string& id, const std::filesystem::path& out) {
  const auto landmarks = static_cast<Eigen::Index>(log.landmarks.size());
  const Trajectory path = dead_reckoned(log);
  const std::vector<LandmarkRanges> measurements = ranges_by_landmark(log.ranges, landmarks, path);
  WindowSearch search;
  print(id + ": choice of windows",
        seconds(1, [&] { search = choose_window(measurements, path, path.time_s); }));
  const WindowOptions window = search.options;
  WindowedRanges ranges;
  print(id + ": interpolation",
        seconds(5, [&] { ranges = windowed_ranges(measurements, path, path.time_s, window); }));
  Factorization factors;
  print(id + ": SVD", seconds(5, [&] { factors = factorize(ranges.Y, 4); }));
  print(id + ": metric upgrade", seconds(5, [&] { metric_upgrade(factors); }));
  SpectralSlamOptions options;
  options.window = window;
  SpectralSlam found;
  print(id + ": all of these and positions",
        seconds(5, [&] { found = spectral_slam(log, path, options); }));
  SlamEstimate refined;
  print(id + ": refinement",
        seconds(3, [&] { refined = refine(log, found.estimate, RefineOptions{}); }));
  RefineOptions with_covariances;
  with_covariances.covariances = 60;
  print(id + ": refinement with covariances",
        seconds(1, [&] { refined = refine(log, found.estimate, with_covariances); }));
  write_matrix(ranges.Y, out / (id + ".bin"));
}

void bench_plaza(const std::string& folder, const std::string& out, const std::string& file) {
  for (const LogOfSet& item : read_logs(experiment_of(file), folder))
    bench_set(item.log, item.set.id, out);
}

void bench_pairs(const std::string& file) {
  const SlamExperiment experiment = experiment_of(file);
  const ConvergenceOptions& convergence = experiment.convergence.value();
  print(fmt::format("{} worlds of {} steps, errors at {} of them", convergence.pairs,
                    convergence.steps.back(), convergence.steps.size()),
        seconds(1, [&] { make_convergence(experiment, convergence.noises.front()); }));
}

void bench_stream(Eigen::Index landmarks, long steps) {
  Random random(1);
  Eigen::MatrixXd places(2, landmarks);
  for (double& coordinate : places.reshaped()) coordinate = random.uniform(-10.0, 10.0);
  IncrementalSpectralMap stream(landmarks);
  Eigen::Vector2d robot = Eigen::Vector2d::Zero();
  SpectralMap map;
  const double taken = seconds(1, [&] {
    for (long t = 0; t < steps; ++t) {
      robot += Eigen::Vector2d(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)) - 0.01 * robot;
      const Eigen::ArrayXd distance = (places.colwise() - robot).colwise().norm().transpose();
      // One error for a whole step would do for the time; a few make the columns differ.
      const double error = 1.0 + 0.01 * random.normal();
      stream.add(0.5 * (error * distance).square().matrix());
    }
    map = stream.map();
  });
  print(fmt::format("stream of {} landmarks, {} steps, map {}", landmarks, steps,
                    map.empty() ? "none" : "made"),
        taken);
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  fmt::print("{:<58} {:>10.0f} MiB\n", "  peak memory",
             static_cast<double>(usage.ru_maxrss) / 1024.0);
}

int run(const std::vector<std::string>& words) {
  if (words.size() == 4 && words[0] == "plaza") {
    bench_plaza(words[1], words[2], words[3]);
  } else if (words.size() == 2 && words[0] == "pairs") {
    bench_pairs(words[1]);
  } else if (words.size() == 3 && words[0] == "stream") {
    bench_stream(std::stol(words[1]), std::stol(words[2]));
  } else {
    fmt::print(stderr, "see the head of tests/bench/range_bench.cpp\n");
    return 2;
  }
  return 0;
}

}  // namespace
}  // namespace mapproof

int main(int argc, char** argv) { return mapproof::run({argv + 1, argv + argc}); }
