#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "core/results/quantity.hpp"

namespace mapproof {

/// Tolerances by the id of a quantity, or kOtherNumbers. They replace the defaults.
using Tolerances = std::map<std::string, Tolerance, std::less<>>;

/// The name in the settings of numbers in the records that do not belong to a quantity.
inline constexpr std::string_view kOtherNumbers = "other";

/// The tolerances of images that hold unless the settings change them. docs/diff-images.md tells
/// what each was measured on.
struct ImageTolerances {
  static constexpr double kNoise = 2.0;             ///< Of 255, of one pixel in a flat region.
  static constexpr double kMeanNoise = 0.4;         ///< Of 255, of the mean of a flat region.
  static constexpr double kDisplacement_px = 0.35;  ///< Of a part of an image.
  static constexpr double kChangedShare = 0.0;      ///< Of all pixels.
  static constexpr double kSvgDistance = 0.15;      ///< Pixels as drawn, of SVG geometry.
  static constexpr double kSvgColour = 0.0;         ///< Of 255, of a channel of an SVG colour.
};

Tolerance tolerance_of(const Quantity& quantity, const Tolerances& changed);

/// The tolerance of numbers that do not belong to a quantity.
Tolerance tolerance_of_others(const Tolerances& changed);

/// Both numbers with as many digits as distinguish them, at least the given count; "none" for NaN.
std::pair<std::string, std::string> distinguished(double baseline, double current, int digits);

/// "0.120" and "0.153": as many digits as distinguish the two, at least three; of whole numbers no
/// decimals; "none" for NaN.
std::pair<std::string, std::string> changed_numbers(double baseline, double current);

/// "0.120 → 0.153 m", see changed_numbers().
/// @param errors_m  Errors in m: those of maps that diverged are "over 1 km".
std::string change_text(double baseline, double current, std::string_view unit,
                        bool errors_m = false);

}  // namespace mapproof
