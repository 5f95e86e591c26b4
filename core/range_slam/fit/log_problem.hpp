#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "core/base/not_finite.hpp"
#include "core/model/fit.hpp"
#include "core/model/points.hpp"
#include "core/model/range_log.hpp"
#include "core/range_slam/fit/chain_system.hpp"
#include "core/range_slam/refinement/key_poses.hpp"

namespace mapproof {

/// Standard deviations of the errors in a log of odometry and ranges. Those of odometry grow with
/// the square root of the way, or of the angle turned.
struct LogNoise {
  double way_m = 0.0;               ///< Forward and sideways, after 1 m.
  double heading_per_metre = 0.0;   ///< Of the heading after 1 m, rad.
  double heading_per_radian = 0.0;  ///< Of the heading after turning by 1 rad, rad.
  double range_m = 0.0;             ///< Of a range that is not an outlier.
  double outlier_share = 0.01;  ///< Of the ranges; outliers may have any length up to the longest.
  double offset_m = 0.0;        ///< Of a constant in a landmark's ranges; 0: none.
  double range_information = 1.0;  ///< Share of the ranges' information that counts, in (0, 1]:
                                   ///< less than 1 where errors hang together in time.
};

/// A model of what is wrong with a log; one at a time is compared with the plain one.
struct LogHypothesis {
  FitCode code = FitCode::kResiduals;  ///< kResiduals: nothing, the plain model.
  std::vector<Eigen::Index> landmarks = {};
  double from_s = -kInfinity;  ///< It applies to ranges, or motions, at or after this time,
  double to_s = kInfinity;     ///< and before this one.
};

/// What a fit moves.
struct LogState {
  std::vector<Eigen::Vector3d> poses;           ///< Of the key poses: x, y, heading.
  std::vector<Eigen::Vector2d> landmarks = {};  ///< N, and of a moved landmark its second position.
  double scale = 1.0;                           ///< Measured range over distance.
  double offset_m = 0.0;                        ///< Of a hypothesis that has one.
  double shift_s = 0.0;                         ///< Stamp of a range less its time, likewise.
  Eigen::VectorXd offsets_m = {};               ///< N, where the noise has offsets.
};

struct LogProblemOptions {
  Eigen::Index most_keys = 400;    ///< Poses that are estimated, evenly spread over the way.
  std::vector<double> breaks_s{};  ///< Times at which a pose is estimated, too.
  double outlier_width_m = 0.0;    ///< 0: the longest range.
  /// Whether these parts of the noise are given, and not estimated: of the way, of the heading per
  /// metre and per radian, of a range.
  std::array<bool, 4> given = {};
};

/// A stretch without odometry: nothing is known of the way but how far the robot may have come.
struct OdometryGap {
  double from_s = 0.0;
  double to_s = 0.0;
  double way_sigma_m = 0.0;
  double heading_change_sigma_rad = 0.0;
};

/// The negative log-likelihood of a log, marginal over the path, and its derivatives.
///
/// Motions between key poses have Gaussian errors; a range is Gaussian about scale * distance or,
/// as an outlier, uniform. The first pose is held.
class LogProblem {
 public:
  /// @param odometry   From dead_reckoned(), T >= 2.
  /// @param is_placed  Landmarks that take part, N.
  /// @param gaps       Ranges within them are left out.
  LogProblem(const RangeLog& log, const Trajectory& odometry, const std::vector<bool>& is_placed,
             const std::vector<OdometryGap>& gaps, const LogProblemOptions& options);

  const KeyPoses& keys() const { return keys_; }
  Eigen::Index landmarks() const { return landmarks_; }
  /// Whether the noise of the way is estimated, not given.
  bool estimates_way() const { return !given_[0]; }

  struct Range {
    double time_s = 0.0;
    double range_m = 0.0;
    double sigma_m = 0.0;  ///< Given with it; 0: that of the noise.
    Eigen::Index landmark = 0;
    std::size_t row = 0;  ///< In the log.
    bool in_gap = false;
    BetweenPoses at;
  };
  const std::vector<Range>& ranges() const { return ranges_; }

  /// The poses of a path at the key poses' times.
  std::vector<Eigen::Vector3d> poses_of(const Trajectory& path) const;
  /// The whole path about its key poses.
  Trajectory path_of(const std::vector<Eigen::Vector3d>& poses) const;

  struct Fit {
    LogState state;
    LogNoise noise;
    double cost = kInfinity;  ///< -2 ln of the likelihood, marginal over the path.
    bool is_usable = false;
    bool has_converged = false;
    Eigen::VectorXd normalised = {};  ///< Residual of each range of ranges() over its sigma.
    Eigen::VectorXd inlier = {};      ///< Probability that it is not an outlier.
    int iterations = 0;
  };
  struct Effort {
    int rounds = 25;  ///< Most estimates of the noise.
    int steps = 4;    ///< Most steps between them.
    bool estimates_noise = true;
    double tolerance = 0.02;  ///< Change of the cost at which it ends.
  };
  /// Minimises the cost over the state and, in turn, estimates the noise (REML) under the
  /// hypothesis.
  Fit fit(const LogHypothesis& hypothesis, LogState start, LogNoise noise,
          const Effort& effort) const;

  /// What each range adds to the cost of a fit under a hypothesis: at most the cost of an outlier.
  /// Ranges within a gap: 0.
  Eigen::VectorXd range_costs(const LogHypothesis& hypothesis, const Fit& fit) const;

  /// The noise that a fit begins with: from the size of the log alone, so that it does not depend
  /// on the unit, and from the residuals of the start.
  LogNoise first_noise(const LogState& start) const;

  /// Drops of the cost, by their scores, when one number is added to a fit: of an offset of all
  /// ranges, of each landmark's (N), of a time offset, and of jumps of the clock at `times_s`; and
  /// the standard deviation of each number.
  struct Scores {
    double common = 0.0, common_sigma_m = kInfinity;
    Eigen::VectorXd landmark, landmark_sigma_m;
    double shift = 0.0, shift_sigma_s = kInfinity;
    Eigen::VectorXd jump, jump_sigma_s;
  };
  Scores scores(const Fit& fit, const std::vector<double>& times_s) const;

  /// Covariances about a fit, free of the frame: after a rigid fit of the landmarks.
  struct Covariances {
    std::vector<Eigen::Matrix2d> landmarks;
    std::vector<Eigen::Matrix2d> positions;  ///< Of the key poses.
    Eigen::MatrixXd all;                     ///< 2N x 2N, of the landmarks; NaN where not placed.
    double scale_sigma = kInfinity;
    bool is_determined = false;
    bool are_of_first_pose = false;
  };
  Covariances covariances(const Fit& fit) const;

 private:
  /// The normal equations of a fit with the columns of a common offset, a time shift, the offset of
  /// each landmark and the time jumps, behind the others.
  ChainSystem score_system(const Fit& fit, const std::vector<double>& times_s) const;
  struct Motion {
    Eigen::Vector3d step;
    Eigen::Matrix3d way, per_metre, per_radian, given;  ///< Covariances at unit noise, and fixed.
    double from_s = 0.0, to_s = 0.0;
  };
  struct Columns;
  struct Term;
  struct Turned;
  struct Solved;
  struct ErrorSums;

  Motion motion_between(Eigen::Index first, Eigen::Index last,
                        const std::vector<OdometryGap>& gaps) const;
  Eigen::Matrix3d motion_covariance(const Motion& motion, const LogNoise& noise) const;
  Columns columns_of(const LogHypothesis& hypothesis, const LogNoise& noise) const;
  Term term_of(const Range& range, const LogHypothesis& hypothesis, const Turned& turned) const;
  /// The slope of a range in the shift of its time.
  double slope_in_time(const Range& range, const Term& term, const Turned& turned) const;
  double sigma_of(const Range& range, const LogNoise& noise) const;
  double cost_of(const LogHypothesis& hypothesis, const LogState& state,
                 const LogNoise& noise) const;
  void assemble(const LogHypothesis& hypothesis, const Columns& columns, const LogState& state,
                const LogNoise& noise, ChainSystem& system) const;
  LogState moved(const LogState& state, const Columns& columns,
                 const ChainSystem::Solution& step) const;
  /// Levenberg and Marquardt's steps at the noise of `fit`. @return The cost.
  double descend(const LogHypothesis& hypothesis, const Effort& effort, ChainSystem& system,
                 Fit& fit, double& damping) const;
  void add_motion_errors(const Solved& solved, ErrorSums& sums) const;
  void add_range_errors(const Solved& solved, ErrorSums& sums) const;
  double prediction_variance(const Solved& solved, const Range& range, const Term& term) const;
  bool update_noise(const LogHypothesis& hypothesis, const Columns& columns, const LogState& state,
                    const ChainSystem& system, LogNoise& noise) const;
  /// The normalised residual of each range, and the probability that it is not an outlier.
  void take_residuals(const LogHypothesis& hypothesis, Fit& fit) const;

  const RangeLog* log_;
  KeyPoses keys_;
  Eigen::Index landmarks_;
  std::vector<bool> is_placed_;
  std::vector<Motion> motions_;
  std::vector<Range> ranges_;
  double outlier_width_m_;
  double step_s_ = 0.0;  ///< Median time between motions.
  Eigen::Matrix3d floor_;
  std::array<bool, 4> given_ = {};
};

}  // namespace mapproof
