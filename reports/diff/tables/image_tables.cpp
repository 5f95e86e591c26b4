#include "reports/diff/tables/image_tables.hpp"

#include <utility>

#include <fmt/format.h>

#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"
#include "reports/diff/svg/svg_diff.hpp"
#include "reports/diff/tables/table_builder.hpp"
#include "reports/model/format.hpp"

namespace mapproof {
namespace {

std::string pixels_text(const PixelDiff& p) {
  const std::int64_t all = std::int64_t{p.baseline.width} * p.baseline.height;
  const auto count = [all](std::int64_t some) { return count_text(some, all); };
  std::string text = fmt::format("{} of {} changed ({} %)", count(p.changed), count(all),
                                 format_number(100.0 * p.changed_share, 3));
  if (p.clusters > 0)
    text += fmt::format(" in {}, the largest of {} pixel{}", counted(p.clusters, "cluster"),
                        count(p.largest_cluster_pixels), p.largest_cluster_pixels == 1 ? "" : "s");
  text += fmt::format("; {} differ in any way", count(p.differing));
  if (p.antialiased > 0) text += fmt::format(", {} by anti-aliasing", count(p.antialiased));
  if (p.ignored > 0) text += fmt::format("; {} ignored", count(p.ignored));
  return text;
}

std::string structure_text(const PixelDiff& p) {
  return fmt::format("least {} at ({}, {}); largest colour difference {}",
                     format_number(p.least_structure, 3), p.least_structure_at.x,
                     p.least_structure_at.y, format_number(p.largest_colour_difference, 3));
}

std::string svg_text(const SvgDiff& svg) {
  return fmt::format(
      "{}: {} of geometry, {} of style, {} of text, {} of structure, {} of metadata; {} tolerated",
      counted(svg.total, "change"), svg.geometry, svg.style, svg.text, svg.structure, svg.metadata,
      svg.tolerated);
}

std::string renderers_text(const ImageDiff& diff) {
  if (diff.baseline_renderer == diff.current_renderer) return diff.current_renderer;
  const auto shown = [](const std::string& text) { return text.empty() ? "unknown" : text; };
  return shown(diff.baseline_renderer) + " \u2192 " + shown(diff.current_renderer);
}

void add_facts(KeyValues& facts, const ImageFile& file) {
  std::string format = file.format == "png" ? "PNG" : file.format == "svg" ? "SVG" : file.format;
  if (!file.baseline_key.empty()) format += ", baseline " + file.baseline_key;
  const auto add = [&](const std::string& key, const std::string& text) {
    if (!text.empty()) facts.items.push_back({key, {text, Emphasis::kData}});
  };
  if (file.baseline.empty() || file.current.empty()) {
    add(format, file.baseline.empty() ? "only in the current" : "only in the baseline");
    return;
  }
  std::string state(name(file.diff.state));
  if (!file.diff.reason.empty()) state += ": " + file.diff.reason;
  add(format, state);
  if (file.diff.pixels && file.diff.pixels->baseline == file.diff.pixels->current &&
      file.diff.pixels->differing > 0) {
    add("Pixels", pixels_text(*file.diff.pixels));
    add("Structure", structure_text(*file.diff.pixels));
  }
  if (file.diff.svg && file.diff.svg->total > 0) add("Elements", svg_text(*file.diff.svg));
  if (file.diff.state != ImageState::kIdentical) add("Drawn by", renderers_text(file.diff));
}

Table svg_table(const SvgDiff& svg, const std::string& suffix) {
  Table table{"svg-" + suffix,
              "What changed in the SVG: " + counted(svg.total, "change"),
              {},
              {},
              {},
              true};
  table.columns = {{"Element", "", "", ""},
                   {"What", "", "", ""},
                   {"Baseline", "", "", ""},
                   {"Current", "", "", ""},
                   {"Distance", "", "", "In user units, or of 255 for colours"},
                   {"Tolerated", "", "", ""}};
  for (const SvgChange& change : svg.changes) {
    if (table.rows.size() == kMostTableRows) break;
    Row row{{user_text(change.element), user_text(change.what), user_text(change.baseline),
             user_text(change.current)},
            "",
            false};
    row.cells.push_back(change.distance == 0.0 ? Cell(MissingCell{})
                                               : Cell(NumberCell{change.distance, 2}));
    row.cells.emplace_back(TextCell{change.tolerated ? "yes" : "no"});
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// The same as a table, which a page can fold.
Table folded(const KeyValues& facts, const std::string& suffix) {
  Table table{"files-" + suffix, "Files, pixels and elements", {}, {}, {}, true};
  table.columns = {{"What", "", "", ""}, {"How it differs", "", "", ""}};
  for (const KeyValues::Item& item : facts.items)
    table.rows.push_back({{TextCell{item.key}, TextCell{item.value.text}}, "", false});
  return table;
}

}  // namespace

std::string size_text(const ImageSize& size) {
  return fmt::format("{} \u00D7 {}", size.width, size.height);
}

void add_image_tables(std::vector<Block>& blocks, const std::vector<ImageFile>& files,
                      const std::string& suffix, bool secondary) {
  KeyValues facts;
  for (const ImageFile& file : files) {
    const auto& pixels = file.diff.pixels;
    if (pixels && pixels->baseline != pixels->current)
      blocks.emplace_back(Callout{
          Callout::Tone::kWarning,
          "The sizes differ",
          {{{size_text(pixels->baseline) + " \u2192 " + size_text(pixels->current) + " pixels",
             Emphasis::kPlain}}}});
    add_facts(facts, file);
  }
  if (!facts.items.empty())
    blocks.push_back(secondary ? Block(folded(facts, suffix)) : Block(std::move(facts)));
  int number = 0;
  for (const ImageFile& file : files)
    if (file.diff.svg)
      add_table(
          blocks,
          svg_table(*file.diff.svg, suffix + (number++ > 0 ? fmt::format("-{}", number) : "")),
          file.diff.svg->total);
}

}  // namespace mapproof
