#include "core/map_fit/fit_maker.hpp"

#include <algorithm>
#include <functional>
#include <utility>

namespace mapproof {
namespace {

bool is_open(const FitCause& cause) {
  return cause.code == FitCode::kWeakBridge || cause.code == FitCode::kDisconnected;
}

/// 2 for a cause that has a name, 1 for a symptom of the data, 0 for known positions that are
/// missed for a reason that is not known.
double naming(const FitCause& cause) {
  if (cause.code == FitCode::kKnownLandmarksAtOdds) return 0.0;
  return cause.code == FitCode::kOutliers || cause.code == FitCode::kScatter ? 1.0 : 2.0;
}

/// Contradictions before connections that are open, named causes before symptoms, small causes
/// last.
double gravity(const FitCause& cause) {
  const double most = 1e5;
  return (cause.is_small ? 0.0 : 16.0 * most) + (is_open(cause) ? 0.0 : 8.0 * most) +
         2.0 * most * naming(cause) + std::min(most, cause.statistic / cause.bound);
}

FitVerdict verdict_of(const std::vector<FitCause>& causes) {
  const auto any = [&](bool open) {
    return std::ranges::any_of(
        causes, [&](const FitCause& cause) { return !cause.is_small && is_open(cause) == open; });
  };
  if (any(false)) return FitVerdict::kDoesNotFit;
  if (any(true)) return FitVerdict::kUndetermined;
  return causes.empty() ? FitVerdict::kFits : FitVerdict::kDoubtful;
}

}  // namespace

std::vector<std::string> FitMaker::names(const std::vector<int>& landmarks) const {
  std::vector<std::string> result;
  for (const int k : landmarks) result.push_back(names_[static_cast<std::size_t>(k)]);
  return result;
}

void FitMaker::test(FitCause cause, bool may_be_cause) {
  fit_.tests.push_back({cause.code, cause.landmarks, cause.statistic, cause.bound});
  if (may_be_cause && cause.statistic > cause.bound) fit_.causes.push_back(std::move(cause));
}

bool FitMaker::has_cause(FitCode one, FitCode other) const {
  return std::ranges::any_of(
      fit_.causes, [&](const FitCause& cause) { return cause.code == one || cause.code == other; });
}

Fit FitMaker::finished() && {
  std::ranges::stable_sort(fit_.causes, std::ranges::greater(), gravity);
  std::ranges::stable_sort(fit_.tests, {}, &FitTest::code);
  fit_.verdict = verdict_of(fit_.causes);
  return std::move(fit_);
}

}  // namespace mapproof
