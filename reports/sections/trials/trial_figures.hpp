#pragma once

#include "core/model/trial_study.hpp"
#include "reports/sections/study_figures.hpp"

namespace mapproof {

/// The figures of a study of trials: for each setup with levels a curve figure a quantity, and the
/// maps. Ids begin with the study's name: "missing-at-random-mpe-m", "missing-map-ID". The groups
/// are the setups, and "NAME-maps".
StudyFigures trial_figures(const TrialStudy& study);

}  // namespace mapproof
