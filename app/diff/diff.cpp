#include "app/commands.hpp"

#include <array>
#include <filesystem>
#include <memory>
#include <optional>

#include "app/console.hpp"
#include "app/diff/diff_options.hpp"
#include "app/input_streams.hpp"
#include "app/output_paths.hpp"
#include "reports/diff/folder_diff.hpp"

namespace mapproof {
namespace {

struct DiffArguments {
  std::string baseline;
  std::string current;
  DiffOptions options;
};

int diff(DiffArguments arguments, const Invocation& invocation) {
  refuse_shared_streams(
      std::array{arguments.baseline, arguments.current, arguments.options.settings});
  // Files are read more than once: for the verdict, for the page.
  for (std::string* path : {&arguments.baseline, &arguments.current}) *path = made_file(*path);
  const std::array<std::filesystem::path, 3> inputs = {arguments.baseline, arguments.current,
                                                       arguments.options.settings};
  check_output_paths(arguments.options, inputs);
  const DiffSettings settings =
      diff_settings(arguments.options, arguments.baseline, invocation.console);
  std::optional<WorkingLine> working(std::in_place, invocation.console, "comparing");
  const DiffResult result = folder_diff(arguments.baseline, arguments.current, settings);
  working.reset();
  return hand_out(result, settings, arguments.options, invocation);
}

}  // namespace

Action diff_command(CLI::App& app) {
  auto arguments = std::make_shared<DiffArguments>();
  app.description("Compare two studies, folders of images or files, and explain why they differ");
  app.footer(
      "Examples:\n"
      "  mapproof diff baseline out\n"
      "  mapproof diff baseline out --page diff.html\n"
      "  mapproof diff baseline out --junit diff.junit.xml --markdown diff.md\n"
      "  mapproof diff old.png new.png\n"
      "  mapproof diff <(git show HEAD:map.png) map.png\n\n"
      "Exit code 0 if all is identical, within tolerance, or rendered differently without a "
      "visible\n"
      "change; 1 for any other verdict that --allow does not name; 2 if nothing could be "
      "compared.\n"
      "docs/diff.md explains the verdicts.\n");
  app.add_option("BASELINE", arguments->baseline, "The study, folder or file to compare with")
      ->required();
  app.add_option("CURRENT", arguments->current, "The one that is compared")->required();
  add_diff_options(app, arguments->options);
  return [arguments](const Invocation& invocation) { return diff(*arguments, invocation); };
}

}  // namespace mapproof
