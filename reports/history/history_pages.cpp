#include "reports/history/history_pages.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/words.hpp"
#include "reports/history/history_tables.hpp"
#include "reports/history/night_standing.hpp"

namespace mapproof {
namespace {

/// As many findings of a study stand at the head of a page; its page over the nights has all.
constexpr std::size_t kMostTold = 3;

FigureBlock block_of(const Figure& figure) {
  return {figure.id, figure.title, figure.caption, figure.alt, figure.record_ids};
}

/// The sentences of one study's findings of a night.
std::vector<std::string> told_of(std::span<const NightFinding> findings, const std::string& study) {
  std::vector<std::string> sentences;
  for (const NightFinding& finding : findings)
    if (finding.study == study) sentences.push_back(finding.sentence + ".");
  return sentences;
}

/// The findings of a night.
std::span<const NightFinding> found_on(int night, const NightFindings& findings) {
  const auto found = findings.find(night);
  return found == findings.end() ? std::span<const NightFinding>{} : found->second;
}

std::vector<std::string> told_of(const NightFindings& findings, int night,
                                 const std::string& study) {
  const auto of_night = findings.find(night);
  return of_night == findings.end() ? std::vector<std::string>{} : told_of(of_night->second, study);
}

/// Which nights the page is of.
Paragraph nights_shown(const StudyTrend& trend) {
  return {{{fmt::format("{} from night {} on are shown: those that had the same order as the last.",
                        counted(static_cast<long long>(trend.nights.size()), "night"),
                        trend.nights.front().number)}}};
}

/// The studies that have findings of a night, in the order of these.
std::vector<std::string> studies_of(int night, const NightFindings& findings) {
  std::vector<std::string> studies;
  if (const auto of_night = findings.find(night); of_night != findings.end())
    for (const NightFinding& finding : of_night->second)
      if (std::ranges::find(studies, finding.study) == studies.end())
        studies.push_back(finding.study);
  return studies;
}

}  // namespace

HistoryPage trend_page(const StudyTrend& trend, const NightFindings& findings, bool is_compared) {
  HistoryPage page;
  page.figures = trend_figures(trend, findings);
  page.report.title = trend.name + ", night by night";
  page.report.subtitle =
      fmt::format("Nights {} to {}", trend.nights.front().number, trend.nights.back().number);
  const NightFacts& tonight = trend.nights.back();
  page.report.opening.standing =
      study_standing(tonight, found_on(tonight.number, findings), trend.name, is_compared);
  Section figures{"trends", "Trends", {nights_shown(trend)}};
  Gallery gallery;
  for (const Figure& figure : page.figures) gallery.figures.push_back(block_of(figure));
  figures.blocks.emplace_back(std::move(gallery));
  page.report.sections.push_back(std::move(figures));
  page.report.sections.push_back({"values", "Values", {accuracy_table(trend)}});
  if (Table found = findings_table(findings, trend.name); !found.rows.empty())
    page.report.sections.push_back({"findings", "Findings", {std::move(found)}});
  return page;
}

Report index_page(std::span<const NightFacts> nights, const NightFindings& findings,
                  const NightStudies& studies, std::span<const std::string> remarks) {
  Report report{.title = "Nights", .subtitle = "", .sections = {}, .footer = ""};
  Section last{"last", "The last night", {}};
  if (nights.empty()) {
    last.blocks.emplace_back(Paragraph{{{"No night was recorded yet."}}});
    report.sections.push_back(std::move(last));
    return report;
  }
  const NightFacts& tonight = nights.back();
  report.subtitle = fmt::format("{}, the last begun {} UTC",
                                counted(static_cast<long long>(nights.size()), "night"),
                                to_the_minute(tonight.started_utc));
  const auto found = findings.find(tonight.number);
  const std::size_t count = found == findings.end() ? 0 : found->second.size();
  last.blocks.emplace_back(
      Paragraph{{{fmt::format("Night {}: ", tonight.number), Emphasis::kStrong},
                 {verdict_sentence(tonight, count)}}});
  BulletList list;
  for (const std::string& study : studies_of(tonight.number, findings)) {
    const std::vector<std::string> told = told_of(findings, tonight.number, study);
    for (const std::string& sentence : std::span(told).first(std::min(told.size(), kMostTold)))
      list.items.push_back({{{study + ": ", Emphasis::kStrong}, {sentence}}});
    if (told.size() > kMostTold)
      list.items.push_back({{{study + ": ", Emphasis::kStrong},
                             {fmt::format("and {} more, in ", told.size() - kMostTold)},
                             {fmt::format("trends/{}/report.html", study), Emphasis::kFile}}});
  }
  for (const std::string& remark : remarks) list.items.push_back({{{remark + "."}}});
  if (!list.items.empty()) last.blocks.emplace_back(std::move(list));
  const auto made = studies.find(tonight.number);
  for (const std::string& study : made == studies.end() ? std::vector<std::string>() : made->second)
    last.blocks.emplace_back(Paragraph{
        {{study + ": ", Emphasis::kStrong},
         {fmt::format("nights/{:04}/{}/report.html", tonight.number, study), Emphasis::kFile},
         {", over the nights "},
         {fmt::format("trends/{}/report.html", study), Emphasis::kFile}}});
  report.sections.push_back(std::move(last));
  report.sections.push_back({"nights", "All nights", {nights_table(nights, findings, studies)}});
  return report;
}

}  // namespace mapproof
