#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

namespace mapproof {

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

}  // namespace mapproof
