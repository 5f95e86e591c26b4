#include "reports/html/diff/diff_html.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <kainjow/mustache.hpp>

#include "core/base/errors.hpp"
#include "core/base/text/words.hpp"
#include "core/base/version.hpp"
#include "reports/diff/approvals/approvals.hpp"
#include "reports/diff/diff_result.hpp"
#include "reports/diff/shared_causes.hpp"
#include "reports/diff/tables/image_tables.hpp"
#include "reports/diff/tables/item_blocks.hpp"
#include "reports/html/block_data.hpp"
#include "reports/html/page_folds.hpp"
#include "reports/html/page_frame.hpp"
#include "reports/html/sha256.hpp"
#include "reports/model/format.hpp"
#include "reports/model/page_text.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;
using kainjow::mustache::data;
using kainjow::mustache::list;

constexpr std::size_t kMostName = 300;    // Characters.
constexpr std::size_t kMostPath = 80;     // Characters.
constexpr std::size_t kMostCause = 2000;  // Characters.

/// What a page calls one side.
struct SideName {
  std::string side;   ///< "baseline", "current", "heat" or "change".
  std::string title;  ///< For readers.
  std::string path;   ///< As the user named the side; empty: it is neither.
};

/// One image.
data pane_data(const ShownImage& image, const SideName& name, const std::string& id) {
  const std::string& title = name.title;
  data out;
  out.set("side", name.side);
  out.set("title", title);
  out.set("path", text_or_false(printable(name.path, kMostPath)));
  out.set("uri", image.uri);
  out.set("alt", title + " of " + id);
  std::string note = image.size ? size_text(*image.size) : "";
  if (!image.note.empty()) note += (note.empty() ? "" : ", ") + printable(image.note, kMostName);
  out.set("note", note);
  out.set("sized", image.size.has_value());
  out.set("width", fmt::format("{}", image.size ? image.size->width : 0));
  out.set("height", fmt::format("{}", image.size ? image.size->height : 0));
  return out;
}

data stage_data(const DiffItem& item, const ShownImages& shown, const DiffResult& all) {
  if (shown.format.empty()) return data(false);
  const std::string id = printable(item.id, kMostName);
  list panes;
  if (shown.baseline)
    panes.push_back(pane_data(*shown.baseline, {"baseline", "Baseline", shown_baseline(all)}, id));
  if (shown.current)
    panes.push_back(pane_data(*shown.current, {"current", "Current", shown_current(all)}, id));
  data out;
  out.set("both", shown.baseline.has_value() && shown.current.has_value());
  out.set("has_heat", shown.heat.has_value());
  out.set("drawn", !item.baseline_figure.empty() || !item.current_figure.empty());
  if (shown.heat) panes.push_back(pane_data(*shown.heat, {"heat", "Heat map", ""}, id));
  out.set("panes", panes);
  out.set("format", shown.format);
  return out;
}

data change_data(const ShownImages& shown, const std::string& id) {
  if (!shown.change) return data(false);
  const SideName name{"change", "What changed", ""};
  data out = pane_data(*shown.change, name, id);
  out.set("narrow", shown.narrow_change ? pane_data(*shown.narrow_change, name, id) : data(false));
  return out;
}

data cluster_data(const ShownImages& shown) {
  if (!shown.cluster) return data(false);
  const PixelBox& box = *shown.cluster;
  data out;
  out.set("box", fmt::format("{} {} {} {}", box.x, box.y, box.width, box.height));
  out.set("size", fmt::format("{} {}", shown.cluster_in.width, shown.cluster_in.height));
  out.set("text", fmt::format("Largest cluster of changed pixels: {} at ({}, {})",
                              size_text({box.width, box.height}), box.x, box.y));
  return out;
}

/// The id of an item's element, by which links reach it: "figure-fig-7", "records-records".
std::string anchor_of(const DiffItem& item) {
  return (item.kind == ItemKind::kRecords ? "records-" : "figure-") + percent_encoded(item.id);
}

/// "1.2 % of pixels": how much of the images changed; empty if no image shows it.
std::string share_text(double share) {
  return share > 0.0 ? fmt::format("{:.2g}\u00a0% of pixels", 100.0 * share) : "";
}

/// The data of an item in lists: its name, verdict, link target and size.
data entry_data(const DiffItem& item, double changed_share) {
  data out;
  out.set("anchor", anchor_of(item));
  out.set("id", printable(item.id, kMostName));
  out.set("verdict", std::string(name(item.judgement.verdict)));
  out.set("label", std::string(label(item.judgement.verdict)));
  out.set("share", fmt::format("{:.6g}", changed_share));
  out.set("share_text", text_or_false(share_text(changed_share)));
  return out;
}

/// The data for diff_item.mustache.
/// @param refusal  Why the item cannot be approved by itself; null: it can.
/// @param number   Distinguishes ids on the page.
data item_data(const DiffItem& item, const ShownImages& shown, const DiffResult& all,
               const ApprovalRefusal* refusal, std::size_t number) {
  data out = entry_data(item, shown.changed_share);
  const std::string id = printable(item.id, kMostName);
  out.set("number", fmt::format("{}", number));
  out.set("code", percent_encoded(item.id));
  out.set("passes", item.passes);
  out.set("cause", text_or_false(printable(item.judgement.cause, kMostCause)));
  out.set("approvable", item.judgement.verdict != Verdict::kUnreadable);
  out.set("refused", refusal != nullptr);
  out.set("with_records", refusal != nullptr && refusal->goes_with_records);
  out.set("refusal", refusal ? printable(refusal->why, kMostCause) : std::string());
  out.set("stage", stage_data(item, shown, all));
  out.set("change", change_data(shown, id));
  out.set("no_heat", text_or_false(shown.no_heat));
  out.set("cluster", cluster_data(shown));
  out.set("absent", text_or_false(shown.absent));
  return out;
}

/// The characters of a table's cells as markup: what a page of tables consists of.
std::size_t size_of(const Block& block) {
  constexpr std::size_t kCell = 60;  // The markup around a cell, at most.
  const Table* table = std::get_if<Table>(&block);
  if (table == nullptr) return 10 * kCell;
  std::size_t size = 0;
  for (const Row& row : table->rows)
    for (const Cell& cell : row.cells) {
      const TextCell* text = std::get_if<TextCell>(&cell);
      size += kCell + (text == nullptr ? 0 : text->text.size());
    }
  return size;
}

/// Heights in pixels on a page 1400 wide, measured on comparisons of studies and of nightly runs.
namespace item_px {
constexpr double kMost = 13.0 * 900;  ///< Of all items: some fourteen screens with what is around.
constexpr double kHead = 90, kLine = 25, kFold = 42;
constexpr double kRefusal = 48, kAbsent = 36;  ///< Their lines with the gaps around them.
constexpr double kChange = 640, kPane = 540, kMostPane = 660;  ///< Widths; the last one a height.
constexpr double kWords = 70;                                  ///< Above and below images.
constexpr double kUnknownRatio = .75;                          ///< Of an SVG.
constexpr std::size_t kCharacters = 105;                       ///< Of a line of text.
}  // namespace item_px

double height_of(const std::optional<ShownImage>& image, double width) {
  if (!image) return 0.0;
  const double ratio = image->size ? static_cast<double>(image->size->height) / image->size->width
                                   : item_px::kUnknownRatio;
  return std::min(item_px::kMostPane, width * ratio);
}

/// What an item takes of the page.
struct ItemHeight {
  double head = 0.0;      ///< Its name and its cause, and what it cannot show.
  double contents = 0.0;  ///< Images and tables.
  std::string words;      ///< "3 images and 2 tables"; empty: it has no contents.
};

/// Without its tables.
ItemHeight item_height(const DiffItem& item, const ShownImages& shown, bool is_refused) {
  const std::size_t lines =
      (item.judgement.cause.size() + item_px::kCharacters - 1) / item_px::kCharacters;
  ItemHeight out;
  out.head = item_px::kHead + item_px::kLine * static_cast<double>(lines) +
             (is_refused ? item_px::kRefusal : 0.0) +
             (shown.absent.empty() ? 0.0 : item_px::kAbsent);
  for (const double images : {height_of(shown.change, item_px::kChange),
                              std::max(height_of(shown.baseline, item_px::kPane),
                                       height_of(shown.current, item_px::kPane))})
    out.contents += images > 0.0 ? images + item_px::kWords : 0.0;
  return out;
}

/// "3 images and 2 tables": what an item shows below its cause; empty if that is nothing.
/// @param tables  As the page shows them.
std::string contents_text(const ShownImages& shown, long long tables, bool any_blocks) {
  const long long images =
      (shown.change ? 1 : 0) + (shown.format.empty()
                                    ? 0
                                    : static_cast<long long>(shown.baseline.has_value()) +
                                          shown.current.has_value() + shown.heat.has_value());
  std::vector<std::string> parts;
  if (images > 0) parts.push_back(counted(images, "image"));
  if (tables > 0) parts.push_back(counted(tables, "table"));
  if (parts.empty()) return any_blocks ? "details" : "";
  return listed(parts, 2);
}

/// Folds until the page has some fifteen screens: what the items show below their causes, that of
/// the last one first, then the last items as a whole, then what is left open but the first item.
/// @return How many items stay outside the fold of the last ones.
std::size_t fold_items(list& items, const std::vector<ItemHeight>& heights) {
  constexpr std::size_t kFirst = 3;  // Items that are open before others are seen at all.
  const std::size_t count = heights.size();
  double all = 0.0;
  for (const ItemHeight& each : heights) all += each.head + each.contents;
  std::vector<bool> folds(count, false);
  std::size_t outside = count;
  const auto fold_contents = [&](std::size_t first) {
    for (std::size_t i = count; i > first && all > item_px::kMost; --i) {
      if (heights[i - 1].words.empty() || folds[i - 1]) continue;
      folds[i - 1] = true;
      all -= heights[i - 1].contents - item_px::kFold;
    }
  };
  fold_contents(kFirst);
  for (; outside > kFirst && all > item_px::kMost; --outside)
    all -= heights[outside - 1].head + (folds[outside - 1] ? item_px::kFold : 0.0);
  fold_contents(1);
  for (std::size_t i = 0; i < count; ++i)
    items[i].set("folded_words", text_or_false(folds[i] ? heights[i].words : ""));
  return outside;
}

/// Sets the tables of an item, if the page has room for them.
/// @param room  Bytes of the page that are left for tables.
/// @param height  Without the tables, whose heights are added.
void set_blocks(data& out, const DiffItem& item, const ShownImages& shown, const DiffResult& all,
                std::size_t number, std::size_t& room, ItemHeight& height) {
  list blocks;
  long long tables = 0;
  if (!is_repeated(all, item))
    for (const Block& block : item_blocks(item, all, number)) {
      const std::size_t size = size_of(block);
      if (size > room) continue;
      room -= size;
      tables += std::holds_alternative<Table>(block) ? 1 : 0;
      height.contents += height_of(block);
      blocks.push_back(block_data(block, {},
                                  {.figure_folder = "", .table_folder = "", .copies_tables = false},
                                  anchor_of(item)));
    }
  height.words = contents_text(shown, tables, !blocks.empty());
  out.set("blocks", blocks);
}

/// The verdicts that occur, the heaviest first, each with its number of items.
list counts_data(const DiffResult& result) {
  const std::vector<int> counts = counts_of(result);
  list out;
  for (std::size_t v = kVerdicts.size(); v-- > 0;) {
    if (counts[v] == 0) continue;
    data entry;
    entry.set("verdict", std::string(name(kVerdicts[v])));
    entry.set("label", std::string(label(kVerdicts[v])));
    entry.set("count", fmt::format("{}", counts[v]));
    out.push_back(std::move(entry));
  }
  return out;
}

/// The number of items whose images are not shown because the page is full.
std::string left_out(const std::vector<ShownImages>& shown) {
  long long count = 0;
  for (const ShownImages& images : shown) count += images.absent.empty() ? 0 : 1;
  return count == 0
             ? ""
             : "Images of " + counted(count, "item") + " are not shown; each item states why.";
}

constexpr std::size_t kLongestNote = 2000;

/// Remarks on items that were not compared.
list remarks_data(const DiffResult& result) {
  list out;
  for (const std::string& remark : result.remarks)
    out.push_back(data("remark", printable(remark, kLongestNote)));
  return out;
}

/// "3 items follow from records: data, worse.", whose cause stands beside that item; else with the
/// cause.
std::string shared_text(const SharedCause& shared, const DiffResult& result) {
  const std::string count = counted(std::ssize(shared.ids), "item");
  const std::string verdict(label(shared.verdict));
  std::string text;
  for (const DiffItem& item : result.items)
    if (item.kind == ItemKind::kRecords && shared.cause.starts_with(follows_from(item)))
      text = fmt::format("{} follow from {}: {}.", count, item.id, verdict);
  if (text.empty())
    text = fmt::format("{} have one cause, {}: {}{}", count, verdict, shared.cause,
                       shared.cause.ends_with('.') ? "" : ".");
  if (std::ssize(shared.ids) > kExamples)
    text += fmt::format(" The first {} are shown in full.", kExamples);
  return text;
}

/// That items have one cause, or are not shown.
list notes_data(const DiffResult& result, const std::vector<ShownImages>& shown) {
  list out;
  for (const SharedCause& shared : result.shared)
    out.push_back(data("note", printable(shared_text(shared, result), kLongestNote)));
  if (const std::string text = left_out(shown); !text.empty()) out.push_back(data("note", text));
  return out;
}

/// Of the items that differ, without identical ones.
std::map<std::string, ApprovalRefusal> refusals_of(const DiffResult& result) {
  ApprovalQuestion question;
  for (const DiffItem& item : result.items) {
    if (item.judgement.verdict == Verdict::kIdentical) continue;
    question.ids.push_back(item.id);
    // A file whose name is of another format than its content is not approved.
    for (const ImageFile& file : item.images)
      if (file.format == "png" && file.diff.is_decoded) question.decoded.insert(file.current);
  }
  return approval_refusals(result.baseline, result.current, question);
}

void set_items(data& page, const DiffResult& result, const std::vector<ShownImages>& shown,
               std::size_t page_bytes) {
  auto room = static_cast<std::size_t>(kTableShare * static_cast<double>(page_bytes));
  const auto refusals = refusals_of(result);
  list changed, items, identical;
  std::vector<ItemHeight> heights;
  for (std::size_t i = 0; i < result.items.size(); ++i) {
    const DiffItem& item = result.items[i];
    if (item.judgement.verdict == Verdict::kIdentical) {
      identical.push_back(entry_data(item, 0.0));
      continue;
    }
    changed.push_back(entry_data(item, shown[i].changed_share));
    const auto refused = refusals.find(item.id);
    items.push_back(item_data(item, shown[i], result,
                              refused == refusals.end() ? nullptr : &refused->second, i + 1));
    heights.push_back(item_height(item, shown[i], refused != refusals.end()));
    set_blocks(items.back(), item, shown[i], result, i + 1, room, heights.back());
  }
  const std::size_t outside = fold_items(items, heights);
  const std::size_t further = items.size() - outside;
  page.set("identical_count", fmt::format("{}", identical.size()));
  page.set("any_identical", !identical.empty());
  page.set("any_items", !items.empty());
  page.set("entries", changed);
  page.set("any_further", further > 0);
  page.set("further_words", counted(further, "more item"));
  page.set("further_list", list(items.begin() + static_cast<std::ptrdiff_t>(outside), items.end()));
  items.resize(outside);
  page.set("items_list", items);
  page.set("identical", identical);
}

/// The counts and the first item that differs, whose cause stands beside it; nothing of one item
/// alone, and where none differs.
std::string whole_text(const DiffResult& result) {
  const bool differs = std::ranges::any_of(result.items, [](const DiffItem& item) {
    return item.judgement.verdict != Verdict::kIdentical;
  });
  if (!differs || result.items.size() == 1) return "";
  return printable(counts_and_first(result), kMostCause) + ".";
}

/// The beginning of the first item's cause, for a screen that has no room for items beside the
/// list; nothing where whole_text() is empty.
std::string first_cause(const DiffResult& result) {
  constexpr std::size_t kMost = 240;  // Five lines of a phone.
  if (whole_text(result).empty()) return "";
  return printable(result.items.front().judgement.cause, kMost);
}

/// The names of two paths without the folders that they share: "a/b" and "a/c" are "b" and "c".
std::pair<std::string, std::string> distinct_names(const std::string& a, const std::string& b) {
  std::size_t shared = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()) && a[i] == b[i]; ++i)
    if (a[i] == '/') shared = i + 1;
  if (shared == a.size() || shared == b.size()) return {a, b};  // One is within the other.
  return {a.substr(shared), b.substr(shared)};
}

}  // namespace

std::string diff_html(const DiffResult& result, const std::vector<ShownImages>& shown,
                      const Templates& templates, std::size_t page_bytes) {
  data page;
  set_page_frame(page, "diff", templates);
  page.set("passes", result.passes);
  page.set("verdict", std::string(name(result.judgement.verdict)));
  page.set("label", std::string(label(result.judgement.verdict)));
  page.set("whole", text_or_false(whole_text(result)));
  page.set("first_cause", text_or_false(first_cause(result)));
  page.set("compared", counted(std::ssize(result.items), "item"));
  const auto [baseline, current] = distinct_names(shown_baseline(result), shown_current(result));
  page.set("baseline_name", page_text(printable(baseline, kMostPath)));
  page.set("current_name", page_text(printable(current, kMostPath)));
  page.set("baseline", percent_encoded(result.baseline));
  page.set("current", percent_encoded(result.current));
  std::error_code error;
  page.set("files", std::filesystem::is_regular_file(result.current, error));
  page.set("facts", block_data(whole_facts(result), {}, {}, "facts"));
  page.set("counts", counts_data(result));
  page.set("remarks", remarks_data(result));
  page.set("notes", notes_data(result, shown));
  page.set("version", std::string(version()));
  set_items(page, result, shown, page_bytes);
  return rendered("diff", templates, page);
}

}  // namespace mapproof
