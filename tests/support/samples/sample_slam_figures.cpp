#include <cmath>
#include <functional>
#include <numbers>

#include "render/figures/curves/convergence.hpp"
#include "render/figures/curves/refinement_starts.hpp"
#include "render/figures/curves/spectrum.hpp"
#include "render/figures/maps/map_grid.hpp"
#include "render/figures/maps/path_errors.hpp"
#include "render/figures/maps/path_map.hpp"
#include "tests/support/samples/sample_comparisons.hpp"
#include "tests/support/samples/sample_figures.hpp"
#include "tests/support/samples/sample_slam.hpp"

namespace mapproof::test {
namespace {

const std::vector<SlamMethod> kShown = {SlamMethod::kDeadReckoning, SlamMethod::kSpectral,
                                        SlamMethod::kRefined};

void add_paths(std::vector<Figure>& figures) {
  const auto add = [&figures](const std::string& id, const std::function<void(SlamRun&)>& change) {
    SlamRun run = sample_drive("plaza-1", 2000, 1);
    change(run);
    figures.push_back(path_map_figure({"path-" + id, "Paths and landmarks, Plaza 1", run, kShown}));
  };
  add("usual", [](SlamRun&) {});
  add("no-ground-truth", [](SlamRun& run) {
    run.log.ground_truth.reset();
    run.log.true_landmarks.reset();
    for (SlamRecord& record : run.records) record.errors.clear(), record.error_m.clear();
  });
  add("leaving", [](SlamRun& run) {
    run.records[0].estimate.path.positions_m *= 40.0;
    run.records[3].estimate.landmarks_m.row(2) << 1e9, -1e9;
  });
  add("gaps", [](SlamRun& run) {
    for (SlamRecord& record : run.records)
      for (int i = 400; i < 700; ++i) {
        record.estimate.path.positions_m.row(i).setConstant(NAN);
        record.error_m[static_cast<std::size_t>(i)] = NAN;
      }
  });
  add("failed", [](SlamRun& run) {
    for (SlamRecord& record : run.records) {
      record.estimate = {};
      record.error_m.clear();
      record.errors.clear();
      record.estimate.statuses = {
          status_with_message(StatusCode::kTooFewObservations,
                              "3 landmarks were heard; the factorisation needs 4."),
          status_with_message(StatusCode::kFailed, "failed")};
    }
  });
  add("hostile-names", [](SlamRun& run) {
    const std::vector<std::string> names = hostile_names();
    run.log.name = names[3];
    for (std::size_t i = 0; i < run.log.landmarks.size(); ++i) run.log.landmarks[i] = names[i];
  });
  add("one-pose", [](SlamRun& run) {
    const auto keep_one = [](Trajectory& path) {
      path.time_s.conservativeResize(1);
      path.positions_m.conservativeResize(1, 2);
      path.heading_rad.conservativeResize(1);
    };
    keep_one(*run.log.ground_truth);
    run.log.true_landmarks.reset();
    for (SlamRecord& record : run.records) {
      keep_one(record.estimate.path);
      record.error_m.resize(1);
      record.estimate.landmarks_m.resize(0, 2);
      record.estimate.landmark_cov_m2.clear();
      record.estimate.position_cov_m2.clear();
      record.estimate.position_cov_rows.clear();
    }
  });
  const SlamRun walk = sample_walk();
  figures.push_back(path_map_figure({"path-walk",
                                     "Landmarks and path, true and recovered",
                                     walk,
                                     {SlamMethod::kSpectralKnown, SlamMethod::kSpectral}}));
}

void add_convergence(std::vector<Figure>& figures) {
  const ConvergenceCurve curve = sample_convergence("white", "white noise, 1 % of range", 1.0);
  figures.push_back(convergence_figure("convergence-usual", curve));
  figures.push_back(subspace_angle_figure("angle-usual", curve));
  figures.push_back(positions_figure("positions-usual", curve));
  const std::vector<ConvergenceCurve> curves = {
      curve, sample_convergence("correlated", "correlated noise, 1 % of range, .9 a step", 2.6),
      sample_convergence("additive", "white noise, .1 m", 0.7)};
  figures.push_back(noise_models_figure("noise-usual", curves));
  figures.push_back(factorization_cost_figure("cost-usual", sample_factorization()));
  figures.push_back(factorization_cost_figure("cost-none", {}));
  ConvergenceCurve hard = curve;
  hard.points.resize(3);
  hard.points[1].observation = {};
  hard.points[1].landmarks_m.half_width = 10.0;
  figures.push_back(convergence_figure("convergence-hard", hard));
  hard.points.resize(1);
  figures.push_back(convergence_figure("convergence-one", hard));
  figures.push_back(noise_models_figure("noise-none", {}));
}

void add_singular_values(std::vector<Figure>& figures) {
  const SingularValues four{"4-D", {9.1e5, 4.2e4, 2.9e4, 1.1e3}, 4, 140.0};
  const SingularValues seven{
      "7-D", {9.2e5, 4.3e4, 3.0e4, 1.4e3, 900.0, 610.0, 330.0, 95.0}, 7, std::nullopt};
  figures.push_back(singular_values_figure(
      {"singular-usual", "Singular values of the squared ranges, Plaza 1", {four, seven}, {}}));
  figures.push_back(singular_values_figure({"singular-exact",
                                            "Singular values",
                                            {{"", {1e4, 1e3, 500.0, 20.0, 0.0, 1e-13}, 4, {}}},
                                            {}}));
  figures.push_back(singular_values_figure({"singular-none", "Singular values", {{}}, {}}));
}

void add_choices(std::vector<Figure>& figures) {
  SlamRun run = sample_drive("plaza-1", 100, 1);
  figures.push_back(
      window_curve_figure({"windows-usual", "Window lengths, Plaza 1", *run.windows, "plaza-1"}));
  const WindowCurve failed{{30.0, 60.0}, {NAN, NAN}, 60.0};
  figures.push_back(
      window_curve_figure({"windows-failed", "Window lengths, Plaza 1", failed, "plaza-1"}));
  figures.push_back(refinement_starts_figure(
      {"starts-usual", "Starts of the refinement, Plaza 1", run.starts, "plaza-1"}));
  for (RefinementStart& start : run.starts) start.mean_m.reset();
  run.starts[5].cost = NAN;
  figures.push_back(refinement_starts_figure(
      {"starts-no-ground-truth", "Starts of the refinement, Plaza 1", run.starts, "plaza-1"}));
  figures.push_back(refinement_starts_figure({"starts-none", "Starts", {}, "plaza-1"}));
  MapGridSpec maps = sample_maps(11);
  maps.id = "wall-eleven";
  figures.push_back(map_wall_figure(maps));
}

/// Three rounds of an oval with a loop at one end, whose errors grow from round to round; a gap.
void add_path_errors(std::vector<Figure>& figures) {
  constexpr int kPoses = 3000;
  PoseErrors poses;
  poses.time_s = Eigen::VectorXd::LinSpaced(kPoses, 0.0, 300.0);
  poses.distance_m = Eigen::VectorXd::Zero(kPoses);
  poses.error_m = Eigen::VectorXd::Zero(kPoses);
  poses.ground_truth_m = poses.estimate_m = SpacePoints::Zero(kPoses, 3);
  for (int i = 0; i < kPoses; ++i) {
    const double turn = 6.0 * std::numbers::pi * i / kPoses;
    const double error_m = 0.4 * (1.1 - std::cos(0.5 * turn)) * (1.0 + turn / 12.0);
    poses.ground_truth_m.row(i) << 30.0 * std::cos(turn) + 4.0 * std::sin(4.0 * turn),
        12.0 * std::sin(turn), 0.0;
    poses.estimate_m.row(i) = poses.ground_truth_m.row(i);
    poses.estimate_m(i, 1) += error_m;
    poses.error_m(i) = error_m;
    if (i > 0)
      poses.distance_m(i) = poses.distance_m(i - 1) +
                            (poses.ground_truth_m.row(i) - poses.ground_truth_m.row(i - 1)).norm();
    if (i == 1700) poses.distance_m(i) += 10.0;
  }
  figures.push_back(
      path_error_map_figure({"path-errors", "oval: 0.7 m off", {{"oval", &poses}}, {"oval"}}, 0));
}

}  // namespace

std::vector<Figure> sample_slam_figures() {
  std::vector<Figure> figures;
  add_paths(figures);
  add_path_errors(figures);
  add_convergence(figures);
  add_singular_values(figures);
  add_choices(figures);
  return figures;
}

}  // namespace mapproof::test
