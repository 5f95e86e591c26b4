#pragma once

#include <span>
#include <string>
#include <vector>

#include "reports/history/nightly_summary.hpp"

namespace mapproof {

/// What an Atom feed holds.
struct FeedFacts {
  std::string identifier;                 ///< Of the history (HistoryStore::identifier()).
  std::vector<NightlySummary> summaries;  ///< Of the nightly runs, the last one first.
  std::string nightly_runs = {};  ///< Where nightly_runs/ lies, from the feed's folder: "../store/".
};

/// An Atom feed [rfc4287] of nightly runs, one entry each: its title, its findings with their
/// commits, and what was noted on it, as plain text. Links are relative to the feed.
std::string nightly_feed(const FeedFacts& facts);

}  // namespace mapproof
