#pragma once

#include <string>
#include <vector>

namespace mapproof {

/// Where an axis is marked and what stands there.
struct Ticks {
  std::vector<double> at;           ///< Ascending, within the range asked for.
  std::vector<std::string> labels;  ///< As many; equal numbers of decimals, U+2212 for minus.
  std::vector<double> minor;        ///< Without a label, on a log axis.
  std::string factor;   ///< "×10⁶" to multiply the labels by, "+ 5,821,200" to add; or empty.
  double unit = 1.0;    ///< Of the factor: a label is (value − offset) / unit.
  double offset = 0.0;  ///< Of the factor.
};

/// The least step 1, 2 or 5 × 10^k that puts at most `most` (>= 2) marks into [low, high].
double tick_step(double low, double high, int most);

/// Multiples of `step` > 0 in [low, high]. Labels far from 0 for their extent leave out an offset.
Ticks linear_ticks(double low, double high, double step);

/// Decades in [low, high], 0 < low < high, thinned to about `most`; with 2s and 5s between them if
/// there are fewer than three; linear ticks if there is less than that. All labels are plain
/// numbers, or all powers of ten where one would be longer than five digits.
Ticks log_ticks(double low, double high, int most);

/// Three of them, far from each other, for a frame that has no room for more; log_ticks() where
/// there are no three.
Ticks three_log_ticks(double low, double high);

}  // namespace mapproof
