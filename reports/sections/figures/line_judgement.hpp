#pragma once

#include <cstddef>
#include <vector>

#include "core/model/method.hpp"
#include "core/model/score.hpp"
#include "core/results/values_by_run.hpp"
#include "render/figures/curves/error_lines.hpp"
#include "reports/sections/figures/figure_source.hpp"

namespace mapproof {

/// What titles of a mapping study's figures go by: how the paired test judges their lines, each at
/// one point (see paired_methods.hpp).

/// A point of a line, and the errors of the runs that it is the mean of.
struct PointOfRuns {
  ErrorLine* line = nullptr;
  std::size_t index = 0;
  ValuesByRun runs;
};

void judge(std::vector<PointOfRuns> points, const GroupsByRun& layouts);

/// A point that is the mean of a setting at the last checkpoint.
struct PointOfSetting {
  ErrorLine* line = nullptr;
  std::size_t index = 0;
  MethodSetting setting;
};

/// @param error  What the points are means of.
void judge(const std::vector<PointOfSetting>& points, double Score::*error,
           const SensorStudy& sensor, FigureSource& source);

}  // namespace mapproof
