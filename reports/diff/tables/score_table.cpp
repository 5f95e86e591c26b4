#include "reports/diff/tables/score_table.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "reports/diff/records/record_words.hpp"
#include "reports/diff/tables/table_parts.hpp"

namespace mapproof {
namespace {

/// Worse before changed before better, and so on; then by p.
std::tuple<int, double> weight(const Comparison& comparison) {
  const auto place = [](Outcome outcome) {
    switch (outcome) {
      case Outcome::kWorse:
        return 0;
      case Outcome::kChanged:
        return 1;
      case Outcome::kBetter:
        return 2;
      case Outcome::kWithinTolerance:
        return 3;
      case Outcome::kEqual:
        break;
    }
    return 4;
  };
  return {place(comparison.outcome), comparison.test ? comparison.test->p : 2.0};
}

std::string runs_text(const Comparison& c) {
  std::string text = fmt::format("{} of {}", c.beyond, c.pairs);
  if (c.lost > 0) text += fmt::format(", {} lost", c.lost);
  if (c.gained > 0) text += fmt::format(", {} gained", c.gained);
  return text;
}

Row row_of(const Comparison& c) {
  const double scale = std::max(std::abs(c.baseline_mean), std::abs(c.current_mean));
  const std::string subject = c.current_subject == c.subject || c.current_subject.empty()
                                  ? c.subject
                                  : c.subject + " \u2192 " + c.current_subject;
  Row row{{user_text(subject), TextCell{label_with_unit(c.quantity)},
           scaled_number(c.baseline_mean, scale), scaled_number(c.current_mean, scale),
           TextCell{runs_text(c)}},
          "",
          false};
  row.cells.push_back(c.test ? Cell(TextCell{fmt::format("{:.2g}", c.test->p)})
                             : Cell(MissingCell{}));
  row.cells.push_back(c.test ? Cell(NumberCell{c.test->test.effect, 2, true})
                             : Cell(MissingCell{}));
  row.cells.emplace_back(TextCell{std::string(label(verdict_of(c.outcome)))});
  return row;
}

}  // namespace

void add_score_table(std::vector<Block>& blocks, const std::string& id, const std::string& caption,
                     std::vector<const Comparison*> comparisons) {
  std::ranges::stable_sort(comparisons, {}, [](const Comparison* c) { return weight(*c); });
  Table table{id, caption, {}, {}, {}};
  table.columns = {{"Subject", "", "", ""},
                   {"Score", "", "", ""},
                   {"Baseline", "", "", "Mean over the runs that both sides have"},
                   {"Current", "", "", "Mean over the runs that both sides have"},
                   {"Runs beyond tolerance", "", "", ""},
                   {"p", "", "", "Of a paired test, corrected for the number of tests"},
                   {"Effect", "", "", "Rank-biserial correlation, -1 to 1; above 0: greater"},
                   {"Outcome", "", "", ""}};
  const long total = std::ssize(comparisons);
  if (comparisons.size() > kMostTableRows) comparisons.resize(kMostTableRows);
  bool tested = false;
  for (const Comparison* comparison : comparisons) {
    table.rows.push_back(row_of(*comparison));
    tested = tested || comparison->test.has_value();
  }
  if (!tested)
    table.notes.emplace_back("No p: there are too few pairs of runs or of groups to test.");
  add_table(blocks, std::move(table), total);
}

}  // namespace mapproof
