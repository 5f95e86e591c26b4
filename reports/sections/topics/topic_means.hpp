#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/topic_study.hpp"
#include "core/statistics/intervals.hpp"

namespace mapproof {

/// A outcome's value of a quantity; NaN if nothing came out or the quantity does not apply.
double topic_value(const TopicOutcome& outcome, std::string_view quantity);

/// What all parts of a study came to for one quantity, over them all: for conclusions.
///
/// @return Of the finite values alone, in the order of the parts.
/// @throws InvalidInput if the design has no such quantity.
std::vector<double> topic_values(const TopicStudy& study, const Condition& at,
                                 std::string_view method, std::string_view quantity);

/// Their mean; NaN without any.
double topic_mean(const TopicStudy& study, const Condition& at, std::string_view method,
                  std::string_view quantity);

/// "noise of bearings 20°", "observations 2000": the levels of a condition of the setup with what
/// they are of; empty if it has no factors.
std::string level_words(const TopicSetup& setup, const Condition& at);

/// The label of a method of the design; its id if there is none of it.
std::string series_label(const TopicDesign& design, std::string_view id);

/// "share missing [%]", "observations".
std::string label_with_unit(const SetupFactor& factor);

/// "a, b and c", all of them.
std::string all_listed(const std::vector<std::string>& words);

/// How far one method is from another, run by run: `method` less `other` wherever both have a
/// value.
/// @return Its mean, and the 95 % interval over layouts (none with one layout); empty without any
///         pair.
std::optional<MeanEstimate> topic_difference(const TopicStudy& study, const Condition& at,
                                             std::string_view method, std::string_view other,
                                             std::string_view quantity);

/// The same over several conditions together.
std::optional<MeanEstimate> topic_difference(const TopicStudy& study,
                                             const std::vector<Condition>& conditions,
                                             std::string_view method, std::string_view other,
                                             std::string_view quantity);

/// The conditions of all setups and levels.
std::vector<Condition> all_conditions(const TopicStudy& study);

/// How many layouts the parts of a study are of.
int layouts_of(const TopicStudy& study);

/// Whether runs are of too few layouts for an interval (see kFewestGroups).
bool has_few_layouts(const TopicStudy& study);

/// "; too few runs to test differences, in 2 layouts", the end of a sentence; empty if they are
/// not.
std::string few_layouts_words(const TopicStudy& study);

/// Whether the runs of a difference are of too few layouts.
bool has_few_layouts(const MeanEstimate& difference);

/// Whether the interval of a difference leaves 0 out, over as many layouts as one needs.
bool is_apart_from_0(const MeanEstimate& difference);

/// Whether that interval is below 0, of a quantity that is better if lower.
bool is_better(const MeanEstimate& difference);

/// "better", "worse" or "not significantly different", of a quantity that is better if lower; of
/// too few layouts for an interval "too few runs to test the difference, in 2 layouts".
std::string verdict_words(const MeanEstimate& difference);

}  // namespace mapproof
