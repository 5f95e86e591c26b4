#pragma once

#include <functional>

#include "core/model/study.hpp"
#include "reports/sections/study_figures.hpp"

namespace mapproof::test {

/// A study of `layouts` x `poses` runs without any solver: two sensors, all four methods, and
/// scores by a formula, so that means and intervals have closed forms:
///   mpe = base(method, parameter) * (1 + .1 * layout + .01 * pose) * 200 / step^(1/2).
/// Some records carry statuses; one run of Isomap, K = 4 failed.
Study synthetic_study(int layouts = 5, int poses = 2);

/// The mpe that `synthetic_study` gives that record.
double synthetic_mpe(const MethodSetting& setting, const RunId& run, int step);

/// All maps of one run of it: 12 landmarks on a grid, estimates displaced by the mpe.
std::vector<MapRecord> synthetic_maps(const Study& study, const RunId& run);

/// Seconds and one session, as a store would give them.
std::vector<Timing> synthetic_timings(const Study& study);
std::vector<Session> synthetic_sessions();

/// The figures of it, without details of its runs.
StudyFigures synthetic_figures(const Study& study);

}  // namespace mapproof::test
