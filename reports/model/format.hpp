#pragma once

#include <string>
#include <string_view>

#include "reports/model/report.hpp"

namespace mapproof {

/// The sign that stands for a missing value: an en dash.
inline constexpr const char* kMissingText = "\u2013";

/// `value` with `decimals` places and a true minus (U+2212); "–" if it is not a finite number. Zero
/// carries no sign. Without places it has its thousands apart, "25,700". With an exponent from 1e9
/// on, and where six places or more show zeros alone of a value that is none.
std::string format_number(double value, int decimals, bool with_sign = false);

/// As a reader sees it: "0.219", "0.191 to 0.247", "–".
std::string format_cell(const Cell& cell);

/// As a page shows it in prose: as format_number(), with powers of ten set as such, "2.8 × 10¹⁴".
std::string page_number(double value, int decimals, bool with_sign = false);

/// As a page shows it in that column: powers of ten are set as such, and errors of maps that
/// diverged are "over 1 km".
std::string page_cell(const Cell& cell, const Column& column);

/// Smaller p-values are shown as being smaller than this.
inline constexpr double kLeastP = 1e-3;

/// A p-value in a column of them: "0.034", "< 0.001"; files have its digits.
NumberCell p_cell(double p);

/// A p-value in prose: "p = 0.034", "p < 0.001"; of a test corrected for many, "p = 1".
std::string p_words(double p);

/// In place of the p of equal changes, see PairedChange::has_p().
inline constexpr std::string_view kNoPWords = "the changes are equal, so that no p is given";

/// That of a test at a level of kLeastP or less: "p = 3.2 × 10⁻⁷", "p < 10⁻⁹".
std::string small_p_words(double p);

/// "1 of 25 runs", "2,310 of 25,700 maps".
std::string part_text(long long part, long long whole, std::string_view noun);

/// "MPE: Mean [m]": group, title and unit of a column.
std::string full_heading(const Column& column);

/// As seconds_text() below a minute; "4 min 10 s", "2 h 5 min".
std::string format_duration(double seconds);

/// `text` as valid UTF-8 that can be shown: bytes that are no UTF-8 and the controls
/// U+0080 to U+009F become U+FFFD, other control characters but tab and newline their images
/// (U+2400 and on).
std::string displayable(const std::string& text);

/// Escapes a text for content between tags and for quoted attributes of HTML and XML: special
/// characters become references, and what displayable() changes becomes visible.
std::string html_escaped(const std::string& text);

/// The same on one line.
std::string xml_line(const std::string& text);

/// A text of at most `longest` characters that is text alone in Markdown, also in a cell of a table
/// and on a page that accepts HTML.
std::string markdown_text(const std::string& text, std::size_t longest);

}  // namespace mapproof
