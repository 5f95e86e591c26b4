#include "core/range_slam/refinement/free_of_frame.hpp"

#include "core/linalg/decompositions.hpp"

namespace mapproof {

bool free_of_frame(const FramedMap& map, Eigen::MatrixXd& shared,
                   std::vector<Eigen::Matrix3d>& poses,
                   const std::vector<Eigen::MatrixXd>& shared_pose) {
  // How a landmark moves with the three rigid motions, about the middle of all of them.
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  double count = 0.0;
  for (std::size_t n = 0; n < map.landmarks.size(); ++n) {
    if (map.columns[n] < 0) continue;
    middle += map.landmarks[n];
    count += 1.0;
  }
  if (count < 2.0) return false;
  middle /= count;
  const auto motions_at = [&](const Eigen::Vector2d& position) {
    Eigen::Matrix<double, 2, 3> moves;
    moves << 1.0, 0.0, -(position(1) - middle(1)), 0.0, 1.0, position(0) - middle(0);
    return moves;
  };
  Eigen::MatrixXd G = Eigen::MatrixXd::Zero(shared.rows(), 3);
  for (std::size_t n = 0; n < map.landmarks.size(); ++n)
    if (const Eigen::Index column = map.columns[n]; column >= 0)
      G.middleRows<2>(column) = motions_at(map.landmarks[n]);
  const Eigen::Matrix3d M = G.transpose() * G;
  const Eigen::LDLT<Eigen::Matrix3d> factor(M);
  if (!(M(2, 2) > 0.0)) return false;
  // The motion that a rigid fit of the landmarks takes back: F times their errors.
  const Eigen::MatrixXd F = factor.solve(G.transpose());
  const Eigen::Matrix3d motion = F * shared * F.transpose();
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Eigen::Matrix<double, 2, 3> moves = motions_at(map.poses[i].head<2>());
    const Eigen::Matrix2d cross = moves * (F * shared_pose[i].leftCols<2>());
    poses[i].topLeftCorner<2, 2>() +=
        moves * motion * moves.transpose() - cross - cross.transpose();
  }
  const Eigen::MatrixXd P = Eigen::MatrixXd::Identity(shared.rows(), shared.rows()) - G * F;
  shared = (P * shared * P.transpose()).eval();
  return true;
}

}  // namespace mapproof
