#pragma once

#include "core/model/slam_study.hpp"
#include "core/range_slam/known_landmarks.hpp"

namespace mapproof {

/// The length that the constants of the range-only methods take for 30 m: the median range. With
/// lengths in it a log gives the same map whatever its unit.
double unit_of(const RangeLog& log);

/// All lengths of a log times a factor, > 0.
RangeLog in_unit(RangeLog log, double factor);

/// All lengths of a run's results times a factor, > 0; its log is put in place of the run's.
void take_unit(SlamRun& run, RangeLog log, double factor);

}  // namespace mapproof
