#include "tests/core/records/slam_samples.hpp"

#include "core/base/not_finite.hpp"

namespace mapproof::test {
namespace {

Trajectory short_path(double shift_m, bool has_heading) {
  Trajectory path{
      .time_s = Eigen::Vector3d(0.5, 1.0, 2.25), .positions_m = Points(3, 2), .heading_rad = {}};
  path.positions_m << 0.0 + shift_m, 0.1, 1.0 / 3.0, 0.2, 2.0, -0.3;
  if (has_heading) path.heading_rad = Eigen::Vector3d(0.0, -3.1, 1e-7);
  return path;
}

RangeLog made_up_log() {
  RangeLog log;
  log.name = "A drive \"there\" and back";
  log.landmarks = {"0", "post, left", "2"};
  log.ranges = {{.time_s = 0.5, .landmark = 0, .range_m = 3.25},
                {.time_s = 0.75, .landmark = 2, .range_m = 0.1}};
  log.start = {.time_s = 0.5, .x_m = 1.5, .y_m = -2.0, .heading_rad = 0.1};
  log.odometry = {
      {.time_s = 1.0, .distance_m = 0.4, .heading_change_rad = 0.2, .sideways_m = 0.0},
      {.time_s = 2.25, .distance_m = -0.3, .heading_change_rad = 0.0, .sideways_m = 0.05}};
  log.ground_truth = short_path(0.0, true);
  log.true_landmarks = Points(3, 2);
  *log.true_landmarks << 0.0, 1.0, kNaN, kNaN, 5.0, 5.5;
  log.remarks = {"The stamps jump back once."};
  return log;
}

SlamRecord made_up_record() {
  SlamRecord record{.method = SlamMethod::kRefined, .estimate = {}, .errors = {}, .error_m = {}};
  SlamEstimate& estimate = record.estimate;
  estimate.path = short_path(0.25, true);
  estimate.landmarks_m = Points(3, 2);
  estimate.landmarks_m << 0.1, 1.1, kNaN, kNaN, 5.1, 5.4;
  estimate.range_scale = 1.0625;
  estimate.landmark_cov_m2 = {Eigen::Matrix2d::Identity(), Eigen::Matrix2d::Constant(kNaN),
                              (Eigen::Matrix2d() << 2.0, 0.5, 0.5, 1.0).finished()};
  estimate.position_cov_rows = {0, 2};
  estimate.position_cov_m2 = {Eigen::Matrix2d::Identity(), 0.25 * Eigen::Matrix2d::Identity()};
  estimate.singular_values = Eigen::Vector4d(100.0, 10.0, 1.0, 0.1);
  estimate.noise_level = 0.05;
  estimate.condition = 12.5;
  estimate.iterations = 7;
  estimate.cost = 123.456;
  estimate.statuses = {
      status_with_message(StatusCode::kLandmarkUnseen, "Landmark \"post, left\" has no position.")};
  record.errors = {{.alignment = Alignment::kRigid,
                    .mean_m = 0.2,
                    .rmse_m = 0.25,
                    .last_tenth_m = 0.3,
                    .best_tenth_m = 0.1,
                    .worst_tenth_m = 0.4,
                    .landmarks_m = 0.15}};
  record.error_m = {0.1, 0.2, kNaN};
  return record;
}

Fit made_up_fit() {
  return {.verdict = FitVerdict::kDoesNotFit,
          .causes = {{.code = FitCode::kIdsExchanged,
                      .landmarks = {"0", "2"},
                      .values = {{.id = "from_s", .value = 1.0},
                                 {.id = "offset_m", .value = 0.5, .sigma = 0.25}},
                      .statistic = 100.0,
                      .bound = 22.0,
                      .figure = "fit-drive"}},
          .parts = {{"0", "2"}, {"post, left"}},
          .numbers = {{"fit_chi2_ratio", 1.5, 1.25}, {"fit_range_sigma_m", 0.5}},
          .tests = {{.code = FitCode::kCommonOffset,
                     .statistic = 0.5,
                     .bound = 20.0,
                     .limit = FitValue{.id = "offset_m", .value = 0.75}}}};
}

MeanEstimate some_mean(double mean) {
  return {.mean = mean, .values = 20, .clusters = 20, .half_width = 0.1 * mean};
}

}  // namespace

SlamRun made_up_slam_run(const std::string& id) {
  SlamRun run;
  run.id = id;
  run.figure = "fig-2b";
  run.log = made_up_log();
  run.known = {0, 2};
  run.windows =
      WindowCurve{.lengths_s = {60.0, 120.0}, .held_out_m = {kNaN, 0.75}, .chosen_s = 120.0};
  run.records = {made_up_record()};
  SlamRecord failed{.method = SlamMethod::kEkf, .estimate = {}, .errors = {}, .error_m = {}};
  failed.estimate.path.positions_m.resize(0, 2);
  failed.estimate.landmarks_m = Points::Constant(3, 2, kNaN);
  failed.estimate.statuses = {status_with_message(StatusCode::kFailed, "It is lost.")};
  run.records.push_back(failed);
  run.fit = made_up_fit();
  run.starts = {{.method = SlamMethod::kRefinedFromRandom,
                 .number = 2,
                 .cost = kNaN,
                 .mean_m = std::nullopt,
                 .iterations = 3,
                 .converged = false}};
  run.published = PublishedDrive{.length_km = 1.9, .poses = 9658, .measurements = 3529};
  run.upgrade.emplace();
  run.upgrade->steps = {0, 2};
  run.upgrade->before = {SpacePoints::Constant(2, 3, 1.0 / 7.0), Eigen::Matrix4d::Identity()};
  run.upgrade->after = {SpacePoints::Constant(2, 3, -2.5), Eigen::Matrix4d::Constant(0.1)};
  return run;
}

ConvergenceCurve made_up_convergence(const std::string& id) {
  ConvergenceCurve curve{
      .id = id, .title = "white noise", .landmarks = 6, .points = {}, .slope = -0.5};
  for (const int steps : {50, 100})
    curve.points.push_back({.steps = steps,
                            .observation = some_mean(10.0 / steps),
                            .landmarks_m = some_mean(1.0 / steps),
                            .positions_m = some_mean(0.2),
                            .sine = some_mean(0.1 / steps),
                            .bound = 1.0 / steps});
  return curve;
}

RangeHistoryStudy made_up_histories() {
  RangeHistoryStudy study{.landmarks_m = Points::Identity(4, 2), .steps = 10, .maps = {}};
  study.maps.push_back({.setting = MethodSetting{Method::kIsomap, 3.0},
                        .squared = true,
                        .positions_m = Points::Constant(4, 2, 0.5),
                        .statuses = {status_with_message(StatusCode::kBridged, "In two pieces.")},
                        .score = Score{.mpe_m = kNaN,
                                       .moe_percent = kNaN,
                                       .mpe_all_fitted_m = 0.25,
                                       .moe_unmirrored_percent = 1.5}});
  study.maps.push_back({.setting = std::nullopt,
                        .squared = true,
                        .positions_m = Points::Constant(4, 2, kNaN),
                        .statuses = {},
                        .score = std::nullopt});
  return study;
}

SpaceRun made_up_space_run() {
  SpaceRun run{.landmarks_m = SpacePoints::Constant(5, 3, 0.1),
               .positions_m = SpacePoints::Constant(2, 3, 1.0 / 3.0),
               .known = {0, 2},
               .noise = "white noise",
               .records = {}};
  SpaceRecord record{.knows_landmarks = true,
                     .estimate = {},
                     .alignment = Alignment::kNone,
                     .landmarks_error_m = 0.25,
                     .positions_error_m = 0.5};
  record.estimate.landmarks_m = run.landmarks_m;
  record.estimate.landmarks_m.row(1).setConstant(kNaN);
  record.estimate.positions_m = run.positions_m;
  record.estimate.singular_values = Eigen::Vector3d(5.0, 1.5, 1e-7);
  record.estimate.noise_level = 0.01;
  run.records.push_back(record);
  record.knows_landmarks = false;
  record.alignment = Alignment::kRigidWithReflection;
  record.estimate.landmarks_m.setConstant(kNaN);
  record.estimate.positions_m.resize(0, 3);
  record.estimate.statuses = {
      status_with_message(StatusCode::kDegenerateGeometry, "All in a plane.")};
  record.landmarks_error_m = record.positions_error_m = std::nullopt;
  run.records.push_back(record);
  return run;
}

SlamExperiment small_slam_experiment() {
  SlamExperiment experiment;
  experiment.name = "small";
  experiment.title = "A small one";
  experiment.seed = 7;
  const RangeNoiseModel noise{.id = "white", .title = "white noise", .noise_m = 0.0, .share = 0.01};
  RangeNoiseModel example = noise;
  example.id = "simulation";
  experiment.example = SlamExample{.figure = "fig-1a", .steps = 60, .noise = example};
  experiment.convergence = ConvergenceOptions{.pairs = 6, .steps = {20, 40}, .noises = {noise}};
  experiment.data = {{.id = "drive",
                      .title = "A drive",
                      .figure = "fig-2b",
                      .files = {"drive", "drive.mat"},
                      .source = "Ask for it.",
                      .published = std::nullopt}};
  experiment.methods = {SlamMethod::kDeadReckoning, SlamMethod::kSpectral};
  experiment.random_starts = 1;
  experiment.histories = RangeHistoryOptions{.landmarks = 8,
                                             .steps = 40,
                                             .noise = noise,
                                             .neighbours = 4,
                                             .methods = {Method::kLpca, Method::kIsomap}};
  experiment.space = SpaceFlightOptions{.landmarks = 8, .steps = 40, .noise = noise};
  experiment.factorization = {.landmarks = {4, 6}, .steps = {20}};
  return experiment;
}

}  // namespace mapproof::test
