#include "reports/history/nightly_report.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "reports/history/history_blocks.hpp"
#include "reports/history/nightly_standing.hpp"

namespace mapproof {
namespace {

/// What got worse of a study, at the head of its report.
Section worse_of_study(const StudyOfNightlyRun& study, NightlyLinks& links) {
  Section section{"worse", "What got worse", {}};
  std::size_t count = 0;
  for (const FindingGroup& group : study.groups) {
    if (group.study != study.name || ++count > kMostGroups) continue;
    std::vector<Phrase> to;
    const int before = group.commits.before.number, since = group.commits.since.number;
    if (study.comparisons.contains(comparison_file(before, since, group.study)))
      to.push_back(links.comparison(before, since, group.study));
    to.push_back(links.trends(group.study));
    section.blocks.emplace_back(finding_block(group, std::move(to), links));
  }
  add_rest(count, section);
  return section;
}

/// Puts what got worse before everything else: its section, then in each study of the report the
/// sections that show it.
void put_regressed_first(Report& report, Section worse) {
  std::vector<Section>& sections = report.sections;
  for (auto begin = sections.begin(); begin != sections.end();) {
    const auto end = std::find_if(begin, sections.end(), [&](const Section& section) {
      return section.group != begin->group;
    });
    std::stable_partition(begin, end, shows_regression);
    begin = end;
  }
  if (!worse.blocks.empty()) sections.insert(sections.begin(), std::move(worse));
}

/// Makes a figure of what got worse, of the first finding if one shows it, the one of the first
/// screen; the one that was is a small one.
void show_regressed(Report& report, std::span<const FindingGroup> groups) {
  Opening& opening = report.opening;
  const auto all = figures(report);
  std::string first = groups.empty() ? "" : groups.front().headline();
  const auto is_worse = [&](const FigureBlock* figure) {
    return !figure->regressed.empty() && figure->regressed.find(first) != std::string::npos;
  };
  if (std::ranges::none_of(all, is_worse)) first.clear();  // Then any that got worse.
  const auto main_figure = std::ranges::find(all, opening.main_figure, &FigureBlock::id);
  const auto worse = std::ranges::find_if(all, is_worse);
  if (worse == all.end() || (main_figure != all.end() && is_worse(*main_figure))) return;
  std::erase(opening.figure_ids, (*worse)->id);
  if (!opening.main_figure.empty())
    opening.figure_ids.insert(opening.figure_ids.begin(), opening.main_figure);
  opening.main_figure = (*worse)->id;
  if (opening.figure_ids.size() > kMostSmall) opening.figure_ids.resize(kMostSmall);
}

}  // namespace

void add_nightly_run(Report& report, const StudyOfNightlyRun& study, NightlyLinks& links) {
  const NightlyRun& nightly_run = study.nightly_run;
  const LostNightlyRuns& lost = study.lost;
  Opening& opening = report.opening;
  report.subtitle +=
      fmt::format("{}{}", report.subtitle.empty() ? "" : "; ", dated_name(nightly_run.facts));
  opening.standing = study_standing(nightly_run.facts, study.groups, study.name, study.is_compared);
  mark_regressed(report, study.figures, study.groups, study.name);
  show_regressed(report, study.groups);
  put_regressed_first(report, worse_of_study(study, links));
  std::optional<Phrase> reference;
  if (study.is_compared && nightly_run.facts.reference)
    reference = links.report(*nightly_run.facts.reference, study.name);
  std::vector<Paragraph> head = {ways({links.index(), links.trends(study.name)}, reference)};
  if (!lost.kept_as.empty()) {
    opening.standing->worse = true;
    opening.standing->sentences.push_back(
        fmt::format("The history was damaged. It is kept as {}, and a new one begins with this "
                    "nightly run: there is none before it to compare with.",
                    lost.kept_as.back()));
    std::vector<Phrase> reports;
    for (const auto& [number, studies] : lost.reports)
      if (std::ranges::find(studies, study.name) != studies.end())
        reports.push_back(links.report(number, study.name));
    if (reports.size() > kMostLinked)
      reports.erase(reports.begin(), reports.end() - static_cast<long>(kMostLinked));
    if (!reports.empty()) {
      head.push_back(ways(std::move(reports), std::nullopt));
      head.back().phrases.front().text = "Reports from before that are still there: ";
    }
  }
  opening.findings.insert(opening.findings.begin(), std::make_move_iterator(head.begin()),
                          std::make_move_iterator(head.end()));
}

}  // namespace mapproof
