#include "core/model/fit.hpp"

#include <algorithm>
#include <array>

namespace mapproof {
namespace {

constexpr std::array<std::string_view, 5> kFitVerdicts = {"fits", "doubtful", "undetermined",
                                                          "does_not_fit", "not_testable"};

constexpr std::array<std::string_view, 29> kFitCodes = {"residuals",
                                                        "landmark_residuals",
                                                        "outliers",
                                                        "common_offset",
                                                        "landmark_offset",
                                                        "time_offset",
                                                        "clock_jump",
                                                        "landmark_moved",
                                                        "ids_exchanged",
                                                        "odometry_gap",
                                                        "odometry_frozen",
                                                        "known_landmark_off",
                                                        "known_landmarks_exchanged",
                                                        "known_landmarks_at_odds",
                                                        "residuals_over_time",
                                                        "residuals_over_range",
                                                        "odometry_residuals",
                                                        "stress",
                                                        "anchor_missed",
                                                        "weak_bridge",
                                                        "mirror",
                                                        "fold",
                                                        "wrong_ids",
                                                        "scatter",
                                                        "robot_ranges",
                                                        "robot_bearings",
                                                        "known_mirrored",
                                                        "known_scale",
                                                        "disconnected"};
static_assert(kFitCodes.size() == static_cast<std::size_t>(FitCode::kDisconnected) + 1);

constexpr std::array<std::string_view, 6> kFitMissing = {"map", "redundancy", "noise_model",
                                                         "odometry", "metric", "size"};

}  // namespace

std::string_view name(FitVerdict verdict) {
  return kFitVerdicts[static_cast<std::size_t>(verdict)];
}

std::string_view name(FitCode code) { return kFitCodes[static_cast<std::size_t>(code)]; }

std::string_view name(FitMissing missing) { return kFitMissing[static_cast<std::size_t>(missing)]; }

const FitNumber* Fit::number(std::string_view quantity) const {
  const auto found = std::ranges::find(numbers, quantity, &FitNumber::quantity);
  return found == numbers.end() ? nullptr : &*found;
}

std::optional<double> fit_rank(FitVerdict verdict) {
  if (verdict == FitVerdict::kNotTestable) return std::nullopt;
  return 1.0 + static_cast<double>(verdict);
}

std::vector<FitNumber> fit_numbers(const Fit& fit) {
  std::vector<FitNumber> all;
  if (const auto rank = fit_rank(fit.verdict)) all.push_back({"fit_verdict", *rank});
  all.insert(all.end(), fit.numbers.begin(), fit.numbers.end());
  return all;
}

}  // namespace mapproof
