#include "core/range_slam/refinement/placed_start.hpp"

#include <cmath>
#include <limits>

#include "core/align/rigid.hpp"
#include "core/range_slam/log_checks.hpp"
#include "core/range_slam/refinement/carried_along.hpp"
#include "core/range_slam/trilateration.hpp"

namespace mapproof {
namespace {

/// Known landmarks nearer to each other than this fix no turn.
constexpr double kOnePlace_m = 1e-3;

/// How many known landmarks are heard, and whether two of them are in different places.
struct Ties {
  int heard = 0;
  bool fix_the_frame = false;
};

Ties ties_of(const KnownLandmarks& known, const std::vector<bool>& is_heard) {
  Ties ties;
  std::optional<Eigen::RowVector2d> first;
  for (std::size_t i = 0; i < known.rows.size(); ++i) {
    if (!is_heard[static_cast<std::size_t>(known.rows[i])]) continue;
    const Eigen::RowVector2d place = known.positions_m.row(static_cast<Eigen::Index>(i));
    ++ties.heard;
    if (!first) first = place;
    ties.fix_the_frame = ties.fix_the_frame || (place - *first).norm() > kOnePlace_m;
  }
  return ties;
}

/// The start's landmarks where known ones are give the motion to their frame.
void move_to_known(const KnownLandmarks& known, PlacedStart& placed) {
  std::vector<Eigen::Index> both;
  for (std::size_t i = 0; i < known.rows.size(); ++i)
    if (placed.landmarks_m.row(known.rows[i]).allFinite())
      both.push_back(static_cast<Eigen::Index>(i));
  if (both.size() >= 2) {
    Points from(static_cast<Eigen::Index>(both.size()), 2);
    for (Eigen::Index i = 0; i < from.rows(); ++i)
      from.row(i) = placed.landmarks_m.row(
          known.rows[static_cast<std::size_t>(both[static_cast<std::size_t>(i)])]);
    const Similarity motion =
        fit_similarity(from, known.positions_m(both, Eigen::all), Alignment::kRigid);
    placed.path.positions_m = motion(placed.path.positions_m);
    placed.path.heading_rad.array() += std::atan2(motion.rotation(1, 0), motion.rotation(0, 0));
    placed.landmarks_m = motion(placed.landmarks_m);
  }
  for (std::size_t i = 0; i < known.rows.size(); ++i)
    placed.landmarks_m.row(known.rows[i]) = known.positions_m.row(static_cast<Eigen::Index>(i));
}

}  // namespace

PlacedStart placed_start(const RangeLog& log, const Trajectory& odometry, const SlamEstimate& start,
                         const std::optional<KnownLandmarks>& known) {
  PlacedStart placed{.path = carried_along(start.path, odometry),
                     .landmarks_m = start.landmarks_m,
                     .known = std::nullopt,
                     .statuses = {}};
  if (!placed.landmarks_m.allFinite()) {
    const Points found = trilaterated(log, placed.path, start.range_scale);
    for (Eigen::Index n = 0; n < placed.landmarks_m.rows(); ++n)
      if (!placed.landmarks_m.row(n).allFinite()) placed.landmarks_m.row(n) = found.row(n);
  }
  // Without a reading a place is nobody's finding.
  const std::vector<bool> is_heard =
      heard_between(log, odometry.time_s(0), odometry.time_s(odometry.size() - 1));
  for (Eigen::Index n = 0; n < placed.landmarks_m.rows(); ++n)
    if (!is_heard[static_cast<std::size_t>(n)])
      placed.landmarks_m.row(n).setConstant(std::numeric_limits<double>::quiet_NaN());
  if (!known) return placed;
  if (const Ties ties = ties_of(*known, is_heard); ties.fix_the_frame) {
    placed.known = known;
    move_to_known(*known, placed);
  } else {
    placed.statuses.push_back(
        status_of<StatusReason::kFrameNotTied>(ties.heard, known->rows.size()));
  }
  return placed;
}

}  // namespace mapproof
