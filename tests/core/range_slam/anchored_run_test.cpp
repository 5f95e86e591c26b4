#include <algorithm>

#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "core/experiment/slam_run.hpp"
#include "core/simulate/range_world.hpp"

namespace mapproof {
namespace {

RangeLog anchored_drive(const DriveFaults& faults) {
  Random random(3);
  return simulate_drive({.landmarks = 6, .steps = 1500}, faults, random);
}

/// The landmarks of a log, moved, as anchors: all but the last.
KnownLandmarks anchors_of(const RangeLog& log, const Eigen::RowVector2d& offset_m) {
  KnownLandmarks known;
  for (Eigen::Index n = 0; n + 1 < log.true_landmarks->rows(); ++n) known.rows.push_back(n);
  known.positions_m = (*log.true_landmarks)(known.rows, Eigen::all);
  known.positions_m.rowwise() += offset_m;
  return known;
}

RangeLog moved(RangeLog log, const Eigen::RowVector2d& offset_m) {
  log.start.x_m += offset_m.x();
  log.start.y_m += offset_m.y();
  log.ground_truth->positions_m.rowwise() += offset_m;
  log.true_landmarks->rowwise() += offset_m;
  return log;
}

SlamRunOptions anchored(const KnownLandmarks& known, const std::vector<SlamMethod>& methods) {
  LogFitOptions fit;
  fit.test_keys = fit.final_keys = 120;
  fit.known = known;
  return {.methods = methods, .known = known, .ties_refinement = true, .fit = std::move(fit)};
}

/// Greatest distance of anything from what it is after a translation.
double apart_m(const SlamRecord& a, const SlamRecord& b, const Eigen::RowVector2d& offset_m) {
  const Points path =
      (b.estimate.path.positions_m - a.estimate.path.positions_m).rowwise() - offset_m;
  const Points landmarks = (b.estimate.landmarks_m - a.estimate.landmarks_m).rowwise() - offset_m;
  double most = path.size() > 0 ? path.cwiseAbs().maxCoeff() : 0.0;
  for (const double coordinate : landmarks.reshaped())
    if (!std::isnan(coordinate)) most = std::max(most, std::abs(coordinate));
  return most;
}

class FarOut : public ::testing::TestWithParam<Eigen::RowVector2d> {
 protected:
  static void expect_the_same(const RangeLog& log, const std::vector<SlamMethod>& methods) {
    const Eigen::RowVector2d offset_m = GetParam();
    const auto near = make_slam_run("a", log, anchored(anchors_of(log, {0, 0}), methods)).run;
    const auto far =
        make_slam_run("a", moved(log, offset_m), anchored(anchors_of(log, offset_m), methods)).run;
    ASSERT_EQ(near.records.size(), far.records.size());
    for (std::size_t i = 0; i < near.records.size(); ++i) {
      EXPECT_GT(near.records[i].estimate.path.size(), 0);
      EXPECT_LT(apart_m(near.records[i], far.records[i], offset_m), 1e-6)
          << info(near.records[i].method).name;
      EXPECT_EQ(near.records[i].estimate.statuses.size(), far.records[i].estimate.statuses.size());
    }
  }
};

TEST_P(FarOut, EveryMethodGivesTheSameMapAsNearZero) {
  expect_the_same(
      anchored_drive({}),
      {SlamMethod::kDeadReckoning, SlamMethod::kEkf, SlamMethod::kSpectralKnown,
       SlamMethod::kSpectralKnown7, SlamMethod::kSpectral, SlamMethod::kSpectral7,
       SlamMethod::kBatchFixedScale, SlamMethod::kRefined, SlamMethod::kRefinedFromOdometry});
}

TEST_P(FarOut, RangesAtCommonTimesGiveTheSameMapAsNearZero) {
  RangeLog log = anchored_drive({});
  log.odometry.clear();
  log.ranges.clear();
  for (Eigen::Index t = 0; t < log.ground_truth->size(); t += 10)
    for (Eigen::Index n = 0; n < log.true_landmarks->rows(); ++n)
      log.ranges.push_back(
          {.time_s = log.ground_truth->time_s(t),
           .landmark = n,
           .range_m = (log.true_landmarks->row(n) - log.ground_truth->positions_m.row(t)).norm()});
  expect_the_same(log, {SlamMethod::kSpectralKnown, SlamMethod::kSpectral});
}

INSTANTIATE_TEST_SUITE_P(Offsets, FarOut,
                         ::testing::Values(Eigen::RowVector2d(1e4, 1e4),
                                           Eigen::RowVector2d(391234.5, 5821234.5)));

TEST(SlamTimings, OfTheRefinedMapAreThoseOfTheFitThatItIsTakenFrom) {
  const RangeLog log = anchored_drive({});
  SlamRunOptions options = anchored(anchors_of(log, {0, 0}), {SlamMethod::kRefined});
  options.ties_refinement = false;
  SlamEstimates estimates(log, options);
  estimates.prepare(SlamMethod::kRefined);
  EXPECT_EQ(estimates.prepared_s(SlamMethod::kRefined), estimates.log_fit()->map_s);
  EXPECT_EQ(estimates.prepared_s(SlamMethod::kEkf), 0.0);
  constexpr double kLongerThanACopy_s = 1e-3;
  EXPECT_GT(make_slam_run("a", log, options).timings.front().seconds, kLongerThanACopy_s);
  options.ties_refinement = true;  // It only starts from the fit.
  EXPECT_EQ(estimates.prepared_s(SlamMethod::kRefined), 0.0);
}

TEST(RepairedMap, IsInTheFrameOfTheAnchorsAndPredictsHeldOutRangesBetter) {
  for (const DriveFaults& faults :
       {DriveFaults{.landmark_offset_m = 5.0}, DriveFaults{.exchanged_share = 1.0}}) {
    const RangeLog log = anchored_drive(faults);
    const Eigen::RowVector2d offset_m(100.0, -40.0);
    const KnownLandmarks known = anchors_of(log, offset_m);
    SlamRunOptions options = anchored(known, {SlamMethod::kRefined});
    options.repairs = true;
    const SlamRun run = make_slam_run("a", moved(log, offset_m), options).run;
    ASSERT_EQ(run.records.back().method, SlamMethod::kRepaired);
    const SlamRecord& repaired = run.records.back();
    for (std::size_t k = 0; k < known.rows.size(); ++k)
      EXPECT_LT((repaired.estimate.landmarks_m.row(known.rows[k]) -
                 known.positions_m.row(static_cast<Eigen::Index>(k)))
                    .norm(),
                1e-6);
    ASSERT_FALSE(repaired.errors.empty());
    EXPECT_EQ(repaired.errors.front().alignment, Alignment::kNone);
    EXPECT_LT(repaired.errors.front().mean_m, 0.5 * run.records.front().errors.front().mean_m);
    ASSERT_NE(run.fit->number("fit_held_out_nats"), nullptr);
    EXPECT_GT(run.fit->number("fit_repaired_held_out_nats")->value,
              run.fit->number("fit_held_out_nats")->value);
  }
}

TEST(RepairedMap, DoesNotHoldAnAnchorThatMoved) {
  const RangeLog log = anchored_drive({.moved_m = 10.0});
  SlamRunOptions options = anchored(anchors_of(log, {0, 0}), {SlamMethod::kRefined});
  options.repairs = true;
  const SlamRun run = make_slam_run("a", log, options).run;
  ASSERT_EQ(run.records.back().method, SlamMethod::kRepaired);
  const Points& landmarks_m = run.records.back().estimate.landmarks_m;
  ASSERT_EQ(landmarks_m.rows(), log.true_landmarks->rows());
  EXPECT_LT((landmarks_m.row(1) - log.true_landmarks->row(1)).norm(), 1e-6);
  EXPECT_GT((landmarks_m.row(0) - log.true_landmarks->row(0)).norm(), 1e-6);
  EXPECT_LT((landmarks_m.row(0) - log.true_landmarks->row(0)).norm(), 1.0);
}

}  // namespace
}  // namespace mapproof
