#include "reports/html/block_data.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/percent.hpp"
#include "core/base/text/words.hpp"
#include "reports/html/regression_marks.hpp"
#include "reports/model/format.hpp"
#include "reports/model/page_text.hpp"
#include "reports/tables/write_tables.hpp"

namespace mapproof {
namespace {

using kainjow::mustache::data;
using kainjow::mustache::list;

constexpr std::size_t kLongCaption = 800;  ///< Longer ones scroll in a box of their own.

/// Drawings are in a <noscript> element. The script inserts them from there when they come near the
/// viewport; without a script they are simply shown.
void check_drawing(const std::string& id, const std::string& drawing) {
  if (lower_case(drawing).find("</noscript") != std::string::npos)
    throw InvalidInput("report: the drawing of \"" + id + "\" holds </noscript");
}

constexpr double kWidth = 160.0, kHeight = 28.0, kMargin = 3.0;

/// A small curve of changes, oldest first, with a line at zero: an <svg> element without text of
/// its own. Above zero is worse. Classes give the colours: "worse" where a finding is about the
/// change, "better", "same". Changes below the least do not fill half of the height: rounding would
/// seem like mountains.
std::string curve_svg(const ChangeCurve& curve) {
  const std::vector<double>& changes = curve.changes;
  const auto class_of = [&](std::size_t i) {
    if (i < curve.is_found.size() && curve.is_found[i]) return "worse";
    return changes[i] <= -curve.least ? "better" : "same";
  };
  double most = curve.least;
  for (const double value : changes)
    if (std::isfinite(value)) most = std::max(most, std::abs(value));
  const double step =
      changes.size() > 1 ? (kWidth - 2 * kMargin) / static_cast<double>(changes.size() - 1) : 0.0;
  const auto x = [&](std::size_t i) { return kMargin + step * static_cast<double>(i); };
  const auto y = [&](double value) { return kHeight / 2 - (kHeight / 2 - kMargin) * value / most; };
  std::string svg = fmt::format(
      "<svg class=\"curve\" viewBox=\"0 0 {} {}\" width=\"{}\" height=\"{}\" "
      "aria-hidden=\"true\" focusable=\"false\"><line class=\"zero\" x1=\"0\" x2=\"{}\" "
      "y1=\"{}\" y2=\"{}\"/>",
      kWidth, kHeight, kWidth, kHeight, kWidth, kHeight / 2, kHeight / 2);
  for (std::size_t i = 0; i + 1 < changes.size(); ++i)
    if (std::isfinite(changes[i]) && std::isfinite(changes[i + 1]))
      svg += fmt::format(
          "<line class=\"{}\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>",
          class_of(i + 1), x(i), y(changes[i]), x(i + 1), y(changes[i + 1]));
  if (!changes.empty() && std::isfinite(changes.back()))
    svg += fmt::format("<circle class=\"{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.5\"/>",
                       class_of(changes.size() - 1), x(changes.size() - 1), y(changes.back()));
  return svg + "</svg>";
}

/// A folder from the page; false if nothing links to it.
data folder_data(const std::string& folder, const HtmlOptions& options) {
  return text_or_false(folder.empty() ? "" : options.root + folder);
}

/// The target of a link; empty if the text is none.
std::string link_of(Emphasis emphasis, const std::string& text, const HtmlOptions& options) {
  if (emphasis == Emphasis::kFile) return file_link(options.root + text);
  return emphasis == Emphasis::kUrl ? web_link(text) : "";
}

constexpr std::size_t kLongCell = 80;     ///< Longer texts scroll in a box of their own.
constexpr std::size_t kLongHeading = 20;  ///< Longer ones would be a word a line.

bool any_group(const Table& table) {
  for (const Column& column : table.columns)
    if (!column.group.empty()) return true;
  return false;
}

data heading_data(const Table& table, std::size_t index, bool two_rows) {
  const Column& column = table.columns[index];
  data out;
  out.set("title", column.title);
  out.set("unit", text_or_false(column.unit));
  out.set("tooltip", text_or_false(column.tooltip));
  out.set("index", fmt::format("{}", index));
  out.set("text", holds_text(table, index));
  out.set("interval", holds_intervals(table, index));
  out.set("wide", data(column.title.size() > kLongHeading));
  out.set("group", false);
  out.set("rows", two_rows && column.group.empty() ? data("2") : data(false));
  const bool begins = index > 0 && table.columns[index - 1].group != column.group;
  out.set("begins", begins);
  return out;
}

data group_data(const Table& table, std::size_t first, std::size_t count) {
  data out;
  out.set("group", true);
  out.set("title", table.columns[first].group);
  out.set("columns", fmt::format("{}", count));
  out.set("begins", first > 0);
  return out;
}

/// One heading row, or two where columns share headings.
void add_headings(const Table& table, data& out) {
  const bool two_rows = any_group(table);
  list upper;
  list lower;
  for (std::size_t i = 0; i < table.columns.size();) {
    const std::string& group = table.columns[i].group;
    if (group.empty()) {
      upper.push_back(heading_data(table, i++, two_rows));
      continue;
    }
    const std::size_t first = i;
    for (; i < table.columns.size() && table.columns[i].group == group; ++i)
      lower.push_back(heading_data(table, i, false));
    upper.push_back(group_data(table, first, i - first));
  }
  out.set("upper", upper);
  out.set("lower", lower);
  out.set("two_rows", two_rows);
}

/// The sort key of a cell: a number by its value, an interval by its middle; empty cells come last.
struct SortKey {
  std::string operator()(const TextCell& cell) const { return cell.text; }
  std::string operator()(const NumberCell& cell) const { return number(cell.value); }
  std::string operator()(const IntervalCell& cell) const {
    return number(0.5 * cell.low + 0.5 * cell.high);
  }
  std::string operator()(const MissingCell&) const { return ""; }

  static std::string number(double value) {
    return std::isfinite(value) ? fmt::format("{}", value) : "";
  }
};

/// The curve that stands in a cell; false if there is none.
data curve_data(const Row& row, std::size_t index) {
  const auto curve = std::ranges::find(row.curves, index, &ChangeCurve::cell);
  return curve == row.curves.end() ? data(false) : data(curve_svg(*curve));
}

data cell_data(const Table& table, const Row& row, std::size_t index, const HtmlOptions& options) {
  const Cell& cell = row.cells[index];
  const auto* text = std::get_if<TextCell>(&cell);
  const auto emphasis = text != nullptr ? text->emphasis : Emphasis::kPlain;
  data out;
  const std::string link = text == nullptr ? "" : link_of(emphasis, text->text, options);
  const bool is_file = !link.empty();
  const std::string words =
      is_file ? link_words(text->text, options) : page_cell(cell, table.columns[index]);
  const bool is_short = is_file && !text->shown.empty();
  out.set("value", is_short ? text->shown : words);
  out.set("words", is_short ? data(words) : data(false));
  const data curve = curve_data(row, index);
  out.set("curve", curve);
  out.set("heads", index == 0);
  out.set("worse", index == 0 ? text_or_false(row.regressed) : data(false));
  out.set("is_text", text != nullptr || holds_text(table, index));
  out.set("code", emphasis == Emphasis::kCode);
  out.set("file", is_file);
  out.set("link", link);
  const bool is_strong = emphasis == Emphasis::kStrong;
  out.set("strong", is_strong);
  out.set("data", emphasis != Emphasis::kCode && !is_file && !is_strong);
  out.set("date", text != nullptr && is_date(text->text));
  // What stands above a curve is read whole.
  out.set("long", text != nullptr && text->text.size() > kLongCell && curve.is_false());
  const std::string key = std::visit(SortKey{}, cell);
  out.set("sort", text == nullptr ? data("key", key) : data(false));
  const bool begins = index > 0 && table.columns[index - 1].group != table.columns[index].group;
  out.set("begins", begins);
  return out;
}

data row_data(const Table& table, const Row& row, const HtmlOptions& options) {
  data out;
  list cells;
  cells.reserve(row.cells.size());
  for (std::size_t i = 0; i < row.cells.size(); ++i)
    cells.push_back(cell_data(table, row, i, options));
  out.set("cells", cells);
  out.set("marked", row.marked);
  out.set("regressed", text_or_false(row.regressed));
  out.set("source", text_or_false(row.source));
  return out;
}

std::string without_line_end(std::string text) {
  text.erase(text.find_last_not_of("\r\n") + 1);
  return text;
}

/// The rows, each with its lines in the copy of the table as text.
list rows_data(const Table& table, const HtmlOptions& options) {
  const bool copies = options.copies_tables;
  TableLines csv, latex;
  if (copies) {
    csv = csv_lines(table);
    latex = latex_lines(table);
  }
  list rows;
  rows.reserve(table.rows.size());
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    data row = row_data(table, table.rows[i], options);
    row.set("lines", data(copies));
    row.set("csv", copies ? without_line_end(csv.rows[i]) : "");
    row.set("latex", copies ? without_line_end(latex.rows[i]) : "");
    rows.push_back(std::move(row));
  }
  return rows;
}

/// The lines before and after the rows in the copy as text.
void add_frames(const Table& table, bool copies, data& out) {
  out.set("copies", data(copies));
  out.set("csv_head", copies ? without_line_end(csv_lines(table).head) : "");
  const TableLines latex = copies ? latex_lines(table) : TableLines{};
  out.set("latex_head", latex.head);
  out.set("latex_tail", latex.tail);
}

/// A note that an earlier table has is said there alone: a link leads to it by its number.
void add_notes(const Table& table, const FigureContext& drawn, data& out) {
  list notes, earlier;
  std::set<std::string_view> seen;
  for (const std::string& note : table.notes) {
    if (!seen.insert(note).second) continue;
    const auto found = drawn.notes.find(note);
    const FirstNote first = found == drawn.notes.end() ? FirstNote{&table} : found->second;
    const bool is_here = first.table == &table;
    data shown;
    shown.set("note", note);
    shown.set("number", text_or_false(first.number > 0 ? std::to_string(first.number) : ""));
    shown.set("later", data(!earlier.empty()));
    (is_here ? notes : earlier).push_back(std::move(shown));
  }
  out.set("any_notes", data(!notes.empty() || !earlier.empty()));
  out.set("notes", notes);
  out.set("any_earlier_notes", data(!earlier.empty()));
  out.set("earlier_notes", earlier);
}

/// "not_converged" as "not converged"; what is not such a code stays as it is.
std::string words_of_code(std::string code) {
  const auto is_of_code = [](char c) { return (c >= 'a' && c <= 'z') || c == '_'; };
  if (std::ranges::all_of(code, is_of_code)) std::ranges::replace(code, '_', ' ');
  return code;
}

/// The cell of a matrix of warnings; without an item, an empty one.
data warning_cell(const StatusList::Item* item, const std::string& id) {
  data out;
  out.set("any", data(item != nullptr));
  if (item == nullptr) return out;
  const double share = item->of > 0 ? 100.0 * item->count / item->of : 0.0;
  out.set("id", id);
  out.set("failed", data(item->failed));
  out.set("share", format_number(share, share < 1.0 ? 1 : 0) + "\u00a0%");
  out.set("count", part_text(item->count, item->of, "map"));
  return out;
}

/// The distinct texts, in the order in which they occur.
template <typename Get>
std::vector<std::string> distinct(const std::vector<StatusList::Item>& items, Get get) {
  std::vector<std::string> found;
  for (const StatusList::Item& item : items)
    if (const std::string& text = get(item); std::ranges::find(found, text) == found.end())
      found.push_back(text);
  return found;
}

std::vector<std::string> titles_of(const PageLinks& links) {
  std::vector<std::string> titles;
  for (const PageLinks::Item& item : links.items) titles.push_back(item.title);
  return titles;
}

/// Longer texts scroll in a box of their own.
constexpr std::size_t kLong = 200;

data phrase_data(const Phrase& phrase, const HtmlOptions& options) {
  data out;
  const std::string element = phrase.element.empty() ? "" : "#" + phrase.element;
  const std::string address = link_of(phrase.emphasis, phrase.text, options);
  const bool is_file = !address.empty();
  const std::string link = address + (is_file ? element : "");
  const bool is_prose = phrase.emphasis == Emphasis::kPlain || phrase.emphasis == Emphasis::kStrong;
  out.set("text", is_file    ? link_words(phrase.text + element, options)
                  : is_prose ? page_text(phrase.text)
                             : phrase.text);
  out.set("plain",
          phrase.emphasis == Emphasis::kPlain || (phrase.emphasis == Emphasis::kUrl && !is_file));
  out.set("strong", phrase.emphasis == Emphasis::kStrong);
  out.set("code", phrase.emphasis == Emphasis::kCode);
  out.set("file", is_file);
  out.set("link", link);
  out.set("data", phrase.emphasis == Emphasis::kData);
  out.set("long", phrase.text.size() > kLong);
  return out;
}

}  // namespace

MarkedDrawing marked_drawing(const FigureBlock& figure, const FigureContext& drawn) {
  MarkedDrawing marked{.svg = drawn.svg ? drawn.svg(figure.id) : ""};
  std::map<std::string, std::size_t> rings;  // By label: a curve may be in several panels.
  for (const RegressedCurve& curve : figure.regressed_curves)
    rings[curve.label] += mark_curve(curve, marked.svg);
  marked.ringed =
      !rings.empty() && std::ranges::all_of(rings, [](const auto& one) { return one.second > 0; });
  return marked;
}

std::string folded_words(const Gallery& gallery) {
  constexpr std::size_t kLongest = 80;  // Characters of a line on a narrow page.
  std::vector<std::string> titles;
  for (std::size_t i = gallery.open; i < gallery.figures.size(); ++i)
    titles.push_back(gallery.figures[i].title);
  const std::string count =
      counted(std::ssize(titles), gallery.open > 0 ? "more figure" : "figure");
  const std::string words = gallery.folded.empty() ? listed(titles, 3) : gallery.folded;
  const bool are_too_long = gallery.folded.empty() && titles.size() > 1 && words.size() > kLongest;
  return are_too_long ? count : count + ": " + words;
}

data figure_data(const FigureBlock& figure, const FigureContext& drawn,
                 const HtmlOptions& options) {
  data out;
  out.set("id", figure.id);
  out.set("title", figure.title);
  out.set("caption", page_text(figure.caption));
  out.set("alt", figure.alt);
  out.set("value", figure.value);
  out.set("wide", data(figure.wide));
  out.set("long", figure.caption.size() > kLongCaption);
  const auto [drawing, ringed] = marked_drawing(figure, drawn);
  check_drawing(figure.id, drawing);
  out.set("svg", text_or_false(drawing));
  out.set("regressed", text_or_false(figure.regressed));
  out.set("ringed", data(ringed));
  out.set("folder", folder_data(options.figure_folder, options));
  std::string records;
  for (const std::string& id : figure.record_ids) records += (records.empty() ? "" : "; ") + id;
  out.set("records", text_or_false(records));
  list steps;
  for (const std::string& step : figure.steps) steps.push_back(data("step", step));
  out.set("any_steps", data(!steps.empty()));
  out.set("steps", steps);
  return out;
}

std::map<std::string, FirstNote> first_notes(const Report& report) {
  std::map<std::string, FirstNote> first;
  std::set<std::string_view> shared;
  for (const Table* table : tables(report))
    for (const std::string& note : table->notes)
      if (first.try_emplace(note, FirstNote{table}).first->second.table != table)
        shared.insert(note);
  std::size_t count = 0;
  for (const Table* table : tables(report))
    for (const std::string& note : table->notes)
      if (FirstNote& one = first.at(note); one.number == 0 && shared.contains(note))
        one.number = ++count;
  return first;
}

data table_data(const Table& table, const FigureContext& drawn, const HtmlOptions& options) {
  data out;
  out.set("id", table.id);
  out.set("caption", page_text(table.caption));
  out.set("folder", folder_data(options.table_folder, options));
  add_headings(table, out);
  const list rows = rows_data(table, options);
  add_frames(table, options.copies_tables, out);
  out.set("any_rows", !rows.empty());
  out.set("secondary", data(table.secondary));
  const std::ptrdiff_t worse = regressed_rows(table);
  out.set("worse_rows", text_or_false(worse > 0 ? counted(worse, "row") + " got worse" : ""));
  out.set("folded", data(!table.secondary && table.rows.size() > kMostRowsOpen));
  out.set("row_count", counted(std::ssize(table.rows), "row"));
  out.set("table_rows", rows);
  add_notes(table, drawn, out);
  return out;
}

/// The id of the element that a number links to: its table, else its section; empty: none.
std::string target_of(const Highlights::Item& item) {
  if (!item.table.empty()) return "table-" + item.table;
  return item.section.empty() ? "" : "section-" + item.section;
}

list highlight_items(const Highlights& highlights) {
  list items;
  for (const Highlights::Item& item : highlights.items) {
    data out;
    out.set("label", page_text(item.label));
    out.set("value", page_text(item.value));
    out.set("detail", text_or_false(page_text(item.detail)));
    out.set("target", text_or_false(target_of(item)));
    out.set("falls_short", data(item.falls_short));
    items.push_back(std::move(out));
  }
  return items;
}

data phrases_data(const Paragraph& paragraph, const HtmlOptions& options) {
  list phrases;
  for (const Phrase& phrase : paragraph.phrases) phrases.push_back(phrase_data(phrase, options));
  return phrases;
}

namespace {

/// Makes the data of each kind of block, under the name of its template.
class BlockVisitor {
 public:
  BlockVisitor(const FigureContext& drawn, const HtmlOptions& options, std::string matrix)
      : drawn_(drawn), options_(options), matrix_(std::move(matrix)) {
    for (const char* kind : {"paragraph", "bullet_list", "highlights", "callout", "table", "figure",
                             "gallery", "page_links", "key_values", "finding", "status_list"})
      block_.set(kind, false);
  }

  data take() { return std::move(block_); }

  void operator()(const Paragraph& paragraph) {
    data out;
    out.set("phrases", phrases_data(paragraph, options_));
    block_.set("paragraph", out);
  }

  void operator()(const BulletList& bullets) {
    list items, more;
    for (const Paragraph& item : bullets.items)
      (items.size() < bullets.open ? items : more)
          .push_back(data("phrases", phrases_data(item, options_)));
    data out;
    out.set("items", items);
    out.set("any_more", data(!more.empty()));
    out.set("more_words", fmt::format("{} more", more.size()));
    out.set("more", more);
    block_.set("bullet_list", out);
  }

  void operator()(const Highlights& highlights) {
    block_.set("highlights", data("items", highlight_items(highlights)));
  }

  void operator()(const Callout& callout) {
    data out;
    out.set("title", callout.title);
    out.set("warning", callout.tone == Callout::Tone::kWarning);
    out.set("phrases", phrases_data(callout.text, options_));
    block_.set("callout", out);
  }

  void operator()(const Table& table) { block_.set("table", table_data(table, drawn_, options_)); }

  void operator()(const FigureBlock& figure) {
    block_.set("figure", figure_data(figure, drawn_, options_));
  }

  void operator()(const Gallery& gallery) {
    list shown, more;
    for (std::size_t i = 0; i < gallery.figures.size(); ++i)
      (i < gallery.open ? shown : more)
          .push_back(figure_data(gallery.figures[i], drawn_, options_));
    data out;
    out.set("any_figures", data(!shown.empty()));
    out.set("figures", shown);
    out.set("any_more", data(!more.empty()));
    out.set("more", more);
    out.set("more_words", folded_words(gallery));
    block_.set("gallery", out);
  }

  void operator()(const PageLinks& links) {
    list items;
    for (const PageLinks::Item& item : links.items) {
      data out;
      out.set("element", item.element);
      out.set("link", file_link(options_.root + item.page) + "#" + item.element);
      out.set("title", page_text(item.title));
      items.push_back(std::move(out));
    }
    data out;
    const bool are_many = links.items.size() > kMostLinksOpen;
    out.set("words", links.words + (are_many ? ": " + listed(titles_of(links), 3) : ""));
    out.set("many", data(are_many));
    out.set("links", items);
    block_.set("page_links", out);
  }

  void operator()(const KeyValues& pairs) {
    list items;
    for (const KeyValues::Item& item : pairs.items) {
      data out = phrase_data(item.value, options_);
      out.set("key", item.key);
      out.set("date", is_date(item.value.text));
      items.push_back(std::move(out));
    }
    block_.set("key_values", data("items", items));
  }

  void operator()(const FindingBlock& finding) {
    data out;
    out.set("title", finding.title);
    out.set("phrases", phrases_data(finding.text, options_));
    list details;
    for (const std::string& detail : finding.details) details.push_back(data("detail", detail));
    out.set("details", details);
    out.set("any_details", data(!finding.details.empty() || !finding.command.empty()));
    out.set("command", text_or_false(finding.command));
    out.set("keys", text_or_false(finding.keys));
    out.set("known", data(finding.known));
    block_.set("finding", out);
  }

  void operator()(const StatusList& statuses) {
    const auto rows = distinct(statuses.items, [](const auto& item) { return item.where; });
    const auto codes = distinct(statuses.items, [](const auto& item) { return item.code; });
    list heads, lines, items;
    for (const std::string& code : codes) {
      const auto item = std::ranges::find(statuses.items, code, &StatusList::Item::code);
      data head;
      head.set("words", words_of_code(code));
      head.set("meaning", item->meaning);
      heads.push_back(std::move(head));
    }
    for (std::size_t row = 0; row < rows.size(); ++row) {
      list cells;
      for (std::size_t column = 0; column < codes.size(); ++column) {
        const auto item = std::ranges::find_if(statuses.items, [&](const auto& each) {
          return each.where == rows[row] && each.code == codes[column];
        });
        const std::string id = fmt::format("{}-{}-{}", matrix_, row + 1, column + 1);
        const bool is_there = item != statuses.items.end();
        cells.push_back(warning_cell(is_there ? &*item : nullptr, id));
        if (is_there) items.push_back(status_data(*item, id));
      }
      data line;
      line.set("where", rows[row]);
      line.set("cells", cells);
      lines.push_back(std::move(line));
    }
    data out;
    out.set("heads", heads);
    out.set("lines", lines);
    out.set("items", items);
    block_.set("status_list", out);
  }

 private:
  static data status_data(const StatusList::Item& item, const std::string& id) {
    data out;
    out.set("id", id);
    out.set("words", words_of_code(item.code));
    out.set("where", item.where);
    out.set("failed", item.failed);
    out.set("count", part_text(item.count, item.of, "map"));
    list locations, others;
    for (const StatusList::Location& location : item.locations) {
      data entry;
      if (location.detail.empty()) {
        entry.set("record", location.record_id);
        others.push_back(std::move(entry));
        continue;
      }
      entry.set("record", location.record_id);
      entry.set("detail", location.detail);
      entry.set("long", location.detail.size() > kLong);
      locations.push_back(std::move(entry));
    }
    out.set("any_locations", !item.locations.empty());
    out.set("locations", locations);
    out.set("any_others", !others.empty());
    out.set("others", others);
    const int more = item.count - static_cast<int>(item.locations.size());
    out.set("more", more > 0 ? data(fmt::format("and {} more", more)) : data(false));
    return out;
  }

  const FigureContext& drawn_;
  const HtmlOptions& options_;
  std::string matrix_;  ///< Begins the ids of what a matrix links to.
  data block_;
};

}  // namespace

data block_data(const Block& block, const FigureContext& drawn, const HtmlOptions& options,
                const std::string& section) {
  BlockVisitor visitor(drawn, options, section + "-runs");
  std::visit(visitor, block);
  return visitor.take();
}

std::string percent_encoded(std::string_view text) {
  return percent_encoded(text, [](char c) { return is_plain(c, "-._/"); });
}

std::string web_link(const std::string& url) {
  if (!url.starts_with("https://") && !url.starts_with("http://")) return "";
  return percent_encoded(url, [](char c) { return is_plain(c, "-._~:/?#=&+%@,"); });
}

std::string file_link(const std::string& path) {
  return "./" + percent_encoded(path);  // Never taken for a scheme or a host.
}

}  // namespace mapproof
