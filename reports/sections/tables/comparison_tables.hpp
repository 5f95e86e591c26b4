#pragma once

#include <span>

#include "reports/model/report.hpp"
#include "reports/sections/half_choice.hpp"
#include "reports/sections/method_ranks.hpp"

namespace mapproof {

/// The parameter chosen on one half of the runs, the error from the other.
Table half_table(const SensorStudy& sensor, const HalfChoices& choices);

/// Mean ranks over layouts, Friedman's test and the significant differences by Nemenyi's.
Table rank_table(const SensorStudy& sensor, const MethodRanks& ranks);

/// The paper's orderings, each compared with the runs.
Table ordering_table(const SensorStudy& sensor, std::span<const OrderingClaim> claims);

}  // namespace mapproof
