#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "reports/history/history_store.hpp"

namespace mapproof {

/// Which nightly runs are kept: the last ones, and of the others every so many.
struct PruneRule {
  int last = 0;   ///< >= 1.
  int every = 0;  ///< Nightly runs whose number is a multiple; 0: none.
};

/// "last=30" or "last=30,every=7". @throws InvalidInput for anything else.
PruneRule parse_prune_rule(const std::string& text);

/// The nightly runs that the rule removes, ascending. Pinned references, and those that a kept
/// nightly run was compared with, stay.
std::vector<int> nightly_runs_to_remove(std::span<const NightlyFacts> nightly_runs,
                                        const PruneRule& rule);

/// What pruning did.
struct Pruned {
  std::vector<int> nightly_runs;
  int files = 0;  ///< Figures that no nightly run names any more.
};

/// The folder of a nightly run in a store: "nightly_runs/0012".
std::filesystem::path nightly_folder(const std::filesystem::path& store, int nightly_run);

/// Removes the folders of nightly runs, then the nightly runs and the figures that no other nightly
/// run has. After a kill or an error in between, the next prune finishes it. @throws IoError.
Pruned prune(HistoryStore& history, const std::filesystem::path& store, const PruneRule& rule);

}  // namespace mapproof
