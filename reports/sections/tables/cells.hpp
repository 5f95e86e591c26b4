#pragma once

#include <optional>
#include <vector>

#include "core/model/method.hpp"
#include "core/model/points.hpp"
#include "core/statistics/intervals.hpp"
#include "reports/model/report.hpp"
#include "reports/sections/method_summary.hpp"

namespace mapproof {

/// Decimals of MOE, %.
inline constexpr int kMoeDecimals = 2;

/// The method's label, without its parameter.
Cell method_cell(Method method);

/// "K = 6"; missing without a parameter.
Cell parameter_cell(const std::optional<MethodSetting>& setting);

/// Missing without an estimate.
Cell mean_cell(const std::optional<MeanEstimate>& estimate, int decimals, bool with_sign = false);

/// The interval of an error, cut at 0; missing if it has none.
Cell interval_cell(const std::optional<MeanEstimate>& estimate, int decimals);

/// The interval of a difference, which may reach below 0; missing if it has none.
Cell difference_interval_cell(const std::optional<MeanEstimate>& estimate, int decimals);

/// Decimals of a column of these values: those that give the least three significant digits, as
/// sentences have them, but at most two more than give them to the median.
int decimals_of(std::vector<double> sizes);

/// The same of errors in m, but at least 3; those of maps that diverged have no digits.
int error_decimals(std::vector<double> errors_m);

/// The same of the MPE of a study, one number for all of its tables: by the best of each method
/// with each sensor and by what a paper printed for it.
int mpe_decimals(const Study& study);

/// Decimals of a number that a paper printed: those that it needs, or those of three significant
/// digits, which papers print at least.
int printed_decimals(double printed);

/// Of positions, by their extent: 3, or as many as show a thousandth of it.
int position_decimals(const Points& positions);

/// A coordinate; missing if it is not finite.
Cell position_cell(double coordinate, int decimals);

/// Drops the columns that show nothing in any row, as tests of a single run.
void drop_empty_columns(Table& table);

/// What the intervals of a table rest on.
std::string interval_note(bool any_interval);

}  // namespace mapproof
