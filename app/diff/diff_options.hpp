#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/command_line.hpp"
#include "reports/diff/diff_result.hpp"
#include "reports/diff/diff_settings.hpp"

namespace mapproof {

/// What the commands that compare have in common.
struct DiffOptions {
  std::string page, junit, json, markdown;  ///< Files to write; empty: none.
  std::optional<std::string> templates;     ///< Folder whose templates replace the embedded ones.
  std::string allow;                        ///< "better,style".
  std::string settings;  ///< File; empty: mapproof-diff.json next to the baseline, if it is there.
};

/// Adds --templates, --junit, --json FILE (instead of the common --json), --markdown, --allow and
/// --settings. The page is the command's own option: --out may be taken.
void add_diff_options(CLI::App& app, DiffOptions& options);

/// What a comparison with that baseline goes by.
/// @throws IoError for a settings file that cannot be used; InvalidInput for --allow.
DiffSettings diff_settings(const DiffOptions& options, const std::string& baseline);

/// Writes the files asked for, disclosed, and the verdicts to standard output, with the lines that
/// CTest takes where it runs the program.
/// @return kDone or kNo. @throws IoError.
int hand_out(const DiffResult& result, const DiffSettings& settings, const DiffOptions& options,
             const Invocation& invocation);

}  // namespace mapproof
