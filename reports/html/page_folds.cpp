#include "reports/html/page_folds.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "reports/html/block_data.hpp"

namespace mapproof {

std::size_t characters_of(const Paragraph& paragraph) {
  std::size_t size = 0;
  for (const Phrase& phrase : paragraph.phrases) size += phrase.text.size();
  return size;
}

namespace {

/// Heights in pixels on a page 1280 wide, measured on the pages of every kind of study.
namespace height {
constexpr double kMost = 12.75 * 800;  ///< Of what is open: about fifteen screens with the opening.
constexpr double kSection = 105, kFold = 42, kText = 30, kLine = 24;
constexpr double kTable = 165, kRow = 36, kWrapped = 19, kFigure = 530, kWideFigure = 860;
constexpr std::size_t kCharacters = 105;  ///< Of a line of text.
constexpr std::size_t kOfFigure = 66;     ///< Characters of a line below a figure.
}  // namespace height

double height_of(const Paragraph& paragraph) {
  return height::kText +
         height::kLine * static_cast<double>(characters_of(paragraph) / height::kCharacters);
}

/// Of a row, whose longest text takes the more lines the less room its columns have.
double height_of(const Row& row) {
  constexpr std::size_t kManyColumns = 9;  ///< Fewer have room for their texts.
  constexpr std::size_t kOfFirst = 19, kOfOthers = 12, kMostLines = 3;  ///< Characters of a line.
  std::size_t lines = 1;
  for (std::size_t i = 0; row.cells.size() >= kManyColumns && i < row.cells.size(); ++i)
    if (const auto* text = std::get_if<TextCell>(&row.cells[i])) {
      const std::size_t most = i == 0 ? kOfFirst : kOfOthers;
      lines = std::max(lines, std::min(kMostLines, (text->text.size() + most - 1) / most));
    }
  if (!row.regressed.empty()) ++lines;
  return height::kRow + height::kWrapped * static_cast<double>(lines - 1);
}

double height_of(const Table& table) {
  if (table.secondary || table.rows.size() > kMostRowsOpen) return height::kFold;
  double all = height::kTable + height::kLine * static_cast<double>(table.notes.size());
  for (const Row& row : table.rows) all += height_of(row);
  return all;
}

double height_of(const FigureBlock& figure) {
  const double drawing = figure.wide || figure.tall ? height::kWideFigure : height::kFigure;
  if (figure.regressed.empty()) return drawing;
  return drawing + height::kText +
         height::kLine * static_cast<double>(figure.regressed.size() / height::kOfFigure);
}

/// Of those that are open: two stand side by side unless they are wide.
double height_of(const Gallery& gallery) {
  const std::size_t shown = std::min(gallery.open, gallery.figures.size());
  double all = shown < gallery.figures.size() ? height::kFold : 0.0;
  for (std::size_t i = 0; i < shown; ++i) {
    const FigureBlock& figure = gallery.figures[i];
    double row = height_of(figure);
    if (!figure.wide && i + 1 < shown && !gallery.figures[i + 1].wide)
      row = std::max(row, height_of(gallery.figures[++i]));
    all += row;
  }
  return all;
}

double height_of(const BulletList& bullets) {
  double all = bullets.items.size() > bullets.open ? height::kFold : 0.0;
  for (std::size_t i = 0; i < std::min(bullets.open, bullets.items.size()); ++i)
    all += height_of(bullets.items[i]);
  return all;
}

}  // namespace

double height_of(const Block& block) {
  if (const auto* paragraph = std::get_if<Paragraph>(&block)) return height_of(*paragraph);
  if (const auto* table = std::get_if<Table>(&block)) return height_of(*table);
  if (const auto* gallery = std::get_if<Gallery>(&block)) return height_of(*gallery);
  if (const auto* figure = std::get_if<FigureBlock>(&block)) return height_of(*figure);
  double all = 0.0;
  if (const auto* bullets = std::get_if<BulletList>(&block))
    all = height_of(*bullets);
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

namespace {

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

constexpr std::size_t kBulletsOpen = 3;

/// Folds the tables of each section behind its first `tables`, the figures of each gallery behind
/// its first `figures`, and the items of each list behind a few. Tables and figures of sections
/// that most readers want stay open unless `all` is true.
void fold_beyond(Report& report, std::size_t tables, std::size_t figures, bool all) {
  for (Section& section : report.sections) {
    const bool is_kept = !all && section.interest == Interest::kMost;
    std::size_t seen = 0;
    for (Block& block : section.blocks) {
      if (auto* bullets = std::get_if<BulletList>(&block);
          bullets != nullptr && bullets->items.size() > kBulletsOpen)
        bullets->open = std::min(bullets->open, kBulletsOpen);
      if (is_kept) continue;
      if (auto* table = std::get_if<Table>(&block);
          table != nullptr && seen++ >= tables && !is_regressed(*table))
        table->secondary = true;
      if (auto* gallery = std::get_if<Gallery>(&block))
        gallery->open = std::min(gallery->open, std::max(figures, regressed_figures(*gallery)));
    }
  }
}

/// The sections of some interest that can be folded, in the order in which that happens: the last
/// of each study first. The first section of a study, and what has no group but one section, stay.
std::vector<const Section*> foldable(const Report& report, Interest interest) {
  std::map<std::string, std::vector<const Section*>> groups;
  for (const Section& section : report.sections) groups[section.group].push_back(&section);
  std::size_t most = 0;
  for (const auto& [group, sections] : groups) most = std::max(most, sections.size());
  std::vector<const Section*> all;
  for (std::size_t size = most; size > 1; --size)
    for (const auto& [group, sections] : groups)
      if (sections.size() >= size && sections[size - 1]->interest == interest &&
          !shows_regression(*sections[size - 1]))
        all.push_back(sections[size - 1]);
  return all;
}

/// With folded sections.
double open_height(const Report& report, const std::set<const Section*>& folded) {
  double open = height_of(report);
  for (const Section* section : folded) open -= height_of(*section) - height::kFold;
  return open;
}

/// Folds sections until the page is low enough.
void fold_sections(const Report& report, Interest interest, std::set<const Section*>& folded) {
  double open = open_height(report, folded);
  for (const Section* section : foldable(report, interest)) {
    if (open <= height::kMost) return;
    folded.insert(section);
    open -= height_of(*section) - height::kFold;
  }
}

/// Folds the table that each open section has left, that of the last section first, until the page
/// is low enough.
void fold_first_tables(Report& report, const std::set<const Section*>& folded) {
  double open = open_height(report, folded);
  for (auto section = report.sections.rbegin(); section != report.sections.rend(); ++section) {
    if (folded.contains(&*section)) continue;
    for (Block& block : section->blocks) {
      auto* table = std::get_if<Table>(&block);
      if (table == nullptr || is_regressed(*table)) continue;
      if (open <= height::kMost) return;
      open -= height_of(*table);
      table->secondary = true;
      open += height_of(*table);
    }
  }
}

/// Folds the tables that show what got worse but the first one, the last of the report first, until
/// the page is low enough.
void fold_regressed_tables(Report& report, const std::set<const Section*>& folded) {
  std::vector<Table*> regressed;
  for (Section& section : report.sections)
    for (Block& block : section.blocks)
      if (auto* table = std::get_if<Table>(&block);
          table != nullptr && is_regressed(*table) && !table->secondary)
        regressed.push_back(table);
  double open = open_height(report, folded);
  for (std::size_t i = regressed.size(); i > 1 && open > height::kMost; --i) {
    open -= height_of(*regressed[i - 1]);
    regressed[i - 1]->secondary = true;
    open += height_of(*regressed[i - 1]);
  }
}

}  // namespace

std::set<const Section*> fold_to_screens(Report& report) {
  std::set<const Section*> folded;
  const auto fits = [&] { return open_height(report, folded) <= height::kMost; };
  const auto fold_some = [&](std::initializer_list<std::pair<std::size_t, std::size_t>> steps,
                             bool all) {
    for (const auto& [tables, figures] : steps)
      if (!fits()) fold_beyond(report, tables, figures, all);
  };
  fold_some({{2, 6}}, false);
  fold_sections(report, Interest::kFew, folded);
  fold_some({{1, 4}, {1, 2}}, false);
  fold_sections(report, Interest::kSome, folded);
  fold_some({{1, 4}, {1, 2}, {1, 1}}, true);
  fold_first_tables(report, folded);
  fold_sections(report, Interest::kMost, folded);
  fold_regressed_tables(report, folded);
  return folded;
}

}  // namespace mapproof
