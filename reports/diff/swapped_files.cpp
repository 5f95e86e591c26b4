#include "reports/diff/swapped_files.hpp"

#include <map>
#include <system_error>

#include <fmt/format.h>

#include "reports/diff/records/record_files.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

struct BaselineFile {
  const DiffItem* item;
  fs::path path;
};

/// Files by their size: only those can be equal.
using BySize = std::multimap<std::uintmax_t, BaselineFile>;

bool is_suspect(const DiffItem& item) { return item.judgement.verdict > Verdict::kWithinTolerance; }

void add(BySize& files, const DiffItem& item, const fs::path& path) {
  std::error_code error;
  if (path.empty()) return;
  const std::uintmax_t size = fs::file_size(path, error);
  if (!error && size > 0) files.emplace(size, BaselineFile{&item, path});
}

/// The item whose baseline file has these bytes; null if there is none, or if the item's own has
/// them too: a file that did not change was not swapped, whoever else has its like.
const DiffItem* owner_of(const fs::path& own, const fs::path& current, const DiffItem& self,
                         const BySize& files) {
  std::error_code error;
  if (current.empty() || (!own.empty() && same_bytes(own, current))) return nullptr;
  const auto [first, last] = files.equal_range(fs::file_size(current, error));
  if (error) return nullptr;
  for (auto file = first; file != last; ++file)
    if (file->second.item != &self && file->second.path.extension() == current.extension() &&
        same_bytes(file->second.path, current))
      return file->second.item;
  return nullptr;
}

/// The first file of the item that belongs to another one.
const DiffItem* owner_of(const DiffItem& item, const BySize& files) {
  if (const DiffItem* owner = owner_of(item.baseline_figure, item.current_figure, item, files))
    return owner;
  for (const PictureFile& picture : item.pictures)
    if (const DiffItem* owner = owner_of(picture.baseline, picture.current, item, files))
      return owner;
  return nullptr;
}

}  // namespace

void name_swapped(std::vector<DiffItem>& items, std::span<const Verdict> allowed) {
  BySize files;
  for (const DiffItem& item : items) {
    if (!is_suspect(item)) continue;
    add(files, item, item.baseline_figure);
    for (const PictureFile& picture : item.pictures) add(files, item, picture.baseline);
  }
  std::vector<std::pair<DiffItem*, std::string>> words;
  std::map<std::string, std::string> renamed;
  for (DiffItem& item : items) {
    if (!is_suspect(item)) continue;
    const DiffItem* owner = owner_of(item, files);
    if (owner == nullptr) continue;
    const bool is_rename =
        item.judgement.verdict == Verdict::kNew && owner->judgement.verdict == Verdict::kMissing;
    words.emplace_back(
        &item, is_rename ? fmt::format("the baseline has it as {}: renamed", owner->id)
                         : fmt::format("its file is the baseline's {}: swapped", owner->id));
    if (is_rename) renamed[owner->id] = item.id;
  }
  for (auto& [item, text] : words) {
    Judgement& told = item->judgement;
    // No renderer did it, and no other styles: the picture is another one.
    told.cause = told.verdict == Verdict::kRenderer ? text : told.cause + "; " + text;
    if (told.verdict != Verdict::kNew) told.verdict = heavier(told.verdict, Verdict::kChanged);
    told.visible = true;
    item->passes = passes(told, allowed);
  }
  for (DiffItem& item : items)
    if (const auto to = renamed.find(item.id);
        to != renamed.end() && item.judgement.verdict == Verdict::kMissing)
      item.judgement.cause += fmt::format("; the current has it as {}: renamed", to->second);
}

}  // namespace mapproof
