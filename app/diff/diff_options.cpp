#include "app/diff/diff_options.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <iostream>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/base/files/paths.hpp"
#include "core/base/text/spelling.hpp"
#include "core/json/json_text.hpp"
#include "reports/diff/diff_outputs.hpp"
#include "reports/diff/item_images.hpp"
#include "reports/html/diff/diff_html.hpp"
#include "reports/html/diff/shown_images.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

constexpr const char* kStandardOutput = "-";
constexpr std::size_t kLargestSettings = std::size_t{1} << 24;  // Bytes.

std::vector<Verdict> verdicts_in(const std::string& list) {
  std::vector<std::string_view> names;
  for (const Verdict verdict : kVerdicts) names.push_back(name(verdict));
  std::vector<Verdict> verdicts;
  for (std::size_t at = 0; at <= list.size();) {
    const std::size_t end = std::min(list.find(',', at), list.size());
    const std::string word = list.substr(at, end - at);
    const auto verdict = verdict_named(word);
    if (!verdict) {
      const std::string_view meant = likely_word(word, names);
      throw InvalidInput(
          fmt::format("--allow: no verdict \"{}\"{}. There are {}", printable(word),
                      meant.empty() ? "" : fmt::format("; did you mean \"{}\"?", meant),
                      fmt::join(names, ", ")));
    }
    verdicts.push_back(*verdict);
    at = end + 1;
  }
  return verdicts;
}

/// mapproof-diff.json of the baseline: in the folder, or next to the file.
/// @throws IoError if it is not a file, or is a link that leads out of the folder.
fs::path settings_beside(const std::string& baseline) {
  std::error_code error;
  const bool is_folder = fs::is_directory(baseline, error);
  const fs::path folder = is_folder ? fs::path(baseline) : fs::path(baseline).parent_path();
  const fs::path file = folder / "mapproof-diff.json";
  if (!fs::exists(fs::symlink_status(file, error))) return {};
  if (is_folder) refuse_links_out(folder);
  if (!fs::is_regular_file(file, error)) throw IoError(file.string(), "is not a file");
  return file;
}

/// How many of the outputs replace the text.
std::ptrdiff_t to_standard_output(const DiffOptions& options, const Console& console) {
  const std::array locations = {&options.page, &options.junit, &options.markdown};
  return (console.is_json() ? 1 : 0) +
         std::ranges::count_if(
             locations, [](const std::string* location) { return *location == kStandardOutput; });
}

/// Whether the environment variable is that text, or with "" any.
bool is_set(const char* variable, std::string_view text = "") {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0' && (text.empty() || value == text);
}

bool wants_github_lines(const DiffOptions& options) {
  return options.annotations == "github" ||
         (options.annotations == "auto" && is_set("GITHUB_ACTIONS", "true"));
}

/// The path of the images as a CI takes it: GitLab from its project's folder, others absolute.
std::string attachment_prefix(const std::string& images) {
  const fs::path path = real_path(images);
  if (!is_set("GITLAB_CI") || !is_set("CI_PROJECT_DIR")) return path.string();
  const fs::path project = real_path(std::getenv("CI_PROJECT_DIR"));
  return lies_in(path, project) ? path.lexically_relative(project).string() : path.string();
}

/// The URL of the images, or their path from the page with the summary.
std::string markdown_prefix(const DiffOptions& options) {
  if (!options.image_url.empty()) return options.image_url;
  const fs::path images = real_path(options.images);
  const fs::path page = options.markdown == kStandardOutput
                            ? fs::current_path()
                            : real_path(options.markdown).parent_path();
  return images.lexically_relative(page).generic_string();
}

/// A path in the repository, as GitHub names it.
std::string path_in_repository(const std::string& folder) {
  const fs::path root =
      real_path(is_set("GITHUB_WORKSPACE") ? std::getenv("GITHUB_WORKSPACE") : ".");
  const fs::path path = real_path(folder);
  return lies_in(path, root) ? path.lexically_relative(root).generic_string() : folder;
}

bool is_run_by_ctest() {
  return std::getenv("DASHBOARD_TEST_FROM_CTEST") != nullptr ||
         std::getenv("CTEST_INTERACTIVE_DEBUG_MODE") != nullptr;
}

}  // namespace

void add_diff_options(CLI::App& app, DiffOptions& options) {
  app.add_option("--page", options.page,
                 "Write a page that shows what differs, e.g. diff.html; - to standard output");
  app.add_option("--page-size", options.page_size_mb,
                 "Size of that page in MB; it states which images and tables it leaves out")
      ->check(number_in(0.5, 2000.0))
      ->capture_default_str();
  app.add_option("--templates", options.templates,
                 "Folder whose templates replace those of the page")
      ->check(names_folder());
  app.add_option("--junit", options.junit, "Write the verdicts as JUnit XML; - to standard output");
  app.add_option("--markdown", options.markdown,
                 "Write a summary for a comment on a change; - to standard output");
  app.add_option("--allow", options.allow, "Verdicts that pass as well: better,style,new");
  app.add_option("--settings", options.settings,
                 "Tolerances and ignored regions, by default mapproof-diff.json of the baseline");
  app.add_option("--include", options.include,
                 "Compare only what matches: the id of an item, or ID.FORMAT; * is any text")
      ->allow_extra_args(false);
  app.add_option("--exclude", options.exclude, "Do not compare what matches, such as \"*.pdf\"")
      ->allow_extra_args(false);
  app.add_option("--images", options.images,
                 "Write the images of each item that differs, both sides and their difference")
      ->check(names_folder());
  app.add_option("--image-url", options.image_url,
                 "Where the folder of --images is served, for the images in --markdown");
  app.add_option("--annotations", options.annotations,
                 "Errors at the files of a change: auto is github if GitHub Actions runs it")
      ->transform(one_of({"auto", "github", "none"}))
      ->capture_default_str();
  group_options(app, {{"Comparison", {"--allow", "--settings", "--include", "--exclude"}},
                      {"Output",
                       {"--page", "--page-size", "--templates", "--junit", "--markdown", "--images",
                        "--image-url", "--annotations"}}});
  app.get_option("--image-url")->needs("--images")->type_name("URL");
  app.get_option("--page-size")->needs("--page")->type_name("MB");
  for (const char* pattern : {"--include", "--exclude"})
    app.get_option(pattern)->type_name("PATTERN");
  for (const char* file : {"--page", "--junit", "--markdown", "--settings"})
    app.get_option(file)->type_name("FILE");
}

namespace {

std::size_t page_bytes(const DiffOptions& options) {
  return static_cast<std::size_t>(1e6 * options.page_size_mb);
}

}  // namespace

bool asks_for_outputs(const DiffOptions& options, const Console& console) {
  return console.is_json() || !options.page.empty() || !options.junit.empty() ||
         !options.markdown.empty() || !options.images.empty();
}

DiffSettings diff_settings(const DiffOptions& options, const std::string& baseline,
                           const Console& console) {
  const fs::path file =
      options.settings.empty() ? settings_beside(baseline) : fs::path(options.settings);
  if (to_standard_output(options, console) > 1)
    throw InvalidInput(
        "only one of --json and the files --page, --junit and --markdown can be standard output");
  DiffSettings settings;
  if (!file.empty())
    settings = parse_diff_settings(read_file(file, kLargestSettings), file.string());
  if (!options.allow.empty())
    for (const Verdict verdict : verdicts_in(options.allow)) settings.allowed.push_back(verdict);
  settings.include = options.include;
  settings.exclude = options.exclude;
  if (!options.page.empty() || !options.images.empty())
    settings.heat_map_bytes = page_bytes(options);
  return settings;
}

namespace {

/// The paths of its images as the user knows them.
DiffResult with_files_named(DiffResult result, const FileNaming& naming) {
  if (!naming) return result;
  for (DiffItem& item : result.items)
    for (ImageFile& image : item.images)
      for (std::filesystem::path* path : {&image.baseline, &image.current})
        *path = naming(path->string());
  return result;
}

}  // namespace

int hand_out(const DiffResult& result, const DiffSettings& settings, const DiffOptions& options,
             const Invocation& invocation, const FileNaming& naming) {
  const Console& console = invocation.console;
  std::string text;
  const auto hand = [&](const std::string& location, const auto& make) {
    if (location.empty()) return;
    std::string disclosed = invocation.disclosure.text(make());
    if (location == kStandardOutput)
      text = std::move(disclosed);
    else
      write_file(location, disclosed);
  };
  ImageLinks links;
  if (!options.images.empty()) links.images = write_item_images(result, settings, options.images);
  hand(options.page, [&] {
    const std::size_t bytes = page_bytes(options);
    return diff_html(result, shown_images(result, settings, {.page_bytes = bytes}),
                     load_templates(options.templates), bytes);
  });
  hand(options.junit, [&] {
    if (!options.images.empty()) links.prefix = attachment_prefix(options.images);
    return diff_junit(result, links);
  });
  hand(options.markdown, [&] {
    if (!options.images.empty()) links.prefix = markdown_prefix(options);
    return diff_markdown(result, links);
  });
  if (console.is_json())
    text = invocation.disclosure.text(json_text(diff_json(with_files_named(result, naming))));
  if (wants_github_lines(options))
    std::cerr << invocation.disclosure.text(github_lines(
        result, path_in_repository(options.folder.empty() ? result.baseline : options.folder)));
  // Without a baseline one line has been written already.
  if (to_standard_output(options, console) == 0 && result.has_baseline) {
    text = diff_text(result, console.is_quiet() ? DiffWords::kFailures : DiffWords::kAll);
    if (is_run_by_ctest()) text += ctest_lines(result, options.folder.empty());
  }
  console.print(text);
  return result.passes ? kDone : kNo;
}

}  // namespace mapproof
