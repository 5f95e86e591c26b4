#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "reports/history/nightly_run.hpp"
#include "reports/model/report.hpp"

namespace mapproof {

/// Number of findings of a study shown at the head of a page and on the console; its trend page
/// lists all.
inline constexpr std::size_t kMostReported = 3;

/// "Nothing got worse than in nightly run 3.", "Accuracy got worse: 2 findings.", "Not compared: …"
std::string verdict_sentence(const NightlyFacts& nightly_run, std::size_t findings);

/// The verdict on a study of a judged nightly run: its first findings, and how many more there are.
/// @param findings     Of that nightly run; those of other studies are left out.
/// @param is_compared  Whether the reference run has the study, ordered in the same way.
Standing study_standing(const NightlyFacts& nightly_run, std::span<const NightlyFinding> findings,
                        const std::string& study, bool is_compared);

/// The verdict on all studies of a nightly run: the first findings of each, after its name.
Standing nightly_standing(const NightlyFacts& nightly_run,
                          std::span<const NightlyFinding> findings);

}  // namespace mapproof
