#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "core/base/not_finite.hpp"

namespace mapproof {

/// The least and the greatest of the finite values that it is shown.
struct Span {
  double low = kInfinity;
  double high = -kInfinity;

  void see(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  void see(std::span<const double> values) {
    for (const double value : values) see(value);
  }
  /// Whether there was any.
  bool known() const { return low <= high; }
};

}  // namespace mapproof
