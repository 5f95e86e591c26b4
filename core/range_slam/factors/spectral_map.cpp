#include "core/range_slam/factors/spectral_map.hpp"

namespace mapproof {

Points landmarks_of(const Eigen::MatrixXd& C) { return C.middleCols(1, 2); }

Points positions_of(const Eigen::MatrixXd& X) { return -X.middleRows(1, 2).transpose(); }

SpacePoints space_landmarks_of(const Eigen::MatrixXd& C) { return C.middleCols(1, 3); }

SpacePoints space_positions_of(const Eigen::MatrixXd& X) { return -X.middleRows(1, 3).transpose(); }

}  // namespace mapproof
