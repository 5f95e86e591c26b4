#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reports/diff/diff_result.hpp"
#include "reports/diff/diff_settings.hpp"

namespace mapproof {

/// The images of one file that is not identical, as paths below a folder; empty: none.
struct ItemImages {
  std::string id, format;       ///< "png"; "change": a figure of what changed in the data.
  std::string difference = {};  ///< A PNG: the heat map (heat_map() in image_diff.hpp).
  std::string current = {}, baseline = {};
  std::string unreadable = {};  ///< Why the file cannot be read; it then has no paths.

  std::vector<std::string> paths() const;  ///< Those that exist, in this order.
};

/// Where outputs find such images.
struct ImageLinks {
  std::vector<ItemImages> images;  ///< In the order of the items.
  std::string prefix;              ///< Put before "/" and a path; empty: the paths are relative.

  /// The images of an item.
  std::vector<const ItemImages*> of(const std::string& id) const;
  std::string joined(const std::string& path) const;
};

/// Writes the images of each item that is neither identical nor within tolerance:
/// ID.FORMAT/baseline.FORMAT, /current.FORMAT as they are, and /difference.png if both can be
/// compared pixel by pixel. A file of which a side cannot be read has none. And where data changed,
/// ID.change/difference.png: change_figure(). In names, bytes other than letters, digits and
/// "-._/@+" are "%XX". The folder is locked meanwhile. What an earlier call wrote to it is removed
/// first, also if that was stopped.
/// @throws IoError; InvalidInput if the folder holds files, but none of an earlier call.
/// @note Compares the images of one file after the other again.
std::vector<ItemImages> write_item_images(const DiffResult& result, const DiffSettings& settings,
                                          const std::filesystem::path& folder);

}  // namespace mapproof
