#include "core/model/sweep.hpp"

#include <algorithm>
#include <array>
#include <numbers>

namespace mapproof {
namespace {

constexpr double kRadOfDegree = std::numbers::pi / 180.0;

const std::array kSweptFactors = {
    SweptFactor{"side_m", "side of the room", "m", Factor::kSide},
    SweptFactor{"landmarks", "landmarks", "", Factor::kLandmarks},
    SweptFactor{"landmark_diameter_m", "diameter of landmarks", "m", Factor::kDiameter},
    SweptFactor{"reach_m", "reach of the sensor", "m", Factor::kReach},
    SweptFactor{"visibility_errors_percent", "entries of visibility that are wrong", "%",
                Factor::kNoise, 0.01, Sensor::kVisibility, 50.0},
    SweptFactor{"bearing_noise_deg", "noise of bearings", "\u00B0", Factor::kNoise, kRadOfDegree,
                Sensor::kBearing, 180.0},
    SweptFactor{"range_noise_m", "noise of ranges", "m", Factor::kNoise, 1.0, Sensor::kRange},
    SweptFactor{"steps", "observations", "", Factor::kSteps},
    SweptFactor{"anchors", "anchors", "", Factor::kAnchors},
};

}  // namespace

std::span<const SweptFactor> swept_factors() { return kSweptFactors; }

const SweptFactor* swept_factor_named(std::string_view name) {
  const auto found = std::ranges::find(kSweptFactors, name, &SweptFactor::name);
  return found == kSweptFactors.end() ? nullptr : &*found;
}

}  // namespace mapproof
