#pragma once

#include <span>
#include <string>
#include <string_view>

#include "reports/model/report.hpp"
#include "reports/sections/half_choice.hpp"
#include "reports/sections/method_ranks.hpp"
#include "reports/sections/method_summary.hpp"

namespace mapproof {

/// Tables of one sensor's methods, each a pure function.
///
/// @param best  A summary a method, at its best parameter.
/// @param all   A summary a method and parameter.
/// @param mpe_decimals  Of every MPE but the printed ones (see cells.hpp).

/// The id of one of a sensor's tables. Where the experiment names the table of its paper, "table-1"
/// for the kind "accuracy" and "table-1-half" for "half"; else "accuracy-bearing", "half-bearing".
std::string paper_table_id(const SensorStudy& sensor, std::string_view kind);

/// Every method at its best parameter compared with the paper's best [yairi2007, tables 1 and 2].
Table accuracy_table(const SensorStudy& sensor, std::span<const SettingSummary> best, bool grid,
                     int mpe_decimals);

/// Every method that was published at the parameter that was published: nothing is chosen by us.
Table paper_parameter_table(const SensorStudy& sensor, std::span<const SettingSummary> all,
                            int mpe_decimals);

/// What the means hide: medians, the anchors' share in the error, runs with warnings or failures.
Table spread_table(const SensorStudy& sensor, std::span<const SettingSummary> best,
                   int mpe_decimals);

Table parameter_table(const SensorStudy& sensor, std::span<const SettingSummary> all,
                      int mpe_decimals);

/// The parameter chosen on one half of the runs, the error from the other.
Table half_table(const SensorStudy& sensor, const HalfChoices& choices, int mpe_decimals);

/// Mean ranks over layouts, Friedman's test and the significant differences by Nemenyi's.
Table rank_table(const SensorStudy& sensor, const MethodRanks& ranks, int mpe_decimals);

std::string ordering_table_id(const SensorStudy& sensor);

/// The paper's orderings, each compared with the runs.
Table ordering_table(const SensorStudy& sensor, std::span<const OrderingClaim> claims,
                     int mpe_decimals);

}  // namespace mapproof
