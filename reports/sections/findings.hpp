#pragma once

#include <span>
#include <string>

#include "core/model/study.hpp"
#include "reports/model/report.hpp"
#include "reports/sections/half_choice.hpp"
#include "reports/sections/method_summary.hpp"

namespace mapproof {

/// The least published error among the methods that were tried; null if none was published.
const SettingSummary* best_published(std::span<const SettingSummary> methods);

/// The findings of the runs of one sensor as sentences, the most important first: the best method,
/// the order of the methods, how near the printed values are, whether the paper's orderings hold,
/// how optimistic its choice of parameters is. Each only where it applies.
///
/// @param methods  A summary a method, at its best parameter; one at least has a score.
BulletList sensor_findings(const Study& study, const SensorStudy& sensor,
                           std::span<const SettingSummary> methods);

/// "on runs that had no part in the choice MPE is higher for 5 of 8 methods, most for LLE, by 9.0
/// %; the median is +2.1 %."; empty where no method had a choice.
std::string optimism_words(const HalfChoices& choices);

}  // namespace mapproof
