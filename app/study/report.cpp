#include "app/commands.hpp"

#include <memory>
#include <optional>
#include <system_error>

#include <fmt/format.h>

#include "app/map/map_folder.hpp"
#include "app/slam/range_map.hpp"
#include "app/study/folder_report.hpp"
#include "core/base/errors.hpp"
#include "core/base/text/words.hpp"
#include "core/records/studies/folder_lock.hpp"

namespace mapproof {
namespace {

struct ReportArguments {
  std::string study;
  std::optional<std::string> templates;
  int jobs = 1;
};

/// A map has its report already. @throws InvalidInput naming it.
void refuse_map(const std::filesystem::path& folder) {
  for (const std::string_view record : {kMapFile, kSlamFile}) {
    std::error_code error;
    if (std::filesystem::exists(folder / record, error))
      throw InvalidInput(fmt::format(
          "{} is the folder of a map: its report is {}; `mapproof render` draws its figures again",
          printable(folder.string()), printable((folder / "report.html").string())));
  }
}

int report(const ReportArguments& arguments, const Invocation& invocation) {
  refuse_map(arguments.study);
  const Templates page = load_templates(arguments.templates);
  const FolderLock lock(arguments.study);
  remove_leftovers(arguments.study);
  std::optional<ProgressLine> working(std::in_place, invocation.console, "reading");
  const FolderReport view = read_folder_report(arguments.study, std::nullopt, invocation.command);
  working.reset();
  const std::filesystem::path path =
      write_report(view,
                   {.page = page,
                    .jobs = arguments.jobs,
                    .disclosure = invocation.disclosure,
                    .progress = count_progress(invocation.console, "drawing"),
                    .note = note_to(invocation.console)},
                   lock);
  invocation.console.detail(fmt::format("{}: {} runs, {} figures, {} 3-D figures", arguments.study,
                                        view.runs, view.figures.size(), view.scenes.size()));
  invocation.console.result(path.string() + "\n", {{"study", arguments.study},
                                                   {"report", path.string()},
                                                   {"figures", view.figures.size()},
                                                   {"scenes", view.scenes.size()}});
  return kDone;
}

}  // namespace

Action report_command(CLI::App& app) {
  auto arguments = std::make_shared<ReportArguments>();
  app.description("Write a study's report again from its records: figures, tables, report.html");
  app.footer(
      "Examples:\n"
      "  mapproof report out\n"
      "  mapproof report out --templates my-templates\n");
  app.add_option("DIR", arguments->study, "The study's folder, or that of several studies")
      ->required()
      ->check(names_folder());
  app.add_option("--templates", arguments->templates,
                 "Folder whose templates replace the embedded ones")
      ->check(names_folder());
  group_options(app, {{"Output", {"--templates"}}});
  add_jobs_option(app, arguments->jobs);
  return [arguments](const Invocation& invocation) { return report(*arguments, invocation); };
}

}  // namespace mapproof
