#pragma once

#include <map>
#include <string>
#include <utility>

#include "reports/model/report.hpp"

namespace mapproof {

/// Where the pages of a history lie, as seen from one of them: folders that end in '/', or empty
/// for the page's own.
struct HistoryPlaces {
  std::string pages = {};   ///< Of index.html and trends/.
  std::string nights = {};  ///< Of nights/.
};

/// Links from one page of a history to the others, and what they are called.
class NightLinks {
 public:
  explicit NightLinks(HistoryPlaces places) : places_(std::move(places)) {}

  Phrase index();
  Phrase trends(const std::string& study);
  Phrase report(int night, const std::string& study);
  /// The folder of a night of several studies.
  Phrase folder(int night);

  /// The words of every link that was asked for, by its path (see HtmlOptions::link_words).
  const std::map<std::string, std::string>& words() const { return words_; }

 private:
  Phrase link(const std::string& path, const std::string& words);

  HistoryPlaces places_;
  std::map<std::string, std::string> words_;
};

}  // namespace mapproof
