#include "core/base/angle.hpp"

#include <cmath>
#include <numbers>

namespace mapproof {

double wrapped(double angle_rad) {
  constexpr double kPi = std::numbers::pi;
  const double angle = std::remainder(angle_rad, 2.0 * kPi);
  return angle > -kPi ? angle : kPi;
}

}  // namespace mapproof
