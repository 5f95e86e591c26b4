#pragma once

#include "core/model/slam_study.hpp"
#include "reports/model/report.hpp"

namespace mapproof {

/// What the study found on each log, in short: a pure function of the values.
Section slam_summary_section(const SlamStudy& study);

}  // namespace mapproof
