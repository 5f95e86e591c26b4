#include "render/plot/short_names.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace mapproof {
namespace {

constexpr double kNarrow = 40.0;  // em; a column of a journal has some 30, a page some 60.

using ShortNames = std::pair<std::string_view, std::string_view>;

/// Short enough for a column, and as clear as the whole.
constexpr std::array<ShortNames, 4> kMethods = {{
    {"SMACOF, equal weights", "SMACOF"},
    {"SMACOF, kNN weights", "SMACOF kNN"},
    {"KPCA, Gaussian", "KPCA Gauss"},
    {"KPCA, polynomial", "KPCA poly"},
}};

/// Clear beside the others of their figure alone. Each is a whole part of a label of a topic or an
/// experiment of ours, so that labels of others keep their words.
constexpr std::array<ShortNames, 15> kShort = {{
    {"Pairwise-complete", "Pairwise"},
    {"PPCA, expected squares", "PPCA squares"},
    {"PCA with missing data", "PCA"},
    {"Covisible pairs, SMACOF of relative errors", "Covisible pairs"},
    {"The strategy that the pattern of missing data suggests", "suggested"},
    {", kNN-SMACOF", ", kNN"},
    {"mean distance, equal weights", "mean dist., equal"},
    {"mean distance, weighted", "mean dist., weighted"},
    {" alone, its order", ", its order"},
    {"Doubtful measurements left out", "Doubtful left out"},
    {" % of the range", " %"},
    {"One landmark with another's ID in all scans", "One landmark misnamed"},
    {", incremental", ", incr."},
    {", from scratch", ", scratch"},
    {", known landmarks", ", known"},
}};

/// Where even those are too wide.
constexpr std::array<ShortNames, 3> kShortest = {{
    {"mean dist., equal", "mean, equal"},
    {"mean dist., weighted", "mean, weighted"},
    {", its order", ", order"},
}};

/// Whether a text is a number behind a space: the mean rank behind a method's name.
bool is_number_behind(std::string_view text) {
  return text.size() > 1 && text[0] == ' ' &&
         text.find_first_not_of("0123456789.", 1) == std::string_view::npos;
}

/// Whether a name is a whole part of a text: from its start, a comma or an "and" to the next, to a
/// colon or to a number at its end.
bool is_part(std::string_view text, std::size_t at, std::string_view name) {
  const std::string_view before = text.substr(0, at), after = text.substr(at + name.size());
  const bool begins = before.empty() || name.starts_with(',') || name.starts_with(' ') ||
                      before.ends_with(", ") || before.ends_with(" and ");
  return begins && (after.empty() || after.starts_with(", ") || after.starts_with(" and ") ||
                    after.starts_with(": ") || is_number_behind(after));
}

template <std::size_t kCount>
std::string with_parts(std::string text, const std::array<ShortNames, kCount>& names) {
  for (const auto& [name, shorter] : names)
    if (const std::size_t at = text.find(name); at != std::string::npos && is_part(text, at, name))
      text.replace(at, name.size(), shorter);
  return text;
}

}  // namespace

std::string short_method_name(const std::string& label) {
  std::string text = label;
  for (const auto& [name, shorter] : kMethods)
    if (const std::size_t at = text.find(name); at != std::string::npos)
      text.replace(at, name.size(), shorter);
  return text;
}

std::string short_name(const std::string& label) {
  return with_parts(short_method_name(label), kShort);
}

std::string without_parameters(const std::string& label) {
  constexpr std::string_view kComma = ", ", kEquals = " = ";
  std::string text = label;
  for (std::size_t equals = text.find(kEquals); equals != std::string::npos;
       equals = text.find(kEquals, equals + 1)) {
    const std::size_t comma = text.rfind(kComma, equals);
    if (comma == std::string::npos || text.find(' ', comma + kComma.size()) != equals) continue;
    const std::size_t end = text.find_first_of(" ,", equals + kEquals.size());
    text.erase(comma, std::min(end, text.size()) - comma);
    equals = comma == 0 ? 0 : comma - 1;
  }
  return text;
}

std::string label_in(const Theme& theme, const std::string& label) {
  return theme.width_pt < kNarrow * theme.font_pt ? short_name(label) : label;
}

ShapedText shape_label_within(const Theme& theme, const std::string& label, double most,
                              const std::vector<std::string>& others) {
  const std::string shorter = short_name(label);
  for (const std::string& text : {label_in(theme, label), shorter})
    if (ShapedText shaped = shape_text(text, theme.font.get()); shaped.advance <= most)
      return shaped;
  std::string bare = without_parameters(shorter);
  const bool is_alike = bare != shorter && std::ranges::any_of(others, [&](const auto& one) {
                          return one != label && without_parameters(short_name(one)) == bare;
                        });
  if (is_alike) bare = shorter;
  if (ShapedText shaped = shape_text(bare, theme.font.get()); shaped.advance <= most) return shaped;
  return shape_text_within(with_parts(bare, kShortest), most, Elide::kMiddle, theme.font.get());
}

std::vector<ShapedText> name_lines(const Theme& theme, const std::string& label, double most) {
  // In .37 of a journal's column they hold the 400 characters that a line has at most.
  constexpr std::size_t kMostLines = 24;
  const std::string text = label_in(theme, label);
  const Font* font = theme.font.get();
  if (ShapedText whole = shape_text(text, font); whole.advance <= most) return {std::move(whole)};
  std::vector<ShapedText> lines = wrap_text(text, most, kMostLines, font, WordBreak::kAnywhere);
  if (!lines.empty() && !is_elided(lines.back())) return lines;
  return {shape_text_within(text, most, Elide::kMiddle, font)};
}

bool is_elided(const ShapedText& text) { return text.text.find("\u2026") != std::string::npos; }

}  // namespace mapproof
