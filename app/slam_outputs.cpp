#include "app/slam_outputs.hpp"

#include <fmt/format.h>

#include "core/records/slam_store.hpp"
#include "core/records/study_store.hpp"
#include "reports/sections/wording.hpp"

namespace mapproof {
namespace {

Cell number_cell(const std::optional<double>& value) {
  return value ? Cell{NumberCell{*value, 3}} : Cell{MissingCell{}};
}

Table errors_table(const SlamRun& run) {
  Table table{
      .id = "errors-" + run.id, .caption = run.log.name, .columns = {}, .rows = {}, .notes = {}};
  table.columns = {{"Method", "", "", ""},
                   {"Alignment", "", "", ""},
                   {"Mean", "m", "Position", ""},
                   {"RMSE", "m", "Position", ""},
                   {"Last 10 %", "m", "Position", ""},
                   {"Landmarks", "m", "", ""}};
  for (const SlamRecord& record : run.records)
    for (const TrajectoryError& error : record.errors)
      table.rows.push_back({{TextCell{std::string(info(record.method).label)},
                             TextCell{std::string(name(error.alignment))},
                             NumberCell{error.mean_m, 3}, NumberCell{error.rmse_m, 3},
                             NumberCell{error.last_tenth_m, 3}, number_cell(error.landmarks_m)},
                            "",
                            false});
  return table;
}

}  // namespace

FolderReport slam_folder_report(const std::filesystem::path& folder, const std::string& command) {
  return slam_folder_report(folder, read_slam_study(folder), read_slam_timings(folder),
                            read_sessions(folder), command);
}

FolderReport slam_folder_report(const std::filesystem::path& folder, const SlamStudy& study,
                                const SlamTimings&, std::span<const Session>,
                                const std::string& command) {
  FolderReport result{.folder = folder,
                      .report = {},
                      .figures = {},
                      .runs = study.runs.size(),
                      .missing = study.missing};
  Report& report = result.report;
  report.title = study.title;
  report.subtitle = fmt::format("Study {}, seed {}", study.name, study.seed);
  Section section{"slam-errors", "Errors", {}};
  for (const std::string& missing : study.missing)
    section.blocks.emplace_back(
        Callout{Callout::Tone::kWarning, "Data are missing", plain(missing)});
  section.blocks.emplace_back(KeyValues{{{"Command", {command, Emphasis::kCode}}}});
  for (const SlamRun& run : study.runs) section.blocks.emplace_back(errors_table(run));
  report.sections.push_back(std::move(section));
  report.footer =
      fmt::format("Made by mapproof {} ({}).", study.provenance.version, study.provenance.commit);
  return result;
}

}  // namespace mapproof
