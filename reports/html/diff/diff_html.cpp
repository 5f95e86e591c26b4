#include "reports/html/diff/diff_html.hpp"

#include <filesystem>
#include <map>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <kainjow/mustache.hpp>

#include "core/base/errors.hpp"
#include "core/base/version.hpp"
#include "core/base/words.hpp"
#include "reports/diff/approvals/approvals.hpp"
#include "reports/diff/tables/item_blocks.hpp"
#include "reports/html/block_data.hpp"
#include "reports/html/diff/item_data.hpp"
#include "reports/html/diff/url_text.hpp"
#include "reports/html/page_frame.hpp"
#include "reports/html/table_data.hpp"

namespace mapproof {
namespace {

using kainjow::mustache::data;
using kainjow::mustache::list;

/// Verdicts that occur, the heaviest first, with how many items have each.
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

/// How many items have pictures that are not shown for want of room.
std::string left_out(const std::vector<ShownPictures>& shown) {
  long long count = 0;
  for (const ShownPictures& pictures : shown) count += pictures.absent.empty() ? 0 : 1;
  return count == 0 ? ""
                    : "Pictures of " + counted(count, "item") + " are not shown; each says why.";
}

constexpr std::size_t kLongestNote = 2000;

/// What was not compared or is not shown.
list notes_data(const DiffResult& result, const std::vector<ShownPictures>& shown) {
  list out;
  for (const std::string& remark : result.remarks)
    out.push_back(data("note", printable(remark, kLongestNote)));
  if (const std::string text = left_out(shown); !text.empty()) out.push_back(data("note", text));
  return out;
}

/// Of the items that differ: identical ones are not taken.
std::map<std::string, ApprovalRefusal> refusals_of(const DiffResult& result) {
  std::vector<std::string> ids;
  for (const DiffItem& item : result.items)
    if (item.judgement.verdict != Verdict::kIdentical) ids.push_back(item.id);
  return approval_refusals(result.baseline, result.current, ids);
}

void set_items(data& page, const DiffResult& result, const std::vector<ShownPictures>& shown) {
  const auto refusals = refusals_of(result);
  list changed, items, identical;
  for (std::size_t i = 0; i < result.items.size(); ++i) {
    const DiffItem& item = result.items[i];
    if (item.judgement.verdict == Verdict::kIdentical) {
      identical.push_back(entry_data(item));
      continue;
    }
    changed.push_back(entry_data(item));
    const auto refused = refusals.find(item.id);
    items.push_back(item_data(item, result, shown[i],
                              refused == refusals.end() ? nullptr : &refused->second, i + 1));
  }
  page.set("identical_count", fmt::format("{}", identical.size()));
  page.set("any_identical", !identical.empty());
  page.set("any_items", !items.empty());
  page.set("entries", changed);
  page.set("items_list", items);
  page.set("identical", identical);
}

}  // namespace

std::string diff_html(const DiffResult& result, const DiffSettings& settings,
                      const Templates& templates, const PictureBudget& budget) {
  const std::vector<ShownPictures> shown = shown_pictures(result, settings, budget);
  data page;
  set_page_frame(page, "diff", templates);
  page.set("passes", result.passes);
  page.set("verdict", std::string(name(result.judgement.verdict)));
  page.set("label", std::string(label(result.judgement.verdict)));
  page.set("cause", text_or_false(printable(result.judgement.cause, kLongestNote)));
  page.set("compared", counted(std::ssize(result.items), "item"));
  page.set("baseline", url_text(result.baseline));
  page.set("current", url_text(result.current));
  std::error_code error;
  page.set("files", std::filesystem::is_regular_file(result.current, error));
  page.set("facts", block_data(whole_facts(result), {}, {}));
  page.set("counts", counts_data(result));
  page.set("notes", notes_data(result, shown));
  page.set("version", std::string(version()));
  set_items(page, result, shown);
  return rendered("diff", templates, page);
}

}  // namespace mapproof
