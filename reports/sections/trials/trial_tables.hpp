#pragma once

#include <vector>

#include "reports/model/report.hpp"
#include "reports/sections/trials/trial_means.hpp"

namespace mapproof {

/// The tables of one setup: of simulated runs one a quantity, a row a series and a column a level
/// with its interval; of data sets one, a row a series and the quantities of each set side by side.
/// Ids begin with id_prefix().
std::vector<Table> trial_tables(const TrialStudy& study, const TrialSetup& setup);

/// Seconds of each series on each data set; empty of a simulated study, or without any.
std::vector<Table> trial_seconds_tables(const TrialStudy& study);

}  // namespace mapproof
