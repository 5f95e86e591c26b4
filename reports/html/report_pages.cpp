#include "reports/html/report_pages.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "core/base/text/words.hpp"
#include "reports/html/page_folds.hpp"
#include "reports/model/format.hpp"

namespace mapproof {
namespace {

/// Bytes of markup, fitted to pages of studies of 1 to 10,000 methods.
constexpr std::size_t kTableMarkup = 1300, kColumnMarkup = 120, kCellMarkup = 70;
/// A cell's text stands in the page, in its CSV and in its LaTeX.
constexpr std::size_t kCopiesOfText = 3;
constexpr std::size_t kFigureMarkup = 1200;  ///< Beside drawing, caption and alt.

/// What tells a page of mapproof from one of somebody else.
constexpr std::string_view kGenerator = "<meta name=\"generator\" content=\"mapproof\">";

std::size_t row_bytes(const Row& row) {
  std::size_t bytes = 0;
  for (const Cell& cell : row.cells)
    bytes += kCellMarkup + kCopiesOfText * format_cell(cell).size();
  return bytes;
}

std::size_t head_bytes(const Table& table) {
  std::size_t bytes = kTableMarkup + kColumnMarkup * table.columns.size() + table.caption.size();
  for (const std::string& note : table.notes) bytes += note.size();
  return bytes;
}

/// The figures of galleries that a page folds.
std::set<const FigureBlock*> folded_figures(const Report& report,
                                            const std::set<const Section*>& sections) {
  std::set<const FigureBlock*> folded;
  for (const Section& section : report.sections)
    for (const Block& block : section.blocks)
      if (const auto* gallery = std::get_if<Gallery>(&block))
        for (std::size_t i = sections.contains(&section) ? 0 : gallery->open;
             i < gallery->figures.size(); ++i)
          folded.insert(&gallery->figures[i]);
  return folded;
}

/// The figures that sections that most readers want have open, before a high page folds some.
std::set<std::string> wanted_figures(const Report& report) {
  std::set<std::string> wanted;
  for (const Section& section : report.sections) {
    if (section.interest != Interest::kMost) continue;
    for (const Block& block : section.blocks) {
      if (const auto* figure = std::get_if<FigureBlock>(&block)) wanted.insert(figure->id);
      if (const auto* gallery = std::get_if<Gallery>(&block))
        for (std::size_t i = 0; i < std::min(gallery->open, gallery->figures.size()); ++i)
          wanted.insert(gallery->figures[i].id);
    }
  }
  return wanted;
}

/// Figures in the order in which the first page takes them.
std::vector<const FigureBlock*> by_weight(const Report& report,
                                          const std::set<const FigureBlock*>& folded,
                                          const std::set<std::string>& wanted) {
  std::vector<const FigureBlock*> all = figures(report);
  const std::vector<std::string>& first = report.opening.figure_ids;
  const auto weight = [&](const FigureBlock* figure) {
    if (figure->id == report.opening.main_figure) return 0;
    if (!figure->regressed.empty() || std::ranges::find(first, figure->id) != first.end()) return 0;
    if (wanted.contains(figure->id)) return folded.contains(figure) ? 2 : 1;
    return (figure->value == "scene" ? 4 : 3) + (folded.contains(figure) ? 2 : 0);
  };
  std::ranges::stable_sort(all, {}, weight);
  return all;
}

std::set<std::string> tables_of_first_page(const Report& report, std::size_t most) {
  std::vector<const Table*> all = tables(report);
  std::ranges::stable_sort(all, {}, [](const Table* table) {
    return is_regressed(*table) ? 0 : table->secondary ? 2 : 1;
  });
  std::set<std::string> held;
  std::size_t bytes = 0;
  for (const Table* table : all) {
    const std::size_t own = table_bytes(*table);
    if (bytes + own > most) continue;
    bytes += own;
    held.insert(table->id);
  }
  return held;
}

/// "page 2 (pages/2.html)", "pages 2 to 40 (pages/2.html to 40.html)": on paper a number alone
/// would be that of a sheet.
std::string pages_text(std::size_t first, std::size_t last) {
  return first == last ? fmt::format("page {0} (pages/{0}.html)", first)
                       : fmt::format("pages {0} to {1} (pages/{0}.html to {1}.html)", first, last);
}

/// Fills the further pages of a report in its order.
class FurtherPages {
 public:
  FurtherPages(const Report& report, std::size_t most) : report_(report), most_(most) {}

  /// What is added from now on is of that section.
  void begin(const Section& section) { section_ = &section; }

  /// @return The number of the page that holds the figure.
  std::size_t add(const FigureBlock& figure, std::size_t drawing_bytes) {
    std::vector<Block>& blocks =
        room_for(drawing_bytes + kFigureMarkup + figure.caption.size() + figure.alt.size());
    if (blocks.empty() || !std::holds_alternative<Gallery>(blocks.back()))
      blocks.emplace_back(Gallery{});
    std::get<Gallery>(blocks.back()).figures.push_back(figure);
    return number();
  }

  /// @return The number of the page that holds the table, or its first rows.
  std::size_t add(const Table& table) {
    if (const std::size_t bytes = table_bytes(table); bytes <= most_) {
      room_for(bytes).emplace_back(table);
      return number();
    }
    std::size_t first_page = 0;
    for (std::size_t begin = 0; begin < table.rows.size();) {
      std::size_t end = begin, bytes = head_bytes(table);
      while (end < table.rows.size() &&
             (end == begin || bytes + row_bytes(table.rows[end]) <= most_))
        bytes += row_bytes(table.rows[end++]);
      Table part{.id = table.id,
                 .caption = fmt::format("{} Rows {} to {} of {}.", table.caption, begin + 1, end,
                                        table.rows.size()),
                 .columns = table.columns,
                 .rows = {table.rows.begin() + static_cast<std::ptrdiff_t>(begin),
                          table.rows.begin() + static_cast<std::ptrdiff_t>(end)},
                 .notes = table.notes};
      room_for(bytes, begin > 0).emplace_back(std::move(part));
      if (begin == 0) first_page = number();
      begin = end;
    }
    return first_page;
  }

  std::vector<Report> take() && { return std::move(pages_); }

  /// Of the page that is being filled.
  std::size_t number() const { return pages_.size() + 1; }

 private:
  /// The blocks of the section on a page that has so many bytes left.
  std::vector<Block>& room_for(std::size_t bytes, bool on_next = false) {
    if (pages_.empty() || on_next || (held_ > 0 && held_ + bytes > most_)) {
      pages_.push_back({.title = report_.title,
                        .subtitle = {},
                        .sections = {},
                        .footer = report_.footer,
                        .date = report_.date});
      held_ = 0;
    }
    held_ += bytes;
    std::vector<Section>& sections = pages_.back().sections;
    if (sections.empty() || sections.back().id != section_->id)
      sections.push_back({section_->id, section_->title, {}, section_->group});
    return sections.back().blocks;
  }

  const Report& report_;
  std::size_t most_;
  const Section* section_ = nullptr;
  std::vector<Report> pages_;
  std::size_t held_ = 0;  ///< Bytes on the last page.
};

/// Moves what the first page does not hold to further pages.
class Division {
 public:
  Division(const Report& report, const DrawingSize& bytes_of, const PageLimits& limits)
      : report_(report),
        bytes_of_(bytes_of),
        figures_(figures_of_first_page(report, bytes_of, limits.drawing_bytes)),
        tables_(tables_of_first_page(report, limits.table_bytes)),
        further_(report, limits.further_bytes) {}

  std::vector<Report> pages() && {
    Report first = report_;
    for (std::size_t i = 0; i < first.sections.size(); ++i) {
      further_.begin(report_.sections[i]);
      std::vector<Block> kept;
      links_ = {};
      for (Block& block : first.sections[i].blocks) divide(std::move(block), kept);
      if (!links_.items.empty()) {
        links_.words = words_of_links();
        kept.emplace_back(std::move(links_));
      }
      first.sections[i].blocks = std::move(kept);
    }
    std::vector<Report> further = std::move(further_).take();
    const std::size_t count = further.size() + 1;
    if (count > 1) first.opening.other_pages = words(count);
    const auto is_elsewhere = [&](const std::string& id) { return !figures_.contains(id); };
    std::erase_if(first.opening.figure_ids, is_elsewhere);
    if (is_elsewhere(first.opening.main_figure)) first.opening.main_figure.clear();
    std::vector<Report> all;
    all.push_back(std::move(first));
    for (Report& page : further) {
      const std::size_t number = all.size() + 1;
      page.subtitle = fmt::format("Page {} of {}", number, count);
      page.opening.findings.push_back(ways(number, count));
      all.push_back(std::move(page));
    }
    return all;
  }

 private:
  void divide(Block block, std::vector<Block>& kept) {
    if (const auto* table = std::get_if<Table>(&block)) {
      if (tables_.contains(table->id)) return kept.push_back(std::move(block));
      const std::size_t page = further_.add(*table);
      link("table-" + table->id, page, table->caption);
      last_page_ = further_.number();
    } else if (const auto* figure = std::get_if<FigureBlock>(&block)) {
      if (figures_.contains(figure->id)) return kept.push_back(std::move(block));
      move_figure(*figure);
    } else if (auto* gallery = std::get_if<Gallery>(&block)) {
      divide_gallery(std::move(*gallery), kept);
    } else {
      kept.push_back(std::move(block));
    }
  }

  void divide_gallery(Gallery gallery, std::vector<Block>& kept) {
    Gallery here;
    here.folded = gallery.folded;
    std::size_t open = 0;
    for (std::size_t i = 0; i < gallery.figures.size(); ++i)
      if (!figures_.contains(gallery.figures[i].id)) {
        move_figure(gallery.figures[i]);
      } else {
        open += i < gallery.open ? 1 : 0;
        here.figures.push_back(std::move(gallery.figures[i]));
      }
    if (open < here.figures.size()) here.open = open;
    if (!here.figures.empty() || gallery.figures.empty()) kept.emplace_back(std::move(here));
  }

  void move_figure(const FigureBlock& figure) {
    link("figure-" + figure.id, further_.add(figure, bytes_of_(figure.id)),
         figure.title.empty() ? figure.id : figure.title);
    ++moved_figures_;
  }

  void link(std::string element, std::size_t page, const std::string& title) {
    if (links_.items.empty()) first_page_ = page;
    last_page_ = page;
    links_.items.push_back({std::move(element), page_path(page), title});
  }

  /// "9000 figures and 2 tables on pages 7 to 51".
  std::string words_of_links() const {
    const auto of_tables = std::ranges::count_if(links_.items, [](const PageLinks::Item& item) {
      return item.element.starts_with("table-");
    });
    const auto of_figures = std::ssize(links_.items) - of_tables;
    std::string text;
    if (of_figures > 0) text = counted(of_figures, "figure");
    if (of_tables > 0) text += (text.empty() ? "" : " and ") + counted(of_tables, "table");
    return fmt::format("{} on {}", text, pages_text(first_page_, last_page_));
  }

  /// "9900 of 10000 figures and 3 of 8 tables are on pages 2 to 40 …".
  std::string words(std::size_t count) const {
    const std::size_t all_tables = tables(report_).size(),
                      moved_tables = all_tables - tables_.size();
    std::string text;
    if (moved_figures_ > 0)
      text =
          fmt::format("{} of {}", moved_figures_, counted(std::ssize(figures(report_)), "figure"));
    if (moved_tables > 0)
      text += fmt::format("{}{} of {}", text.empty() ? "" : " and ", moved_tables,
                          counted(static_cast<long long>(all_tables), "table"));
    return fmt::format("{} {} on {}. Their titles stand here as links, in their sections.", text,
                       moved_figures_ + moved_tables == 1 ? "is" : "are", pages_text(2, count));
  }

  static Paragraph ways(std::size_t number, std::size_t count) {
    Paragraph text{{phrase("See "), {page_path(1), Emphasis::kFile}}};
    if (number > 2) {
      text.phrases.push_back(phrase(", "));
      text.phrases.push_back({page_path(number - 1), Emphasis::kFile});
    }
    if (number < count) {
      text.phrases.push_back(phrase(", "));
      text.phrases.push_back({page_path(number + 1), Emphasis::kFile});
    }
    text.phrases.push_back(phrase("."));
    return text;
  }

  const Report& report_;
  const DrawingSize& bytes_of_;
  std::set<std::string> figures_, tables_;  ///< Of the first page.
  FurtherPages further_;
  PageLinks links_;                             ///< Of the section that is being divided.
  std::size_t first_page_ = 0, last_page_ = 0;  ///< Where these links lead.
  std::size_t moved_figures_ = 0;
};

}  // namespace

std::size_t table_bytes(const Table& table) {
  std::size_t bytes = head_bytes(table);
  for (const Row& row : table.rows) bytes += row_bytes(row);
  return bytes;
}

std::set<std::string> figures_of_first_page(const Report& report, const DrawingSize& bytes_of,
                                            std::size_t drawing_bytes) {
  Report folded = report;
  const std::set<const Section*> sections = fold_to_screens(folded);
  std::set<std::string> held;
  std::size_t bytes = 0;
  for (const FigureBlock* figure :
       by_weight(folded, folded_figures(folded, sections), wanted_figures(report))) {
    const std::size_t own = bytes_of(figure->id);
    if (bytes + own > drawing_bytes) continue;
    bytes += own;
    held.insert(figure->id);
  }
  return held;
}

std::vector<Report> pages_of(const Report& report, const DrawingSize& bytes_of,
                             const PageLimits& limits) {
  return Division(report, bytes_of, limits).pages();
}

std::string page_path(std::size_t number) {
  return number == 1 ? "report.html" : fmt::format("pages/{}.html", number);
}

void write_further_pages(const OutputFolder& folder, std::size_t count,
                         const std::function<std::string(std::size_t)>& html_of) {
  for (std::size_t number = 2; number <= count; ++number)
    folder.write(page_path(number), html_of(number));
  std::size_t end = count + 1;
  while (const std::optional<std::string> left = folder.read(page_path(end))) {
    if (left->find(kGenerator) == std::string::npos) break;
    ++end;
  }
  // The last one first: after a kill the others are found again.
  while (--end > count) folder.remove(page_path(end));
  std::error_code error;  // A folder that holds anything stays.
  if (count == 1) std::filesystem::remove(folder.path() / "pages", error);
}

HtmlOptions page_options(std::size_t number, std::size_t count, HtmlOptions options) {
  if (number == 1) return options;
  options.root = "../";
  options.link_words[page_path(1)] = "the start of the report, with all titles";
  if (number > 2) options.link_words[page_path(number - 1)] = fmt::format("page {}", number - 1);
  if (number < count)
    options.link_words[page_path(number + 1)] = fmt::format("page {}", number + 1);
  return options;
}

}  // namespace mapproof
