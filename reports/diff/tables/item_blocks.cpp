#include "reports/diff/tables/item_blocks.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "core/base/byte_source.hpp"
#include "core/base/errors.hpp"
#include "core/base/words.hpp"
#include "render/plot/figure_json.hpp"
#include "reports/diff/tables/figure_tables.hpp"
#include "reports/diff/tables/picture_tables.hpp"
#include "reports/diff/tables/record_tables.hpp"
#include "reports/diff/tables/score_table.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kLargestFigure = std::size_t{1} << 28;  // Bytes.
constexpr std::size_t kMostItemNames = 6;

/// The records that either side of the figure was made of.
std::set<std::string> record_ids(const DiffItem& item) {
  std::set<std::string> ids;
  for (const auto& path : {item.baseline_figure, item.current_figure}) {
    if (path.empty()) continue;
    try {
      const Figure figure = figure_from_json(read_input(path, kLargestFigure), path.string());
      ids.insert(figure.record_ids.begin(), figure.record_ids.end());
    } catch (const IoError&) {  // The verdict says so: unreadable.
    }
  }
  return ids;
}

/// The scores of the records that the figure shows.
std::vector<const Comparison*> tied_scores(const DiffItem& item, const DiffResult& all) {
  std::vector<const Comparison*> scores;
  std::set<const Comparison*> seen;
  const std::set<std::string> ids = record_ids(item);
  for (const DiffItem& other : all.items) {
    if (!other.records) continue;
    for (const std::string& id : ids)
      for (const Comparison* comparison : tie(*other.records, id).comparisons)
        if (seen.insert(comparison).second) scores.push_back(comparison);
  }
  return scores;
}

/// "FreeType 2.12 → 2.13", each once.
std::vector<std::string> version_changes(const DiffResult& result) {
  std::vector<std::string> changes;
  for (const DiffItem& item : result.items) {
    if (!item.records) continue;
    for (const SettingChange& change : item.records->provenance) {
      const auto shown = [](const std::string& text) { return text.empty() ? "none" : text; };
      std::string text = fmt::format("{} {} \u2192 {}", change.pointer, shown(change.baseline),
                                     shown(change.current));
      if (std::ranges::find(changes, text) == changes.end()) changes.push_back(std::move(text));
    }
  }
  return changes;
}

/// What drew the pictures of one side, each once.
std::vector<std::string> renderers(const DiffResult& result, std::string PictureDiff::*side) {
  std::set<std::string> names;
  for (const DiffItem& item : result.items)
    for (const PictureFile& file : item.pictures)
      if (!(file.diff.*side).empty()) names.insert(file.diff.*side);
  return {names.begin(), names.end()};
}

}  // namespace

std::vector<Block> item_blocks(const DiffItem& item, const DiffResult& all, std::size_t number) {
  const std::string suffix = fmt::format("{}", number);
  std::vector<Block> blocks;
  if (item.figure) {
    add_figure_tables(blocks, *item.figure, suffix);
    if (item.figure->has(ChangeKind::kData))
      add_score_table(blocks, "tied-" + suffix, "Scores of the records that it shows",
                      tied_scores(item, all));
  }
  if (item.records) add_record_tables(blocks, *item.records, suffix);
  add_others_table(blocks, item.documents, suffix);
  add_picture_tables(blocks, item.pictures, suffix);
  return blocks;
}

KeyValues whole_facts(const DiffResult& result) {
  KeyValues facts;
  const auto add = [&](const std::string& key, const std::string& text, Emphasis emphasis) {
    if (!text.empty()) facts.items.push_back({key, {text, emphasis}});
  };
  add("Baseline", result.baseline, Emphasis::kData);
  add("Current", result.current, Emphasis::kData);
  std::vector<std::string> allowed;
  for (const Verdict verdict : result.allowed) allowed.emplace_back(label(verdict));
  add("Passes as well", listed(allowed, kVerdicts.size()), Emphasis::kPlain);
  add("Versions that differ", listed(version_changes(result), kMostItemNames), Emphasis::kData);
  const auto before = renderers(result, &PictureDiff::baseline_renderer);
  const auto after = renderers(result, &PictureDiff::current_renderer);
  if (before == after) {
    add("Pictures drawn by", listed(before, kMostItemNames), Emphasis::kData);
  } else {
    add("Baseline drawn by", listed(before, kMostItemNames), Emphasis::kData);
    add("Current drawn by", listed(after, kMostItemNames), Emphasis::kData);
  }
  return facts;
}

}  // namespace mapproof
