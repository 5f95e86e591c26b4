#include "render/figures/maps/path_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "render/base/span.hpp"
#include "render/figures/maps/covariance_ellipse.hpp"

namespace mapproof {
namespace {

using Eigen::Index;

constexpr double kPathReach = 0.5;  // Sides about the core that paths may take up.
constexpr double kMargin = 0.05;    // Of the picture's side.
constexpr double kVisible = 0.06;   // Half axis of the largest ellipse, of the side, at most.
constexpr double kTolerance = 1.0 / 3600.0;  // Of the side.

void require_consistent(const PathMapSpec& spec) {
  const auto refuse = [&spec](const std::string& what) {
    throw InvalidInput("figure " + printable(spec.id) + ": " + what);
  };
  const auto landmarks = std::ssize(spec.run.log.landmarks);
  const auto& truth = spec.run.log.true_landmarks;
  if (truth && truth->rows() != landmarks) refuse("not as many true landmarks as names");
  for (const Index known : spec.run.known)
    if (known < 0 || known >= landmarks) refuse(fmt::format("known {} is not a landmark", known));
  for (const SlamRecord& record : spec.run.records) {
    const SlamEstimate& estimate = record.estimate;
    const Index size = estimate.path.size();
    if (estimate.path.positions_m.rows() != size) refuse("times and positions differ in number");
    if (!record.error_m.empty() && std::ssize(record.error_m) != size)
      refuse("not as many errors as positions");
    if (estimate.landmarks_m.rows() != 0 && estimate.landmarks_m.rows() != landmarks)
      refuse("not as many landmarks as names");
    if (!estimate.landmark_cov_m2.empty() && std::ssize(estimate.landmark_cov_m2) != landmarks)
      refuse("not as many covariances as landmarks");
    if (estimate.position_cov_m2.size() != estimate.position_cov_rows.size())
      refuse("not as many covariances as their rows");
    for (const Index row : estimate.position_cov_rows)
      if (row < 0 || row >= size) refuse(fmt::format("covariance of no position, {}", row));
  }
}

struct PathExtent {
  Span x, y;

  void see(const Eigen::RowVector2d& point) {
    if (!point.allFinite()) return;
    x.see(point.x()), y.see(point.y());
  }
  void see(const Points& points) {
    for (Index i = 0; i < points.rows(); ++i) see(Eigen::RowVector2d(points.row(i)));
  }
  double side() const { return x.known() ? std::max(x.high - x.low, y.high - y.low) : 0.0; }
  bool holds(const Eigen::RowVector2d& point, double by) const {
    return x.low - by <= point.x() && point.x() <= x.high + by && y.low - by <= point.y() &&
           point.y() <= y.high + by;
  }
};

/// The middle 90 % of a column, as far as its numbers are finite.
Range middle_range(const Points& points, Index column) {
  std::vector<double> values;
  for (Index i = 0; i < points.rows(); ++i)
    if (points.row(i).allFinite()) values.push_back(points(i, column));
  if (values.empty()) return {NAN, NAN};
  std::ranges::sort(values);
  const std::size_t cut = values.size() / 20;
  return {values[cut], values[values.size() - 1 - cut]};
}

/// Where a reader's eye belongs.
PathExtent core_of(const SlamRun& run, const PathView& view) {
  PathExtent core;
  if (run.log.truth) core.see(run.log.truth->positions_m);
  if (run.log.true_landmarks) core.see(*run.log.true_landmarks);
  if (core.side() > 0.0) return core;
  for (const SlamRecord* record : view.shown)
    for (const Points* points :
         {&record->estimate.path.positions_m, &record->estimate.landmarks_m}) {
      const Range x = middle_range(*points, 0), y = middle_range(*points, 1);
      core.see(Eigen::RowVector2d(x.low, y.low));
      core.see(Eigen::RowVector2d(x.high, y.high));
    }
  return core;
}

void find_limits(const SlamRun& run, PathView& view) {
  const PathExtent core = core_of(run, view);
  if (!core.x.known()) {
    view.limits = {{0.0, 1.0}, {0.0, 1.0}};
    return;
  }
  const double reach = core.side() > 0.0 ? kPathReach * core.side() : 1.0;
  PathExtent all = core;
  for (const SlamRecord* record : view.shown) {
    bool leaves = false;
    for (const Points* points : {&record->estimate.path.positions_m, &record->estimate.landmarks_m})
      for (Index i = 0; i < points->rows(); ++i) {
        if (core.holds(points->row(i), reach))
          all.see(Eigen::RowVector2d(points->row(i)));
        else
          leaves |= points->row(i).allFinite();
      }
    if (leaves) view.leaving.emplace_back(info(record->method).label);
  }
  view.side_m = all.side() > 0.0 ? all.side() : 1.0;
  const double by = kMargin * view.side_m;
  view.limits = {{all.x.low - by, all.x.high + by}, {all.y.low - by, all.y.high + by}};
}

/// The greatest round factor at which no ellipse is larger than the eye needs.
double enlargement(const PathView& view) {
  constexpr std::array kFactors = {100.0, 50.0, 20.0, 10.0, 5.0, 2.0};
  double longest_m = 0.0;
  for (const SlamRecord* record : view.shown)
    for (const Eigen::Matrix2d& C : record->estimate.landmark_cov_m2)
      if (C.allFinite()) longest_m = std::max(longest_m, covariance_ellipse(C).a);
  for (const double factor : kFactors)
    if (factor * longest_m <= kVisible * view.side_m) return factor;
  return 1.0;
}

bool any_finite(const Points& points) { return points.array().isFinite().any(); }

}  // namespace

PathView path_view(const PathMapSpec& spec) {
  require_consistent(spec);
  PathView view;
  for (const SlamMethod method : spec.methods)
    for (const SlamRecord& record : spec.run.records) {
      if (record.method != method) continue;
      const bool came_out =
          any_finite(record.estimate.path.positions_m) || any_finite(record.estimate.landmarks_m);
      (came_out ? view.shown : view.failed).push_back(&record);
    }
  find_limits(spec.run, view);
  view.tolerance_m = kTolerance * view.side_m;
  view.enlarged = enlargement(view);
  return view;
}

}  // namespace mapproof
