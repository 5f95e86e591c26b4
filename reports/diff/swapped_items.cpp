#include "reports/diff/swapped_items.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/words.hpp"
#include "reports/diff/records/record_set.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

bool is_suspect(const DiffItem& item) { return item.judgement.verdict > Verdict::kWithinTolerance; }

/// The baseline's files by their bytes.
class BaselineFiles {
 public:
  explicit BaselineFiles(const BytesOfFile& read) : read_(read) {}

  void add(const DiffItem& item, const fs::path& path) {
    std::error_code error;
    if (path.empty()) return;
    const std::uintmax_t size = fs::file_size(path, error);
    if (!error && size > 0) of_size_[size].files.push_back({&item, path});
  }

  /// The other item whose baseline file has these bytes. Null if there is none, or if the item's
  /// own baseline file has them too: a file that did not change was not swapped.
  const DiffItem* owner_of(const fs::path& own, const fs::path& current, const DiffItem& self) {
    std::error_code error;
    if (current.empty()) return nullptr;
    const auto same_size = of_size_.find(fs::file_size(current, error));
    if (error || same_size == of_size_.end()) return nullptr;
    const std::optional<std::size_t> hash = hash_of(current);
    if (!hash) return nullptr;
    const auto [first, last] = hashed(same_size->second).equal_range(*hash);
    const DiffItem* owner = nullptr;
    for (auto at = first; at != last; ++at) {
      const File& file = same_size->second.files[at->second];
      const bool is_own = file.item == &self && file.path == own;
      const bool is_candidate =
          owner == nullptr && file.item != &self && file.path.extension() == current.extension();
      if ((!is_own && !is_candidate) || !same_bytes(file.path, current)) continue;
      if (is_own) return nullptr;
      owner = file.item;
    }
    return owner;
  }

 private:
  struct File {
    const DiffItem* item;
    fs::path path;
  };
  /// Only files of one size can be equal. They are read when the first file is compared with them.
  struct OfOneSize {
    std::vector<File> files;
    std::optional<std::multimap<std::size_t, std::size_t>> by_hash = {};
  };

  std::optional<std::size_t> hash_of(const fs::path& path) const {
    try {
      return std::hash<std::string_view>{}(read_(path));
    } catch (const IoError&) {
      return std::nullopt;  // It equals none.
    }
  }

  const std::multimap<std::size_t, std::size_t>& hashed(OfOneSize& same_size) const {
    if (!same_size.by_hash) {
      same_size.by_hash.emplace();
      for (std::size_t i = 0; i < same_size.files.size(); ++i)
        if (const std::optional<std::size_t> hash = hash_of(same_size.files[i].path))
          same_size.by_hash->emplace(*hash, i);
    }
    return *same_size.by_hash;
  }

  const BytesOfFile& read_;
  std::map<std::uintmax_t, OfOneSize> of_size_;
};

/// Another item to which files of an item belong.
struct Owner {
  const DiffItem* item = nullptr;
  std::vector<std::string> formats;  ///< "value" for its figure.json.
};

/// The first other item to which a file of the item belongs, and all files that do.
Owner owner_of(const DiffItem& item, BaselineFiles& files) {
  Owner owner;
  const auto note = [&](const fs::path& own, const fs::path& current, const std::string& format) {
    const DiffItem* found = files.owner_of(own, current, item);
    if (found == nullptr || (owner.item != nullptr && owner.item != found)) return;
    owner.item = found;
    owner.formats.push_back(format);
  };
  note(item.baseline_figure, item.current_figure, "value");
  for (const ImageFile& image : item.images) note(image.baseline, image.current, image.format);
  return owner;
}

}  // namespace

void name_swapped(std::vector<DiffItem>& items, const DiffSettings& settings,
                  const BytesOfFile& read) {
  if (std::ranges::none_of(items, is_suspect)) return;
  BaselineFiles files(read);
  for (const DiffItem& item : items) {
    files.add(item, item.baseline_figure);
    for (const ImageFile& image : item.images) files.add(item, image.baseline);
  }
  std::vector<std::pair<DiffItem*, std::string>> words;
  std::map<std::string, std::string> renamed;
  for (DiffItem& item : items) {
    if (!is_suspect(item)) continue;
    const Owner owner = owner_of(item, files);
    if (owner.item == nullptr) continue;
    const bool is_rename = item.judgement.verdict == Verdict::kNew &&
                           owner.item->judgement.verdict == Verdict::kMissing;
    words.emplace_back(
        &item, is_rename ? fmt::format("the baseline has it as {}: renamed", owner.item->id)
                         : fmt::format("its {} {} {} in the baseline: swapped",
                                       listed(owner.formats, owner.formats.size() + 1),
                                       owner.formats.size() == 1 ? "is that of" : "are those of",
                                       owner.item->id));
    if (is_rename) renamed[owner.item->id] = item.id;
  }
  for (auto& [item, text] : words) {
    Judgement& reported = item->judgement;
    reported.cause = reported.verdict == Verdict::kNew ? reported.cause + "; " + text : text;
    if (reported.verdict != Verdict::kNew)
      reported.verdict = heavier(reported.verdict, Verdict::kChanged);
    reported.visible = true;
    item->passes = passes(reported, settings.allowed_of(item->id));
  }
  for (DiffItem& item : items)
    if (const auto to = renamed.find(item.id);
        to != renamed.end() && item.judgement.verdict == Verdict::kMissing)
      item.judgement.cause += fmt::format("; the current has it as {}: renamed", to->second);
}

}  // namespace mapproof
