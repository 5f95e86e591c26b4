#pragma once

#include "reports/diff/records/record_diff.hpp"

namespace mapproof {

/// The verdict on all of it, and its cause in one sentence.
Judgement judge(const RecordDiff& diff);

/// The comparison of those that says most: the heaviest outcome, MPE before others, the least p.
/// Null if there is none.
const Comparison* most_telling(const std::vector<const Comparison*>& comparisons);

/// " (errors: 1 worse, 3 better)" where they point both ways, and `first`, the most telling of
/// them, has no test that tells more; else empty.
std::string directions_text(const std::vector<const Comparison*>& all, const Comparison& first);

/// "space.json is missing"; "maps/layout-1-pose-2.json: 2 numbers differ, the first at …".
std::string other_text(const OtherDiff& other);

/// What the outcome makes of a thing.
Verdict verdict_of(Outcome outcome);

/// "seed 0 → 5", "K = 6 → K = 7 of bearing/isomap/2000": what the experiments differ in; empty if
/// nothing.
std::string settings_text(const RecordDiff& diff);

}  // namespace mapproof
