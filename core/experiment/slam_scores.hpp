#pragma once

#include "core/model/slam_study.hpp"

namespace mapproof {

/// Lays an estimate on the truth of a log by `first` and takes its errors, under this and every
/// weaker alignment that means something. Nothing without a truth.
void score_against_truth(SlamRecord& record, const RangeLog& log, Alignment first);

/// Lays an estimate on a path, rigidly, with mirror if it is free to.
void lay_on(SlamEstimate& estimate, const Trajectory& path, bool may_mirror);

}  // namespace mapproof
