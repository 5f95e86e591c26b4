#include "app/nightly/history_report.hpp"

#include <algorithm>

#include "app/nightly/nightly_folders.hpp"
#include "app/study/folder_report.hpp"
#include "core/base/files/files.hpp"
#include "core/base/files/output_folder.hpp"
#include "render/output/write_figure.hpp"
#include "reports/history/judge_nightly_run.hpp"
#include "reports/history/nightly_summary.hpp"
#include "reports/html/report_html.hpp"

namespace mapproof {

namespace fs = std::filesystem;

namespace {

constexpr const char* kIndex = "index.html";

/// Writes trends/STUDY/report.html of a study of the last nightly run.
void write_trend(HistoryStore& history, const HistoryOutputs& outputs, const NightlyStudy& study,
                 const IndexFacts& facts) {
  const auto trend = std::ranges::find(facts.trends, study.name, &StudyTrend::name);
  if (trend == facts.trends.end()) return;
  const NightlyFacts& this_run = facts.nightly_runs.back();
  const bool is_compared = this_run.reference && has_study(history, *this_run.reference, study);
  const fs::path folder = outputs.out / "trends" / study.name;
  HistoryPage shown = trend_page(*trend, facts.findings, is_compared,
                                 paths_from(folder, outputs.out, outputs.store), facts.notes);
  const FolderReport report{.folder = folder,
                            .report = std::move(shown.report),
                            .in_company = {},
                            .figures = std::move(shown.figures),
                            .scenes = {},
                            .films = {},
                            .runs = 0,
                            .missing = {},
                            .link_words = std::move(shown.link_words)};
  make_folder(folder);
  write_report(report, {outputs.page, outputs.jobs, outputs.disclosure}, FolderLock(folder));
}

/// Nightly runs that the feed has; readers keep older ones themselves.
constexpr std::size_t kMostEntries = 30;

/// Each of the last nightly runs by itself, the last one first.
std::vector<NightlySummary> last_summaries(const IndexFacts& facts) {
  std::vector<NightlySummary> summaries = {last_summary(facts)};
  const std::size_t count = facts.nightly_runs.size();
  for (std::size_t i = 1; i < std::min(count, kMostEntries); ++i) {
    const NightlyFacts& nightly_run = facts.nightly_runs[count - 1 - i];
    const auto found = facts.findings.find(nightly_run.number);
    NightlySummary summary{.facts = nightly_run,
                           .notes = notes_on(nightly_run.number, facts.notes)};
    if (found != facts.findings.end())
      summary.groups = grouped(nightly_run.number, found->second, facts.trends, facts.notes);
    summaries.push_back(std::move(summary));
  }
  return summaries;
}

}  // namespace

IndexFacts read_index_facts(HistoryStore& history, const HistoryOutputs& outputs,
                            std::span<const std::string> remarks) {
  const fs::path& store = outputs.store;
  IndexFacts facts{.nightly_runs = history.nightly_runs(),
                   .remarks = {remarks.begin(), remarks.end()}};
  facts.findings = history.all_findings();
  facts.studies = history.study_names();
  facts.lost = lost_nightly_runs(store, facts.nightly_runs);
  facts.notes = history.notes();
  facts.comparisons = comparisons_in(outputs.out);
  if (!facts.nightly_runs.empty())
    for (const NightlyStudy& study : history.studies(facts.nightly_runs.back().number))
      facts.trends.push_back(history.trend(study.name, study.experiment_digest, kTrendRuns,
                                           facts.nightly_runs.back().number));
  return facts;
}

HistoryFolders paths_from(const fs::path& folder, const fs::path& out, const fs::path& store) {
  const auto to = [&](const fs::path& target) {
    // Neither need be there yet.
    const std::string path =
        fs::relative(fs::absolute(target), fs::absolute(folder)).generic_string();
    return path == "." ? "" : path + "/";
  };
  return {.pages = to(out), .nightly_runs = to(store)};
}

fs::path write_history_pages(HistoryStore& history, const HistoryOutputs& outputs,
                             const IndexFacts& facts) {
  const fs::path& out = outputs.out;
  if (!facts.nightly_runs.empty()) {
    for (const NightlyStudy& study : history.studies(facts.nightly_runs.back().number))
      write_trend(history, outputs, study, facts);
    const std::vector<NightlySummary> summaries = last_summaries(facts);
    OutputFolder(out).write(
        "feed.xml", outputs.disclosure.text(nightly_feed(
                        {.identifier = history.identifier(),
                         .summaries = summaries,
                         .nightly_runs = paths_from(out, out, outputs.store).nightly_runs})));
    OutputFolder(out).write("badge.svg", nightly_badge(summaries.front()));
    OutputFolder(out).write("badge.json", nightly_badge_json(summaries.front()));
  }
  const HistoryPage shown = index_page(facts, paths_from(out, out, outputs.store));
  HtmlOptions options{.figure_folder = "", .table_folder = ""};
  options.link_words = shown.link_words;
  const auto drawing = [&](const std::string& id) {
    const auto figure = std::ranges::find(shown.figures, id, &Figure::id);
    return figure == shown.figures.end() ? std::string() : figure_svg(*figure, report_theme());
  };
  OutputFolder(out).write(
      kIndex, outputs.disclosure.text(report_html(shown.report, outputs.page, drawing, options)));
  return out / kIndex;
}

}  // namespace mapproof
