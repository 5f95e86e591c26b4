#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace mapproof {

/// The files of one item on one side.
struct ItemFiles {
  std::filesystem::path figure;  ///< ID.figure.json or ID.scene.json; empty: none.
  /// By format ("png", "svg", "pdf", and those that are not compared: "jpg", "gif", …) and baseline
  /// key. The plain file has the key "".
  std::map<std::string, std::map<std::string, std::filesystem::path>> images;
  /// Files of a table or a page, by format: "csv", "md", "tex", "html". The item then has no
  /// others.
  std::map<std::string, std::filesystem::path> documents;
};

/// Items by id.
using ItemList = std::map<std::string, ItemFiles>;

/// Lists the images, figures, tables and reports of a folder and of those below it, or a single
/// file as the item "". Where the name of a single file does not determine its kind, its first
/// bytes do. The id is the path below the folder without a leading "figures/" and without the
/// extension; a report keeps the whole path: "report.html".
/// @throws IoError if the folder cannot be listed, or holds more than 100,000 such files; or if a
///         single file cannot be read.
ItemList list_items(const std::filesystem::path& path);

/// Treats "ID@KEY" of the baseline as another valid baseline of ID, where the current has ID and no
/// "ID@KEY".
void join_keyed(ItemList& baseline, const ItemList& current);

/// Whether images of the format are compared by what they show.
bool is_decoded(std::string_view kind);

/// Formats of images that are compared by their bytes alone, as nothing here decodes them.
bool is_not_compared(std::string_view kind);

/// The type of an image that browsers show: "image/png"; empty: they show none of this format.
std::string_view media_type(std::string_view format);

/// The id of a file below `folder` and its kind, in lower case: "png", "svg", "figure.json", "pdf",
/// "scene.json", of tables (in a folder "tables") "csv", "md", "tex", of reports "html"; an empty
/// kind if the file does not belong to an item.
struct ItemName {
  std::string id, kind;
};
ItemName item_name(const std::filesystem::path& file, const std::filesystem::path& folder);

}  // namespace mapproof
