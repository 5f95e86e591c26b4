#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/model/trial_study.hpp"
#include "core/statistics/intervals.hpp"

namespace mapproof {

/// What one series came to at one level of one setup: over all runs, or on one data set.
struct TrialCell {
  std::string setup;
  std::string series;
  double level = 0.0;
  std::string part;  ///< Id of the data set; empty: over the simulated runs.
  int tried = 0;     ///< Parts with such a trial.
  std::vector<std::optional<MeanEstimate>> means;  ///< One a quantity, over the finite values.
  std::map<StatusCode, int> statuses;              ///< How many trials carry each.
};

/// Every combination that was tried, in the order of setups, series, levels and parts.
std::vector<TrialCell> trial_cells(const TrialStudy& study);

/// Those of one setup and series.
std::vector<const TrialCell*> cells_of(const std::vector<TrialCell>& cells,
                                       const std::string& setup, const std::string& series);

/// Whether the parts are data sets rather than simulated runs.
bool is_of_data(const TrialStudy& study);

/// Places after the point that tell the values of a quantity apart: three significant digits of
/// their median.
int decimals_of(const std::vector<TrialCell>& cells, std::size_t quantity);

/// The study's name as the beginning of ids: [a-z][a-z0-9-]*.
std::string id_prefix(const TrialStudy& study);

}  // namespace mapproof
