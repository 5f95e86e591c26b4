#pragma once

#include <optional>
#include <span>

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

/// Of MPE, m: small errors, ours or a paper's, need a place more.
int mpe_decimals(std::span<const SettingSummary> summaries);

/// Of positions, by their extent: 3, or as many as show a thousandth of it.
int position_decimals(const Points& positions);

/// A coordinate; missing if it is not finite.
Cell position_cell(double coordinate, int decimals);

/// What the intervals of a table rest on.
std::string interval_note(bool any_interval);

}  // namespace mapproof
