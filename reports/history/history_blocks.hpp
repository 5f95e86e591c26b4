#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reports/history/finding_groups.hpp"
#include "reports/history/nightly_links.hpp"
#include "reports/model/report.hpp"

namespace mapproof {

/// What pages show at most: groups of findings in a section, whose rest the trends have; links to
/// nightly runs in one sentence, whose rest the index has; small figures on a first screen.
inline constexpr std::size_t kMostGroups = 30, kMostLinked = 10, kMostSmall = 6;

/// "See all nightly runs, trends of tiny, report of nightly run 9, which it was compared with."
/// @param reference  What it was compared with, if anything.
Paragraph ways(std::vector<Phrase> to, const std::optional<Phrase>& reference);

/// What got worse in one group, and where to find it.
/// @param to  Links to pages on it.
FindingBlock finding_block(const FindingGroup& group, std::vector<Phrase> to, NightlyLinks& links);

/// Those of its groups of findings that a page shows.
std::span<const FindingGroup> shown_groups(std::span<const FindingGroup> groups);

/// Adds that others are with the findings of the trends; nothing if a page shows all.
/// @param groups  How many there are in all.
void add_rest(std::size_t groups, Section& section);

}  // namespace mapproof
