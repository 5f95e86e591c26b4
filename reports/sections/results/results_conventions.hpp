#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "reports/sections/results/results_view.hpp"

namespace mapproof {

/// More panels than these are too narrow to be read.
inline constexpr std::size_t kMostPanels = 4;

/// "study-setup-mpe-m": the id of a figure or table in a block, at most kLongestId long.
std::string id_below(const std::string& block, std::string what);

/// The id of the section that begins a study's report, and of the group of figures in it.
std::string summary_id(const std::string& study);

/// Of the line's marks.
std::string key_of(std::size_t line);

/// The subject of all results of the block's setup: a diff finds them by it.
std::string record_of(const ResultsBlock& block);

/// A value in words with its unit, without the unit where this is a power of ten.
/// @param unit          Of the value: the quantity's, or one that a figure scales it to.
/// @param great_errors  Whether an error in m beyond kGreatestError_m is of a map that
///                      diverged, and is "over 1 km": see ResultsView::has_great_errors().
std::string value_words(double value, const std::string& unit, bool great_errors);

/// A value by itself, in its own unit: "20.1 µs" of a study whose times are in ms. Lengths stay in
/// metres, in which tables have them.
std::string lone_value(double value, const Quantity& quantity, bool great_errors);

/// "MPE between 0.1 m and 0.2 m; odometry over 1 km; too few runs to rank the methods": contents
/// cut long entries at their end, so that what differs between figures stands first.
/// @param diverged    As of diverged_words(); may be empty.
/// @param not_ranked  Why; may be empty.
std::string range_title(const std::string& range, const std::string& diverged,
                        const std::string& not_ranked);

/// Whether the values need a logarithmic axis.
bool spans_widely(const std::vector<double>& values);

bool is_known(double value);

/// "Regret with anchors" as "regret with anchors". Names keep their case, those with a digit, a
/// second capital or one letter: "MPE", "F1 of closures", "F-score", "RoC area". "MOE, reflection
/// allowed" is "MOE (reflection allowed)".
std::string in_sentence(std::string label);

/// The coverage that 95 % ellipses are meant to have [%]: more is as wrong as less. Nothing of
/// other quantities.
std::optional<double> aim_of(const Quantity& quantity);

/// Whether one side of the quantity is better: findings then name methods.
bool has_better_side(const Quantity& quantity);

/// A distance from the results of another method, which are 0 of that method itself.
bool is_distance_from_another(const Quantity& quantity);

}  // namespace mapproof
