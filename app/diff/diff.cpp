#include "app/commands.hpp"

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "app/console.hpp"
#include "app/diff/diff_options.hpp"
#include "app/input_streams.hpp"
#include "app/output_paths.hpp"
#include "core/base/errors.hpp"
#include "core/base/files/byte_source.hpp"
#include "core/base/files/files.hpp"
#include "core/base/files/input_file.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/records/studies/study_page.hpp"
#include "render/output/write_figure.hpp"
#include "render/plot/figure_json.hpp"
#include "render/theme/theme.hpp"
#include "reports/diff/folder_diff.hpp"
#include "reports/diff/records/record_set.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

constexpr const char* kReportPage = "report.html";
constexpr std::string_view kFigureEnding = ".figure.json";

struct DiffArguments {
  std::string baseline;
  std::string current;
  DiffOptions options;
};

/// The pages among the sides of a comparison: none, or both.
struct Pages {
  std::optional<StudyPage> baseline, current;
};

/// The page of a side: itself, or that of its folder.
fs::path page_of(const fs::path& side, const fs::path& other) {
  if (is_page(side)) return side;
  if (is_folder(side) && is_page(side / kReportPage)) return side / kReportPage;
  throw InvalidInput(
      fmt::format("{} is a page, and {} is none: name two pages, two folders, or a "
                  "folder with its report.html, which mapproof report writes",
                  other.string(), side.string()));
}

/// Opens the sides if one of them is a page with data. Pages without are compared as documents.
Pages opened_pages(const fs::path& baseline, const fs::path& current) {
  Pages pages;
  const auto carries = [](const fs::path& side) {
    return is_page(side) && carries_data(read_input(side, kMostPageBytes));
  };
  if (!carries(baseline) && !carries(current)) return pages;
  pages.baseline.emplace(page_of(baseline, current));
  pages.current.emplace(page_of(current, baseline));
  return pages;
}

/// The ids of the figures whose values the side alone has, or has otherwise.
std::vector<std::string> differing_figures(const fs::path& side, const fs::path& other) {
  std::vector<std::string> ids;
  std::error_code error;
  for (fs::directory_iterator entry(side / "figures", error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (name.ends_with(kFigureEnding) && !same_bytes(entry->path(), other / "figures" / name))
      ids.push_back(name.substr(0, name.size() - kFigureEnding.size()));
  }
  return ids;
}

/// Draws these figures: a page carries values, and images show what differs. What cannot be drawn
/// is left to the comparison.
void draw_differing(const fs::path& side, const fs::path& other) {
  const OutputFolder figures = OutputFolder(side) / "figures";
  for (const std::string& id : differing_figures(side, other)) {
    try {
      const fs::path file = figures.path() / (id + std::string(kFigureEnding));
      const Figure figure = figure_from_json(read_file(file), file.string());
      figures.write(id + ".svg", figure_svg(figure, report_theme()));
    } catch (const IoError&) {
      continue;
    } catch (const InvalidInput&) {
      continue;
    }
  }
}

/// Names the pages instead of their folders.
FileNaming naming_of(const Pages& pages) {
  if (!pages.baseline) return {};
  return [&pages](const std::string& text) {
    return pages.baseline->named(pages.current->named(text));
  };
}

/// Compares what two pages carry.
DiffResult page_diff(const Pages& pages, const DiffSettings& settings) {
  DiffResult result;
  const fs::path &before = pages.baseline->folder(), &after = pages.current->folder();
  draw_differing(before, after);
  draw_differing(after, before);
  const auto compare = [&] { result = folder_diff(before, after, settings); };
  pages.baseline->with_names([&] { pages.current->with_names(compare); });
  rename_files(result, naming_of(pages));
  result.baseline = pages.baseline->name();
  result.current = pages.current->name();
  return result;
}

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
  std::optional<ProgressLine> working(std::in_place, invocation.console, "comparing");
  const Pages pages = opened_pages(arguments.baseline, arguments.current);
  const DiffResult result = pages.baseline
                                ? page_diff(pages, settings)
                                : folder_diff(arguments.baseline, arguments.current, settings);
  working.reset();
  return hand_out(result, settings, arguments.options, invocation, naming_of(pages));
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
      "  mapproof diff A.html B.html\n"
      "  mapproof diff old.png new.png\n"
      "  mapproof diff <(git show HEAD:map.png) map.png\n\n"
      "Exit code 0 if all is identical, within tolerance, or rendered differently without a "
      "visible\n"
      "change; 1 for any other verdict that --allow does not name; 2 if nothing could be "
      "compared.\n"
      "docs/diff.md explains the verdicts.\n");
  app.add_option("BASELINE", arguments->baseline,
                 "The study, folder, page of a report or file to compare with")
      ->required();
  app.add_option("CURRENT", arguments->current, "The one that is compared")->required();
  add_diff_options(app, arguments->options);
  return [arguments](const Invocation& invocation) { return diff(*arguments, invocation); };
}

}  // namespace mapproof
