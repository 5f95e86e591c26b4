#include "app/study/validate.hpp"

#include <memory>

#include <fmt/format.h>

#include "app/input_streams.hpp"
#include "app/output_files.hpp"
#include "app/progress_line.hpp"
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

int validate_files(const std::vector<std::string>& paths, const Invocation& invocation) {
  refuse_shared_streams(paths);
  nlohmann::ordered_json object{{"valid", true}, {"files", nlohmann::ordered_json::array()}};
  std::string text;
  bool all_valid = true;
  const WorkingLine working(invocation.console, "reading");
  for (const std::string& path : paths)
    for (const Finding& finding : validate_all(path, read_foreign)) {
      const bool valid = finding.problem.empty();
      all_valid &= valid;
      object["files"].push_back({{"path", finding.path},
                                 {"kind", finding.kind},
                                 {"valid", valid},
                                 {"problem", finding.problem},
                                 {"remarks", finding.remarks}});
      text += valid ? fmt::format("{}: {}\n", printable(finding.path, 300), finding.kind)
                    : printable(finding.problem, 4000) + "\n";
      for (const std::string& remark : finding.remarks)
        text += "  (" + printable(remark, 4000) + ")\n";
    }
  object["valid"] = all_valid;
  invocation.console.result(text, object);
  return all_valid ? kDone : kNo;
}

}  // namespace

Action validate_command(CLI::App& app) {
  auto paths = std::make_shared<std::vector<std::string>>();
  app.description("Check files that mapproof reads or writes, and say what is wrong with them");
  app.footer(
      "Examples:\n"
      "  mapproof validate observations.csv anchors.csv\n"
      "  mapproof validate out\n\n"
      "Exit code 1 if a file is not valid or not there.\n");
  app.add_option("FILE", *paths, "Files, or folders of studies and maps")->required();
  return [paths](const Invocation& invocation) { return validate_files(*paths, invocation); };
}

}  // namespace mapproof
