#include "app/commands.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "app/failures.hpp"
#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/base/files/paths.hpp"
#include "core/records/studies/folder_lock.hpp"
#include "core/records/studies/folder_replacement.hpp"
#include "reports/diff/approvals/approvals.hpp"
#include "reports/diff/records/record_set.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestLine = 4096;                  // Bytes.
constexpr std::size_t kLargestFile = std::size_t{1} << 26;  // Bytes, of approvals.

struct ApproveArguments {
  std::string baseline;
  std::string current;
  std::string from;
  ApprovalRequest request;
};

/// Whether CURRENT is a file; then no ids are needed.
bool are_files(const ApproveArguments& arguments) {
  std::error_code error;
  return fs::exists(arguments.current, error) && !fs::is_directory(arguments.current, error);
}

ApprovalRequest request_of(const ApproveArguments& arguments) {
  ApprovalRequest request = arguments.request;
  if (!arguments.from.empty())
    for (std::string& id : parse_approvals(read_file(arguments.from, kLargestFile), arguments.from))
      request.ids.push_back(std::move(id));
  if (request.all && !request.ids.empty())
    throw InvalidInput("--all takes every item: give no ids with it");
  if (!request.all && request.ids.empty() && arguments.from.empty() && !are_files(arguments))
    throw InvalidInput("give the ids to approve, --all or --from FILE");
  return request;
}

/// @return The steps that were done.
ApprovalPlan take_file(const fs::path& baseline, const fs::path& current) {
  approve_file(baseline, current);
  return {.steps = {{current, {}}}};
}

ApprovalPlan take_folder(const fs::path& baseline, const fs::path& current,
                         const ApprovalRequest& request) {
  const fs::path real = real_path(baseline);
  recover_folder(real);
  std::optional<FolderLock> lock;
  if (std::error_code error; fs::exists(real, error)) {
    lock.emplace(real);
    remove_leftovers(real);
    refuse_links_out(real);
  }
  ApprovalPlan plan = approval_plan(baseline, current, request);
  apply(plan, baseline);
  return plan;
}

/// Reports of the baseline that are older than the records that were taken.
std::set<fs::path> stale_reports(const ApprovalPlan& plan, const fs::path& baseline) {
  std::set<fs::path> reports, taken;
  for (const ApprovalStep& step : plan.steps) {
    if (step.file.filename() == "report.html") taken.insert(step.file);
    const std::optional<fs::path> folder = folder_of_record(baseline, step.file);
    std::error_code error;
    if (folder && fs::exists(baseline / *folder / "report.html", error))
      reports.insert(*folder / "report.html");
  }
  for (const fs::path& report : taken) reports.erase(report);
  return reports;
}

int approve(const ApproveArguments& arguments, const Invocation& invocation) {
  const ApprovalRequest request = request_of(arguments);
  const fs::path baseline = arguments.baseline, current = arguments.current;
  const ApprovalPlan plan =
      are_files(arguments) ? take_file(baseline, current) : take_folder(baseline, current, request);
  nlohmann::ordered_json object{{"baseline", arguments.baseline},
                                {"written", nlohmann::ordered_json::array()},
                                {"removed", nlohmann::ordered_json::array()}};
  std::string text;
  for (const ApprovalStep& step : plan.steps) {
    const char* what = step.from.empty() ? "removed" : "written";
    const std::string file = (step.file.empty() ? baseline : baseline / step.file).string();
    object[what].push_back(file);
    text += fmt::format("{}  {}\n", what, printable(file, kLongestLine));
  }
  for (const fs::path& made : plan.made) {
    const std::string file = (baseline / made).string();
    object["written"].push_back(file);
    text += fmt::format("written  {}\n", printable(file, kLongestLine));
  }
  object["refused"] = plan.refused;
  object["stale"] = nlohmann::ordered_json::array();
  for (const fs::path& report : stale_reports(plan, baseline)) {
    const fs::path file = baseline / report;
    object["stale"].push_back(file.string());
    invocation.console.warning(fmt::format(
        "{}: shows the earlier records, as do the figures and tables that were not taken; mapproof "
        "report {} makes them again",
        printable(file.string(), kLongestLine),
        printable(file.parent_path().string(), kLongestLine)));
  }
  for (const std::string& refusal : plan.refused) report_failure(refusal, kNo);
  if (text.empty()) invocation.console.info(arguments.baseline + ": nothing to take");
  invocation.console.result(text, object);
  return plan.refused.empty() ? kDone : kNo;
}

}  // namespace

Action approve_command(CLI::App& app) {
  auto arguments = std::make_shared<ApproveArguments>();
  app.description("Take changes as the new baseline");
  app.footer(
      "Examples:\n"
      "  mapproof approve baseline out map-bearing-isomap\n"
      "  mapproof approve baseline out --from approvals.json\n"
      "  mapproof approve baseline out --all\n"
      "  mapproof approve baseline out -- -id-that-begins-with-a-dash\n\n"
      "The files of a figure are taken together: its records, ID.figure.json, SVG, PNG and PDF.\n"
      "A folder is replaced in one step: stopped at any moment, it is wholly the old or the new\n"
      "one. With --all the baseline then holds what CURRENT holds; an item that cannot be read is\n"
      "named and stays as it was, and the exit code is 1.\n");
  app.add_option("BASELINE", arguments->baseline, "The folder or file that is replaced")
      ->required()
      ->check(names_folder());
  app.add_option("CURRENT", arguments->current, "The one that is taken")
      ->required()
      ->check(names_folder());
  app.add_option("ID", arguments->request.ids, "Figures, tables, images, or \"records\"");
  app.add_flag("--all", arguments->request.all, "Every item; those that CURRENT lacks are removed");
  app.add_flag("--force", arguments->request.force,
               "--all may remove more than half of the baseline's files");
  app.add_option("--from", arguments->from, "File of approvals, as the page of a diff writes it");
  app.add_option(
      "--key", arguments->request.key,
      "Keep the images in addition to the others, as ID@KEY: those of another valid renderer");
  return [arguments](const Invocation& invocation) { return approve(*arguments, invocation); };
}

}  // namespace mapproof
