#include "reports/diff/folder_diff.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/base/parallel.hpp"
#include "core/base/text/words.hpp"
#include "reports/diff/diff_result.hpp"
#include "reports/diff/documents/document_diff.hpp"
#include "reports/diff/item_diff.hpp"
#include "reports/diff/items.hpp"
#include "reports/diff/records/record_set.hpp"
#include "reports/diff/shared_causes.hpp"
#include "reports/diff/swapped_items.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

/// Folders of records, by the id of their item: the path itself, or those directly below it.
std::map<std::string, fs::path> record_locations(const fs::path& path) {
  std::map<std::string, fs::path> locations;
  std::error_code error;
  if (holds_records(path)) locations["records"] = path;
  if (!fs::is_directory(path, error) || !locations.empty()) return locations;
  for (fs::directory_iterator entry(path, error), end; !error && entry != end;
       entry.increment(error))
    if (entry->is_directory(error) && holds_records(entry->path()))
      locations["records/" + entry->path().filename().string()] = entry->path();
  return locations;
}

DiffItem compare_records(const std::string& id, const fs::path& baseline, const fs::path& current,
                         const DiffSettings& settings) {
  DiffItem item;
  item.id = id;
  item.kind = ItemKind::kRecords;
  try {
    const RecordSets sets = read_records(baseline, current);
    item.records = record_diff(sets.baseline, sets.current, settings.records);
    item.judgement = item.records->judgement;
  } catch (const IoError& error) {
    item.judgement = {Verdict::kUnreadable, true, error.what()};
  }
  item.passes = passes(item.judgement, settings.allowed_of(item.id));
  return item;
}

DiffItem lone_records(const std::string& id, Judgement judgement) {
  DiffItem item;
  item.id = id;
  item.kind = ItemKind::kRecords;
  item.judgement = std::move(judgement);
  return item;
}

/// The ids of the records of either side.
std::vector<std::string> record_ids(const fs::path& baseline, const fs::path& current) {
  std::set<std::string> ids;
  for (const fs::path* side : {&baseline, &current})
    for (const auto& [id, path] : record_locations(*side)) ids.insert(id);
  return {ids.begin(), ids.end()};
}

/// Throws if the settings have a tolerance of a quantity that none of the records has, and all
/// records were read.
void check_tolerances(const std::vector<DiffItem>& items, const DiffSettings& settings) {
  const auto is_read = [](const DiffItem& item) { return item.records.has_value(); };
  if (items.empty() || !std::ranges::all_of(items, is_read)) return;
  for (const auto& [id, tolerance] : settings.records.tolerances) {
    const auto has_it = [&named = id](const DiffItem& item) {
      return std::ranges::find(item.records->declared, named, &Quantity::id) !=
             item.records->declared.end();
    };
    if (find_quantity(id) == nullptr && id != kOtherNumbers && std::ranges::none_of(items, has_it))
      throw InvalidInput(
          fmt::format("the settings have a tolerance of the quantity \"{}\", which none of the "
                      "compared studies has",
                      id));
  }
}

std::vector<DiffItem> record_items(const fs::path& baseline, const fs::path& current,
                                   const DiffSettings& settings) {
  const auto is_left_out = [&](const auto& entry) { return !settings.compares(entry.first, ""); };
  auto before = record_locations(baseline), after = record_locations(current);
  std::erase_if(before, is_left_out);
  std::erase_if(after, is_left_out);
  std::vector<DiffItem> items;
  for (const auto& [id, path] : before) {
    const auto other = after.find(id);
    if (other != after.end()) {
      items.push_back(compare_records(id, path, other->second, settings));
      continue;
    }
    items.push_back(lone_records(id, {Verdict::kMissing, true, "the current has no records"}));
  }
  for (const auto& [id, path] : after)
    if (!before.contains(id))
      items.push_back(lone_records(id, {Verdict::kNew, true, "the baseline has no records"}));
  for (DiffItem& item : items) item.passes = passes(item.judgement, settings.allowed_of(item.id));
  check_tolerances(items, settings);
  return items;
}

void check_there(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error))
    throw IoError(path.string(), error ? error.message() : "does not exist");
  if (!fs::is_directory(path, error)) require_file(path);
}

/// Requires two files of one kind, each of them the item "".
void check_kinds(const ItemList& baseline, const ItemList& current, const fs::path& a,
                 const fs::path& b) {
  std::error_code error;
  const bool first = fs::is_directory(a, error), second = fs::is_directory(b, error);
  if (first != second)
    throw InvalidInput(fmt::format("{} is a {}, {} a {}: they cannot be compared", a.string(),
                                   first ? "folder" : "file", b.string(),
                                   second ? "folder" : "file"));
  if (first || baseline.empty() || current.empty()) return;
  const ItemFiles& x = baseline.begin()->second;
  const ItemFiles& y = current.begin()->second;
  const bool same_kind =
      x.figure.empty() == y.figure.empty() && x.images.size() == y.images.size() &&
      std::ranges::equal(x.documents, y.documents, {}, &decltype(x.documents)::value_type::first,
                         &decltype(x.documents)::value_type::first) &&
      std::ranges::equal(x.images, y.images, {}, &decltype(x.images)::value_type::first,
                         &decltype(x.images)::value_type::first);
  if (!same_kind)
    throw InvalidInput(a.string() + " and " + b.string() +
                       " are files of different kinds: they cannot be compared");
}

/// "fig-7.png": what a single file is called.
std::string file_id(const fs::path& path) { return item_name(path, path.parent_path()).id; }

std::vector<DiffItem> image_items(const ItemList& baseline, const ItemList& current,
                                  const std::string& name, const RecordContext& context,
                                  const DiffSettings& settings) {
  std::set<std::string> ids;
  for (const ItemList* side : {&baseline, &current})
    for (const auto& [id, files] : *side)
      if (files.documents.empty()) ids.insert(id);
  const std::vector<std::string> order(ids.begin(), ids.end());
  std::vector<DiffItem> items(order.size());
  HeatMapRoom room(settings.heat_map_bytes);
  parallel_for(order.size(), [&](std::size_t i) {
    const auto before = baseline.find(order[i]);
    const auto after = current.find(order[i]);
    const ItemSides sides{before == baseline.end() ? nullptr : &before->second,
                          after == current.end() ? nullptr : &after->second};
    items[i] = item_diff(order[i].empty() ? name : order[i], sides, context, settings, room);
  });
  return items;
}

/// Whether a side is a study without figures, as `mapproof run` leaves it.
/// @param lacks  The verdict on records that are missing on this side.
bool holds_records_alone(const ItemList& side, const std::vector<DiffItem>& records,
                         Verdict lacks) {
  return side.empty() && std::ranges::any_of(records, [&](const DiffItem& item) {
           return item.judgement.verdict != lacks;
         });
}

/// One item for a report that is missing in the current as a whole.
DiffItem missing_report(std::size_t items, const std::string& current,
                        const DiffSettings& settings) {
  DiffItem item;
  item.id = "report";
  item.kind = ItemKind::kDocument;
  item.judgement = {
      Verdict::kMissing, true,
      fmt::format("the current has no report: {} of the baseline, figures, tables "
                  "and pages, are missing; mapproof report {} makes them",
                  counted(static_cast<long long>(items), "item"), printable(current))};
  item.passes = passes(item.judgement, settings.allowed_of(item.id));
  return item;
}

/// "1 data, worse, 51 identical. The first is fig-7: …", which ends with its cause.
Judgement judge_whole(const DiffResult& result) {
  Judgement whole;
  whole.visible = false;
  for (const DiffItem& item : result.items) {
    whole.verdict = heavier(whole.verdict, item.judgement.verdict);
    whole.visible |= item.judgement.visible;
  }
  if (whole.verdict == Verdict::kIdentical) return whole;
  whole.cause = counts_and_first(result) + ": " + result.items[0].judgement.cause;
  return whole;
}

/// Names the images that nothing here decodes.
void remark_not_compared(const std::vector<DiffItem>& items, DiffResult& result) {
  std::vector<std::string> names;
  for (const DiffItem& item : items)
    for (const ImageFile& file : item.images)
      if (is_not_compared(file.format)) names.push_back(printable(item.id) + "." + file.format);
  if (!names.empty())
    result.remarks.push_back("Compared only by their bytes:  " + listed(names, 12) + ".");
}

/// Names what the settings leave out, and those of them that match nothing.
void remark_selection(const Selection& selection, DiffResult& result) {
  constexpr std::size_t kMostNames = 12;
  std::vector<std::string> left_out;
  for (const std::string& id : selection.left_out) left_out.push_back(printable(id));
  if (!left_out.empty())
    result.remarks.push_back(fmt::format("Left out, {} by the settings:  {}.",
                                         counted(static_cast<long long>(left_out.size()), "item"),
                                         listed(left_out, kMostNames)));
  if (!selection.unmatched.empty())
    result.remarks.push_back(
        "Settings that match nothing:  " + listed(selection.unmatched, kMostNames) + ".");
}

/// Names the figures that do not show their records any more.
void remark_stale(const std::vector<DiffItem>& items, DiffResult& result) {
  constexpr std::size_t kMostNames = 6;
  std::vector<std::string> names;
  for (const DiffItem& item : items)
    if (item.is_stale) names.push_back(printable(item.id));
  if (!names.empty())
    result.remarks.push_back(fmt::format(
        "Stale:  {} did not change although the records that {} did: {} to be drawn again.",
        listed(names, kMostNames), names.size() == 1 ? "it shows" : "they show",
        names.size() == 1 ? "it has" : "they have"));
}

/// Sorts the items and judges the whole.
void conclude(DiffResult& result) {
  std::ranges::stable_sort(result.items, std::ranges::greater(),
                           [](const DiffItem& item) { return item.judgement.verdict; });
  result.shared = shared_causes(result.items);
  result.judgement = judge_whole(result);
  result.passes =
      std::ranges::all_of(result.items, [](const DiffItem& item) { return item.passes; });
}

}  // namespace

DiffResult folder_diff(const fs::path& baseline, const fs::path& current,
                       const DiffSettings& settings) {
  check_there(baseline);
  check_there(current);
  for (const fs::path& side : {baseline, current}) refuse_links_out(side);
  DiffResult result;
  result.baseline = baseline.string();
  result.current = current.string();
  result.allowed = settings.allowed;
  ComparedItems sides{.baseline = list_items(baseline),
                      .current = list_items(current),
                      .record_ids = record_ids(baseline, current),
                      .file_name = file_id(current)};
  ItemList &before = sides.baseline, &after = sides.current;
  check_kinds(before, after, baseline, current);
  join_keyed(before, after);
  const Selection selection = select_items(sides, settings);
  result.items = record_items(baseline, current, settings);
  RecordContext context;
  for (const DiffItem& item : result.items)
    if (item.records) context.records.push_back(&*item.records);
  const std::vector<DiffItem>& records = result.items;
  const bool lacks_report =
      holds_records_alone(after, records, Verdict::kMissing) && before.size() > 1;
  if (holds_records_alone(before, records, Verdict::kNew) && !after.empty()) {
    result.remarks.push_back(fmt::format(
        "The baseline was made without figures, tables and report: {} of the current not compared.",
        after.size() == 1 ? "one is" : fmt::format("{} are", after.size())));
    after.clear();
  }
  const std::size_t lacking = lacks_report ? before.size() : 0;
  if (lacks_report) before.clear();
  std::vector<DiffItem> images = image_items(before, after, sides.file_name, context, settings);
  name_swapped(images, settings);
  remark_not_compared(images, result);
  remark_stale(images, result);
  remark_selection(selection, result);
  std::ranges::move(images, std::back_inserter(result.items));
  if (lacks_report) result.items.push_back(missing_report(lacking, result.current, settings));
  add_documents(result.items, before, after, sides.file_name, settings);
  if (result.items.empty() && !selection.left_out.empty())
    throw InvalidInput("the settings leave out everything: there is nothing to compare");
  if (result.items.empty())
    throw InvalidInput(baseline.string() + " and " + current.string() +
                       "  hold no records, figures or images to compare");
  conclude(result);
  return result;
}

bool holds_items(const fs::path& folder) {
  return !record_locations(folder).empty() || !list_items(folder).empty();
}

void judge_records_as(DiffResult& result, const Judgement& judgement) {
  const auto records = std::ranges::find(result.items, ItemKind::kRecords, &DiffItem::kind);
  if (records == result.items.end()) return;
  const std::string follows = follows_from(*records);
  records->judgement = judgement;
  records->passes = passes(judgement, result.allowed);
  for (DiffItem& item : result.items)
    for (std::string* cause : {&item.judgement.cause, &item.judgement.shared_cause})
      if (cause->starts_with(follows)) *cause = follows + judgement.cause;
  conclude(result);
}

void rename_files(DiffResult& result,
                  const std::function<std::string(const std::string& text)>& renamed) {
  const auto rename = [&](std::string& text) { text = renamed(text); };
  rename(result.judgement.cause);
  std::ranges::for_each(result.remarks, rename);
  for (SharedCause& shared : result.shared) rename(shared.cause);
  for (DiffItem& item : result.items) {
    rename(item.judgement.cause);
    for (ImageFile& image : item.images) rename(image.diff.reason);
  }
}

DiffResult no_baseline(const fs::path& baseline, const fs::path& current,
                       const DiffSettings& settings) {
  DiffResult result;
  result.has_baseline = false;
  result.baseline = baseline.string();
  result.current = current.string();
  result.allowed = settings.allowed;
  result.items.push_back(lone_records(
      "baseline", {Verdict::kMissing, true,
                   fmt::format("there is no baseline {}; the candidate is kept in {}",
                               printable(result.baseline), printable(result.current))}));
  ComparedItems sides{.baseline = {},
                      .current = list_items(current),
                      .record_ids = record_ids(baseline, current),
                      .file_name = file_id(current)};
  for (const std::string& id : sides.record_ids)
    if (settings.compares(id, ""))
      result.items.push_back(
          lone_records(id, {Verdict::kNew, true, "the baseline has no records"}));
  remark_selection(select_items(sides, settings), result);
  std::ranges::move(image_items({}, sides.current, sides.file_name, {}, settings),
                    std::back_inserter(result.items));
  add_documents(result.items, {}, sides.current, sides.file_name, settings);
  for (DiffItem& item : result.items)
    item.passes = item.judgement.verdict == Verdict::kNew &&
                  passes(item.judgement, settings.allowed_of(item.id));
  conclude(result);
  return result;
}

}  // namespace mapproof
