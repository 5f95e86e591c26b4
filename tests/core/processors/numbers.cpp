#include "tests/core/processors/numbers.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/base/files/files.hpp"
#include "core/base/not_finite.hpp"
#include "core/embed/embedder.hpp"
#include "core/embed/sde/sde.hpp"
#include "core/experiment/run.hpp"
#include "core/experiment/slam_run.hpp"
#include "core/records/observations/observations.hpp"
#include "tests/core/range_slam/slam_worlds.hpp"
#include "tests/support/samples/worlds.hpp"
#include "tests/support/slam_checks.hpp"

namespace mapproof::test {
namespace {

std::vector<double> values_of(const Eigen::MatrixXd& matrix) {
  return {matrix.data(), matrix.data() + matrix.size()};
}

/// Whether the eigenvectors are those of eigenvalues that no other equals: HLLE needs two at 0.
bool is_determined(Method method, const Embedding& map) {
  constexpr double kRounding = 1e-9;
  return method != Method::kHessianLle || map.spectrum.size() < 3 ||
         map.spectrum(2) > kRounding * map.spectrum(map.spectrum.size() - 1);
}

void add_simulated_run(Numbers& numbers) {
  const RunResult result = simulate_run(small_experiment(), {.layout = 1, .pose = 1});
  numbers["run/landmarks"] = values_of(result.run.world.landmarks_m);
  for (const MapRecord& map : result.maps) {
    if (setting_of(map)->method == Method::kLaplacianEigenmap) continue;  // Landmarks coincide.
    numbers["run/map/" + map.id] = values_of(map.estimate);
    if (map.score)
      numbers["run/score/" + map.id] = {map.score->mpe_m, map.score->moe_percent,
                                        map.score->mpe_all_fitted_m};
  }
}

void add_maps(Numbers& numbers) {
  for (const auto& [log, sensor] :
       {std::pair("visibility-1", Sensor::kVisibility), std::pair("bearing-1", Sensor::kBearing),
        std::pair("range-1", Sensor::kRange), std::pair("noise-1", Sensor::kRange)}) {
    const std::string file = log + ("." + std::string(name(sensor))) + ".csv";
    const ObservationHistory history =
        read_observations(std::filesystem::path(MAPPROOF_TEST_DATA) / "reference" / file, sensor)
            .history;
    HistoryEmbedder embedder(history, history.steps());
    for (const MethodInfo& method : all_methods()) {
      const MethodSetting setting = embedder.usual_setting(method.method);
      const Embedding map = embedder.embed(setting);
      const std::string id = log + ("/" + slug(setting));
      if (is_determined(setting.method, map)) numbers["map/" + id] = values_of(map.coordinates);
      numbers["spectrum/" + id] = values_of(map.spectrum);
      numbers["stress/" + id] = {map.stress.value_or(kNaN)};
    }
  }
}

void add_semidefinite(Numbers& numbers) {
  const Eigen::MatrixXd D = distances_of(scattered(25, 3));
  for (const SdpSolver solver : {SdpSolver::kCsdp, SdpSolver::kInteriorPoint})
    numbers["sde/" + std::string(name(solver))] =
        values_of(sde(D, {.neighbours = {.neighbours = 6}, .solver = solver}).coordinates);
}

void add_range_slam(Numbers& numbers) {
  const RangeLog log = slam_world(3, {.steps = 400,
                                      .landmarks = 8,
                                      .range_sigma_m = 0.1,
                                      .distance_sigma_m = 0.01,
                                      .heading_change_sigma_rad = 0.005,
                                      .range_scale = 1.05});
  SlamRunOptions options{.methods = {}, .known = all_known(log), .random_starts = 2};
  for (const SlamMethodInfo& method : all_slam_methods()) options.methods.push_back(method.method);
  for (const SlamRecord& record : make_slam_run("world", log, options).run.records) {
    const std::string method(info(record.method).name);
    numbers["slam/path/" + method] = values_of(record.estimate.path.positions_m);
    numbers["slam/landmarks/" + method] = values_of(record.estimate.landmarks_m);
    numbers["slam/singular-values/" + method] = values_of(record.estimate.singular_values);
    for (const TrajectoryError& error : record.errors)
      numbers["slam/error/" + method + "/" + std::string(name(error.alignment))] = {error.mean_m,
                                                                                    error.rmse_m};
  }
}

/// Infinite unless both are numbers or both are not.
double gap(double a, double b) {
  if (std::isnan(a) != std::isnan(b)) return kInfinity;
  return std::isnan(a) || a == b ? 0.0 : std::abs(a - b);
}

double difference(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return kInfinity;
  double largest_gap = 0.0;
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest_gap = std::max(largest_gap, gap(a[i], b[i]));
    for (const double value : {a[i], b[i]})
      if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  }
  return largest_gap == 0.0 ? 0.0 : largest_gap / largest;
}

}  // namespace

double across_processors(const std::string& block) {
  return block.find("sde") == std::string::npos ? 1e-6 : 1e-4;
}

Numbers numbers() {
  Numbers numbers;
  add_simulated_run(numbers);
  add_maps(numbers);
  add_semidefinite(numbers);
  add_range_slam(numbers);
  return numbers;
}

std::string text_of(const Numbers& numbers) { return nlohmann::json(numbers).dump(1) + "\n"; }

Numbers read_numbers(const std::filesystem::path& file) {
  Numbers numbers;
  const nlohmann::json blocks = nlohmann::json::parse(read_file(file));
  for (const auto& [block, values] : blocks.items()) {
    std::vector<double>& numbers_of = numbers[block];  // There, even without a number.
    for (const auto& value : values)
      numbers_of.push_back(value.is_null() ? kNaN : value.get<double>());
  }
  return numbers;
}

std::map<std::string, double> differences(const Numbers& first, const Numbers& second) {
  std::map<std::string, double> found;
  for (const Numbers* side : {&first, &second})
    for (const auto& [block, values] : *side)
      found[block] = first.contains(block) && second.contains(block)
                         ? difference(first.at(block), second.at(block))
                         : kInfinity;
  return found;
}

}  // namespace mapproof::test
