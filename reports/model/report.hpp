#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace mapproof {

/// How a piece of text is set; no style carries meaning that the words lack.
enum class Emphasis {
  kPlain,
  kStrong,
  kCode,  ///< Commands, file names, ids.
  kFile,  ///< A file or folder by its path from the page: a link.
  kData,  ///< Text from a user's file: kept apart from the direction of the text around it.
  kUrl,   ///< An http or https address: a link; any other text is shown as it stands.
};

/// A piece of text. Never markup: whatever it holds is shown as it is.
struct Phrase {
  std::string text;
  Emphasis emphasis = Emphasis::kPlain;
  std::string element = {};  ///< Of a kFile: the id in it that the link leads to.

  bool operator==(const Phrase&) const = default;
};

/// Words set as the text around them.
inline Phrase phrase(std::string text) { return {std::move(text), Emphasis::kPlain}; }

/// Words that stand out.
inline Phrase strong(std::string text) { return {std::move(text), Emphasis::kStrong}; }

struct Paragraph {
  std::vector<Phrase> phrases;

  bool operator==(const Paragraph&) const = default;
};

struct BulletList {
  std::vector<Paragraph> items;
  /// A page shows so many of them and folds the rest.
  std::size_t open = std::numeric_limits<std::size_t>::max();
};

/// A few numbers to be seen first.
struct Highlights {
  struct Item {
    std::string label;
    std::string value;
    std::string detail;
    std::string section =
        {};  ///< Id of the section that says more; empty: the item links to nothing.
    bool falls_short = false;  ///< Of what it is compared with; a page marks it.
    std::string table = {};    ///< Id of the table that has the number: the link leads there.
  };
  std::vector<Item> items;
};

/// A remark that must not be missed.
struct Callout {
  enum class Tone { kNote, kWarning };
  Tone tone = Tone::kNote;
  std::string title;
  Paragraph text;
};

struct TextCell {
  std::string text;
  Emphasis emphasis = Emphasis::kPlain;
  std::string shown = {};  ///< Of a link, on pages in place of its words, which screen readers
                           ///< still say; empty: the words.
};

/// Shown as missing if the value is not a finite number.
struct NumberCell {
  double value = 0.0;
  int decimals = 3;
  bool with_sign = false;  ///< Positive values carry a plus.
  bool error_m = false;    ///< As Column::errors_m, in a column of several quantities.
  double least = 0.0;      ///< What is smaller is shown as "< 0.001", if it is 0.001.
};

struct IntervalCell {
  double low = 0.0;
  double high = 0.0;
  int decimals = 3;
};

/// Nothing to show: "–".
struct MissingCell {};

using Cell = std::variant<TextCell, NumberCell, IntervalCell, MissingCell>;

struct Column {
  std::string title;
  std::string unit;     ///< "m"; empty if none.
  std::string group;    ///< Neighbouring columns of one group share a heading; empty if none.
  std::string tooltip;  ///< One sentence on what the column holds; may be empty.
  /// Whether cells are errors in metres, of which a page says "over 1 km" if they are larger;
  /// unset: if the unit is m.
  std::optional<bool> errors_m = std::nullopt;
  /// The number that the title shows to readers; files of comma-separated values have its digits.
  std::optional<double> number = std::nullopt;
};

/// By how much something got worse over time, as a small curve beside a cell; pages alone show it.
struct ChangeCurve {
  std::size_t cell = 0;              ///< Index of the cell that it stands in.
  std::vector<double> changes = {};  ///< Oldest first, above zero is worse; NaN: not known.
  std::vector<bool> is_found = {};   ///< Per change: whether a finding is about it.
  double least = 1.0;                ///< Improvements of less are drawn as no change.
};

struct Row {
  std::vector<Cell> cells;     ///< One a column.
  std::string source;          ///< Which records the numbers come from.
  bool marked = false;         ///< The best of its table.
  std::string regressed = {};  ///< What got worse of it: "MPE +17.6 %"; pages alone show it.
  std::vector<ChangeCurve> curves = {};
};

struct Table {
  std::string id;  ///< [a-z0-9-]+, unique among tables; also the name of its files.
  std::string caption;
  std::vector<Column> columns;
  std::vector<Row> rows;
  std::vector<std::string> notes;
  bool secondary = false;  ///< What few readers need: a page folds it.
};

/// A curve of a figure that got worse.
struct RegressedCurve {
  std::string label = {};       ///< Of the curve.
  std::vector<double> at = {};  ///< The x values of its points; none: all of them.
  std::size_t panel = 0;        ///< Index of its panel in the figure.

  bool operator==(const RegressedCurve&) const = default;
};

/// Where a figure stands; its drawing is handed to the writer apart.
struct FigureBlock {
  std::string id;  ///< [a-z0-9-]+, unique among figures; also the name of its files.
  std::string title;
  std::string caption;
  std::string alt;  ///< What the figure shows, in words.
  std::vector<std::string> record_ids;
  std::string value = "figure";  ///< What it is as a value, in ID.VALUE.json: "figure", "scene".
  std::vector<std::string> steps = {};  ///< Its panels, where they are one thing at several times.
  std::string regressed = {};           ///< What got worse of what it shows; pages alone show it.
  std::vector<RegressedCurve> regressed_curves = {};  ///< Of its drawing, marked by pages alone.
  bool wide = false;  ///< It has many panels: a page gives it the whole width.
  bool tall = false;  ///< Its panels stand below each other.
  bool is_map = false;  ///< Both axes of its first panel count in one scale.
  /// Per panel a number for what its marks show, equal for equal ones; 0: it has no marks.
  std::vector<std::uint64_t> shows = {};
};

/// Figures of one kind, side by side.
struct Gallery {
  std::vector<FigureBlock> figures;
  /// A page shows so many of them and folds the rest.
  std::size_t open = std::numeric_limits<std::size_t>::max();
  std::string folded = {};  ///< What the rest shows, in a few words; empty: its titles say it.
};

/// Figures and tables that another page of the report holds.
struct PageLinks {
  struct Item {
    std::string element;  ///< Id of the element on that page: "figure-map", "table-errors".
    std::string page;     ///< The page's path from the report's folder: "pages/2.html".
    std::string title;
  };
  std::vector<Item> items;
  std::string words;  ///< How many, and on which pages.
};

struct KeyValues {
  struct Item {
    std::string key;
    Phrase value;
  };
  std::vector<Item> items;
};

/// One thing that got worse, with what a reader wants to know next behind a click.
struct FindingBlock {
  std::string title;                 ///< "ISOMAP: MPE +17.6 % (K = 6 and 8)".
  Paragraph text;                    ///< Where, since when, and where to search.
  std::vector<std::string> details;  ///< Its statistics, a sentence each.
  std::string command;               ///< That searches the commit; may be empty.
  std::string keys;  ///< What a decision on it names: "7.1 7.2"; empty: none can be made here.
  bool known = false;
};

/// Warnings and failures: a page shows a matrix of where they occurred and of their codes.
struct StatusList {
  struct Location {
    std::string record_id;
    std::string detail;
  };
  struct Item {
    std::string code;                 ///< As in the files: "not_converged".
    std::string meaning;              ///< One sentence.
    std::string where;                ///< A row of the matrix: "bearing, ISOMAP".
    int count = 0;                    ///< Maps that carry it.
    int of = 0;                       ///< Maps of that kind in all.
    bool failed = false;              ///< No map came out.
    std::vector<Location> locations;  ///< The first few.
  };
  std::vector<Item> items;
};

using Block = std::variant<Paragraph, BulletList, Highlights, Callout, Table, FigureBlock, Gallery,
                           PageLinks, KeyValues, FindingBlock, StatusList>;

/// How many readers open a report for what a section says.
enum class Interest {
  kSome,
  kMost,  ///< A page folds it last.
  kFew,   ///< A page folds it first.
};

struct Section {
  std::string id;  ///< [a-z0-9-]+, unique among sections.
  std::string title;
  std::vector<Block> blocks;
  std::string group = {};  ///< In a report of several studies, the one that it belongs to.
  Interest interest = Interest::kSome;
};

/// How what is reported stands against something earlier.
struct Standing {
  bool worse = false;
  std::string title;                   ///< "Nightly run 12: accuracy got worse".
  std::vector<std::string> sentences;  ///< What, with numbers.
  std::vector<Paragraph> rest = {};    ///< What the sentences leave out, and where it is.
  std::string note = {};               ///< What holds for several sentences.
};

/// What the reader is to see before anything else: what was done, how good it is, compared with
/// what, what is wrong and where the rest is. What is empty is left out.
struct Opening {
  std::vector<Paragraph> findings;      ///< Two or three sentences, what was done first.
  std::vector<std::string> figure_ids;  ///< Shown small and cropped, each leading to its figure.
  std::optional<Standing> standing = std::nullopt;
  Highlights numbers = {};       ///< How good it is, the most important number first.
  std::string main_figure = {};  ///< Id of the figure that is shown whole; empty: none.
  std::string question = {};     ///< What was asked, before the findings; empty: they say it.
  std::string other_pages = {};  ///< What other pages of the report hold, in words.
  /// What a page always says, after the word "Warnings" and after "Compared with", from the colon
  /// on; empty: it does not.
  Paragraph wrong = {};
  Paragraph compared_with = {};
  /// What is wrong, a clause each, whose details follow a colon; empty: nothing is. Reports of
  /// several studies name it.
  std::vector<std::string> warnings = {};
};

/// What a report says; how it looks is another matter.
struct Report {
  std::string title;
  std::string subtitle;
  std::vector<Section> sections;
  std::string footer;
  Opening opening = {};
  std::string figure_command = {};  ///< Draws a figure again, its id to follow; empty: none does.
  std::string date = {};            ///< When the records were made, YYYY-MM-DD; empty: not known.
};

/// Throws unless every id is [a-z0-9-]+, unique among sections, tables or figures, every row has a
/// cell a column, and the opening's figures and sections are among the report's.
/// @throws InvalidInput naming the id.
void check(const Report& report);

/// Whether a column holds words rather than numbers.
bool holds_text(const Table& table, std::size_t column);

/// Whether any cell of a column is an interval.
bool holds_intervals(const Table& table, std::size_t column);

/// Whether a row of a table got worse.
bool is_regressed(const Table& table);

/// How many of its rows show something that got worse.
std::ptrdiff_t regressed_rows(const Table& table);
/// How many figures of a gallery there are up to the last that shows what got worse; 0: none does.
std::size_t regressed_figures(const Gallery& gallery);
/// Whether a table or a figure of a section shows what got worse.
bool shows_regression(const Section& section);

/// All tables and all figures of a report, in reading order.
std::vector<const Table*> tables(const Report& report);
std::vector<const FigureBlock*> figures(const Report& report);

}  // namespace mapproof
