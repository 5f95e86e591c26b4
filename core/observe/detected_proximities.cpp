#include "core/observe/detected_proximities.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"

namespace mapproof {
namespace {

/// One sensor's measurement; visibility: 1. NaN: none.
double value_of(const Detection& seen, Sensor sensor) {
  if (sensor == Sensor::kVisibility) return 1.0;
  return sensor == Sensor::kRange ? seen.range_m * seen.range_m : seen.bearing_rad;
}

/// Mean squared range of each landmark; zero for other sensors.
Eigen::VectorXd means_of(const DetectionLog& log, Sensor sensor) {
  const auto M = static_cast<Eigen::Index>(log.names.size());
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(M);
  Eigen::VectorXd counts = Eigen::VectorXd::Zero(M);
  for (const Detection& seen : log.detections) {
    if (seen.landmark < 0 || seen.landmark >= M)
      throw InvalidInput("a detection names a landmark that its log does not have");
    const double value = value_of(seen, sensor);
    if (sensor != Sensor::kRange || std::isnan(value)) continue;
    sums(seen.landmark) += value;
    counts(seen.landmark) += 1.0;
  }
  return sums.cwiseQuotient(counts.cwiseMax(1.0));
}

/// Sums over each pair's common scans, both triangles.
struct CommonScans {
  Eigen::MatrixXd counts;
  Eigen::MatrixXd products;  ///< Of the vectors' entries.
  Eigen::MatrixXd squares;   ///< (i, j): of i's entries.
};

CommonScans common_scans(const DetectionLog& log, Sensor sensor) {
  const auto M = static_cast<Eigen::Index>(log.names.size());
  const Eigen::VectorXd means = means_of(log, sensor);
  CommonScans sums{.counts = Eigen::MatrixXd::Zero(M, M),
                   .products = Eigen::MatrixXd::Zero(M, M),
                   .squares = Eigen::MatrixXd::Zero(M, M)};
  for (auto first = log.detections.begin(); first != log.detections.end();) {
    const auto last = std::find_if(first, log.detections.end(),
                                   [&](const Detection& seen) { return seen.step != first->step; });
    for (auto a = first; a != last; ++a) {
      const double x = value_of(*a, sensor) - means(a->landmark);
      if (std::isnan(x)) continue;
      for (auto b = first; b != last; ++b) {
        const double y = value_of(*b, sensor) - means(b->landmark);
        if (std::isnan(y)) continue;
        const bool is_bearing = sensor == Sensor::kBearing;
        sums.counts(a->landmark, b->landmark) += 1.0;
        sums.products(a->landmark, b->landmark) += is_bearing ? std::cos(x - y) : x * y;
        sums.squares(a->landmark, b->landmark) += is_bearing ? 1.0 : x * x;
      }
    }
    first = last;
  }
  return sums;
}

/// Cosines of the angles between rows of 0 and 1, all of them known.
Proximities of_visibility(const CommonScans& sums) {
  const Eigen::ArrayXd counts = sums.counts.diagonal();
  const Eigen::ArrayXXd scale = (counts.matrix() * counts.matrix().transpose()).array().sqrt();
  Proximities result;
  result.inner_products = (scale > 0.0).select(sums.products.array() / scale, 0.0);
  result.squared_distances = (2.0 - 2.0 * result.inner_products.array()).max(0.0);
  result.apart_squared = 2.0;
  return result;
}

}  // namespace

Proximities detected_proximities(const DetectionLog& log, Sensor sensor) {
  const CommonScans sums = common_scans(log, sensor);
  Proximities result;
  if (sensor == Sensor::kVisibility) {
    result = of_visibility(sums);
  } else {
    const Eigen::ArrayXXd scale = static_cast<double>(log.steps) / sums.counts.array().max(1.0);
    result.inner_products = sums.products.array() * scale;
    result.squared_distances =
        ((sums.squares + sums.squares.transpose() - 2.0 * sums.products).array() * scale).max(0.0);
    result.squared_distances =
        (sums.counts.array() > 0.0).select(result.squared_distances, kInfinity);
  }
  result.squared_distances.diagonal().setZero();
  return result;
}

}  // namespace mapproof
