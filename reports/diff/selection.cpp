#include "reports/diff/selection.hpp"

#include <algorithm>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "core/base/errors.hpp"

namespace mapproof {
namespace {

/// "figure.json" or "scene.json".
std::string figure_format(const ItemFiles& files) {
  return files.figure.filename().string().ends_with(".scene.json") ? "scene.json" : "figure.json";
}

/// The formats of all files of an item.
std::vector<std::string> formats_of(const ItemFiles& files) {
  std::vector<std::string> formats;
  if (!files.figure.empty()) formats.push_back(figure_format(files));
  for (const auto& [format, by_key] : files.images) formats.push_back(format);
  for (const auto& [format, file] : files.documents) formats.push_back(format);
  return formats;
}

/// Removes the files that are not compared. @return The ids of items without any other.
std::set<std::string> reduce(ItemList& side, const std::string& file_name,
                             const DiffSettings& settings) {
  std::set<std::string> left_out;
  for (auto item = side.begin(); item != side.end();) {
    ItemFiles& files = item->second;
    const std::string& id = item->first.empty() ? file_name : item->first;
    const auto is_left_out = [&](const auto& entry) { return !settings.compares(id, entry.first); };
    std::erase_if(files.images, is_left_out);
    std::erase_if(files.documents, is_left_out);
    if (!files.figure.empty() && !settings.compares(id, figure_format(files))) files.figure.clear();
    if (formats_of(files).empty()) {
      left_out.insert(id);
      item = side.erase(item);
    } else {
      ++item;
    }
  }
  return left_out;
}

/// The names that a pattern can match.
struct Names {
  std::set<std::string> ids, files;  ///< Files: "ID.FORMAT".

  bool any_id(const std::string& pattern) const { return any(ids, pattern); }
  bool any_name(const std::string& pattern) const { return any_id(pattern) || any(files, pattern); }

 private:
  static bool any(const std::set<std::string>& names, const std::string& pattern) {
    return std::ranges::any_of(
        names, [&](const std::string& name) { return matches_glob(pattern, name); });
  }
};

Names names_of(const ComparedItems& items) {
  Names names;
  names.ids.insert(items.record_ids.begin(), items.record_ids.end());
  for (const ItemList* side : {&items.baseline, &items.current})
    for (const auto& [id, files] : *side) {
      const std::string& shown = id.empty() ? items.file_name : id;
      names.ids.insert(shown);
      for (const std::string& format : formats_of(files)) names.files.insert(shown + "." + format);
    }
  return names;
}

std::vector<std::string> unmatched_patterns(const Names& names, const DiffSettings& settings) {
  std::vector<std::string> unmatched;
  const auto add = [&](std::string_view where, const std::string& pattern) {
    unmatched.push_back(fmt::format("{} \"{}\"", where, printable(pattern)));
  };
  for (const std::string& pattern : settings.include)
    if (!names.any_name(pattern)) add("--include", pattern);
  for (const std::string& pattern : settings.exclude)
    if (!names.any_name(pattern)) add("--exclude", pattern);
  // What is meant for all items is not misspelt.
  for (const IgnoredRegion& region : settings.ignored)
    if (region.id != "*" && !names.any_id(region.id)) add("ignore", region.id);
  for (const ItemSettings& item : settings.items)
    if (item.id != "*" && !names.any_id(item.id)) add("items", item.id);
  const auto repeated = std::ranges::unique(unmatched);
  unmatched.erase(repeated.begin(), repeated.end());
  return unmatched;
}

}  // namespace

Selection select_items(ComparedItems& items, const DiffSettings& settings) {
  Selection selection{.left_out = {}, .unmatched = unmatched_patterns(names_of(items), settings)};
  std::set<std::string> left_out = reduce(items.baseline, items.file_name, settings);
  left_out.merge(reduce(items.current, items.file_name, settings));
  for (const std::string& id : items.record_ids)
    if (!settings.compares(id, "")) left_out.insert(id);
  // A file of the item may be compared on the other side, as a new or a missing one.
  for (const ItemList* side : {&items.baseline, &items.current})
    for (const auto& [id, files] : *side) left_out.erase(id.empty() ? items.file_name : id);
  selection.left_out.assign(left_out.begin(), left_out.end());
  return selection;
}

}  // namespace mapproof
