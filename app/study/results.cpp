#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/commands.hpp"
#include "app/result_json.hpp"
#include "app/study/embedded_experiments.hpp"
#include "core/base/errors.hpp"
#include "core/base/files/input_file.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/records/studies/results_table.hpp"
#include "core/records/studies/study_folder.hpp"
#include "core/records/studies/study_page.hpp"
#include "core/studies/study_kind.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

struct ResultsArguments {
  std::string input;
  std::string study;  ///< Of several.
};

/// The study that is asked for: the folder itself, or one of those in it.
fs::path study_in(const fs::path& folder, const ResultsArguments& arguments) {
  const std::string shown = printable(arguments.input);
  refuse_links_out(folder);
  const std::vector<fs::path> inner = study_folders(folder);
  if (is_study(folder) || inner.empty()) {
    require_study(folder);
    if (arguments.study.empty()) return folder;
    throw InvalidInput(fmt::format("--study: {} holds one study alone; leave it out", shown));
  }
  std::vector<std::string> names;
  for (const fs::path& study : inner) {
    names.push_back(study.filename().string());
    if (names.back() == arguments.study) return study;
  }
  throw InvalidInput(fmt::format("{}{} holds several studies; name one by --study: {}",
                                 arguments.study.empty() ? "" : "--study: no such study; ", shown,
                                 fmt::join(names, ", ")));
}

nlohmann::ordered_json row_json(const Result& row) {
  nlohmann::ordered_json levels = nlohmann::ordered_json::object();
  for (const Level& level : row.at.levels)
    std::visit([&](const auto& value) { levels[level.factor] = value; }, level.value);
  return {{"setup", row.at.setup.get()},  {"levels", levels},
          {"method", row.method.get()},   {"quantity", row.quantity.get()},
          {"run", row.run.get()},         {"group", row.group.get()},
          {"subject", row.subject.get()}, {"value", number_or_null(row.value)}};
}

int print_results(const fs::path& folder, const Console& console) {
  const Results results = read_study_contents(folder, {}).results;
  if (!console.is_json()) {
    write_results_csv(results.rows, [&](const std::string& text) { console.print(text); });
    return kDone;
  }
  console.list("results", results.rows.size(),
               [&](std::size_t i) { return row_json(results.rows[i]); });
  return kDone;
}

int results(const ResultsArguments& arguments, const Invocation& invocation) {
  const fs::path input = arguments.input;
  if (is_folder(input)) return print_results(study_in(input, arguments), invocation.console);
  const StudyPage page(input);
  int code = kDone;
  page.with_names(
      [&] { code = print_results(study_in(page.folder(), arguments), invocation.console); });
  return code;
}

}  // namespace

Action results_command(CLI::App& app) {
  auto arguments = std::make_shared<ResultsArguments>();
  app.description("Print the results.csv of a study or of a report's page");
  app.footer(
      "Examples:\n"
      "  mapproof results out > results.csv\n"
      "  mapproof results report.html > results.csv\n"
      "  mapproof results report.html --study yairi2007 > results.csv\n\n"
      "A page carries the results that it shows. docs/file-formats.md describes the table.\n");
  app.add_option("STUDY", arguments->input, "The study's folder, or the page of its report")
      ->required();
  app.add_option("--study", arguments->study,
                 "The name of one study, where there are several in STUDY")
      ->type_name("NAME")
      ->group("Input");
  return [arguments](const Invocation& invocation) { return results(*arguments, invocation); };
}

}  // namespace mapproof
