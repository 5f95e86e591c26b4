#include "app/history_report.hpp"

#include "app/folder_report.hpp"
#include "core/base/files.hpp"
#include "reports/history/judge_night.hpp"
#include "reports/html/report_html.hpp"

namespace mapproof {

namespace fs = std::filesystem;

fs::path write_history_pages(HistoryStore& history, const fs::path& out,
                             std::span<const std::string> remarks, const Templates& page,
                             int jobs) {
  const std::vector<NightFacts> nights = history.nights();
  NightFindings findings;
  NightStudies studies;
  for (const NightFacts& night : nights) {
    findings[night.number] = history.findings(night.number);
    for (const StudyNight& study : history.studies(night.number))
      studies[night.number].push_back(study.name);
  }
  if (!nights.empty())
    for (const StudyNight& study : history.studies(nights.back().number)) {
      const std::optional<int> reference = nights.back().reference;
      HistoryPage trend = trend_page(
          history.trend(study.name, study.order_digest, kTrendNights, nights.back().number),
          findings, reference && has_study(history, *reference, study));
      const FolderReport report{.folder = out / "trends" / study.name,
                                .report = std::move(trend.report),
                                .in_company = {},
                                .figures = std::move(trend.figures),
                                .scenes = {},
                                .films = {},
                                .runs = 0,
                                .missing = {}};
      write_report(report, page, jobs);
    }
  const fs::path index = out / "index.html";
  const HtmlOptions no_files{.figure_folder = "", .table_folder = ""};
  write_file(index, report_html(
                        index_page(nights, findings, studies, remarks), page,
                        [](const std::string&) { return std::string(); }, no_files));
  return index;
}

}  // namespace mapproof
