#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/range_slam/refinement/chain_information.hpp"
#include "core/range_slam/refinement/refine.hpp"
#include "core/range_slam/refinement/refine_residuals.hpp"

namespace mapproof {

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
  ///       whole process: its level has no other place. Calls from several threads are safe.
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

  /// Where landmarks and poses are free to move together: the share of the first pose's whims in
  /// the covariance is taken out.
  /// @return False if fewer than two places of landmarks are free: nothing is taken out.
  bool free_of_frame(const RefineState& state, const Shared& shared,
                     ChainInformation::Covariance& covariance) const;

  bool is_held(std::size_t landmark) const { return is_known_[landmark] || !is_placed_[landmark]; }
  bool holds_first_pose() const { return !options_.known; }

  RefineOptions options_;
  std::vector<bool> is_placed_;
  std::vector<bool> is_known_;
  std::vector<std::unique_ptr<MotionResidual>> motions_;
  std::vector<Range> ranges_;
};

}  // namespace mapproof
