#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "reports/history/night.hpp"
#include "reports/model/report.hpp"

namespace mapproof {

/// As many findings of a study stand at the head of a page and on the console; its page over the
/// nights has all.
inline constexpr std::size_t kMostTold = 3;

/// "Nothing got worse than on night 3.", "Accuracy got worse: 2 findings.", "Not compared: …"
std::string verdict_sentence(const NightFacts& night, std::size_t findings);

/// How a study of a judged night stands: its first findings, and how many more there are.
/// @param findings     Of that night; those of other studies are left out.
/// @param is_compared  Whether the night of reference has the study, ordered in the same way.
Standing study_standing(const NightFacts& night, std::span<const NightFinding> findings,
                        const std::string& study, bool is_compared);

/// How all studies of a night stand: the first findings of each, after its name.
Standing night_standing(const NightFacts& night, std::span<const NightFinding> findings);

}  // namespace mapproof
