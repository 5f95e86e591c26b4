#include "core/model/slam/slam_method.hpp"

#include <array>

namespace mapproof {
namespace {

constexpr std::array kSlamMethods = {
    SlamMethodInfo{.method = SlamMethod::kDeadReckoning,
                   .name = "dead-reckoning",
                   .label = "dead reckoning",
                   .summary = "odometry integrated from its start",
                   .baseline = true,
                   .alignment = Alignment::kNone},
    SlamMethodInfo{.method = SlamMethod::kEkf,
                   .name = "ekf",
                   .label = "extended Kalman filter",
                   .summary = "odometry predicts, gated ranges correct",
                   .baseline = true},
    SlamMethodInfo{.method = SlamMethod::kSpectralKnown,
                   .name = "spectral-known",
                   .label = "spectral, 4-D, known landmarks",
                   .summary = "rank 4 of the squared ranges, regression on known landmarks",
                   .knows_landmarks = true,
                   .alignment = Alignment::kNone},
    SlamMethodInfo{.method = SlamMethod::kSpectralKnown7,
                   .name = "spectral-known-7d",
                   .label = "spectral, 7-D, known landmarks",
                   .summary = "rank 7 with headings, regression on known landmarks",
                   .knows_landmarks = true,
                   .alignment = Alignment::kNone},
    SlamMethodInfo{.method = SlamMethod::kSpectral,
                   .name = "spectral",
                   .label = "spectral, 4-D",
                   .summary = "rank 4 of the squared ranges, metric upgrade, no landmark known"},
    SlamMethodInfo{.method = SlamMethod::kSpectral7,
                   .name = "spectral-7d",
                   .label = "spectral, 7-D",
                   .summary = "rank 7 with headings, metric upgrade, no landmark known"},
    SlamMethodInfo{.method = SlamMethod::kBatchFixedScale,
                   .name = "batch-fixed-scale",
                   .label = "batch, scale fixed",
                   .summary = "nonlinear least squares with ranges taken as distances",
                   .baseline = true},
    SlamMethodInfo{.method = SlamMethod::kRefined,
                   .name = "refined",
                   .label = "refined, scale free",
                   .summary = "nonlinear least squares from the spectral answer"},
    SlamMethodInfo{.method = SlamMethod::kRefinedFromOdometry,
                   .name = "refined-from-odometry",
                   .label = "refined, from odometry",
                   .summary = "nonlinear least squares from dead reckoning"},
    SlamMethodInfo{.method = SlamMethod::kRefinedFromRandom,
                   .name = "refined-from-random",
                   .label = "refined, from random",
                   .summary = "nonlinear least squares from landmarks at random positions"},
    SlamMethodInfo{.method = SlamMethod::kRepaired,
                   .name = "repaired",
                   .label = "refined, repaired",
                   .summary = "nonlinear least squares that allows for the cause of the misfit"},
};

}  // namespace

std::span<const SlamMethodInfo> all_slam_methods() { return kSlamMethods; }

const SlamMethodInfo& info(SlamMethod method) {
  return kSlamMethods[static_cast<std::size_t>(method)];
}

std::optional<SlamMethod> slam_method_named(std::string_view name) {
  for (const SlamMethodInfo& candidate : kSlamMethods)
    if (candidate.name == name) return candidate.method;
  return std::nullopt;
}

}  // namespace mapproof
