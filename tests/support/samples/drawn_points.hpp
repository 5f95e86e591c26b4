#pragma once

#include <Eigen/Core>

#include "core/base/random.hpp"

namespace mapproof::test {

// Points drawn at random. The second coordinate is drawn first whatever the compiler, which would
// choose the order of a call's arguments.

inline Eigen::RowVector2d uniform_point(Random& random, double least, double most) {
  const double y = random.uniform(least, most);
  return {random.uniform(least, most), y};
}

inline Eigen::RowVector2d normal_point(Random& random) {
  const double y = random.normal();
  return {random.normal(), y};
}

}  // namespace mapproof::test
