#pragma once

#include <ceres/sized_cost_function.h>
#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/model/range_log.hpp"
#include "core/model/slam/slam.hpp"
#include "core/range_slam/known_landmarks.hpp"
#include "core/range_slam/refinement/key_poses.hpp"

namespace mapproof {

struct RefineOptions {
  OdometryNoise odometry = {};    ///< Of one motion.
  double range_sigma_m = 0.5;     ///< > 0.
  double huber = 1.5;             ///< Sigmas beyond which a range counts less; > 0.
  bool estimate_scale = true;     ///< One factor for all ranges; else that of the start.
  double offset_sigma_m = 0.0;    ///< Prior of a constant in a landmark's ranges; 0: none.
  double spacing_m = 0.0;         ///< Way between the poses that are estimated; 0: all.
  double coarse_spacing_m = 5.0;  ///< That of a first, cheaper solve; 0: none.
  std::optional<KnownLandmarks> known = std::nullopt;  ///< Held where they are; two or more.
  int most_iterations = 200;                           ///< >= 1.
  /// Poses with a covariance, evenly spread; 0: no covariances at all. With at most 500 landmarks.
  Eigen::Index covariances = 0;

  /// Names the first field that cannot be used with n landmarks; empty if none.
  std::string problem(Eigen::Index n) const;
};

/// The normal matrix J'J of a chain of poses that only neighbours share, and of what all may share:
///
///     [ D_0  O_0'            B_0' ]
///     [ O_0  D_1  O_1'       B_1' ]
///     [      O_1  D_2  ...   ...  ]
///     [ B_0  B_1  ...        C    ]
class ChainInformation {
 public:
  /// @param poses   K >= 1 blocks of 3. @param shared  m >= 0 numbers.
  ChainInformation(Eigen::Index poses, Eigen::Index shared);

  /// Adds J'J of residuals that see pose i (3 columns), pose i + 1 (3 columns; none for the last
  /// one) and the shared numbers `columns`.
  /// @param i  -1: no pose i, pose 0 alone.
  void add(Eigen::Index i, const Eigen::MatrixXd& J_first, const Eigen::MatrixXd& J_second,
           const std::vector<Eigen::Index>& columns, const Eigen::MatrixXd& J_shared);

  /// Parts of the inverse.
  struct Covariance {
    Eigen::MatrixXd shared;                    ///< m x m.
    std::vector<Eigen::Matrix3d> poses;        ///< K, the blocks of the diagonal.
    std::vector<Eigen::MatrixXd> shared_pose;  ///< K blocks m x 3 between the two.
  };

  /// @return Empty if the matrix is not positive definite to working precision: something is not
  ///         determined.
  /// @note O(K m^2) time, O(K m) memory: no entry outside these blocks is computed.
  std::optional<Covariance> inverse() const;

 private:
  std::vector<Eigen::Matrix3d> D_;
  std::vector<Eigen::Matrix3d> O_;  ///< O_[i] couples pose i + 1 (rows) with pose i (columns).
  std::vector<Eigen::MatrixXd> B_;  ///< m x 3.
  Eigen::MatrixXd C_;
};

/// The residual of a motion of the odometry in the poses before and after it, whitened.
class MotionResidual : public ceres::SizedCostFunction<3, 3, 3> {
 public:
  explicit MotionResidual(const KeyMotion& motion) : motion_(motion) {}
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  KeyMotion motion_;
};

/// The residual of a range in the two key poses around it, the landmark, the scale and the
/// landmark's offset: (scale * distance + offset - range) / sigma.
class RangeResidual : public ceres::SizedCostFunction<1, 3, 3, 2, 1, 1> {
 public:
  RangeResidual(const BetweenPoses& position, double range_m, double sigma_m)
      : place_(position), range_m_(range_m), sigma_m_(sigma_m) {}
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  BetweenPoses place_;
  double range_m_;
  double sigma_m_;
};

/// What is known of a landmark's offset beforehand: offset / sigma.
class OffsetPrior : public ceres::SizedCostFunction<1, 1> {
 public:
  explicit OffsetPrior(double sigma_m) : sigma_m_(sigma_m) {}
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  double sigma_m_;
};

/// What refine() moves.
struct RefineState {
  std::vector<Eigen::Vector3d> poses;  ///< Of the key poses: x, y, heading.
  std::vector<Eigen::Vector2d> landmarks;
  std::vector<double> offsets_m;
  double scale = 1.0;
};

/// The residuals of a log about a state, and which parts of it are free.
class RefineProblem {
 public:
  /// @param keys       Read here alone.
  /// @param is_placed  Landmarks that take part.
  RefineProblem(const RangeLog& log, const KeyPoses& keys, const std::vector<bool>& is_placed,
                const RefineOptions& options);

  struct Outcome {
    bool is_usable = false;  ///< A step was taken, or none was needed.
    bool has_converged = false;
    double cost = 0.0;
    int iterations = 0;
  };
  /// @note The first call silences glog, through which Ceres speaks, below fatal errors for the
  ///       whole process: its level has no other location. Calls from several threads are safe.
  Outcome solve(RefineState& state) const;

  /// Covariances about a solution, from its J'J with Huber's weights.
  struct Covariances {
    std::vector<Eigen::Matrix2d> landmarks;  ///< N; zero where held, NaN where not placed.
    std::vector<Eigen::Matrix2d> positions;  ///< Of the key poses.
    bool are_of_first_pose = false;          ///< Not freed of the frame.
  };
  /// @return Empty if a direction is not determined.
  std::optional<Covariances> covariances(const RefineState& state) const;

 private:
  struct Range {
    std::unique_ptr<RangeResidual> residual;
    Eigen::Index before;
    std::size_t landmark;
  };

  /// Where landmarks, then the scale, then offsets stand among the shared numbers; -1: held.
  struct Shared {
    std::vector<Eigen::Index> landmarks, offsets;
    Eigen::Index scale = -1;
    Eigen::Index count = 0;
  };
  Shared shared() const;
  void add_motions(const RefineState& state, ChainInformation& information) const;
  void add_ranges(const RefineState& state, const Shared& shared,
                  ChainInformation& information) const;

  bool is_held(std::size_t landmark) const { return is_known_[landmark] || !is_placed_[landmark]; }
  bool holds_first_pose() const { return !options_.known; }

  RefineOptions options_;
  std::vector<bool> is_placed_;
  std::vector<bool> is_known_;
  std::vector<std::unique_ptr<MotionResidual>> motions_;
  std::vector<Range> ranges_;
};

/// Path, landmarks and range scale that agree best with odometry and ranges: nonlinear least
/// squares by Levenberg and Marquardt's steps [agarwal2022], from a start.
///
/// Minimised is half the sum over motions of the whitened squared error, and over ranges of Huber's
/// loss of (scale * distance + offset - range) / sigma. A range between two poses sees both.
///
/// Without known landmarks the first pose stays where the start has it, and covariances are those
/// after a rigid fit of the landmarks; with fewer than two landmark positions, relative to the
/// first pose. Known landmarks tie the frame, to which the start is moved first, if two of them are
/// heard that are in different positions. A mirrored start ends in a mirrored map.
/// @param start  Any path within the time of the odometry, with headings or not; N landmarks, NaN
///               rows: found from that path.
/// @return The path at all of odometry's times. Landmarks without a position: kLandmarkUnseen;
///         kNotConverged at the limit; kUndetermined if known landmarks do not tie the frame, which
///         is then as without them, if covariances are relative to the first pose, or if there are
///         none since some direction is not determined; kFailed if no step could be taken: the
///         start, carried along the odometry and moved to the frame of the known landmarks.
/// @throws InvalidInput if the log has no odometry or no ranges, or a bound is broken: for ranges
///         that check_ranges() refuses, for what carried_along() refuses of the start's path; or if
///         covariances are asked for with more than 1e7 poses times landmarks.
/// @note One thread; the same bits every time. Time is linear in the poses; see
///       docs/methods/measurements.md.
///       From the first call on, what Ceres logs below the level of fatal errors is silenced in the
///       whole process.
SlamEstimate refine(const RangeLog& log, const SlamEstimate& start,
                    const RefineOptions& options = {});

}  // namespace mapproof
