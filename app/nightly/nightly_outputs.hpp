#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/console.hpp"
#include "app/disclosure.hpp"
#include "app/nightly/history_report.hpp"
#include "reports/history/nightly_summary.hpp"

namespace mapproof {

/// Files and commands that a nightly run is to end with; empty: none.
struct NightlyWishes {
  std::string markdown = {};
  std::string junit = {};
  std::string on_worse = {};  ///< A command of the shell.
};

/// Writes the summaries that are asked for. @throws IoError.
void write_summaries(const NightlySummary& summary, const NightlyWishes& wishes,
                     const Disclosure& disclosure);

/// Runs the command if something got worse that is not known, by /bin/sh, with the summary in
/// Markdown on its standard input and facts in its environment: MAPPROOF_NIGHTLY_RUN,
/// MAPPROOF_VERDICT, MAPPROOF_TITLE, MAPPROOF_PAGE and, if they are known, MAPPROOF_COMMITS. What it
/// writes goes to standard error; a failure of it is a warning.
void run_on_worse(const NightlySummary& summary, const NightlyWishes& wishes,
                  const std::filesystem::path& index, const Console& console);

/// Two nightly runs, the older one first, and studies that both have.
struct NightlyPair {
  NightlyFacts before = {};
  NightlyFacts after = {};
  std::vector<std::string> studies = {};
  /// What got worse from one to the other, where the later one was compared with the earlier one:
  /// the pages say the same.
  std::vector<FindingGroup> groups = {};
};

/// What got worse from one nightly run to another one, as far as the later one was compared with
/// the earlier one, or its findings began between them.
std::vector<FindingGroup> groups_between(const IndexFacts& facts, int before, int after);

/// Compares each study of two nightly runs as `mapproof diff` does, and writes the page of each (see
/// comparison_file()). A study whose files are not there any more is left out.
/// @return The files of the pages, below the folder of the pages. @throws IoError, InvalidInput.
std::vector<std::string> write_comparisons(const NightlyPair& pair, const HistoryOutputs& outputs);

}  // namespace mapproof
