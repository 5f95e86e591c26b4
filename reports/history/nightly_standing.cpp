#include "reports/history/nightly_standing.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "core/base/text/words.hpp"

namespace mapproof {
namespace {

/// What, by how much, since when, and in which commits.
std::string sentence_of(const FindingGroup& group) {
  std::string text = group.setup.empty() ? "" : group.setup + ", ";
  text += fmt::format("{}, since nightly run {}", group.headline(), group.commits.since.number);
  if (group.commits.has_commits()) text += ", commits " + group.commits.text();
  return text + (group.known ? "; known: " + group.known->text : ".");
}

/// @param before  Put before each sentence.
void add_findings(std::span<const FindingGroup> groups, const std::string& study,
                  const std::string& before, Standing& standing) {
  std::size_t count = 0;
  for (const FindingGroup& group : groups)
    if (group.study == study && ++count <= kMostReported)
      standing.sentences.push_back(before + sentence_of(group));
  if (count > kMostReported)
    standing.sentences.push_back(fmt::format("{}{} {} more, among the findings of its trends.",
                                             before, before.empty() ? "And" : "and",
                                             count - kMostReported));
}

/// The studies that have findings, in the order of these.
std::vector<std::string> studies_of(std::span<const FindingGroup> groups) {
  std::vector<std::string> studies;
  for (const FindingGroup& group : groups)
    if (std::ranges::find(studies, group.study) == studies.end()) studies.push_back(group.study);
  return studies;
}

}  // namespace

Standing study_standing(const NightlyFacts& nightly_run, std::span<const FindingGroup> groups,
                        const std::string& study, bool is_compared) {
  Standing result;
  add_findings(groups, study, "", result);
  long long count = 0, known = 0;
  for (const FindingGroup& group : groups)
    if (group.study == study) (group.known ? known : count) += std::ssize(group.numbers);
  result.worse = count > 0;
  const std::string this_run = fmt::format("Nightly run {}: ", nightly_run.number);
  if (result.worse)
    result.title = this_run + counted(count, "thing") + " got worse";
  else if (is_compared && nightly_run.reference)
    result.title =
        this_run + fmt::format("nothing {}got worse than in nightly run {}", known > 0 ? "new " : "",
                               *nightly_run.reference);
  else
    result.title = this_run + "not compared: no nightly run to compare with has the same settings";
  return result;
}

Standing nightly_standing(const NightlySummary& summary) {
  Standing result;
  for (const std::string& study : studies_of(summary.groups))
    add_findings(summary.groups, study, study + ": ", result);
  result.worse = summary.new_findings() > 0;
  result.title = summary.title();
  return result;
}

}  // namespace mapproof
