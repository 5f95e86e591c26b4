#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "core/base/random.hpp"
#include "core/model/method.hpp"
#include "tests/support/samples/drawn_points.hpp"
#include "tests/support/samples/sample_scenes.hpp"
#include "tests/support/samples/sample_slam.hpp"

namespace mapproof::test {
namespace {

using Eigen::Index;

/// Lanes of 60 m, 5 m apart, forth and back, at constant speed.
Trajectory lanes(int poses) {
  constexpr double kLane_m = 60.0, kApart_m = 5.0, kLanes = 11.0;
  Trajectory path;
  path.time_s = Eigen::VectorXd::LinSpaced(poses, 0.0, 0.5 * (poses - 1));
  path.positions_m.resize(poses, 2);
  path.heading_rad = Eigen::VectorXd::Zero(poses);
  for (Index i = 0; i < poses; ++i) {
    const double along = kLanes * (kLane_m + kApart_m) * static_cast<double>(i) / poses;
    const double lane = std::floor(along / (kLane_m + kApart_m));
    const double rest = along - lane * (kLane_m + kApart_m);
    const bool back = static_cast<int>(lane) % 2 == 1;
    const double x = std::min(rest, kLane_m);
    path.positions_m.row(i) << (back ? kLane_m - x : x),
        kApart_m * lane + std::max(rest - kLane_m, 0.0);
  }
  return path;
}

/// Slow waves of different lengths: an error that a smooth estimate makes.
Eigen::RowVector2d wave(double share, double phase) {
  const double turn = 2.0 * std::numbers::pi * share;
  return {std::sin(7.0 * turn + phase) + 0.5 * std::sin(31.0 * turn + 2.0 * phase),
          std::cos(9.0 * turn + phase) + 0.5 * std::cos(41.0 * turn)};
}

TrajectoryError error_of(const std::vector<double>& error_m, Alignment alignment,
                         double landmarks_m) {
  double sum = 0.0, squares = 0.0;
  for (const double e : error_m) sum += e, squares += e * e;
  const auto n = static_cast<double>(error_m.size());
  TrajectoryError error;
  error.alignment = alignment;
  error.mean_m = sum / n;
  error.rmse_m = std::sqrt(squares / n);
  error.last_tenth_m = 1.1 * error.mean_m;
  error.best_tenth_m = 0.5 * error.mean_m;
  error.worst_tenth_m = 2.0 * error.mean_m;
  error.landmarks_m = landmarks_m;
  return error;
}

/// The ground truth with an error of `wave_m` and a turning drift of `drift_m` at the end.
SlamRecord record_of(const RangeLog& log, SlamMethod method, double wave_m, double drift_m) {
  SlamRecord record;
  record.method = method;
  SlamEstimate& estimate = record.estimate;
  estimate.path = *log.ground_truth;
  const Index size = estimate.path.size();
  for (Index i = 0; i < size; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(size);
    const Eigen::RowVector2d off =
        wave_m * wave(share, drift_m) + drift_m * share * Eigen::RowVector2d(share, -0.7);
    estimate.path.positions_m.row(i) += off;
    record.error_m.push_back(off.norm());
  }
  if (method != SlamMethod::kDeadReckoning) {
    estimate.landmarks_m = *log.true_landmarks;
    estimate.landmarks_m.array() += 0.4 * wave_m;
  }
  record.errors = {error_of(record.error_m, info(method).alignment, 0.4 * wave_m * std::sqrt(2.0))};
  return record;
}

void add_covariances(SlamRecord& record, double sigma_m) {
  SlamEstimate& estimate = record.estimate;
  for (Index i = 0; i < estimate.landmarks_m.rows(); ++i) {
    Eigen::Matrix2d C;
    C << 1.0, 0.6, 0.6, 0.7 + 0.3 * static_cast<double>(i);
    estimate.landmark_cov_m2.push_back(sigma_m * sigma_m * C);
  }
  for (Index row = 0; row < estimate.path.size();
       row += std::max<Index>(estimate.path.size() / 60, 1)) {
    estimate.position_cov_rows.push_back(row);
    estimate.position_cov_m2.push_back(4.0 * sigma_m * sigma_m * Eigen::Matrix2d::Identity());
  }
}

std::vector<RefinementStart> sample_starts() {
  std::vector<RefinementStart> starts = {
      {SlamMethod::kRefined, 1, 812.4, 0.19, 14, true},
      {SlamMethod::kRefinedFromOdometry, 1, 812.4, 0.19, 41, true}};
  for (int i = 1; i <= 12; ++i) {
    const bool lost = i == 7;
    starts.push_back({SlamMethod::kRefinedFromRandom, i, lost ? 9150.0 : 812.4 + 0.001 * i,
                      lost ? 21.3 : 0.19, 60 + 3 * i, !lost});
  }
  return starts;
}

}  // namespace

SlamRun sample_drive(const std::string& id, int poses, std::uint64_t seed) {
  Random random(seed);
  SlamRun run;
  run.id = id;
  run.log.name = id == "plaza-1" ? "Plaza 1" : "Plaza 2";
  run.log.landmarks = {"1", "5", "6", "10"};
  run.log.true_landmarks = Points(4, 2);
  *run.log.true_landmarks << -5.0, -4.0, 66.0, 3.0, 62.0, 57.0, 4.0, 61.0;
  run.log.ground_truth = lanes(poses);
  for (int i = 0; i < 4 * poses / 10; ++i)
    run.log.ranges.push_back({i * 1.0, i % 4, 20.0 + random.uniform(0.0, 40.0)});
  run.log.remarks = {
      "Heading increments of the table DR are the ground truth\u2019s: odometry was recovered "
      "from DRp."};
  run.known = {0, 1, 2, 3};
  run.windows = WindowCurve{{240.0, 170.0, 120.0, 85.0, 60.0, 42.0, 30.0},
                            {0.66, 0.61, 0.58, 0.63, 0.9, 2.4, NAN},
                            120.0};
  const auto add = [&](SlamMethod method, double wave_m, double drift_m) {
    run.records.push_back(record_of(run.log, method, wave_m, drift_m));
  };
  add(SlamMethod::kDeadReckoning, 0.1, 20.0);
  add(SlamMethod::kEkf, 0.8, 0.5);
  add(SlamMethod::kSpectralKnown, 0.6, 0.2);
  add(SlamMethod::kSpectral, 0.4, 0.1);
  add(SlamMethod::kBatchFixedScale, 0.9, 0.1);
  add(SlamMethod::kRefined, 0.12, 0.0);
  SlamRecord& spectral = run.records[3];
  spectral.errors.push_back(spectral.errors.front());
  spectral.errors.back().alignment = Alignment::kSimilarity;
  spectral.errors.back().mean_m *= 0.9;
  spectral.estimate.singular_values = Eigen::Vector4d(9.1e5, 4.2e4, 2.9e4, 1.1e3);
  spectral.estimate.noise_level = 140.0;
  add_covariances(spectral, 0.15);
  run.records[5].estimate.range_scale = 1.066;
  run.records[5].estimate.cost = 812.4;
  add_covariances(run.records[5], 0.05);
  run.records[1].estimate.statuses = {
      status_with_message(StatusCode::kNotConverged, "14 of 3529 ranges were gated out.")};
  run.starts = sample_starts();
  run.published = PublishedDrive{1.9, 9658, 3529};
  return run;
}

SlamRun sample_walk() {
  Random random(11);
  SlamRun run;
  run.id = "simulation";
  run.figure = "fig-1a";
  run.simulated = true;
  run.log.name = "Simulation";
  run.log.true_landmarks = Points(6, 2);
  for (int i = 0; i < 6; ++i) {
    run.log.landmarks.push_back(fmt::format("{}", i + 1));
    run.log.true_landmarks->row(i) << random.uniform(-10.0, 10.0), random.uniform(-10.0, 10.0);
  }
  run.known = {0, 1, 2, 3};
  Trajectory path;
  path.time_s = Eigen::VectorXd::LinSpaced(500, 0.0, 499.0);
  path.positions_m.resize(500, 2);
  Eigen::RowVector2d at(0.0, 0.0);
  double heading = 0.3;
  for (Index i = 0; i < 500; ++i) {
    path.positions_m.row(i) = at;
    heading += 0.5 * random.normal();
    const Eigen::RowVector2d next =
        at + 1.0 * Eigen::RowVector2d(std::cos(heading), std::sin(heading));
    if (next.cwiseAbs().maxCoeff() > 10.0)
      heading += std::numbers::pi / 2.0;
    else
      at = next;
  }
  run.log.ground_truth = path;
  for (int i = 0; i < 3000; ++i) run.log.ranges.push_back({std::floor(i / 6.0), i % 6, 10.0});
  run.records = {record_of(run.log, SlamMethod::kSpectralKnown, 0.02, 0.0),
                 record_of(run.log, SlamMethod::kSpectral, 0.05, 0.0)};
  run.records[1].estimate.singular_values.resize(6);
  run.records[1].estimate.singular_values << 5.4e3, 1.3e3, 9.8e2, 3.1e2, 14.0, 11.0;
  return run;
}

ConvergenceCurve sample_convergence(const std::string& id, const std::string& title, double level) {
  ConvergenceCurve curve{.id = id, .title = title, .landmarks = 6, .points = {}, .slope = -0.5};
  const auto estimate = [](double mean, double share) {
    return MeanEstimate{mean, 1000, 1000, share * mean};
  };
  for (const int steps : {50, 100, 200, 500, 1000, 2000, 5000}) {
    const double root = std::sqrt(100.0 / steps);
    ConvergencePoint point;
    point.steps = steps;
    point.observation = estimate(2.1 * level * root, 0.06);
    point.landmarks_m = estimate(0.2 * level * root, 0.09);
    point.positions_m = estimate(0.15 * level + 0.1 * root * level, 0.03);
    point.sine = estimate(0.004 * level * root, 0.05);
    point.bound = 0.0057 * level * root * std::sqrt(std::log(steps) / std::log(50.0));
    curve.points.push_back(point);
  }
  return curve;
}

std::vector<FactorizationCost> sample_factorization() {
  std::vector<FactorizationCost> costs;
  for (const int landmarks : {10, 30, 100, 300})
    for (const long steps : {1000L, 10000L, 100000L})
      costs.push_back({landmarks, steps,
                       2e-10 * 4.0 * landmarks * landmarks * static_cast<double>(steps) + 2e-5});
  return costs;
}

RangeHistoryStudy sample_histories() {
  Random random(5);
  RangeHistoryStudy study;
  study.steps = 500;
  study.landmarks_m.resize(30, 2);
  for (Index i = 0; i < 30; ++i)
    study.landmarks_m.row(i) << random.uniform(-10.0, 10.0), random.uniform(-10.0, 10.0);
  const auto add = [&](std::optional<MethodSetting> setting, bool squared, double error_m) {
    RangeHistoryMap map{.setting = setting,
                        .squared = squared,
                        .positions_m = study.landmarks_m,
                        .statuses = {},
                        .score = {}};
    for (Index i = 0; i < 30; ++i)
      map.positions_m.row(i) += error_m * normal_point(random);
    map.score = Score{1.25 * error_m, 4.0 * error_m, 1.25 * error_m, 4.0 * error_m};
    study.maps.push_back(map);
  };
  for (const bool squared : {false, true})
    for (const MethodInfo& method : all_methods())
      if (!method.approximates)
      add(MethodSetting{method.method, method.parameter ? std::optional(6.0) : std::nullopt},
          squared, (squared ? 0.2 : 0.5) + 0.1 * static_cast<double>(method.method));
  study.maps[8].positions_m.setConstant(NAN);
  study.maps[8].score.reset();
  study.maps[8].statuses = {
      status_with_message(StatusCode::kFailed, "No map: the graph has no edges.")};
  add(std::nullopt, true, 0.004);
  return study;
}

SlamTimings sample_slam_timings() {
  SlamTimings timings;
  timings.methods = {{"plaza-1", SlamMethod::kSpectral, 0.041},
                     {"plaza-1", SlamMethod::kRefined, 0.73},
                     {"plaza-2", SlamMethod::kSpectral, 0.022}};
  timings.factorization = sample_factorization();
  return timings;
}

SlamStudy sample_slam_study() {
  SlamStudy study;
  study.experiment.name = "boots2013";
  study.experiment.title = "Range-only SLAM by factorisation";
  study.experiment.seed = 2013;
  study.provenance = {"0.1.0", "abc", "0123", {{"Eigen", "3.4.0"}}};
  study.runs = {sample_walk(), sample_drive("plaza-1", 2000, 1), sample_drive("plaza-2", 1500, 2)};
  study.runs[1].figure = "fig-2b";
  study.runs[2].figure = "fig-2c";
  study.convergence = {sample_convergence("white", "white noise, 1 % of range", 1.0),
                       sample_convergence("correlated", "correlated noise, .9 a step", 2.6)};
  study.histories = sample_histories();
  study.runs[0].upgrade = sample_clouds(0.5);
  study.space = sample_space_run();
  return study;
}

}  // namespace mapproof::test
