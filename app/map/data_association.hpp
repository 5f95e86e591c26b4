#pragma once

#include <string>
#include <vector>

#include "core/records/observations/observations.hpp"

namespace mapproof {

/// Whose a reading was found to be.
struct AssignedReading {
  double step = 0.0;     ///< Number of the step, as the file has it, or the column from 0.
  std::size_t line = 0;  ///< Of the file; 0: not known.
  std::string given;     ///< The label in the file: "?" if it had none.
  std::string found;     ///< The landmark.
  double value = 0.0;    ///< As the history has it: rad, m, or 0 and 1.
  bool clear = false;    ///< No exchange within its step would be nearly as likely.
};

/// What came of estimating labels.
struct EstimatedLabels {
  std::vector<AssignedReading> readings;  ///< Of unlabelled ones all, of unsure ones the changed.
  std::vector<std::string> remarks;
  std::vector<std::string> warnings;
};

/// Finds, together with the map, whose the readings without a label are, and those under labels
/// that are confused with one another (see estimated_correspondence), and puts them in their place.
///
/// @param unsure  Labels any of whose readings may be of any other of them; empty: none.
/// @throws IoError naming the line or the step for what cannot be estimated: an entry that is
///         missing though there is no reading for it, more readings than landmarks without one,
///         a label that is not there; or for fewer than two unsure labels.
EstimatedLabels estimate_labels(ObservationSource& source, const std::vector<std::string>& unsure);

/// RFC 4180: step,line,given,landmark,value,clear.
std::string labels_csv(const EstimatedLabels& labels);

}  // namespace mapproof
