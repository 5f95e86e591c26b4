#include <memory>

#include <fmt/format.h>

#include "app/commands/verbs.hpp"
#include "app/study_outputs.hpp"
#include "core/records/study_store.hpp"

namespace mapproof {
namespace {

struct Arguments {
  std::string study;
  std::optional<std::string> templates;
  int jobs = 1;
};

/// The command of the session that made the records; its own where none is noted.
std::string making_command(const Arguments& arguments, const Invocation& invocation) {
  const std::vector<Session> sessions = read_sessions(arguments.study);
  return sessions.empty() ? invocation.command : sessions.back().command;
}

int report(const Arguments& arguments, const Invocation& invocation) {
  const Templates page = load_templates(arguments.templates);
  const StudyView view = view_study(arguments.study);
  const std::filesystem::path path =
      write_report(view, making_command(arguments, invocation), page, arguments.jobs);
  invocation.console.detail(fmt::format("{}: {} runs, {} figures", arguments.study,
                                        view.study.runs.size(), all_figures(view.figures).size()));
  invocation.console.result(path.string() + "\n", {{"study", arguments.study},
                                                   {"report", path.string()},
                                                   {"figures", all_figures(view.figures).size()}});
  return kDone;
}

}  // namespace

Action report_verb(CLI::App& app) {
  auto arguments = std::make_shared<Arguments>();
  app.description("Write a study's report again from its records: figures, tables, report.html");
  app.footer(
      "Examples:\n"
      "  mapproof report out\n"
      "  mapproof report out --templates my-templates\n");
  app.add_option("DIR", arguments->study, "The study's folder")->required();
  app.add_option("--templates", arguments->templates,
                 "Folder whose templates replace the embedded ones");
  add_jobs_option(app, arguments->jobs);
  return [arguments](const Invocation& invocation) { return report(*arguments, invocation); };
}

}  // namespace mapproof
