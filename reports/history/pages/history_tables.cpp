#include "reports/history/pages/history_tables.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <ranges>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "core/base/text/words.hpp"
#include "reports/history/accuracy_rule.hpp"
#include "reports/history/great_medians.hpp"
#include "reports/history/pages/study_course.hpp"
#include "reports/history/shown_names.hpp"

namespace mapproof {
namespace {

TextCell text(std::string words) { return {std::move(words), Emphasis::kPlain}; }

/// @param error_m  See NumberCell::error_m.
Cell number(double value, int decimals, bool error_m = false) {
  if (!std::isfinite(value)) return MissingCell{};
  NumberCell cell{value, decimals};
  cell.error_m = error_m;
  return cell;
}

/// @param verdict  Without the findings that are known.
std::string words_of(const NightlyFacts& nightly_run, NightlyVerdict verdict) {
  switch (verdict) {
    case NightlyVerdict::kPassed:
      return nightly_run.verdict == NightlyVerdict::kPassed ? std::string(verdict_word(nightly_run))
                                                            : "nothing new";
    case NightlyVerdict::kCost:
      return "slower or larger";
    default:
      return "accuracy worse";
  }
}

/// The last step of each method, of what is an error or shown.
std::vector<SeriesId> last_steps(const StudyTrend& trend) {
  std::vector<SeriesId> last;
  for (const auto& [id, values] : trend.medians) {
    const NightlyRule rule = rule_of(id, trend.quantities, trend.medians);
    if (!is_accuracy(rule) && rule != NightlyRule::kShown) continue;
    const auto later = std::ranges::find_if(last, [&](const SeriesId& other) {
      return method_of(other) == method_of(id) && other.quantity == id.quantity;
    });
    if (later == last.end())
      last.push_back(id);
    else
      *later = id;
  }
  return last;
}

/// Whether findings of a group are about a series, whatever its step.
bool is_in(const FindingGroup& group, const StudyTrend& trend, const SeriesId& id) {
  return group.study == trend.name && group.quantity_id == id.quantity &&
         group.setup == shown_setup(trend.labels, id.sensor) &&
         std::ranges::find(group.lines, shown_method(trend.labels, id.method)) != group.lines.end();
}

/// A course as a cell of a table, and its curve.
/// @param without  What the cell says where there is no course.
void add_course(const std::optional<Course>& course, const std::string& without, Row& row) {
  row.cells.emplace_back(text(course ? course->words : without));
  if (!course || course->curve.changes.empty()) return;
  row.curves.push_back(course->curve);
  row.curves.back().cell = row.cells.size() - 1;
}

Cell commit_cell(const NightlyFacts& nightly_run, NightlyLinks& links) {
  if (nightly_run.commit.empty()) return MissingCell{};
  const Phrase commit = links.commit(nightly_run);
  return TextCell{commit.text, commit.emphasis};
}

/// "accepted: better maps; 2 known: broken sensor".
Cell notes_cell(int nightly_run, std::span<const NightlyNote> notes) {
  std::map<std::pair<NoteKind, std::string>, int> said;
  for (const NightlyNote& note : notes_on(nightly_run, notes)) ++said[{note.kind, note.text}];
  std::string all;
  for (const auto& [what, count] : said) {
    const auto& [kind, words] = what;
    if (!all.empty()) all += "; ";
    if (kind == NoteKind::kKnown) all += fmt::format("{} known: ", count);
    if (kind == NoteKind::kAccepted) all += "accepted: ";
    all += words;
  }
  if (all.empty()) return MissingCell{};
  return TextCell{all, Emphasis::kData};
}

}  // namespace

Table studies_table(const IndexFacts& facts, NightlyLinks& links) {
  const NightlyFacts& this_run = facts.nightly_runs.back();
  Table table{
      .id = "studies",
      .caption = "Change of each study over its nightly runs.",
      .columns = {{"Study", "", "", ""},
                  {"Worse", "", "",
                   "The greatest change for the worse against the reference run, or the one "
                   "before what got worse; red where it is a finding, grey where it is none"},
                  {"Better", "", "",
                   "The greatest change for the better of 1 % or half a point at least; it "
                   "is not tested"},
                  {"Trends", "", "", ""},
                  {"Report", "", "", ""}},
      .rows = {},
      .notes = {}};
  for (const StudyTrend& trend : facts.trends) {
    const Phrase report = links.report(this_run.number, trend.name);
    const Phrase trends = links.trends(trend.name);
    Row row{{text(trend.name)},
            fmt::format("{} to {}", counted(std::ssize(trend.nightly_runs), "nightly run"),
                        this_run.number)};
    const std::string without = trend.nightly_runs.size() < 2 ? "not compared" : "none";
    add_course(worst_course(trend, facts.findings, facts.notes), without, row);
    add_course(best_course(trend, facts.findings), without, row);
    row.cells.emplace_back(TextCell{trends.text, trends.emphasis});
    row.cells.emplace_back(TextCell{report.text, report.emphasis});
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table nightly_runs_table(const IndexFacts& facts, NightlyLinks& links) {
  Table table{
      .id = "nightly-runs",
      .caption = "Every nightly run, the last one first.",
      .columns = {{"Run", "", "", "Its number: the order of nightly runs, whatever clocks say"},
                  {"Started", "", "", "By the clock of the place where it ran"},
                  {"Commit", "", "", "Of what was under test"},
                  {"Verdict", "", "", "Without findings that are known"},
                  {"Findings", "", "", "How many"},
                  {"Compared with", "", "", "The nightly run it was compared with"},
                  {"Host", "", "", "The machine; seconds are compared between runs on one machine"},
                  {"Report", "", "",
                   "The report of that nightly run; its folder if there are several"},
                  {"Note", "", "", "What was noted on it"}},
      .rows = {},
      .notes = {}};
  for (const NightlyFacts& nightly_run : facts.nightly_runs | std::views::reverse) {
    const auto found = found_on(nightly_run.number, facts.findings);
    const NightlyVerdict verdict = verdict_of(new_findings(found, facts.notes));
    const auto made = facts.studies.find(nightly_run.number);
    const bool has_report = made != facts.studies.end() && made->second.size() == 1;
    const Phrase place = has_report ? links.report(nightly_run.number, made->second.front())
                                    : links.folder(nightly_run.number);
    // What got worse is marked by weight as well, not by its text alone.
    const Emphasis weight =
        verdict == NightlyVerdict::kPassed ? Emphasis::kPlain : Emphasis::kStrong;
    const Cell against =
        nightly_run.reference ? Cell{number(*nightly_run.reference, 0)} : Cell{MissingCell{}};
    table.rows.push_back(
        {{number(nightly_run.number, 0), text(local_time(nightly_run)),
          commit_cell(nightly_run, links),
          TextCell{words_of(nightly_run, verdict) + (nightly_run.pinned ? ", reference" : ""),
                   weight},
          number(static_cast<double>(found.size()), 0), against,
          TextCell{nightly_run.host, Emphasis::kData},
          TextCell{place.text, place.emphasis, has_report ? "report" : "folder"},
          notes_cell(nightly_run.number, facts.notes)},
         fmt::format("nightly run {}", nightly_run.number)});
  }
  return table;
}

Table findings_table(const NightlyFindings& findings, const std::string& study) {
  Table table{.id = "findings",
              .caption = "What got worse, the last nightly run first.",
              .columns = {{"Run", "", "", ""},
                          {"Since", "", "",
                           "The nightly run in which it began, as far as can be determined"},
                          {"Rule", "", "", "The rule that found it"},
                          {"Finding", "", "", ""}},
              .rows = {},
              .notes = {}};
  for (const auto& [nightly_run, of_nightly_run] : findings | std::views::reverse)
    for (const NightlyFinding& finding : of_nightly_run)
      if (finding.study == study)
        table.rows.push_back({{number(nightly_run, 0), number(finding.since, 0),
                               text(std::string(name(finding.rule))), text(finding.sentence)},
                              fmt::format("nightly run {}", nightly_run)});
  return table;
}

Table accuracy_table(const StudyTrend& trend, std::span<const NightlyFinding> found) {
  const std::vector<SeriesId> shown = last_steps(trend);
  const std::vector<FindingGroup> groups =
      grouped(trend.nightly_runs.back().number, found, std::span(&trend, 1), {});
  const std::size_t base = base_index(trend, found);
  const bool has_before = base + 1 < trend.nightly_runs.size();
  const bool has_steps = std::ranges::any_of(shown, [](const SeriesId& id) { return id.step > 0; });
  std::string caption = "Medians over the runs";
  if (has_steps) caption += " at the last step of each method";
  if (has_before)
    caption += fmt::format("; before: nightly run {}", trend.nightly_runs[base].number);
  Table table{.id = "accuracy-now",
              .caption = caption + ".",
              .columns = {{"Method", "", "", ""},
                          {"Quantity", "", "", ""},
                          {"Unit", "", "", ""},
                          {"First", "", "", "The first of the nightly runs shown"},
                          {"Before", "", "", "The nightly run that changes are shown against"},
                          {"Last", "", "", "The last nightly run"}},
              .rows = {},
              .notes = {}};
  std::map<std::string, bool> great_errors;  // By quantity.
  for (const SeriesId& id : shown) {
    const Quantity& quantity = trend.quantities.at(id.quantity);
    const std::vector<double>& values = trend.medians.at(id);
    const double before = has_before ? values[base] : kNaN;
    const auto [known, is_new] = great_errors.try_emplace(id.quantity, false);
    if (is_new) known->second = has_great_errors(trend, quantity);
    const bool errors_m = known->second;
    table.rows.push_back({{text(shown_subject(trend.labels, id)), text(quantity.label),
                           text(quantity.unit), number(values.front(), 4, errors_m),
                           number(before, 4, errors_m), number(values.back(), 4, errors_m)},
                          "medians over runs"});
    const auto worse = std::ranges::find_if(
        groups, [&](const FindingGroup& group) { return is_in(group, trend, id); });
    if (worse != groups.end()) table.rows.back().regressed = worse->change_text();
  }
  return table;
}

}  // namespace mapproof
