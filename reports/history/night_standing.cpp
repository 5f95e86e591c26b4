#include "reports/history/night_standing.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "core/base/words.hpp"

namespace mapproof {
namespace {

/// @param before  Put before each sentence.
void tell(std::span<const NightFinding> findings, const std::string& study,
          const std::string& before, Standing& standing) {
  std::size_t count = 0;
  for (const NightFinding& finding : findings)
    if (finding.study == study && ++count <= kMostTold)
      standing.sentences.push_back(before + finding.sentence + ".");
  if (count > kMostTold)
    standing.sentences.push_back(fmt::format("{}{} {} more, among the findings of its trends.",
                                             before, before.empty() ? "And" : "and",
                                             count - kMostTold));
}

/// The studies that have findings, in the order of these.
std::vector<std::string> studies_of(std::span<const NightFinding> findings) {
  std::vector<std::string> studies;
  for (const NightFinding& finding : findings)
    if (std::ranges::find(studies, finding.study) == studies.end())
      studies.push_back(finding.study);
  return studies;
}

}  // namespace

std::string verdict_sentence(const NightFacts& night, std::size_t findings) {
  const std::string count = counted(static_cast<long long>(findings), "finding");
  switch (night.verdict) {
    case NightVerdict::kGood:
      return night.reference
                 ? fmt::format("Nothing got worse than in nightly run {}.", *night.reference)
                 : "Not compared: no nightly run to compare with has the same settings.";
    case NightVerdict::kCost:
      return "Accuracy is unchanged; seconds or memory grew: " + count + ".";
    default:
      return "Accuracy got worse or results are lost: " + count + ".";
  }
}

Standing study_standing(const NightFacts& night, std::span<const NightFinding> findings,
                        const std::string& study, bool is_compared) {
  Standing result;
  tell(findings, study, "", result);
  const auto count = std::ranges::count(findings, study, &NightFinding::study);
  result.worse = count > 0;
  const std::string tonight = fmt::format("Nightly run {}: ", night.number);
  if (result.worse)
    result.title = tonight + counted(count, "thing") + " got worse";
  else if (is_compared && night.reference)
    result.title =
        tonight + fmt::format("nothing got worse than in nightly run {}", *night.reference);
  else
    result.title = tonight + "not compared: no nightly run to compare with has the same settings";
  return result;
}

Standing night_standing(const NightFacts& night, std::span<const NightFinding> findings) {
  Standing result;
  for (const std::string& study : studies_of(findings)) tell(findings, study, study + ": ", result);
  result.worse = !findings.empty();
  std::string verdict = lower_case(verdict_sentence(night, findings.size()));
  verdict.pop_back();  // A title has no full stop.
  result.title = fmt::format("Nightly run {}: {}", night.number, verdict);
  return result;
}

}  // namespace mapproof
