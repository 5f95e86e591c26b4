#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "app/disclosure.hpp"
#include "reports/history/history_store.hpp"
#include "reports/history/pages/history_pages.hpp"
#include "reports/html/templates.hpp"

namespace mapproof {

/// Where a history's pages lie as seen from one in `folder`.
HistoryFolders paths_from(const std::filesystem::path& folder, const std::filesystem::path& out,
                          const std::filesystem::path& store);

/// Where a history lies and its pages go.
struct HistoryOutputs {
  std::filesystem::path store;  ///< Where nightly_runs/ lies, and what is left of lost ones.
  std::filesystem::path out;    ///< For the pages: the store or another folder.
  const Templates& page;
  int jobs = 1;
  const Disclosure& disclosure;
};

/// What the pages show of a history, whose last nightly run has these remarks. @throws IoError.
IndexFacts read_index_facts(HistoryStore& history, const HistoryOutputs& outputs,
                            std::span<const std::string> remarks);

/// Writes index.html, feed.xml, badge.svg, badge.json and, of every study of the last nightly run,
/// trends/STUDY/report.html with its figures, again from the history.
/// @return The path of index.html. @throws IoError.
std::filesystem::path write_history_pages(HistoryStore& history, const HistoryOutputs& outputs,
                                          const IndexFacts& facts);

}  // namespace mapproof
