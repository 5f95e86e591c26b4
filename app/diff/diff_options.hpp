#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/command_line.hpp"
#include "reports/diff/diff_result.hpp"
#include "reports/diff/diff_settings.hpp"

namespace mapproof {

/// What the commands that compare have in common.
struct DiffOptions {
  std::string page, junit, markdown;     ///< Files to write; empty: none.
  double page_size_mb = 5.0;             ///< The page leaves out what would exceed it.
  std::optional<std::string> templates;  ///< Folder whose templates replace the embedded ones.
  std::string allow;                     ///< "better,style".
  std::string settings;  ///< File; empty: mapproof-diff.json next to the baseline, if it is there.
  std::vector<std::string> include, exclude;  ///< Patterns of items and files.
  std::string images;                         ///< Folder for the images of what differs.
  std::string image_url;                      ///< Where that folder is served; empty: nowhere.
  std::string annotations = "auto";           ///< Of these: auto, github, none.
  std::string folder;  ///< The baseline in the working tree, where it is not the baseline itself.
};

/// Adds --page, --page-size, --templates, --junit, --markdown, --allow, --settings, --include,
/// --exclude,
/// --images, --image-url and --annotations.
void add_diff_options(CLI::App& app, DiffOptions& options);

/// Whether a result is asked for beyond the text on standard output.
bool asks_for_outputs(const DiffOptions& options, const Console& console);

/// What a comparison with that baseline goes by.
/// @throws IoError for a settings file that cannot be used; InvalidInput for --allow.
DiffSettings diff_settings(const DiffOptions& options, const std::string& baseline,
                           const Console& console);

/// What a text names instead of a temporary folder; empty: nothing is temporary.
using FileNaming = std::function<std::string(const std::string& text)>;

/// Writes the files asked for, disclosed, and the verdicts to standard output, with --json as the
/// object of diff_json(), with the lines that CTest takes where it runs the program. Lines for
/// GitHub Actions go to standard error, where it reads them as well.
/// @return kDone or kNo. @throws IoError.
int hand_out(const DiffResult& result, const DiffSettings& settings, const DiffOptions& options,
             const Invocation& invocation, const FileNaming& naming = {});

}  // namespace mapproof
