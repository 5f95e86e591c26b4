#include "tests/support/samples/sample_figures.hpp"

#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "core/base/random.hpp"
#include "render/figures/maps/map.hpp"
#include "tests/support/samples/drawn_points.hpp"
#include "tests/support/samples/sample_comparisons.hpp"
#include "tests/support/samples/sample_slam.hpp"
#include "tests/support/samples/sample_studies.hpp"

namespace mapproof::test {
namespace {

constexpr double kRoom_m = 2.5;

/// The rows nearest the room's corners.
std::vector<Eigen::Index> corner_rows(const Points& points) {
  std::vector<Eigen::Index> rows;
  for (const double x : {0.0, kRoom_m})
    for (const double y : {0.0, kRoom_m}) {
      Eigen::Index row = 0;
      (points.rowwise() - Eigen::RowVector2d(x, y)).rowwise().norm().minCoeff(&row);
      rows.push_back(row);
    }
  return rows;
}

Figure changed_map(const std::string& id, int landmarks, double error_m,
                   const std::function<void(MapRecord&)>& change) {
  MapRecord record = sample_map(landmarks, error_m, 7);
  change(record);
  return map_figure(record, id);
}

void strip_ground_truth(MapRecord& record) {
  record.frame = Frame::kSimilarity;
  record.ground_truth_m.reset();
  record.anchors.clear();
  record.score.reset();
}

void add_maps(std::vector<Figure>& figures) {
  const auto add = [&figures](const std::string& id, int landmarks, double error_m,
                              const std::function<void(MapRecord&)>& change) {
    figures.push_back(changed_map("map-" + id, landmarks, error_m, change));
  };
  add("usual", 50, 0.12, [](MapRecord&) {});
  add("exact", 50, 0.0, [](MapRecord&) {});
  add("poor", 50, 0.6, [](MapRecord&) {});
  add("one-far-off", 50, 0.1, [](MapRecord& r) { r.estimate.row(20) << 101.0, -40.0; });
  add("all-far-off", 50, 0.1, [](MapRecord& r) { r.estimate.array() += 100.0; });
  add("huge", 50, 0.1, [](MapRecord& r) { r.estimate *= 1e9; });
  add("two", 2, 0.1, [](MapRecord& r) { r.anchors = {0}; });
  add("one", 1, 0.1, [](MapRecord& r) { r.anchors.clear(); });
  add("none", 0, 0.1, [](MapRecord& r) { r.anchors.clear(); });
  add("500", 500, 0.1, [](MapRecord&) {});
  add("all-nan", 50, 0.1, [](MapRecord& r) {
    r.estimate.setConstant(NAN);
    r.score.reset();
    r.statuses = {status_with_message(
        StatusCode::kFailed, "No map: the eigenvalues did not converge after 300 sweeps.")};
  });
  add("identical", 50, 0.1, [](MapRecord& r) {
    r.estimate.setConstant(1.0);
    r.statuses = {status_with_message(StatusCode::kRankDeficient,
                                      "The data have rank 0: all landmarks fall on one point.")};
  });
  add("some-missing", 50, 0.1, [](MapRecord& r) {
    for (const int row : {3, 9, 12, 30, 31, 32, 33}) r.estimate.row(row).setConstant(NAN);
    r.ground_truth_m->row(5).setConstant(NAN);
    r.statuses = {
        status_with_message(StatusCode::kLandmarkUnseen, "7 of 50 landmarks were never observed."),
        status_with_message(StatusCode::kBridged,
                            "The graph of 6 nearest neighbours had 3 components; the 2 "
                            "shortest bridges, 0.71 and 0.93 long, join them."),
        status_with_message(StatusCode::kNotConverged,
                            "Stress still fell by 2e-4 after 1000 iterations.")};
  });
  add("long-names", 50, 0.2, [](MapRecord& r) {
    for (std::string& name : r.names) name = "the landmark beside the third window, " + name;
  });
  add("hostile-names", 14, 0.2, [](MapRecord& r) {
    const std::vector<std::string> names = hostile_names();
    for (std::size_t i = 0; i < r.names.size(); ++i) r.names[i] = names[i % names.size()];
  });
  add("hostile-shape", 14, 0.1, [](MapRecord& r) {
    strip_ground_truth(r);
    const std::vector<std::string> names = hostile_names();
    for (std::size_t i = 0; i < r.names.size(); ++i) r.names[i] = names[i % names.size()];
  });
  add("shape", 20, 0.1, strip_ground_truth);
  add("shape-outlier", 40, 0.1, [](MapRecord& r) {
    strip_ground_truth(r);
    r.estimate.row(4) << 1e4, 3e4;
  });
  add("line", 30, 0.0, [](MapRecord& r) {
    strip_ground_truth(r);
    r.estimate.col(1).setZero();
  });
}

void add_curves(std::vector<Figure>& figures) {
  const auto add = [&figures](const std::string& id, std::size_t count,
                              const std::function<void(ErrorCurveSpec&)>& change) {
    ErrorCurveSpec spec = sample_curves(count, 3);
    spec.id = "curve-" + id;
    change(spec);
    figures.push_back(error_curve_figure(spec));
  };
  add("usual", 4, [](ErrorCurveSpec&) {});
  add("seven", 7, [](ErrorCurveSpec&) {});
  add("eight", 8, [](ErrorCurveSpec&) {});
  add("ten", 10, [](ErrorCurveSpec&) {});
  add("one", 1, [](ErrorCurveSpec&) {});
  add("none", 0, [](ErrorCurveSpec&) {});
  add("log", 4, [](ErrorCurveSpec& spec) {
    for (double& value : spec.curves[0].mean) value *= 60.0;
    for (double& value : spec.curves[0].low) value *= 50.0;
    for (double& value : spec.curves[0].high) value *= 80.0;
  });
  add("filled", 6, [](ErrorCurveSpec& spec) {  // No corner is free of data.
    for (std::size_t c = 0; c < spec.curves.size(); ++c)
      for (std::size_t i = 0; i < spec.curves[c].mean.size(); ++i) {
        spec.curves[c].mean[i] = 0.1 + 0.18 * static_cast<double>(c);
        spec.curves[c].low[i] = spec.curves[c].mean[i] - 0.1;
        spec.curves[c].high[i] = spec.curves[c].mean[i] + 0.1;
      }
  });
  add("long-labels", 3, [](ErrorCurveSpec& spec) {
    for (ErrorLine& curve : spec.curves)
      curve.label += ", with quite a long explanation of what it is";
  });
  add("gaps", 3, [](ErrorCurveSpec& spec) {
    spec.curves[0].mean[3] = NAN;
    spec.curves[1].low[2] = NAN;
    spec.curves[2].mean.assign(spec.curves[2].mean.size(), NAN);
  });
  add("one-step", 2, [](ErrorCurveSpec& spec) {
    for (ErrorLine& curve : spec.curves)
      for (std::vector<double>* part : {&curve.x, &curve.mean, &curve.low, &curve.high})
        part->resize(1);
  });
  add("tiny", 2, [](ErrorCurveSpec& spec) {
    for (ErrorLine& curve : spec.curves)
      for (std::vector<double>* part : {&curve.mean, &curve.low, &curve.high})
        for (double& value : *part) value *= 1e-9;
  });
}

}  // namespace

MapRecord sample_map(int landmarks, double error_m, std::uint64_t seed) {
  Random random(seed);
  MapRecord record;
  record.id = fmt::format("layout-1-pose-{}/visibility/isomap-K6/2000", seed);
  record.origin = FromSensor{Sensor::kVisibility, {Method::kIsomap, 6.0}};
  record.step = 2000;
  Points ground_truth(landmarks, 2);
  record.estimate.resize(landmarks, 2);
  double sum = 0.0;
  for (int i = 0; i < landmarks; ++i) {
    record.names.push_back(fmt::format("L{:02}", i + 1));
    ground_truth.row(i) << random.uniform(0.1, kRoom_m - 0.1), random.uniform(0.1, kRoom_m - 0.1);
    const Eigen::RowVector2d error = error_m * normal_point(random);
    record.estimate.row(i) = ground_truth.row(i) + error;
    sum += error.norm();
  }
  if (landmarks >= 4) record.anchors = corner_rows(ground_truth);
  record.ground_truth_m = ground_truth;
  record.score = Score{sum / std::max(landmarks, 1), 4.7, sum / std::max(landmarks, 1), 4.7};
  return record;
}

ErrorCurveSpec sample_curves(std::size_t count, std::uint64_t seed) {
  static const std::vector<std::string> labels = {"LPCA",
                                                  "SMACOF, equal weights",
                                                  "SMACOF, kNN weights, K = 8",
                                                  "ISOMAP, K = 6",
                                                  "Kernel PCA",
                                                  "LLE, K = 10",
                                                  "Laplacian eigenmap",
                                                  "SDE, K = 7",
                                                  "Hessian LLE, K = 8",
                                                  "Kernel PCA, polynomial"};
  Random random(seed);
  ErrorCurveSpec spec;
  spec.id = "curve";
  spec.title = "Mean position error over observations, visibility";
  for (std::size_t c = 0; c < count; ++c) {
    ErrorLine curve;
    curve.label = labels[c % labels.size()];
    curve.key = fmt::format("method-{}", c + 1);
    const double end = 0.15 + 0.07 * static_cast<double>(c);
    for (const double step : {50, 100, 200, 400, 600, 800, 1000, 1200, 1400, 1600, 1800, 2000}) {
      const double mean = end + 0.7 * std::exp(-step / 250.0) + 0.008 * random.normal();
      const double half = 0.02 + 1.5 / (step + 20.0);
      curve.x.push_back(step);
      curve.mean.push_back(mean);
      curve.low.push_back(mean - half);
      curve.high.push_back(mean + half);
    }
    spec.curves.push_back(std::move(curve));
  }
  spec.record_ids = {"layout-1-pose-1", "layout-1-pose-2"};
  return spec;
}

std::vector<std::string> hostile_names() {
  std::string stacked = "Z";
  for (int i = 0; i < 60; ++i) stacked += "\u0301\u0327";
  return {"<script>alert(1)</script>", "\"quoted\" 'twice' & <again>",
          "abc\u202Egnp.exe",          "\u200F\u05E9\u05DC\u05D5\u05DD 12 \u05E2\u05D5\u05DC\u05DD",
          "../../../etc/passwd",       std::string(10240, 'W'),
          "line\nfeed\ttab\x01",       "\xFF\xFE broken \xC3",
          "\U0001F600 face",           stacked,
          "zero\u200Bwidth\uFEFF",     "]]><!-- --><!DOCTYPE x>",
          "a b\u00A0c{{x}}{{{y}}}",    ""};
}

std::vector<Figure> sample_figures() {
  std::vector<Figure> figures;
  add_maps(figures);
  add_curves(figures);
  for (Figure& figure : sample_study_figures()) figures.push_back(std::move(figure));
  for (Figure& figure : sample_comparison_figures()) figures.push_back(std::move(figure));
  for (Figure& figure : sample_slam_figures()) figures.push_back(std::move(figure));
  return figures;
}

}  // namespace mapproof::test
