#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "reports/history/history_store.hpp"

namespace mapproof {

/// Which nights are kept: the last ones, and of the others every so many.
struct PruneRule {
  int last = 0;   ///< >= 1.
  int every = 0;  ///< Nights whose number is a multiple; 0: none.
};

/// "last=30" or "last=30,every=7". @throws InvalidInput for anything else.
PruneRule parse_prune_rule(const std::string& text);

/// The nights that the rule removes, ascending. Pinned nights, and those that a kept night was
/// compared with, stay.
std::vector<int> nights_to_remove(std::span<const NightFacts> nights, const PruneRule& rule);

/// What pruning did.
struct Pruned {
  std::vector<int> nights;
  int files = 0;  ///< Figures that no night names any more.
};

/// The folder of a night in a store: "nights/0012".
std::filesystem::path night_folder(const std::filesystem::path& store, int night);

/// Removes the folders of nights, then the nights and the figures that no other night has. After a
/// kill or an error in between the next one finishes it. @throws IoError.
Pruned prune(HistoryStore& history, const std::filesystem::path& store, const PruneRule& rule);

}  // namespace mapproof
