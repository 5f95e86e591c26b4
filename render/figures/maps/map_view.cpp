#include "render/figures/maps/map_view.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/errors.hpp"

namespace mapproof {
namespace {

constexpr double kReach = 0.75;  // Estimates this many room sides off are still shown in place.
constexpr std::size_t kMostWorst = 5;

void require_consistent(const MapRecord& record) {
  const auto rows = static_cast<Eigen::Index>(record.names.size());
  const auto refuse = [&record](const std::string& what) {
    throw InvalidInput("map " + printable(record.id) + ": " + what);
  };
  if (record.estimate.rows() != rows)
    refuse(fmt::format("{} estimates for {} names", record.estimate.rows(), rows));
  if (record.truth_m && record.truth_m->rows() != rows)
    refuse(fmt::format("{} true positions for {} names", record.truth_m->rows(), rows));
  for (const Eigen::Index anchor : record.anchors)
    if (anchor < 0 || anchor >= rows) refuse(fmt::format("anchor {} is not a landmark", anchor));
  if (record.estimate.array().isInf().any() ||
      (record.truth_m && record.truth_m->array().isInf().any()))
    refuse("infinite coordinates");
}

/// Least and greatest of some rows.
class Extent {
 public:
  void see(double x, double y) {
    low_x_ = std::min(low_x_, x), high_x_ = std::max(high_x_, x);
    low_y_ = std::min(low_y_, y), high_y_ = std::max(high_y_, y);
  }
  double side() const { return std::max(high_x_ - low_x_, high_y_ - low_y_); }
  bool known() const { return low_x_ <= high_x_; }
  PanelBox grown(double by) const {
    return {{low_x_ - by, high_x_ + by}, {low_y_ - by, high_y_ + by}};
  }

 private:
  double low_x_ = INFINITY, high_x_ = -INFINITY, low_y_ = INFINITY, high_y_ = -INFINITY;
};

/// The middle 80 % of a column, NaN left out.
Range middle_of(const Points& points, Eigen::Index column) {
  std::vector<double> values;
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    if (!points.row(i).hasNaN()) values.push_back(points(i, column));
  std::ranges::sort(values);
  const std::size_t cut = values.size() / 10;
  return {values[cut], values[values.size() - 1 - cut]};
}

/// Where a reader's eye belongs: the room if the truth is known, else the bulk of the estimates.
Extent core_of(const MapRecord& record, const MapView& view) {
  Extent extent;
  if (record.frame == Frame::kTruth) {
    for (Eigen::Index i = 0; i < record.estimate.rows(); ++i)
      if (view.has_truth[i]) extent.see((*record.truth_m)(i, 0), (*record.truth_m)(i, 1));
    if (extent.known()) return extent;
  }
  constexpr std::size_t kFewest = 8;  // Of fewer points none is called an outlier.
  if (view.has_estimate.size() - view.unmapped.size() < kFewest) return extent;
  const Range x = middle_of(record.estimate, 0), y = middle_of(record.estimate, 1);
  const double side = std::max(x.high - x.low, y.high - y.low);
  extent.see(x.low - side, y.low - side);
  extent.see(x.high + side, y.high + side);
  return extent;
}

void find_outside(const MapRecord& record, MapView& view) {
  const Extent core = core_of(record, view);
  if (!core.known() || core.side() <= 0.0) return;
  const PanelBox reach = core.grown(kReach * core.side());
  Extent shown;
  for (Eigen::Index i = 0; i < record.estimate.rows(); ++i)
    if (view.has_truth[i]) shown.see((*record.truth_m)(i, 0), (*record.truth_m)(i, 1));
  for (Eigen::Index i = 0; i < record.estimate.rows(); ++i) {
    if (!view.has_estimate[i]) continue;
    const double x = record.estimate(i, 0), y = record.estimate(i, 1);
    if (reach.holds(x, y))
      shown.see(x, y);
    else
      view.outside.push_back(i);
  }
  if (!view.outside.empty()) view.limits = shown.grown(0.08 * shown.side());
}

void find_worst(MapView& view) {
  for (Eigen::Index i = 0; i < static_cast<Eigen::Index>(view.error_m.size()); ++i)
    if (view.error_m[i] > 0.0 && !view.is_anchor[i]) view.worst.push_back(i);
  std::ranges::stable_sort(view.worst, std::ranges::greater{},
                           [&view](Eigen::Index i) { return view.error_m[i]; });
  const std::size_t most = view.error_m.size() < 15 ? 3 : kMostWorst;
  view.worst.resize(std::min(view.worst.size(), most));
}

}  // namespace

MapView view_of(const MapRecord& record) {
  require_consistent(record);
  const Eigen::Index rows = record.estimate.rows();
  MapView view;
  view.is_anchor.assign(rows, false);
  for (const Eigen::Index anchor : record.anchors) view.is_anchor[anchor] = true;
  for (Eigen::Index i = 0; i < rows; ++i) {
    const bool mapped = !record.estimate.row(i).hasNaN();
    const bool true_known = record.truth_m && !record.truth_m->row(i).hasNaN();
    const bool comparable = mapped && true_known && record.frame == Frame::kTruth;
    view.has_estimate.push_back(mapped);
    view.has_truth.push_back(true_known && record.frame == Frame::kTruth);
    view.error_m.push_back(comparable ? (record.estimate.row(i) - record.truth_m->row(i)).norm()
                                      : NAN);
    if (!mapped) view.unmapped.push_back(i);
  }
  find_worst(view);
  find_outside(record, view);
  return view;
}

}  // namespace mapproof
