#include "core/simulate/range_noise.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/errors.hpp"

namespace mapproof {

Eigen::MatrixXd simulated_ranges(const Eigen::MatrixXd& landmarks_m,
                                 const Eigen::MatrixXd& positions_m,
                                 const SimulatedRangeNoise& noise, Random& random) {
  if (landmarks_m.cols() != positions_m.cols())
    throw InvalidInput("landmarks and positions must be of one dimension");
  if (!(noise.sigma_m >= 0.0 && noise.share >= 0.0))
    throw InvalidInput("noise must not be negative");
  if (!(noise.correlation >= 0.0 && noise.correlation < 1.0))
    throw InvalidInput("the correlation of noise must be at least 0 and below 1");
  const double rho = noise.correlation;
  const double fresh = std::sqrt(1.0 - rho * rho);
  Eigen::MatrixXd ranges_m(landmarks_m.rows(), positions_m.rows());
  for (Eigen::Index n = 0; n < ranges_m.rows(); ++n) {
    double error = random.normal();
    for (Eigen::Index t = 0; t < ranges_m.cols(); ++t) {
      if (t > 0) error = rho * error + fresh * random.normal();
      const double range = (landmarks_m.row(n) - positions_m.row(t)).norm();
      const double sigma = std::hypot(noise.sigma_m, noise.share * range);
      ranges_m(n, t) = std::max(0.0, range + sigma * error);
    }
  }
  return ranges_m;
}

}  // namespace mapproof
