#pragma once

#include <string>
#include <vector>

#include "reports/diff/diff_settings.hpp"
#include "reports/diff/items.hpp"

namespace mapproof {

/// The two sides of a comparison and the names in them.
struct ComparedItems {
  ItemList baseline, current;
  std::vector<std::string> record_ids;  ///< Of either side.
  std::string file_name;                ///< The id of the item "" of two single files.
};

/// What the settings do to the items of a comparison.
struct Selection {
  std::vector<std::string> left_out;  ///< Ids, sorted: of these nothing is compared.
  /// Patterns that match neither an item nor a file of one, as `--exclude "map-*"`: they may be
  /// misspelt.
  std::vector<std::string> unmatched;
};

/// Removes from both sides the files that the settings leave out, and items without any file.
Selection select_items(ComparedItems& items, const DiffSettings& settings);

}  // namespace mapproof
