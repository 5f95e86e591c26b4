#include "reports/history/nightly_standing.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "core/base/text/words.hpp"

namespace mapproof {
namespace {

/// @param before  Put before each sentence.
void add_findings(std::span<const NightlyFinding> findings, const std::string& study,
          const std::string& before, Standing& standing) {
  std::size_t count = 0;
  for (const NightlyFinding& finding : findings)
    if (finding.study == study && ++count <= kMostReported)
      standing.sentences.push_back(before + finding.sentence + ".");
  if (count > kMostReported)
    standing.sentences.push_back(fmt::format("{}{} {} more, among the findings of its trends.",
                                             before, before.empty() ? "And" : "and",
                                             count - kMostReported));
}

/// The studies that have findings, in the order of these.
std::vector<std::string> studies_of(std::span<const NightlyFinding> findings) {
  std::vector<std::string> studies;
  for (const NightlyFinding& finding : findings)
    if (std::ranges::find(studies, finding.study) == studies.end())
      studies.push_back(finding.study);
  return studies;
}

}  // namespace

std::string verdict_sentence(const NightlyFacts& nightly_run, std::size_t findings) {
  const std::string count = counted(static_cast<long long>(findings), "finding");
  switch (nightly_run.verdict) {
    case NightlyVerdict::kPassed:
      return nightly_run.reference
                 ? fmt::format("Nothing got worse than in nightly run {}.", *nightly_run.reference)
                 : "Not compared: no nightly run to compare with has the same settings.";
    case NightlyVerdict::kCost:
      return "Accuracy is unchanged; seconds or memory grew: " + count + ".";
    default:
      return "Accuracy got worse or results are lost: " + count + ".";
  }
}

Standing study_standing(const NightlyFacts& nightly_run, std::span<const NightlyFinding> findings,
                        const std::string& study, bool is_compared) {
  Standing result;
  add_findings(findings, study, "", result);
  const auto count = std::ranges::count(findings, study, &NightlyFinding::study);
  result.worse = count > 0;
  const std::string this_run = fmt::format("Nightly run {}: ", nightly_run.number);
  if (result.worse)
    result.title = this_run + counted(count, "thing") + " got worse";
  else if (is_compared && nightly_run.reference)
    result.title =
        this_run + fmt::format("nothing got worse than in nightly run {}", *nightly_run.reference);
  else
    result.title = this_run + "not compared: no nightly run to compare with has the same settings";
  return result;
}

Standing nightly_standing(const NightlyFacts& nightly_run,
                          std::span<const NightlyFinding> findings) {
  Standing result;
  for (const std::string& study : studies_of(findings)) add_findings(findings, study, study + ": ", result);
  result.worse = !findings.empty();
  std::string verdict = lower_case(verdict_sentence(nightly_run, findings.size()));
  verdict.pop_back();  // A title has no full stop.
  result.title = fmt::format("Nightly run {}: {}", nightly_run.number, verdict);
  return result;
}

}  // namespace mapproof
