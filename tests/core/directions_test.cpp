#include "core/observe/features.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace mapproof {
namespace {

TEST(Directions, AreThoseOfLibmToTwoUnitsOfTheLastDigit) {
  std::vector<double> angles;
  for (int k = -40'000; k <= 40'000; ++k) {
    angles.push_back(1e-4 * k);
    angles.push_back(M_PI_4 * k);
    angles.push_back(std::nextafter(M_PI_2 * k, 0.0));
  }
  angles.push_back(1e-300);
  angles.push_back(-0.0);
  std::vector<double> cosines(angles.size()), sines(angles.size());
  directions_of(angles, cosines, sines);
  for (std::size_t i = 0; i < angles.size(); ++i) {
    ASSERT_NEAR(cosines[i], std::cos(angles[i]), 2.3e-16) << angles[i];
    ASSERT_NEAR(sines[i], std::sin(angles[i]), 2.3e-16) << angles[i];
  }
}

TEST(Directions, AreNotANumberWhereTheAngleIsNone) {
  const std::vector<double> angles = {1.0, std::nan(""), 2.0};
  std::vector<double> cosines(3), sines(3);
  directions_of(angles, cosines, sines);
  EXPECT_TRUE(std::isnan(cosines[1]) && std::isnan(sines[1]));
  EXPECT_NEAR(cosines[2], std::cos(2.0), 2.3e-16);
}

}  // namespace
}  // namespace mapproof
