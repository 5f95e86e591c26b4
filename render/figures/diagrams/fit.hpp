#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/model/fit.hpp"
#include "render/plot/figure.hpp"

namespace mapproof {

/// A test of the fit as a row.
struct FitTestRow {
  std::string label;   ///< "common offset", "offset of 7".
  std::string key;     ///< [a-z0-9-]+, unique.
  double ratio = 0.0;  ///< Statistic over bound; above 1 it is an alarm. Not finite: no mark.
  bool is_cause = false;
};

struct FitTestsSpec {
  std::string id;  ///< [a-z][a-z0-9-]*.
  std::string title;
  std::string verdict;           ///< A sentence, under the title.
  bool is_alarm = false;         ///< The sentence is a warning.
  std::vector<FitTestRow> rows;  ///< Of more than 16 the greatest ratios are drawn.
  std::vector<std::string> record_ids;
};

/// Each test of the fit of a map to its data: its statistic over its bound, on a logarithmic axis,
/// the greatest first. What is too small for the axis stands at its end as a mark of its own.
Figure fit_tests_figure(const FitTestsSpec& spec);

struct FitResidualsSpec {
  std::string id;  ///< [a-z][a-z0-9-]*.
  std::string title;
  std::span<const FittedRange> ranges;
  std::span<const std::string> landmarks;  ///< Their names, by row.
  std::string verdict;                     ///< A sentence, under the title.
  bool is_alarm = false;                   ///< The sentence is a warning.
  std::string record_id;
};

/// The number of ranges whose normalised residual is beyond 3: "12 of 3529 ranges beyond 3 sigma".
std::string far_residuals_text(std::span<const FittedRange> ranges);

/// What a fit leaves of the ranges, in standard deviations: over time and over the range. Up to six
/// landmarks have a colour each, more have one. Of many ranges some are drawn, evenly spread;
/// residuals beyond 6 stand at 6.
Figure fit_residuals_figure(const FitResidualsSpec& spec);

}  // namespace mapproof
