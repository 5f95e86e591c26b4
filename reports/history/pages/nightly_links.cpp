#include "reports/history/pages/nightly_links.hpp"

#include <fmt/format.h>

namespace mapproof {

Phrase NightlyLinks::link(const std::string& path, const std::string& words,
                          const std::string& element) {
  words_[path + (element.empty() ? "" : "#" + element)] = words;
  return {path, Emphasis::kFile, element};
}

Phrase NightlyLinks::index() { return link(folders_.pages + "index.html", "all nightly runs"); }

Phrase NightlyLinks::trends(const std::string& study) {
  return link(fmt::format("{}trends/{}/report.html", folders_.pages, study), "trends of " + study);
}

Phrase NightlyLinks::findings(const std::string& study) {
  return link(fmt::format("{}trends/{}/report.html", folders_.pages, study),
              "all findings of " + study, "section-findings");
}

Phrase NightlyLinks::report(int nightly_run, const std::string& study) {
  return link(
      fmt::format("{}nightly_runs/{:04}/{}/report.html", folders_.nightly_runs, nightly_run, study),
      fmt::format("report of nightly run {}", nightly_run));
}

Phrase NightlyLinks::folder(int nightly_run) {
  return link(fmt::format("{}nightly_runs/{:04}/", folders_.nightly_runs, nightly_run),
              fmt::format("folder of nightly run {}", nightly_run));
}

Phrase NightlyLinks::comparison(int before, int after, const std::string& study) {
  return link(folders_.pages + comparison_file(before, after, study),
              fmt::format("diff of nightly runs {} and {}", before, after));
}

Phrase NightlyLinks::commit(const NightlyFacts& nightly_run) {
  const std::string words = short_commit(nightly_run.commit);
  const std::string url = commit_url(nightly_run.repository, nightly_run.commit);
  if (url.empty()) return {words, Emphasis::kCode};
  words_[url] = words;
  return {url, Emphasis::kUrl};
}

Phrase NightlyLinks::commits(const CommitRange& range) {
  const std::string url = range.url();
  if (url.empty()) return {range.text(), Emphasis::kCode};
  words_[url] = range.text();
  return {url, Emphasis::kUrl};
}

Phrase NightlyLinks::feed() { return link(folders_.pages + "feed.xml", "Atom feed"); }

Phrase NightlyLinks::badge() { return link(folders_.pages + "badge.svg", "badge"); }

std::string comparison_file(int before, int after, const std::string& study) {
  return fmt::format("compare/{:04}-{:04}/{}.html", before, after, study);
}

}  // namespace mapproof
