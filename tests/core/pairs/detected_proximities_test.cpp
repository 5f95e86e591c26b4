#include "core/observe/detected_proximities.hpp"

#include <gtest/gtest.h>

#include "tests/support/samples/scans.hpp"
#include "tests/support/samples/worlds.hpp"

namespace mapproof {
namespace {

TEST(DetectedProximities, AreThoseOfTheArray) {
  DetectionLog log = test::scans_at(test::scattered(14, 2), 120, 3, 2);
  log.detections[5].range_m = std::numeric_limits<double>::quiet_NaN();
  log.detections[8].bearing_rad = std::numeric_limits<double>::quiet_NaN();
  for (const Sensor sensor : {Sensor::kVisibility, Sensor::kBearing, Sensor::kRange}) {
    const Proximities sparse = detected_proximities(log, sensor);
    const Proximities dense = proximities(history_of(log, sensor), log.steps);
    EXPECT_EQ(sparse.apart_squared, dense.apart_squared);
    for (Eigen::Index i = 0; i < 14; ++i)
      for (Eigen::Index j = 0; j < 14; ++j) {
        const double distance = dense.squared_distances(i, j);
        EXPECT_EQ(std::isinf(sparse.squared_distances(i, j)), std::isinf(distance));
        if (std::isinf(distance)) continue;
        EXPECT_NEAR(sparse.squared_distances(i, j), distance, 1e-9);
        EXPECT_NEAR(sparse.inner_products(i, j), dense.inner_products(i, j), 1e-9);
      }
  }
}

}  // namespace
}  // namespace mapproof
