#include "reports/html/diff/item_data.hpp"

#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "reports/diff/tables/item_blocks.hpp"
#include "reports/diff/tables/picture_tables.hpp"
#include "reports/html/block_data.hpp"
#include "reports/html/diff/url_text.hpp"
#include "reports/html/table_data.hpp"

namespace mapproof {
namespace {

using kainjow::mustache::data;
using kainjow::mustache::list;

constexpr std::size_t kMostName = 300;    // Characters.
constexpr std::size_t kMostCause = 2000;  // Characters.

/// One picture; `side` is "baseline", "current" or "heat".
data pane_data(const ShownPicture& picture, const std::string& side, const std::string& title,
               const std::string& id) {
  data out;
  out.set("side", side);
  out.set("title", title);
  out.set("uri", picture.uri);
  out.set("alt", title + " of " + id);
  std::string note = picture.size ? size_text(*picture.size) : "";
  if (!picture.renderer.empty())
    note += (note.empty() ? "" : ", ") + printable(picture.renderer, kMostName);
  out.set("note", note);
  out.set("sized", picture.size.has_value());
  out.set("width", fmt::format("{}", picture.size ? picture.size->width : 0));
  out.set("height", fmt::format("{}", picture.size ? picture.size->height : 0));
  return out;
}

data stage_data(const ShownPictures& shown, const std::string& id) {
  if (shown.format.empty()) return data(false);
  list panes;
  if (shown.baseline) panes.push_back(pane_data(*shown.baseline, "baseline", "Baseline", id));
  if (shown.current) panes.push_back(pane_data(*shown.current, "current", "Current", id));
  data out;
  out.set("both", shown.baseline.has_value() && shown.current.has_value());
  out.set("has_heat", shown.heat.has_value());
  if (shown.heat) panes.push_back(pane_data(*shown.heat, "heat", "Heat map", id));
  out.set("panes", panes);
  out.set("format", shown.format);
  return out;
}

data cluster_data(const ShownPictures& shown) {
  if (!shown.cluster) return data(false);
  const PixelBox& box = *shown.cluster;
  data out;
  out.set("box", fmt::format("{} {} {} {}", box.x, box.y, box.width, box.height));
  out.set("text", fmt::format("Largest cluster of changed pixels: {} at ({}, {})",
                              size_text({box.width, box.height}), box.x, box.y));
  return out;
}

}  // namespace

std::string anchor_of(const DiffItem& item) {
  return (item.kind == ItemKind::kRecords ? "records-" : "figure-") + url_text(item.id);
}

data entry_data(const DiffItem& item) {
  data out;
  out.set("anchor", anchor_of(item));
  out.set("id", printable(item.id, kMostName));
  out.set("verdict", std::string(name(item.judgement.verdict)));
  out.set("label", std::string(label(item.judgement.verdict)));
  return out;
}

data item_data(const DiffItem& item, const DiffResult& all, const ShownPictures& shown,
               const ApprovalRefusal* refusal, std::size_t number) {
  data out = entry_data(item);
  const std::string id = printable(item.id, kMostName);
  out.set("number", fmt::format("{}", number));
  out.set("code", url_text(item.id));
  out.set("passes", item.passes);
  out.set("cause", text_or_false(printable(item.judgement.cause, kMostCause)));
  out.set("approvable", item.judgement.verdict != Verdict::kUnreadable);
  out.set("refused", refusal != nullptr);
  out.set("with_records", refusal != nullptr && refusal->goes_with_records);
  out.set("refusal", refusal ? printable(refusal->why, kMostCause) : std::string());
  out.set("stage", stage_data(shown, id));
  out.set("no_heat", text_or_false(shown.no_heat));
  out.set("cluster", cluster_data(shown));
  out.set("absent", text_or_false(shown.absent));
  list blocks;
  for (const Block& block : item_blocks(item, all, number))
    blocks.push_back(
        block_data(block, {}, {.figure_folder = "", .table_folder = "", .copies_tables = false}));
  out.set("blocks", blocks);
  return out;
}

}  // namespace mapproof
