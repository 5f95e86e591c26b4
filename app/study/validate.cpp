#include "app/study/validate.hpp"

#include <memory>

#include <fmt/format.h>

#include "app/input_streams.hpp"
#include "app/output_files.hpp"
#include "app/table_options.hpp"
#include "app/understood.hpp"
#include "core/base/errors.hpp"
#include "core/topics/validate.hpp"
#include "render/plot/figure_json.hpp"
#include "render/scene/scene_json.hpp"

namespace mapproof {
namespace {

/// Reads the JSON formats that rest on more than core's records.
bool read_foreign(std::string_view schema, std::string_view text, const std::string& source) {
  if (schema == "mapproof.figure")
    figure_from_json(text, source);
  else if (schema == "mapproof.scene")
    scene_from_json(text, source);
  else
    return false;
  return true;
}

struct ValidateArguments {
  std::vector<std::string> paths;
  std::string sensor;
  TableOptions table;
};

/// What a file is and what was understood of it, or its problems, a line each.
std::string finding_text(const Finding& finding) {
  std::string text;
  if (!finding.problem.empty()) {
    text = printable(finding.problem, 4000) + "\n";
    for (const std::string& further : finding.further) text += printable(further, 4000) + "\n";
  } else if (finding.input) {
    text = fmt::format("{} ({})\n", understood_line(finding.path, *finding.input), finding.kind);
  } else {
    text = fmt::format("{}: {}\n", printable(finding.path, 300), finding.kind);
  }
  for (const std::string& remark : finding.remarks) text += "  (" + printable(remark, 4000) + ")\n";
  return text;
}

nlohmann::ordered_json finding_json(const Finding& finding) {
  nlohmann::ordered_json object{{"path", finding.path},
                                {"kind", finding.kind},
                                {"valid", finding.problem.empty()},
                                {"problem", finding.problem},
                                {"further_problems", finding.further},
                                {"remarks", finding.remarks}};
  if (finding.input) object["input"] = understood_json(*finding.input);
  return object;
}

int validate_files(const ValidateArguments& arguments, const Invocation& invocation) {
  refuse_shared_streams(arguments.paths);
  const ValidateOptions options{.format = arguments.table.format(), .sensor = arguments.sensor};
  nlohmann::ordered_json object{{"valid", true}, {"files", nlohmann::ordered_json::array()}};
  std::string text;
  bool all_valid = true;
  for (const std::string& path : arguments.paths)
    for (const Finding& finding : validate_all(path, read_foreign, options)) {
      all_valid &= finding.problem.empty();
      object["files"].push_back(finding_json(finding));
      text += finding_text(finding);
    }
  object["valid"] = all_valid;
  invocation.console.result(text, object);
  return all_valid ? kDone : kNo;
}

}  // namespace

Action validate_command(CLI::App& app) {
  auto arguments = std::make_shared<ValidateArguments>();
  app.description("Check files that mapproof reads or writes, and say what is wrong with them");
  app.footer(
      "Examples:\n"
      "  mapproof validate observations.csv anchors.csv\n"
      "  mapproof validate bearings.csv --sensor bearing --degrees\n"
      "  mapproof validate out\n\n"
      "A table is read as map reads it; up to ten problems are reported.\n"
      "Exit code 1 if a file is not valid or not there.\n");
  app.add_option("FILE", arguments->paths, "Files, or folders of studies and maps")->required();
  app.add_option("--sensor", arguments->sensor,
                 "What the values of tables are; without it, any that fits")
      ->check(CLI::IsMember({"visibility", "bearing", "range", "range-bearing"}));
  add_table_options(app, arguments->table);
  return
      [arguments](const Invocation& invocation) { return validate_files(*arguments, invocation); };
}

}  // namespace mapproof
