#include "core/linalg/sign.hpp"

#include <cmath>

namespace mapproof {

void fix_signs(Eigen::Ref<Eigen::MatrixXd> columns) {
  for (Eigen::Index k = 0; k < columns.cols(); ++k) {
    const double largest = columns.col(k).cwiseAbs().maxCoeff();
    for (Eigen::Index i = 0; i < columns.rows(); ++i) {
      if (std::abs(columns(i, k)) < largest * (1.0 - 1e-8)) continue;
      if (columns(i, k) < 0.0) columns.col(k) = -columns.col(k);
      break;
    }
  }
}

}  // namespace mapproof
