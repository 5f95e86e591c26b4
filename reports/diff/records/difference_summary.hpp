#pragma once

#include <string>
#include <vector>

#include "reports/diff/records/record_comparison.hpp"

namespace mapproof {

/// How the values of one quantity differ over all records.
struct QuantityDifferences {
  Quantity quantity;
  long records = 0;  ///< With a value that differs beyond tolerance.
  long worse = 0;    ///< Of them, those whose mean became worse; 0 without a direction.
  long better = 0;
  /// Quantiles over the records of the current mean divided by the baseline's: 10 %, 50 %, 90 %;
  /// NaN: no record has a positive mean on both sides.
  double low = 0.0, median = 0.0, high = 0.0;
};

/// The quantities that differ beyond tolerance, in the order of the dictionary.
std::vector<QuantityDifferences> difference_summary(const RecordDiff& diff);

/// "MPE: 276 records differ, 190 worse, 86 better; current / baseline 1.08 (10 to 90 % of them:
/// 0.61 to 2.3)".
std::string differences_text(const QuantityDifferences& differences);

}  // namespace mapproof
