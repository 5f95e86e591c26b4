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
#include "core/base/files/byte_source.hpp"
#include "core/base/parallel.hpp"
#include "core/base/text/base64.hpp"
#include "core/base/text/words.hpp"
#include "core/base/version.hpp"
#include "render/image/png.hpp"
#include "reports/diff/approvals/approvals.hpp"
#include "reports/diff/diff_result.hpp"
#include "reports/diff/diff_settings.hpp"
#include "reports/diff/images/image_diff.hpp"
#include "reports/diff/shared_causes.hpp"
#include "reports/diff/tables/image_tables.hpp"
#include "reports/diff/tables/item_blocks.hpp"
#include "reports/html/block_data.hpp"
#include "reports/html/page_frame.hpp"
#include "reports/html/sha256.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;
using kainjow::mustache::data;
using kainjow::mustache::list;

constexpr std::int64_t kMostPixels = std::int64_t{1} << 28;

bool has_both(const ImageFile& file) { return !file.baseline.empty() && !file.current.empty(); }

/// The type of an image that browsers show; empty: none.
std::string_view media_type(std::string_view format) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 7> kTypes{
      {{"png", "image/png"},
       {"svg", "image/svg+xml"},
       {"jpg", "image/jpeg"},
       {"jpeg", "image/jpeg"},
       {"gif", "image/gif"},
       {"webp", "image/webp"},
       {"bmp", "image/bmp"}}};
  for (const auto& [known, type] : kTypes)
    if (known == format) return type;
  return {};
}

/// The priority of an image on the page; 0: nothing to show.
int interest(const ImageFile& file) {
  const int of_format = file.format == "png" ? 1 : 0;
  if (media_type(file.format).empty()) return 0;
  if (!has_both(file)) return 2 + of_format;
  switch (file.diff.state) {
    case ImageState::kDifferent:
      return 6 + of_format;
    case ImageState::kWithinTolerance:
      return 4 + of_format;
    default:
      return 0;
  }
}

const ImageFile* most_telling(const DiffItem& item) {
  const ImageFile* best = nullptr;
  for (const ImageFile& file : item.images)
    if (interest(file) > (best == nullptr ? 0 : interest(*best))) best = &file;
  return best;
}

std::uint32_t number_at(std::string_view bytes, std::size_t at) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < 4; ++i)
    number = number << 8 | static_cast<unsigned char>(bytes[at + i]);
  return number;
}

/// Reads the size from the header; a browser reads the rest.
ImageSize png_size(const std::string& bytes, const fs::path& path) {
  constexpr std::string_view kSignature("\x89PNG\r\n\x1a\n", 8);
  if (bytes.size() < 24 || !bytes.starts_with(kSignature))
    throw IoError(path.string(), "is not a PNG");
  const std::int64_t width = number_at(bytes, 16), height = number_at(bytes, 20);
  if (width < 1 || height < 1 || width > kMostPixels || height > kMostPixels / width)
    throw IoError(path.string(), fmt::format("{} x {} pixels are not shown", width, height));
  return {static_cast<int>(width), static_cast<int>(height)};
}

ShownImage read_image(const fs::path& path, const std::string& format, const std::string& renderer,
                      std::size_t limit) {
  const std::string bytes = read_input(path, limit);
  ShownImage image;
  image.renderer = renderer;
  if (format == "png") image.size = png_size(bytes, path);
  image.uri = fmt::format("data:{};base64,{}", media_type(format), base64(bytes));
  return image;
}

/// The files to read for one item.
struct Plan {
  const ImageFile* file = nullptr;
  bool heat = false;
  std::string absent;
};

std::string unreadable_reason(const DiffItem& item) {
  for (const ImageFile& file : item.images)
    if (has_both(file) && file.diff.state == ImageState::kUnreadable)
      return "Not shown: " + file.format + " cannot be read.";
  for (const ImageFile& file : item.images)
    if (media_type(file.format).empty())
      return "Not shown: browsers show no " + file.format + " in a page.";
  return "";
}

std::uintmax_t bytes_of(const ImageFile& file) {
  std::uintmax_t bytes = 0;
  for (const fs::path& path : {file.baseline, file.current}) {
    std::error_code error;
    const std::uintmax_t size = path.empty() ? 0 : fs::file_size(path, error);
    if (!error) bytes += size;
  }
  return bytes;
}

/// Of a cause that several items share, the first items are shown in full.
constexpr std::ptrdiff_t kExamples = 3;

/// Whether the item has a cause that others before it, shown in full, have as well.
bool is_repeated(const DiffResult& result, const DiffItem& item) {
  const SharedCause* shared = shared_cause_of(result, item);
  return shared != nullptr &&
         std::ranges::find(shared->ids, item.id) - shared->ids.begin() >= kExamples;
}

/// The parts of a page that images and tables may fill; styles, scripts and the rest of the markup
/// need what is left.
constexpr double kImageShare = 0.6;
constexpr double kTableShare = 0.32;

std::string full_text(const ImageBudget& budget) {
  return fmt::format("Not shown: this page already has its {:.3g} MB (--page-size).",
                     static_cast<double>(budget.page_bytes) / 1e6);
}

std::vector<Plan> plans(const DiffResult& result, const ImageBudget& budget) {
  constexpr double kBase64 = 4.0 / 3.0;
  const double most = kImageShare * static_cast<double>(budget.page_bytes) / kBase64;
  std::vector<Plan> all;
  double used = 0.0;
  std::size_t heat_maps = 0;
  for (const DiffItem& item : result.items) {
    Plan plan;
    if (item.judgement.verdict != Verdict::kIdentical) {
      plan.file = most_telling(item);
      if (plan.file == nullptr) plan.absent = unreadable_reason(item);
    }
    if (plan.file != nullptr && is_repeated(result, item)) {
      plan.absent = "Not shown: others above have the same cause.";
      plan.file = nullptr;
    }
    if (plan.file != nullptr && used + static_cast<double>(bytes_of(*plan.file)) > most) {
      plan.absent = full_text(budget);
      plan.file = nullptr;
    }
    if (plan.file != nullptr) {
      used += static_cast<double>(bytes_of(*plan.file));
      plan.heat =
          plan.file->format != "svg" && has_both(*plan.file) && heat_maps < budget.heat_maps;
      heat_maps += plan.heat ? 1 : 0;
    }
    all.push_back(std::move(plan));
  }
  return all;
}

/// Why two images are shown without a heat map.
std::string no_heat_reason(const Plan& plan) {
  if (plan.file->format == "svg") return "No heat map: SVGs have none.";
  return plan.heat ? "No heat map: the sizes differ."
                   : "No heat map: the page already holds its maximum number of heat maps.";
}

std::optional<ShownImage> heat_image(const ImageFile& file, const ImageOptions& options) {
  const Image image = heat_map(file.baseline, file.current, options);
  if (image.width < 1 || image.height < 1) return std::nullopt;
  return ShownImage{"data:image/png;base64," + base64(encode_png(image)),
                    ImageSize{image.width, image.height}, ""};
}

ShownImages read_all(const Plan& plan, const ImageOptions& options, std::size_t limit) {
  ShownImages shown;
  shown.absent = plan.absent;
  if (plan.file == nullptr) return shown;
  const ImageFile& file = *plan.file;
  try {
    if (!file.baseline.empty())
      shown.baseline = read_image(file.baseline, file.format, file.diff.baseline_renderer, limit);
    if (!file.current.empty())
      shown.current = read_image(file.current, file.format, file.diff.current_renderer, limit);
    if (plan.heat) shown.heat = heat_image(file, options);
  } catch (const IoError& error) {
    shown = {};
    shown.absent = std::string("Not shown: ") + error.what();
    return shown;
  }
  shown.format = file.format;
  if (has_both(file) && !shown.heat) shown.no_heat = no_heat_reason(plan);
  if (file.diff.pixels && file.diff.pixels->largest_cluster_pixels > 0)
    shown.cluster = file.diff.pixels->largest_cluster;
  return shown;
}

/// Leaves out the heat maps for which the page has no room.
void drop_heat_maps(std::vector<ShownImages>& shown, const ImageBudget& budget) {
  std::size_t room = static_cast<std::size_t>(kImageShare * static_cast<double>(budget.page_bytes));
  for (const ShownImages& images : shown)
    for (const auto* image : {&images.baseline, &images.current})
      if (*image) room -= std::min(room, (*image)->uri.size());
  for (ShownImages& images : shown) {
    if (!images.heat) continue;
    if (images.heat->uri.size() <= room) {
      room -= images.heat->uri.size();
      continue;
    }
    images.heat.reset();
    images.no_heat = "No heat map: the page has no room for it (--page-size).";
  }
}

/// Reads the images of each item, in order, and makes the heat maps of PNGs that differ, also
/// within tolerance. Identical and unreadable images are not shown. Images are embedded as the
/// bytes of their files.
/// @note Reads several items at a time, by oneTBB; the result does not depend on it. Holds all
/// images in memory.
std::vector<ShownImages> shown_images(const DiffResult& result, const DiffSettings& settings,
                                      const ImageBudget& budget = {}) {
  const std::vector<Plan> all = plans(result, budget);
  std::vector<ShownImages> shown(all.size());
  parallel_for(all.size(), [&](std::size_t i) {
    shown[i] = read_all(all[i], settings.images_of(result.items[i].id), budget.largest_bytes);
  });
  drop_heat_maps(shown, budget);
  return shown;
}

constexpr std::size_t kMostName = 300;    // Characters.
constexpr std::size_t kMostCause = 2000;  // Characters.

/// One image; `side` is "baseline", "current" or "heat".
data pane_data(const ShownImage& image, const std::string& side, const std::string& title,
               const std::string& id) {
  data out;
  out.set("side", side);
  out.set("title", title);
  out.set("uri", image.uri);
  out.set("alt", title + " of " + id);
  std::string note = image.size ? size_text(*image.size) : "";
  if (!image.renderer.empty())
    note += (note.empty() ? "" : ", ") + printable(image.renderer, kMostName);
  out.set("note", note);
  out.set("sized", image.size.has_value());
  out.set("width", fmt::format("{}", image.size ? image.size->width : 0));
  out.set("height", fmt::format("{}", image.size ? image.size->height : 0));
  return out;
}

data stage_data(const ShownImages& shown, const std::string& id) {
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

data cluster_data(const ShownImages& shown) {
  if (!shown.cluster) return data(false);
  const PixelBox& box = *shown.cluster;
  data out;
  out.set("box", fmt::format("{} {} {} {}", box.x, box.y, box.width, box.height));
  out.set("text", fmt::format("Largest cluster of changed pixels: {} at ({}, {})",
                              size_text({box.width, box.height}), box.x, box.y));
  return out;
}

/// The id of an item's element, by which links reach it: "figure-fig-7", "records-records".
std::string anchor_of(const DiffItem& item) {
  return (item.kind == ItemKind::kRecords ? "records-" : "figure-") + percent_encoded(item.id);
}

/// The data of an item in lists: its name, verdict and link target.
data entry_data(const DiffItem& item) {
  data out;
  out.set("anchor", anchor_of(item));
  out.set("id", printable(item.id, kMostName));
  out.set("verdict", std::string(name(item.judgement.verdict)));
  out.set("label", std::string(label(item.judgement.verdict)));
  return out;
}

/// The data for diff_item.mustache.
/// @param refusal  Why the item cannot be approved by itself; null: it can.
/// @param number   Distinguishes ids on the page.
data item_data(const DiffItem& item, const ShownImages& shown, const ApprovalRefusal* refusal,
               std::size_t number) {
  data out = entry_data(item);
  const std::string id = printable(item.id, kMostName);
  out.set("number", fmt::format("{}", number));
  out.set("code", percent_encoded(item.id));
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

/// Sets the tables of an item, if the page has room for them.
/// @param room  Bytes of the page that are left for tables.
void set_blocks(data& out, const DiffItem& item, const DiffResult& all, std::size_t number,
                std::size_t& room) {
  list blocks;
  if (!is_repeated(all, item))
    for (const Block& block : item_blocks(item, all, number)) {
      const std::size_t size = size_of(block);
      if (size > room) continue;
      room -= size;
      blocks.push_back(block_data(block, {},
                                  {.figure_folder = "", .table_folder = "", .copies_tables = false},
                                  anchor_of(item)));
    }
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

/// Remarks on items that were not compared or are not shown.
list notes_data(const DiffResult& result, const std::vector<ShownImages>& shown) {
  list out;
  for (const SharedCause& shared : result.shared)
    out.push_back(data(
        "note", printable(fmt::format("{} have one cause, {}: {}. The first {} are shown in full.",
                                      counted(std::ssize(shared.ids), "item"),
                                      label(shared.verdict), shared.cause, kExamples),
                          kLongestNote)));
  for (const std::string& remark : result.remarks)
    out.push_back(data("note", printable(remark, kLongestNote)));
  if (const std::string text = left_out(shown); !text.empty()) out.push_back(data("note", text));
  return out;
}

/// The items that differ, without identical ones.
std::map<std::string, ApprovalRefusal> refusals_of(const DiffResult& result) {
  std::vector<std::string> ids;
  for (const DiffItem& item : result.items)
    if (item.judgement.verdict != Verdict::kIdentical) ids.push_back(item.id);
  return approval_refusals(result.baseline, result.current, ids);
}

void set_items(data& page, const DiffResult& result, const std::vector<ShownImages>& shown,
               const ImageBudget& budget) {
  auto room = static_cast<std::size_t>(kTableShare * static_cast<double>(budget.page_bytes));
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
    items.push_back(
        item_data(item, shown[i], refused == refusals.end() ? nullptr : &refused->second, i + 1));
    set_blocks(items.back(), item, result, i + 1, room);
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
                      const Templates& templates, const ImageBudget& budget) {
  const std::vector<ShownImages> shown = shown_images(result, settings, budget);
  data page;
  set_page_frame(page, "diff", templates);
  page.set("passes", result.passes);
  page.set("verdict", std::string(name(result.judgement.verdict)));
  page.set("label", std::string(label(result.judgement.verdict)));
  page.set("cause", text_or_false(printable(result.judgement.cause, kLongestNote)));
  page.set("compared", counted(std::ssize(result.items), "item"));
  page.set("baseline", percent_encoded(result.baseline));
  page.set("current", percent_encoded(result.current));
  std::error_code error;
  page.set("files", std::filesystem::is_regular_file(result.current, error));
  page.set("facts", block_data(whole_facts(result), {}, {}, "facts"));
  page.set("counts", counts_data(result));
  page.set("notes", notes_data(result, shown));
  page.set("version", std::string(version()));
  set_items(page, result, shown, budget);
  return rendered("diff", templates, page);
}

}  // namespace mapproof
