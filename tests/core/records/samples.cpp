#include "tests/core/records/samples.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/records/experiments/experiment_json.hpp"

namespace mapproof::test {

namespace fs = std::filesystem;

fs::path data_file(std::string_view name) { return fs::path(MAPPROOF_TEST_DATA) / name; }

std::string error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const IoError& error) {
    return error.what();
  }
  return "no error";
}

std::string contents(const fs::path& folder) {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && entry.path().filename() != "timings.jsonl")
      paths.push_back(entry.path());
  std::ranges::sort(paths);
  std::string all;
  for (const fs::path& path : paths)
    all += "== " + path.lexically_relative(folder).string() + "\n" + read_file(path);
  return all;
}

Experiment small_experiment() {
  const fs::path path = data_file("experiments/small.json");
  return parse_experiment(read_file(path), path.string());
}

Provenance made_up_provenance(const std::string& solver_digest) {
  return {.version = "0.1.0",
          .commit = "unknown",
          .solver_digest = solver_digest,
          .libraries = {{"Eigen", "3.4.0"}, {"a library before it in the alphabet", "1"}}};
}

RunDetails made_up_details(const RunId& id) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  RunDetails details{
      .id = id, .path = {.positions_m = Points(3, 2), .headings_rad = {}}, .sensors = {}};
  details.path.positions_m << 0.5, 0.25, 0.75, 0.25, 0.75, 0.5;
  details.path.headings_rad = Eigen::Vector3d(0.0, 0.1, -3.0);
  SensorDetails sensor{.scan_step = 2,
                       .reach_m = 0.55,
                       .views = {View::kVisible, View::kHidden, View::kOutOfReach, View::kVisible},
                       .values = Eigen::Vector4d(1.0, 0.0, nan, 1.0),
                       .first_steps = Eigen::MatrixXd::Identity(4, 3),
                       .step = 3,
                       .distances = Eigen::VectorXd::LinSpaced(6, 0.1, 0.9),
                       .manifold = {},
                       .spectra = {}};
  sensor.distances(2) = nan;
  sensor.spectra = {{{Method::kLpca, std::nullopt}, Eigen::Vector3d(3.0, 2.0, 1e-9)},
                    {{Method::kIsomap, 5.0}, Eigen::Vector2d(3.0, -2.0)}};
  details.sensors = {sensor};
  return details;
}

namespace {

/// Numbers that differ from run to run.
double number_of(const RunId& id) { return id.layout + id.pose / 8.0; }

Run made_up_run(const RunId& id, const Score& score) {
  const double x = number_of(id);
  Run run;
  run.id = id;
  run.world = {.side_m = 1.5, .landmark_diameter_m = 0.048, .landmarks_m = Points(4, 2)};
  run.world.landmarks_m << 0.1, 0.2, 1.25, x / 10.0, 1.0 / 3.0, 0.9, 1.1, 1.3;
  run.anchors = {0, 1, 3};
  run.records = {{.sensor = Sensor::kVisibility,
                  .setting = {Method::kLpca, std::nullopt},
                  .step = 50,
                  .statuses = {},
                  .score = score,
                  .iterations = 0,
                  .stress = std::nullopt,
                  .certificate = std::nullopt},
                 {.sensor = Sensor::kRange,
                  .setting = {Method::kSmacofKnn, 4.0},
                  .step = 100,
                  .statuses = {status_with_message(StatusCode::kFailed, "No map: \"made up\".")},
                  .score = std::nullopt,
                  .iterations = 17,
                  .stress = 0.1 * x,
                  .certificate = Certificate{.solver = SdpSolver::kCsdp,
                                             .primal = 3.0 - 1e-7,
                                             .dual = -3.0,
                                             .relative_gap = 2.0,
                                             .constraint_residual = 1e-9}}};
  run.occlusion = {.within_reach = 90, .hidden = 20};
  run.variations = {{.variation = "noise",
                     .level = 0.125,
                     .setting = {Method::kSmacofKnn, 4.0},
                     .statuses = {},
                     .score = score},
                    {.variation = "noise",
                     .level = 0.25,
                     .setting = {Method::kLpca, std::nullopt},
                     .statuses = {{.code = StatusCode::kFailed,
                                   .reason = StatusReason::kTooManyNeighbours,
                                   .values = {4, 3},
                                   .starts = {Method::kSmacof},
                                   .submaps = SubmapCount{.count = 1, .submaps = 2}}},
                     .score = std::nullopt}};
  return run;
}

/// A map with a landmark that has no position.
MapRecord made_up_map(const Run& run, const Score& score) {
  MapRecord map;
  map.id = slug(run.id) + "/visibility/lpca/50";
  map.step = 50;
  map.names = {"L1", "L2", "L3", "L4"};
  map.estimate = run.world.landmarks_m;
  map.estimate.row(2).setConstant(std::numeric_limits<double>::quiet_NaN());
  map.ground_truth_m = run.world.landmarks_m;
  map.anchors = run.anchors;
  map.score = score;
  return map;
}

}  // namespace

RunResult made_up_result(const RunId& id) {
  const double x = number_of(id);
  const Score score{.mpe_m = x / 7.0,
                    .moe_percent = 60.0,
                    .mpe_all_fitted_m = x / 9.0,
                    .moe_unmirrored_percent = 40.0};
  RunResult result;
  result.run = made_up_run(id, score);
  result.details = made_up_details(id);
  result.maps = {made_up_map(result.run, score)};
  result.timings = {{.run = id,
                     .sensor = Sensor::kRange,
                     .setting = {Method::kSmacofKnn, 4.0},
                     .step = 100,
                     .seconds = 0.25},
                    {.run = id,
                     .sensor = Sensor::kVisibility,
                     .setting = {Method::kLpca, std::nullopt},
                     .step = 50,
                     .seconds = 0.5}};
  return result;
}

Session made_up_session() {
  return {.command = "mapproof run \"an experiment.json\"",
          .started_utc = "2026-01-02T03:04:05Z",
          .host = "here",
          .jobs = 2,
          .seconds = 1.5,
          .peak_memory_mib = {}};
}

}  // namespace mapproof::test
