#include "reports/diff/documents/document_diff.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files/byte_source.hpp"
#include "core/base/text/words.hpp"
#include "core/records/studies/study_page.hpp"
#include "core/records/tables/table_reader.hpp"
#include "reports/diff/documents/excerpts.hpp"
#include "reports/diff/records/numbers_in_text.hpp"
#include "reports/diff/records/record_diff.hpp"
#include "reports/diff/records/record_set.hpp"

namespace mapproof {
namespace {

/// The differences of two tables of one format ("csv", "md", "tex"), cell by cell.
struct TableDiff {
  OtherDiff cells;        ///< Locations are "row 3 (ISOMAP), MPE [m]".
  bool is_style = false;  ///< Only headings, captions or markup differ.
};

namespace fs = std::filesystem;

constexpr std::size_t kLargestTable = std::size_t{1} << 26;  // Bytes.
constexpr std::size_t kMostCellText = 60;                    // Of a cell in a message.
constexpr std::array<std::string_view, 4> kVarying = {"durations", "sessions", "slam-seconds",
                                                      "slam-sessions"};

using Row = std::vector<std::string>;

struct Rows {
  std::vector<Row> rows = {};
  std::size_t heading = 0;  ///< The index of the row with the names of the columns.
  bool has_heading = false;
  bool is_markup = false;  ///< Markdown or LaTeX.
};

/// A cell as readers see it: in markup a backslash before punctuation is not shown.
std::string cell_text(const Rows& table, const std::string& cell) {
  std::string text;
  for (std::size_t i = 0; i < cell.size(); ++i) {
    const bool escapes = table.is_markup && cell[i] == '\\' && i + 1 < cell.size() &&
                         cell[i + 1] != '\\' &&
                         std::ispunct(static_cast<unsigned char>(cell[i + 1])) != 0;
    text += cell[escapes ? ++i : i];
  }
  return text;
}

Row cells_of(std::string_view line, char separator) {
  Row cells;
  for (std::size_t at = 0; at <= line.size();) {
    std::size_t end = line.find(separator, at);
    while (end != std::string_view::npos && end > 0 && line[end - 1] == '\\')
      end = line.find(separator, end + 1);
    end = std::min(end, line.size());
    cells.emplace_back(trimmed(line.substr(at, end - at)));
    at = end + 1;
  }
  return cells;
}

Rows read_csv(const std::string& text, const std::string& source) {
  Rows table{.has_heading = true};
  TableReader reader(text, source, ',');
  for (TableRow row; reader.next(row);) table.rows.emplace_back(row.cells.begin(), row.cells.end());
  if (table.rows.empty()) throw IoError(source, "is empty");
  return table;
}

/// Lines; those of Markdown that begin with '|' are rows, in LaTeX every line may be one.
Rows read_lines(std::string_view text, const std::string& source, bool is_markdown) {
  Rows table{.is_markup = true};
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = text.substr(at, end - at);
    const bool is_row = is_markdown && line.starts_with('|');
    if (is_row && !table.has_heading) {
      table.has_heading = true;
      table.heading = table.rows.size();
    }
    table.rows.push_back(cells_of(line, is_row ? '|' : '&'));
    at = end + 1;
  }
  const bool is_whole = is_markdown ? table.has_heading
                                    : text.find("\\toprule") != std::string_view::npos &&
                                          text.find("\\end{table}") != std::string_view::npos;
  if (!is_whole) throw IoError(source, "is not a table that mapproof wrote, or is truncated");
  return table;
}

Rows read_table(const std::string& format, const fs::path& path) {
  const std::string text = read_input(path, kLargestTable);
  return format == "csv" ? read_csv(text, path.string())
                         : read_lines(text, path.string(), format == "md");
}

std::string location_of(const Rows& table, std::size_t row, std::size_t column) {
  const Row& cells = table.rows[row];
  const std::size_t label = table.has_heading && cells[0].empty() && cells.size() > 1 ? 1 : 0;
  std::string text = fmt::format("row {}", row + 1);
  if (row != table.heading && !cells[label].empty() && column != label)
    text += " (" + printable(cell_text(table, cells[label]), kMostCellText) + ")";
  const bool named = table.has_heading && column < table.rows[table.heading].size();
  return text + ", " +
         (named ? printable(cell_text(table, table.rows[table.heading][column]), kMostCellText)
                : fmt::format("cell {}", column + 1));
}

class TableComparer {
 public:
  TableComparer(const Rows& a, const Rows& b, const Tolerance& tolerance)
      : a_(a), b_(b), tolerance_(tolerance) {}

  TableDiff compare() {
    if (a_.rows.size() != b_.rows.size()) {
      report("the table", counted(std::ssize(a_.rows), "row"), counted(std::ssize(b_.rows), "row"));
      return std::move(found_);
    }
    for (std::size_t row = 0; row < a_.rows.size(); ++row) compare_row(row);
    found_.is_style = found_.cells.shape && !body_differs_;
    return std::move(found_);
  }

 private:
  void report(const std::string& location, const std::string& before, const std::string& after) {
    found_.cells.shape = true;
    body_differs_ = true;
    note(location, before, after);
  }

  void note(const std::string& location, const std::string& before, const std::string& after) {
    if (!found_.cells.first.empty()) return;
    found_.cells.first = location;
    std::tie(found_.cells.baseline, found_.cells.current) = excerpts(before, after, kMostCellText);
  }

  void compare_row(std::size_t row) {
    const Row &first = a_.rows[row], &second = b_.rows[row];
    if (first.size() != second.size())
      return report(fmt::format("row {}", row + 1), counted(std::ssize(first), "cell"),
                    counted(std::ssize(second), "cell"));
    for (std::size_t i = 0; i < first.size(); ++i) {
      found_.cells.numbers += static_cast<long>(numbers_in(first[i]).size());
      const TextChange change = text_change(first[i], second[i], tolerance_);
      if (change == TextChange::kNone) continue;
      if (change == TextChange::kWithin) {
        ++found_.cells.within;
        continue;
      }
      note(location_of(a_, row, i), cell_text(a_, first[i]), cell_text(b_, second[i]));
      const bool is_body = a_.has_heading ? row > a_.heading : first.size() > 1;
      body_differs_ |= is_body;
      if (change == TextChange::kNumbers && is_body)
        ++found_.cells.beyond;
      else
        found_.cells.shape = true;
    }
  }

  const Rows &a_, &b_;
  Tolerance tolerance_;
  TableDiff found_;
  bool body_differs_ = false;
};

/// Whether the content of the table with that id differs from run to run: seconds, dates, hosts,
/// commands.
bool varies(std::string_view table) {
  return table.starts_with("seconds--") || table.starts_with("sessions--") ||
         std::ranges::find(kVarying, table) != kVarying.end();
}

/// @param tolerance  Of numbers, also of those within texts.
/// @throws IoError if either cannot be read as a table of that format.
TableDiff table_diff(const std::string& format, const fs::path& baseline, const fs::path& current,
                     const Tolerance& tolerance) {
  const Rows a = read_table(format, baseline), b = read_table(format, current);
  TableDiff diff = TableComparer(a, b, tolerance).compare();
  diff.cells.file = baseline.filename().string();
  return diff;
}

/// Whether both have the same headings.
bool same_headings(const std::string& format, const fs::path& baseline, const fs::path& current) {
  const Rows a = read_table(format, baseline), b = read_table(format, current);
  return a.has_heading == b.has_heading &&
         (!a.has_heading || a.rows[a.heading] == b.rows[b.heading]);
}

namespace fs = std::filesystem;

/// A kind of region and how its first tag names it.
struct Region {
  std::string_view open, close, mark, prefix;
};
constexpr std::array kRegions = {
    Region{"<figure", "</figure>", "id=\"figure-", ""},
    Region{"<table", "</table>", "aria-labelledby=\"caption-", "tables/"},
    Region{"<section", "</section>", "id=\"section-", "section "}};

/// Elements whose content is not a text.
constexpr std::array<std::string_view, 2> kSilent = {"script", "style"};

/// The id that the tag at `at` carries, with what is before it; empty if it carries none.
std::optional<std::string> id_at(std::string_view html, std::size_t at, const Region& region) {
  if (!html.substr(at).starts_with(region.open)) return std::nullopt;
  const std::string_view tag = html.substr(at, html.find('>', at) - at);
  const std::size_t mark = tag.find(region.mark);
  if (mark == std::string_view::npos) return std::nullopt;
  const std::size_t first = mark + region.mark.size();
  return std::string(region.prefix) + std::string(tag.substr(first, tag.find('"', first) - first));
}

bool is_provenance(const std::string& id) {
  return id.starts_with("section ") && id.ends_with("provenance");
}

/// The end of the region to leave out that begins at `at`; `at` if none begins there.
std::size_t region_end(std::string_view html, std::size_t at,
                       const std::function<bool(const std::string& id)>& is_reported) {
  // Which version made the page, and when.
  constexpr std::pair<std::string_view, std::string_view> kMadeBy[] = {
      {"<p class=\"subtitle made\"", "</p>"}, {"<footer class=\"footer\"", "</footer>"}};
  for (const auto& [open, close] : kMadeBy)
    if (html.substr(at).starts_with(open))
      if (const std::size_t end = html.find(close, at); end != std::string_view::npos)
        return end + close.size();
  for (const Region& region : kRegions) {
    const auto id = id_at(html, at, region);
    if (!id || !(is_provenance(*id) || (!id->starts_with("section ") && is_reported(*id))))
      continue;
    const std::size_t close = html.find(region.close, at);
    if (close != std::string_view::npos) return close + region.close.size();
  }
  return at;
}

/// The end of the element at `at` if it holds no text; else `at`.
std::size_t silent_end(std::string_view html, std::size_t at) {
  for (const std::string_view name : kSilent) {
    if (!html.substr(at + 1).starts_with(name)) continue;
    const std::size_t close = html.find("</" + std::string(name), at);
    return close == std::string_view::npos ? html.size() : close;
  }
  return at;
}

/// A report's page without the parts that other items cover. Its scripts and styles stay; its
/// provenance (versions, commands, dates) and the figures and tables that `is_reported` accepts are
/// removed, region by region. Ids are "figure-ID" of <figure>, "caption-ID" of <table>,
/// "section-ID" of <section>.
/// @param is_reported  Whether another item covers "fig-7" or "tables/accuracy".
std::string masked_page(std::string_view html,
                        const std::function<bool(const std::string& id)>& is_reported) {
  std::string kept;
  for (std::size_t at = 0; at < html.size();) {
    const std::size_t end = html[at] == '<' ? region_end(html, at, is_reported) : at;
    if (end > at) {
      at = end;
      continue;
    }
    const std::size_t next = std::min(html.find('<', at + 1), html.size());
    kept += html.substr(at, next - at);
    at = next;
  }
  return kept;
}

/// The text of a page without its markup, scripts and styles: one line per piece of text.
std::string page_words(std::string_view html) {
  std::string words;
  for (std::size_t at = 0; at < html.size();) {
    if (html[at] == '<') {
      const std::size_t content = silent_end(html, at);
      const std::size_t close = html.find('>', content);
      at = close == std::string_view::npos ? html.size() : close + 1;
      continue;
    }
    const std::size_t next = std::min(html.find('<', at), html.size());
    const std::string_view piece = html.substr(at, next - at);
    if (const std::string_view text = trimmed(piece, kWhiteSpace); !text.empty()) {
      words += text;
      words += '\n';
    }
    at = next;
  }
  return words;
}

constexpr std::size_t kLargestPage = std::size_t{1} << 28;  // Bytes.
constexpr std::size_t kMostTextLength = 80;

bool is_page(const ItemFiles& files) { return files.documents.contains("html"); }

Tolerance tolerance_of_numbers(const DiffSettings& settings) {
  return tolerance_of_others(settings.records.tolerances);
}

const DiffItem* heaviest_records(const std::vector<DiffItem>& reported) {
  const DiffItem* heaviest = nullptr;
  for (const DiffItem& item : reported)
    if (item.kind == ItemKind::kRecords &&
        (heaviest == nullptr || item.judgement.verdict > heaviest->judgement.verdict))
      heaviest = &item;
  return heaviest;
}

/// Judges changed data by the records from which they follow.
Judgement by_records(const std::string& what, const std::vector<DiffItem>& reported) {
  const DiffItem* records = heaviest_records(reported);
  if (records == nullptr) return {Verdict::kChanged, true, what};
  const Verdict verdict = records->judgement.verdict;
  if (verdict <= Verdict::kWithinTolerance)
    return {Verdict::kChanged, true, what + "; its records did not change"};
  const bool has_direction = verdict == Verdict::kBetter || verdict == Verdict::kWorse;
  // The item of the records has the details.
  const std::string& cause = records->judgement.cause;
  const std::string why = follows_from(*records) + cause.substr(0, cause.find("; "));
  const std::string settings = records->records ? settings_text(*records->records) : "";
  return {has_direction ? verdict : Verdict::kChanged, true, what + "; " + why,
          settings.empty() ? why : settings};
}

std::string first_text(const OtherDiff& cells) {
  const auto [before, after] = readable_numbers(cells.baseline, cells.current);
  return fmt::format("{}: {} \u2192 {}", cells.first, before, after);
}

Judgement judge_table(const DiffItem& item, const std::vector<TableDiff>& tables,
                      const std::vector<DiffItem>& reported) {
  const TableDiff* style = nullptr;
  long within = 0;
  for (const TableDiff& table : tables) {
    within += table.cells.within;
    if (table.cells.beyond > 0 || (table.cells.shape && !table.is_style))
      return by_records(fmt::format("{}, {}", table.cells.file, first_text(table.cells)), reported);
    if (table.is_style && style == nullptr) style = &table;
  }
  if (style != nullptr)
    return {Verdict::kStyle, true, style->cells.file + ", " + first_text(style->cells)};
  if (within > 0)
    return {Verdict::kWithinTolerance, false,
            counted(within, "cell") + (within == 1 ? " differs" : " differ") + " within tolerance"};
  return item.documents.empty() ? Judgement{}
                                : Judgement{Verdict::kWithinTolerance, false,
                                            "its cells are equal, its bytes are not"};
}

/// Of each format that both sides have and whose bytes differ.
void compare_tables(DiffItem& item, const ItemFiles& a, const ItemFiles& b,
                    const std::vector<DiffItem>& reported, const DiffSettings& settings) {
  std::vector<TableDiff> tables;
  Tolerance tolerance = tolerance_of_numbers(settings);
  const bool is_varying = varies(fs::path(item.id).filename().string());
  for (const auto& [format, baseline] : a.documents) {
    const auto current = b.documents.find(format);
    if (current == b.documents.end() || same_bytes(baseline, current->second)) continue;
    if (is_varying && same_headings(format, baseline, current->second)) {
      item.documents.push_back({.file = baseline.filename().string()});
      item.judgement = {Verdict::kWithinTolerance, false,
                        "seconds, dates and hosts vary from run to run"};
      continue;
    }
    tables.push_back(table_diff(format, baseline, current->second, tolerance));
    item.documents.push_back(tables.back().cells);
    // Printed numbers are rounded from the CSV, the first of the formats: their last digit may
    // change where the exact numbers differ within tolerance.
    if (format == "csv" && tables.back().cells.within > 0) tolerance.absolute = 1e300;
  }
  if (!tables.empty()) item.judgement = judge_table(item, tables, reported);
}

/// The first line that differs, with the numbers of both.
OtherDiff words_diff(const std::string& a, const std::string& b) {
  OtherDiff diff;
  std::size_t at = 0, line = 1;
  const std::size_t least = std::min(a.size(), b.size());
  for (std::size_t i = 0; i < least && a[i] == b[i]; ++i)
    if (a[i] == '\n') {
      at = i + 1;
      ++line;
    }
  const auto line_at = [&](const std::string& text) {
    return at < text.size() ? text.substr(at, text.find('\n', at) - at) : "nothing";
  };
  diff.first = fmt::format("line {} of its text", line);
  std::tie(diff.baseline, diff.current) = excerpts(line_at(a), line_at(b), kMostTextLength);
  diff.shape = true;
  return diff;
}

void compare_pages(DiffItem& item, const fs::path& baseline, const fs::path& current,
                   const std::vector<DiffItem>& reported, const DiffSettings& settings) {
  // What a page carries are records and figures, which are items of their own.
  const std::string before = without_page_data(read_input(baseline, kLargestPage));
  const std::string after = without_page_data(read_input(current, kLargestPage));
  if (before == after) return;
  for (const auto& [text, path] : {std::pair(&before, &baseline), std::pair(&after, &current)})
    if (text->find("</html>") == std::string::npos)
      throw IoError(path->string(), "is not a page, or is truncated");
  std::set<std::string> others;
  for (const DiffItem& other : reported)
    if (other.judgement.verdict != Verdict::kIdentical) others.insert(other.id);
  const auto is_reported = [&](const std::string& id) { return others.contains(id); };
  const std::string a = masked_page(before, is_reported), b = masked_page(after, is_reported);
  item.documents.push_back({.file = baseline.filename().string()});
  if (a == b) {
    item.judgement = {Verdict::kWithinTolerance, false,
                      "equal, except for its provenance and for parts that other items cover"};
    return;
  }
  const std::string words = page_words(a), other_words = page_words(b);
  if (words == other_words) {
    item.judgement = {Verdict::kStyle, true, "its text is equal, its styles or markup are not"};
    return;
  }
  OtherDiff& first = item.documents.back() = words_diff(words, other_words);
  first.file = baseline.filename().string();
  const TextChange change = text_change(words, other_words, tolerance_of_numbers(settings));
  const DiffItem* records = heaviest_records(reported);
  const bool follows = records != nullptr && records->judgement.verdict > Verdict::kWithinTolerance;
  if (change == TextChange::kWithin)
    item.judgement = {Verdict::kWithinTolerance, false, "its numbers differ within tolerance"};
  else if (change == TextChange::kWords && !follows)
    item.judgement = {Verdict::kStyle, true, "the text differs, " + first_text(first)};
  else
    item.judgement = by_records(first_text(first), reported);
}

void judge_presence(DiffItem& item, const ItemFiles& a, const ItemFiles& b) {
  for (const auto& [format, path] : a.documents)
    if (!b.documents.contains(format))
      item.judgement = {Verdict::kMissing, true, "its " + format + " is missing"};
  if (item.judgement.verdict == Verdict::kMissing) return;
  for (const auto& [format, path] : b.documents)
    if (!a.documents.contains(format) && item.judgement.verdict < Verdict::kNew)
      item.judgement = {Verdict::kNew, true, "its " + format + " is not in the baseline"};
}

}  // namespace

DiffItem document_item(const std::string& id, const ItemFiles* baseline, const ItemFiles* current,
                       const std::vector<DiffItem>& reported, const DiffSettings& settings) {
  DiffItem item;
  item.id = id;
  item.kind = ItemKind::kDocument;
  if (baseline == nullptr) {
    item.judgement = {Verdict::kNew, true, "is not in the baseline"};
  } else if (current == nullptr) {
    item.judgement = {Verdict::kMissing, true, "is not in the current"};
  } else {
    try {
      if (is_page(*baseline))
        compare_pages(item, baseline->documents.begin()->second, current->documents.begin()->second,
                      reported, settings);
      else
        compare_tables(item, *baseline, *current, reported, settings);
      judge_presence(item, *baseline, *current);
    } catch (const IoError& error) {
      item.judgement = {Verdict::kUnreadable, true, error.what()};
    }
  }
  item.passes = passes(item.judgement, settings.allowed_of(item.id));
  return item;
}

void add_documents(std::vector<DiffItem>& items, const ItemList& baseline, const ItemList& current,
                   const std::string& sole, const DiffSettings& settings) {
  std::map<std::string, std::pair<const ItemFiles*, const ItemFiles*>> all;
  for (const auto& [id, files] : baseline)
    if (!files.documents.empty()) all[id].first = &files;
  for (const auto& [id, files] : current)
    if (!files.documents.empty()) all[id].second = &files;
  for (const bool pages : {false, true})
    for (const auto& [id, sides] : all)
      if (is_page(*(sides.first ? sides.first : sides.second)) == pages)
        items.push_back(
            document_item(id.empty() ? sole : id, sides.first, sides.second, items, settings));
}

}  // namespace mapproof
