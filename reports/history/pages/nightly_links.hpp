#pragma once

#include <map>
#include <string>
#include <utility>

#include "reports/history/finding_groups.hpp"
#include "reports/history/nightly_run.hpp"
#include "reports/model/report.hpp"

namespace mapproof {

/// Where the pages of a history lie, as seen from one of them: folders that end in '/', or empty
/// for the page's own.
struct HistoryFolders {
  std::string pages = {};         ///< Of index.html and trends/.
  std::string nightly_runs = {};  ///< Of nightly_runs/.
};

/// Links from one page of a history to the others, and what they are called.
class NightlyLinks {
 public:
  explicit NightlyLinks(HistoryFolders folders) : folders_(std::move(folders)) {}

  Phrase index();
  Phrase trends(const std::string& study);
  /// The findings of all nightly runs on the page of the trends.
  Phrase findings(const std::string& study);
  /// The page that compares a study of two nightly runs.
  Phrase comparison(int before, int after, const std::string& study);
  /// The page of a commit; its digits alone if its address is not known.
  Phrase commit(const NightlyFacts& nightly_run);
  /// The page that compares the two commits; the range alone if its address is not known.
  Phrase commits(const CommitRange& range);
  Phrase feed();
  Phrase badge();
  Phrase report(int nightly_run, const std::string& study);
  /// The folder of a nightly run of several studies.
  Phrase folder(int nightly_run);

  /// The text of every link that was requested (see HtmlOptions::link_words).
  const std::map<std::string, std::string>& words() const { return words_; }

 private:
  Phrase link(const std::string& path, const std::string& words, const std::string& element = "");

  HistoryFolders folders_;
  std::map<std::string, std::string> words_;
};

/// "compare/0005-0006/STUDY.html": the page that compares a study of two nightly runs, from the
/// folder of the index.
std::string comparison_file(int before, int after, const std::string& study);

}  // namespace mapproof
