#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/model/fit.hpp"
#include "render/plot/figure.hpp"

namespace mapproof {

struct FitResidualsSpec {
  std::string id;  ///< [a-z][a-z0-9-]*.
  std::string title;
  std::span<const FittedRange> ranges;
  std::span<const std::string> landmarks;  ///< Their names, by row.
  std::string verdict;                     ///< A sentence, under the title.
  bool is_alarm = false;                   ///< The sentence is a warning.
  std::string record_id;
};

/// What a fit leaves of the ranges, in standard deviations: over time and over the range. Up to six
/// landmarks have a colour each, more have one. Of many ranges some are drawn, evenly spread;
/// residuals beyond 6 stand at 6.
Figure fit_residuals_figure(const FitResidualsSpec& spec);

}  // namespace mapproof
