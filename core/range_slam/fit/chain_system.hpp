#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

namespace mapproof {

/// The normal equations H x = g of a chain of poses that only neighbours share, and of numbers that
/// all may share:
///
///     [ D_0  O_0'            B_0' ]
///     [ O_0  D_1  O_1'       B_1' ]
///     [      O_1  D_2  ...   ...  ]
///     [ B_0  B_1  ...        C    ]
///
/// H is the sum of J'J, g that of -J'r.
class ChainSystem {
 public:
  /// @param poses  K >= 1 blocks of 3. @param shared  m >= 0 numbers.
  ChainSystem(Eigen::Index poses, Eigen::Index shared);

  void clear();

  /// Adds residuals of poses i and i + 1.
  /// @param i  -1: pose 0 alone, as i + 1.
  void add_motion(Eigen::Index i, const Eigen::Matrix3d& J_first, const Eigen::Matrix3d& J_second,
                  const Eigen::Vector3d& residual);

  /// A shared number that a residual depends on, and its slope.
  struct Slope {
    Eigen::Index column = 0;
    double value = 0.0;
  };

  /// Adds one residual of poses i and i + 1 and of some shared numbers.
  /// @param i  -1: pose 0 alone, as i + 1.
  void add_range(Eigen::Index i, const Eigen::RowVector3d& J_first,
                 const Eigen::RowVector3d& J_second, const std::vector<Slope>& slopes,
                 double residual);

  /// Adds one residual of a shared number.
  void add_prior(Eigen::Index column, double slope, double residual);

  /// x, and what H says of it.
  struct Solution {
    Eigen::Matrix3Xd poses;        ///< 3 x K.
    Eigen::VectorXd shared;        ///< m.
    double log_determinant = 0.0;  ///< Of the poses' block of H: D and O alone.
  };
  /// @param damping  Added to the diagonal of H as a share of it; >= 0.
  /// @return Empty if H is not positive definite to working precision.
  /// @note O(K m^2) time.
  std::optional<Solution> solve(double damping = 0.0) const;

  /// C and g after the elimination of the poses: m x m, m. Empty as solve().
  struct Reduced {
    Eigen::MatrixXd C;
    Eigen::VectorXd g;
  };
  std::optional<Reduced> reduced() const;

  /// Parts of the inverse of H.
  struct Covariance {
    Eigen::MatrixXd shared;                    ///< m x m.
    std::vector<Eigen::Matrix3d> poses;        ///< K, the blocks of the diagonal.
    std::vector<Eigen::Matrix3d> next;         ///< K - 1, of pose i (rows) with pose i + 1.
    std::vector<Eigen::MatrixXd> shared_pose;  ///< K blocks m x 3.
  };
  /// @return Empty as solve(). @note O(K m^2) time, O(K m) memory.
  std::optional<Covariance> covariance() const;

 private:
  struct Factors;
  std::optional<Factors> factors(double damping) const;

  Eigen::Index poses_;
  Eigen::Index shared_;
  std::vector<Eigen::Matrix3d> D_;
  std::vector<Eigen::Matrix3d> O_;  ///< O_[i] couples pose i + 1 (rows) with pose i (columns).
  Eigen::MatrixXd B_;               ///< m x 3K.
  Eigen::MatrixXd C_;
  Eigen::VectorXd g_poses_;  ///< 3K.
  Eigen::VectorXd g_shared_;
};

}  // namespace mapproof
