#include "reports/html/page_folds.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "reports/html/block_data.hpp"

namespace mapproof {
namespace {

/// Heights in pixels on a page 1280 wide, measured on the pages of every kind of study.
namespace height {
constexpr double kMost = 12.75 * 800;  ///< Of what is open: about fifteen screens with the opening.
constexpr double kSection = 105, kFold = 42, kText = 30, kLine = 24;
constexpr double kTable = 165, kRow = 36, kFigure = 530, kWideFigure = 860;
constexpr std::size_t kCharacters = 105;  ///< Of a line of text.
}  // namespace height

std::size_t characters_of(const Paragraph& paragraph) {
  std::size_t size = 0;
  for (const Phrase& phrase : paragraph.phrases) size += phrase.text.size();
  return size;
}

double height_of(const Paragraph& paragraph) {
  return height::kText +
         height::kLine * static_cast<double>(characters_of(paragraph) / height::kCharacters);
}

double height_of(const Table& table) {
  if (table.secondary || table.rows.size() > kMostRowsOpen) return height::kFold;
  return height::kTable + height::kRow * static_cast<double>(table.rows.size()) +
         height::kLine * static_cast<double>(table.notes.size());
}

double height_of(const Gallery& gallery) {
  double narrow = 0.0, all = 0.0;
  const std::size_t shown = std::min(gallery.open, gallery.figures.size());
  for (std::size_t i = 0; i < shown; ++i)
    (gallery.figures[i].wide ? all : narrow) +=
        gallery.figures[i].wide ? height::kWideFigure : height::kFigure;
  all += std::ceil(narrow / height::kFigure / 2.0) * height::kFigure;  // Two stand side by side.
  return all + (shown < gallery.figures.size() ? height::kFold : 0.0);
}

double height_of(const Block& block) {
  if (const auto* paragraph = std::get_if<Paragraph>(&block)) return height_of(*paragraph);
  if (const auto* table = std::get_if<Table>(&block)) return height_of(*table);
  if (const auto* gallery = std::get_if<Gallery>(&block)) return height_of(*gallery);
  if (std::holds_alternative<FigureBlock>(block)) return height::kFigure;
  double all = 0.0;
  if (const auto* bullets = std::get_if<BulletList>(&block))
    for (const Paragraph& item : bullets->items) all += height_of(item);
  else if (const auto* facts = std::get_if<KeyValues>(&block))
    all = 1.25 * height::kRow * static_cast<double>(facts->items.size());
  else if (const auto* links = std::get_if<PageLinks>(&block))
    all = links->items.size() > kMostLinksOpen
              ? height::kFold
              : height::kText + height::kLine * static_cast<double>(links->items.size());
  else if (const auto* statuses = std::get_if<StatusList>(&block))
    all = height::kTable + height::kRow * static_cast<double>(statuses->items.size());
  else
    all = 3.0 * height::kText;
  return all;
}

double height_of(const Section& section) {
  double all = height::kSection;
  for (const Block& block : section.blocks) all += height_of(block);
  return all;
}

double height_of(const Report& report) {
  double all = 0.0;
  for (const Section& section : report.sections) all += height_of(section);
  return all;
}

bool is_regressed(const Table& table) {
  return std::ranges::any_of(table.rows, [](const Row& row) { return !row.regressed.empty(); });
}

/// How many figures of a gallery stay open at least: up to the last that shows what got worse.
std::size_t least_open(const Gallery& gallery) {
  for (std::size_t i = gallery.figures.size(); i > 0; --i)
    if (!gallery.figures[i - 1].regressed.empty()) return i;
  return 0;
}

bool shows_regression(const Section& section) {
  return std::ranges::any_of(section.blocks, [](const Block& block) {
    const auto* table = std::get_if<Table>(&block);
    const auto* gallery = std::get_if<Gallery>(&block);
    return (table != nullptr && is_regressed(*table)) ||
           (gallery != nullptr && least_open(*gallery) > 0);
  });
}

/// Folds the tables of each section from its `tables`-th on, and what is over `figures` of each
/// gallery.
void fold_beyond(Report& report, std::size_t tables, std::size_t figures) {
  for (Section& section : report.sections) {
    std::size_t seen = 0;
    for (Block& block : section.blocks) {
      if (auto* table = std::get_if<Table>(&block);
          table != nullptr && seen++ >= tables && !is_regressed(*table))
        table->secondary = true;
      if (auto* gallery = std::get_if<Gallery>(&block))
        gallery->open = std::min(gallery->open, std::max(figures, least_open(*gallery)));
    }
  }
}

/// The sections that can be folded, in the order in which that happens: the last of each study
/// first. The first section of a study, and what has no group but one section, stay.
std::vector<const Section*> foldable(const Report& report) {
  std::map<std::string, std::vector<const Section*>> groups;
  for (const Section& section : report.sections) groups[section.group].push_back(&section);
  std::size_t most = 0;
  for (const auto& [group, sections] : groups) most = std::max(most, sections.size());
  std::vector<const Section*> all;
  for (std::size_t size = most; size > 1; --size)
    for (const auto& [group, sections] : groups)
      if (sections.size() >= size && !shows_regression(*sections[size - 1]))
        all.push_back(sections[size - 1]);
  return all;
}

}  // namespace

std::set<const Section*> fold_to_screens(Report& report) {
  constexpr std::pair<std::size_t, std::size_t> kSteps[] = {{2, 6}, {1, 4}, {1, 2}, {0, 2}, {0, 1}};
  for (const auto& [tables, figures] : kSteps) {
    if (height_of(report) <= height::kMost) return {};
    fold_beyond(report, tables, figures);
  }
  std::set<const Section*> folded;
  double open = height_of(report);
  for (const Section* section : foldable(report)) {
    if (open <= height::kMost) break;
    folded.insert(section);
    open -= height_of(*section) - height::kFold;
  }
  return folded;
}

}  // namespace mapproof
