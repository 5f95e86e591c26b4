#include "app/nightly/history_report.hpp"

#include <algorithm>

#include "app/nightly/nightly_folders.hpp"
#include "app/study/folder_report.hpp"
#include "core/base/files/files.hpp"
#include "core/base/files/output_folder.hpp"
#include "render/output/write_figure.hpp"
#include "reports/history/judge_nightly_run.hpp"
#include "reports/html/report_html.hpp"

namespace mapproof {

namespace fs = std::filesystem;

namespace {

constexpr const char* kIndex = "index.html";

/// Writes trends/STUDY/report.html of a study of the last nightly run. @return The trend.
StudyTrend write_trend(HistoryStore& history, const HistoryOutputs& outputs,
                       const NightlyStudy& study, const IndexFacts& facts) {
  const NightlyFacts& this_run = facts.nightly_runs.back();
  StudyTrend trend =
      history.trend(study.name, study.experiment_digest, kTrendRuns, this_run.number);
  const bool is_compared = this_run.reference && has_study(history, *this_run.reference, study);
  const fs::path folder = outputs.out / "trends" / study.name;
  HistoryPage shown = trend_page(trend, facts.findings, is_compared,
                                 paths_from(folder, outputs.out, outputs.store));
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
  return trend;
}

IndexFacts read_facts(HistoryStore& history, const fs::path& store,
                      std::span<const std::string> remarks) {
  IndexFacts facts{.nightly_runs = history.nightly_runs(),
                   .remarks = {remarks.begin(), remarks.end()}};
  for (const NightlyFacts& nightly_run : facts.nightly_runs) {
    facts.findings[nightly_run.number] = history.findings(nightly_run.number);
    for (const NightlyStudy& study : history.studies(nightly_run.number))
      facts.studies[nightly_run.number].push_back(study.name);
  }
  facts.lost = lost_nightly_runs(store, facts.nightly_runs);
  return facts;
}

}  // namespace

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
                             std::span<const std::string> remarks) {
  const fs::path& out = outputs.out;
  IndexFacts facts = read_facts(history, outputs.store, remarks);
  if (!facts.nightly_runs.empty())
    for (const NightlyStudy& study : history.studies(facts.nightly_runs.back().number))
      facts.trends.push_back(write_trend(history, outputs, study, facts));
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
