#pragma once

#include <string>

#include "core/records/observations/sources.hpp"

namespace mapproof {

/// What was understood of a user's file, in numbers.
struct InputSummary {
  long long landmarks = 0;
  long long steps = 0;
  std::string sensor;          ///< "bearing", "range-bearing".
  double missing_share = 0.0;  ///< Of landmarks times steps: not measured; of lists: not listed.
  long long detections = 0;    ///< Of a list of them; 0: a table of landmarks and steps.
  TableReading reading;
};

InputSummary summary_of(const ObservationSource& source);
InputSummary summary_of(const PackedSource& source);
/// @param sensor  What is taken of the detections.
InputSummary summary_of(const DetectionSource& source, const std::string& sensor);

}  // namespace mapproof
