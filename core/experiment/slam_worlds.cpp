#include "core/experiment/slam_worlds.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/align/affine.hpp"
#include "core/align/rigid.hpp"
#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/parallel.hpp"
#include "core/base/random.hpp"
#include "core/base/stopwatch.hpp"
#include "core/embed/embedder.hpp"
#include "core/experiment/seeds.hpp"
#include "core/experiment/slam_run.hpp"
#include "core/linalg/decompositions.hpp"
#include "core/linalg/planarity.hpp"
#include "core/observe/features.hpp"
#include "core/observe/proximities.hpp"
#include "core/range_slam/factors/metric_upgrade.hpp"
#include "core/range_slam/factors/synchronous_slam.hpp"
#include "core/range_slam/known_landmarks.hpp"
#include "core/range_slam/localise.hpp"
#include "core/score/map_score.hpp"
#include "core/simulate/range_world.hpp"

namespace mapproof {

namespace {

Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& A) {
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(A);
  if (qr.rank() < A.cols()) throw InvalidInput("a subspace needs independent columns");
  return leading_columns(qr.householderQ(), A.cols());
}

void check(const TrueRanges& world, Eigen::Index known, std::span<const Eigen::Index> steps) {
  if (world.ranges_m.rows() != world.landmarks_m.rows() ||
      world.ranges_m.cols() != world.positions_m.rows())
    throw InvalidInput("a world needs a range for each landmark and position");
  if (known < 4 || known > world.landmarks_m.rows())
    throw InvalidInput("4 landmarks or more, and no more than there are, must be known");
  for (const Eigen::Index count : steps)
    if (count < 4 || count > world.positions_m.rows())
      throw InvalidInput("a map needs 4 steps or more, and no more than there are");
}

double mean_distance(const Points& found, const Points& expected) {
  return (found - expected).rowwise().norm().mean();
}

RangeLog log_of(const RangeWorld& world) {
  RangeLog log;
  log.name = "Simulation";
  const Eigen::Index T = world.ranges_m.cols();
  for (Eigen::Index n = 0; n < world.ranges_m.rows(); ++n)
    log.landmarks.push_back("L" + std::to_string(n + 1));
  for (Eigen::Index t = 0; t < T; ++t)
    for (Eigen::Index n = 0; n < world.ranges_m.rows(); ++n)
      log.ranges.push_back(
          {.time_s = static_cast<double>(t), .landmark = n, .range_m = world.ranges_m(n, t)});
  log.ground_truth =
      Trajectory{.time_s = Eigen::VectorXd::LinSpaced(T, 0.0, static_cast<double>(T - 1)),
                 .positions_m = world.positions_m,
                 .heading_rad = world.heading_rad};
  log.true_landmarks = world.landmarks_m;
  return log;
}

/// Rows less their means over time, as features() has them.
Eigen::MatrixXd centred(const Eigen::MatrixXd& rows) {
  return rows.colwise() - Eigen::VectorXd(rows.rowwise().mean());
}

/// Aligns a map to the ground truth by all landmarks, and scores it.
void fit_and_score(RangeHistoryMap& map, const Points& coordinates, const Points& ground_truth_m) {
  std::vector<Eigen::Index> all(static_cast<std::size_t>(ground_truth_m.rows()));
  std::iota(all.begin(), all.end(), Eigen::Index{0});
  AlignedMap aligned = align_to_anchors(coordinates, ground_truth_m, all, AffineFit::kLeastSquares);
  map.statuses.insert(map.statuses.end(), aligned.statuses.begin(), aligned.statuses.end());
  map.positions_m = std::move(aligned.positions_m);
  if (aligned.aligned)
    map.score = score_map(map.positions_m, ground_truth_m, {}, AffineFit::kLeastSquares);
}

MethodSetting setting_of(const Embedder& embedder, Method method, int neighbours) {
  if (on_graph(method)) return {method, static_cast<double>(neighbours)};
  return embedder.usual_setting(method);
}

void add_embeddings(const RangeHistoryOptions& options, const Eigen::MatrixXd& rows, bool squared,
                    RangeHistoryStudy& study) {
  Embedder embedder(proximities({.values = centred(rows), .observed = {}}, Sensor::kRange));
  for (const Method method : options.methods) {
    const MethodSetting setting = setting_of(embedder, method, options.neighbours);
    const Embedding embedding = embedder.embed(setting);
    RangeHistoryMap map{.setting = setting,
                        .squared = squared,
                        .positions_m = {},
                        .statuses = embedding.statuses,
                        .score = std::nullopt};
    fit_and_score(map, embedding.coordinates, study.landmarks_m);
    study.maps.push_back(std::move(map));
  }
}

void add_spectral(const Eigen::MatrixXd& Y, RangeHistoryStudy& study) {
  const Factorization factors = factorize(Y, 4);
  const SpectralMap found = metric_upgrade(factors).map;
  RangeHistoryMap map{.setting = std::nullopt,
                      .squared = true,
                      .positions_m = Points::Constant(study.landmarks_m.rows(), 2, kNaN),
                      .statuses = factors.statuses,
                      .score = std::nullopt};
  map.statuses.insert(map.statuses.end(), found.statuses.begin(), found.statuses.end());
  if (!found.empty()) fit_and_score(map, landmarks_of(found.C), study.landmarks_m);
  study.maps.push_back(std::move(map));
}

/// Mean over independent values; NaN if there is none.
MeanEstimate mean_of(const std::vector<double>& values) {
  if (values.empty()) return {.mean = kNaN, .values = 0, .clusters = 0, .half_width = {}};
  std::vector<int> own(values.size());
  std::iota(own.begin(), own.end(), 0);
  return clustered_mean(values, own);
}

/// The mean of one field at one number of steps, pair by pair.
MeanEstimate mean_of(const std::vector<std::vector<ModelError>>& pairs, int steps,
                     double ModelError::*field) {
  std::vector<double> values;
  for (const std::vector<ModelError>& errors : pairs)
    for (const ModelError& error : errors)
      if (error.steps == steps && std::isfinite(error.*field)) values.push_back(error.*field);
  return mean_of(values);
}

/// How eq. 5 falls with the steps [boots2013].
double fall(int steps) { return std::sqrt(std::log(steps) / steps); }

double slope_of(const std::vector<ConvergencePoint>& points) {
  double n = 0.0, sum_x = 0.0, sum_y = 0.0, sum_xx = 0.0, sum_xy = 0.0;
  for (const ConvergencePoint& point : points) {
    const double x = std::log(point.steps);
    const double y = std::log(point.observation.mean);
    if (!std::isfinite(y)) continue;
    n += 1.0;
    sum_x += x;
    sum_y += y;
    sum_xx += x * x;
    sum_xy += x * y;
  }
  return n < 2.0 ? kNaN : (n * sum_xy - sum_x * sum_y) / (n * sum_xx - sum_x * sum_x);
}

/// Of the first world drawn for the pair whose known landmarks serve.
std::vector<ModelError> errors_of_pair(const SlamExperiment& experiment,
                                       const RangeNoiseModel& noise,
                                       const RangeWorldOptions& options, std::uint64_t pair) {
  constexpr std::uint64_t kMostDraws = 100;
  const ConvergenceOptions& convergence = *experiment.convergence;
  const std::vector<Eigen::Index> steps(convergence.steps.begin(), convergence.steps.end());
  std::vector<ModelError> errors;
  for (std::uint64_t draw = 0; draw < kMostDraws; ++draw) {
    RangeWorld world =
        simulate_range_world(options, derive_seed(experiment.seed, {kSlamPair, pair, draw}));
    errors = model_errors(
        {.landmarks_m = std::move(world.landmarks_m),
         .positions_m = std::move(world.positions_m),
         .ranges_m = std::move(world.ranges_m),
         .noise = range_noise(noise)},
        steps, {.known = experiment.world.known, .subtract_variances = !noise.plain_svd});
    if (!errors.empty() && errors.back().condition <= convergence.most_condition) break;
  }
  return errors;
}

double mean_distance(const SpacePoints& a, const SpacePoints& b) {
  return (a - b).rowwise().norm().mean();
}

/// The map of a flight's ranges, aligned to the ground truth where no landmark tied it down.
SpaceRecord record_of(const RangeFlight& flight, const RangeNoise& noise,
                      const std::optional<KnownSpaceLandmarks>& known) {
  SpaceRecord record{.knows_landmarks = known.has_value(),
                     .estimate = space_slam(flight.ranges_m, known, noise),
                     .alignment = known ? Alignment::kNone : Alignment::kRigidWithReflection,
                     .landmarks_error_m = {},
                     .positions_error_m = {}};
  SpaceEstimate& estimate = record.estimate;
  if (estimate.empty()) return record;
  if (!known) {
    const SpaceMotion motion = fit_space_motion(estimate.positions_m, flight.positions_m, true);
    estimate.positions_m = SpacePoints(motion(estimate.positions_m));
    estimate.landmarks_m = SpacePoints(motion(estimate.landmarks_m));
  }
  record.landmarks_error_m = mean_distance(estimate.landmarks_m, flight.landmarks_m);
  record.positions_error_m = mean_distance(estimate.positions_m, flight.positions_m);
  return record;
}

}  // namespace

Eigen::VectorXd canonical_angles(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  if (A.rows() != B.rows() || A.cols() != B.cols() || A.cols() < 1 || A.cols() > A.rows())
    throw InvalidInput("canonical angles need two subspaces of one dimension in one space");
  if (!A.allFinite() || !B.allFinite()) throw InvalidInput("a subspace needs finite columns");
  const Eigen::MatrixXd P = orthonormal(A), Q = orthonormal(B);
  const Eigen::MatrixXd common = P.transpose() * Q;
  const Eigen::VectorXd cosines = Eigen::JacobiSVD<Eigen::MatrixXd>(common).singularValues();
  const Eigen::VectorXd sines =
      Eigen::JacobiSVD<Eigen::MatrixXd>(Eigen::MatrixXd(Q - P * common)).singularValues().reverse();
  Eigen::VectorXd angles(A.cols());
  for (Eigen::Index i = 0; i < angles.size(); ++i)
    angles(i) = cosines(i) > std::numbers::sqrt2 / 2.0 ? std::asin(std::min(1.0, sines(i)))
                                                       : std::acos(std::min(1.0, cosines(i)));
  return angles;
}

double subspace_error_bound(Eigen::Index landmarks, Eigen::Index steps, double noise_constant,
                            double smallest_eigenvalue) {
  if (landmarks < 1 || steps < 2 || !(noise_constant >= 0.0) || !(smallest_eigenvalue > 0.0))
    throw InvalidInput("the bound needs landmarks, two steps, c >= 0 and gamma > 0");
  const double T = static_cast<double>(steps);
  return static_cast<double>(landmarks) * noise_constant * std::sqrt(2.0 * std::log(T) / T) /
         smallest_eigenvalue;
}

std::vector<ModelError> model_errors(const TrueRanges& world, std::span<const Eigen::Index> steps,
                                     const ModelErrorOptions& options) {
  const Eigen::Index known = options.known;
  check(world, known, steps);
  const Eigen::MatrixXd C = landmark_states(world.landmarks_m);
  const Eigen::MatrixXd Y = half_squared_ranges(world.ranges_m, world.noise);
  KnownLandmarks given{.rows = {}, .positions_m = world.landmarks_m.topRows(known)};
  for (Eigen::Index n = 0; n < known; ++n) given.rows.push_back(n);

  std::vector<ModelError> errors;
  for (const Eigen::Index count : steps) {
    const Eigen::MatrixXd first = Y.leftCols(count);
    const Factorization factors =
        options.subtract_variances
            ? factorize_without_noise(first, half_square_variances(first, world.noise), 4)
            : factorize(first, 4);
    const SpectralMap map = map_from_known_landmarks(factors, given);
    if (map.empty()) continue;
    const Points landmarks_m = landmarks_of(map.C);
    if (!(planarity(landmarks_m) > kFlatPlanarity)) continue;
    const Points positions_m = localise(landmarks_m, first);
    errors.push_back({.steps = count,
                      .observation = (map.C - C).norm(),
                      .landmarks_m = mean_distance(landmarks_m, world.landmarks_m),
                      .positions_m = mean_distance(positions_m, world.positions_m.topRows(count)),
                      .condition = map.condition.value(),
                      .sine = std::sin(canonical_angles(factors.U, C).maxCoeff())});
  }
  return errors;
}

RangeWorldOptions range_world_options(const SlamWorldOptions& world, const RangeNoiseModel& noise,
                                      int landmarks, int steps) {
  return {.landmarks = landmarks,
          .steps = steps,
          .half_width_m = world.half_width_m,
          .step_m = world.step_m,
          .heading_change_sigma_rad = world.heading_change_sigma_rad,
          .noise_m = noise.noise_m,
          .noise_share = noise.share,
          .noise_correlation = noise.correlation};
}

RangeNoise range_noise(const RangeNoiseModel& noise) {
  return {.sigma_m = noise.noise_m, .share = noise.share};
}

SlamRun make_example(const SlamExperiment& experiment, std::vector<SlamTiming>& timings) {
  if (!experiment.example) throw InvalidInput("the experiment has no example");
  const SlamExample& example = *experiment.example;
  const RangeWorld world =
      simulate_range_world(range_world_options(experiment.world, example.noise,
                                               experiment.world.landmarks, example.steps),
                           derive_seed(experiment.seed, {kSlamExample}));
  SlamRunOptions options{.methods = {SlamMethod::kSpectralKnown, SlamMethod::kSpectral},
                         .known = KnownLandmarks{.rows = {}, .positions_m = {}},
                         .noise = range_noise(example.noise)};
  for (Eigen::Index n = 0; n < experiment.world.known; ++n) options.known->rows.push_back(n);
  options.known->positions_m = world.landmarks_m.topRows(experiment.world.known);
  SlamRunResult result = make_slam_run(example.noise.id, log_of(world), options);
  result.run.figure = example.figure;
  result.run.simulated = true;
  timings = std::move(result.timings);
  return std::move(result.run);
}

std::vector<FactorizationCost> time_factorization(const SlamExperiment& experiment) {
  constexpr int kTimings = 5;
  std::vector<FactorizationCost> costs;
  RangeNoiseModel noise;
  noise.share = 0.01;
  for (const int landmarks : experiment.factorization.landmarks)
    for (const int steps : experiment.factorization.steps) {
      const RangeWorld world =
          simulate_range_world(range_world_options(experiment.world, noise, landmarks, steps),
                               derive_seed(experiment.seed, {kSlamCost}));
      const Eigen::MatrixXd Y = half_squared_ranges(world.ranges_m);
      double least_s = kInfinity;  // What else runs on the machine only adds to a time.
      for (int i = 0; i < kTimings; ++i) {
        const Stopwatch stopwatch;
        metric_upgrade(factorize(Y, 4));
        least_s = std::min(least_s, stopwatch.seconds());
      }
      costs.push_back({.landmarks = landmarks, .steps = steps, .seconds = least_s});
    }
  return costs;
}

RangeHistoryStudy make_histories(const SlamExperiment& experiment) {
  if (!experiment.histories) throw InvalidInput("the experiment has no range histories");
  const RangeHistoryOptions& options = *experiment.histories;
  const RangeWorld world = simulate_range_world(
      range_world_options(experiment.world, options.noise, options.landmarks, options.steps),
      derive_seed(experiment.seed, {kSlamHistories}));
  RangeHistoryStudy study{.landmarks_m = world.landmarks_m, .steps = options.steps, .maps = {}};
  const Eigen::MatrixXd squares =
      2.0 * half_squared_ranges(world.ranges_m, range_noise(options.noise));
  add_embeddings(options, world.ranges_m, false, study);
  add_embeddings(options, squares, true, study);
  add_spectral(0.5 * squares, study);
  return study;
}

ConvergenceCurve make_convergence(const SlamExperiment& experiment, const RangeNoiseModel& noise) {
  if (!experiment.convergence) throw InvalidInput("the experiment has no convergence");
  const ConvergenceOptions& convergence = *experiment.convergence;
  const RangeWorldOptions options = range_world_options(
      experiment.world, noise, experiment.world.landmarks, convergence.steps.back());

  std::vector<std::vector<ModelError>> pairs(static_cast<std::size_t>(convergence.pairs));
  parallel_for(pairs.size(), [&](std::size_t pair) {
    pairs[pair] = errors_of_pair(experiment, noise, options, pair);
  });

  ConvergenceCurve curve{.id = noise.id,
                         .title = noise.title,
                         .landmarks = experiment.world.landmarks,
                         .points = {},
                         .slope = 0.0};
  for (const int count : convergence.steps) {
    ConvergencePoint point{.steps = count,
                           .observation = mean_of(pairs, count, &ModelError::observation),
                           .landmarks_m = mean_of(pairs, count, &ModelError::landmarks_m),
                           .positions_m = mean_of(pairs, count, &ModelError::positions_m),
                           .sine = mean_of(pairs, count, &ModelError::sine),
                           .bound = 0.0};
    const double first = curve.points.empty() ? point.sine.mean : curve.points.front().sine.mean;
    point.bound = first * fall(count) / fall(convergence.steps.front());
    curve.points.push_back(point);
  }
  curve.slope = slope_of(curve.points);
  return curve;
}

SpaceRun make_space_run(const SlamExperiment& experiment) {
  if (!experiment.space) throw InvalidInput("the experiment has no flight");
  const SpaceFlightOptions& options = *experiment.space;
  const RangeFlight flight =
      simulate_range_flight({.landmarks = options.landmarks,
                             .steps = options.steps,
                             .half_width_m = options.half_width_m,
                             .height_m = options.height_m,
                             .step_m = options.step_m,
                             .heading_change_sigma_rad = options.heading_change_sigma_rad,
                             .noise = {.sigma_m = options.noise.noise_m,
                                       .share = options.noise.share,
                                       .correlation = options.noise.correlation}},
                            derive_seed(experiment.seed, {kSlamSpace}));
  SpaceRun run{.landmarks_m = flight.landmarks_m,
               .positions_m = flight.positions_m,
               .known = {},
               .noise = options.noise.title,
               .records = {}};
  for (Eigen::Index n = 0; n < options.known; ++n) run.known.push_back(n);
  const RangeNoise noise = range_noise(options.noise);
  run.records.push_back(
      record_of(flight, noise,
                KnownSpaceLandmarks{.rows = run.known,
                                    .positions_m = flight.landmarks_m.topRows(options.known)}));
  run.records.push_back(record_of(flight, noise, std::nullopt));
  return run;
}

}  // namespace mapproof
