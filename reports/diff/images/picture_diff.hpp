#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "render/image/image.hpp"
#include "reports/diff/svg/svg_diff.hpp"

namespace mapproof {

/// Of two picture files. kIdentical is said of equal values alone: equal pixels, or for SVG equal
/// elements.
enum class PictureState { kIdentical, kWithinTolerance, kDifferent, kUnreadable };

/// "within tolerance": in words.
std::string_view name(PictureState state);

/// Pixels x to x + width - 1 and y to y + height - 1, from the upper left corner.
struct PixelBox {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;

  bool operator==(const PixelBox&) const = default;
};

struct PictureSize {
  int width = 0;
  int height = 0;

  bool operator==(const PictureSize&) const = default;
};

struct PictureOptions {
  std::vector<PixelBox> ignored =
      {};                         ///< Pixels that are not looked at; what lies outside is nothing.
  double noise = 2.0;             ///< Of 255, 0 to 64: what one pixel in a flat region may differ.
  double mean_noise = 0.4;        ///< Of 255, 0 to 64: what the mean of a flat region may differ.
  double displacement_px = 0.35;  ///< 0 to 4: how far a piece of a picture may be moved.
  double changed_share = 0.0;     ///< 0 to 1: share of changed pixels that still is tolerated.
  double svg_distance = 0.15;     ///< Pixels as drawn, >= 0: how far SVG geometry may be moved.
  double svg_colour = 0.0;        ///< Of 255, 0 to 255: what a channel of an SVG colour may differ.

  /// Names the first field that cannot be used; empty if none.
  std::string problem() const;
};

/// Two pictures, pixel by pixel. If the sizes differ, nothing but them is set.
struct PixelDiff {
  PictureSize baseline, current;
  std::int64_t differing = 0;    ///< Pixels that differ at all, ignored ones apart.
  std::int64_t changed = 0;      ///< Of them, those that no noise and no other smoothing explains.
  std::int64_t antialiased = 0;  ///< Of them, those on edges that smoothing explains.
  std::int64_t ignored = 0;      ///< Pixels in ignored boxes, different or not.
  double changed_share = 0.0;    ///< Of all pixels.
  int clusters = 0;              ///< Groups of changed pixels, 16 pixels or more apart.
  PixelBox largest_cluster;      ///< Its bounds.
  std::int64_t largest_cluster_pixels = 0;
  double least_structure = 1.0;            ///< Of any 8 x 8 window, at most 1 [wang2004].
  PixelBox least_structure_at;             ///< That window.
  double largest_colour_difference = 0.0;  ///< 0 to 1, black to white is 1 [kotsarenko2010].
  double largest_mean_shift = 0.0;         ///< Of 255, of any window of flat pixels.
  double largest_displacement_px = 0.0;    ///< Of any window whose difference is a movement.
};

struct PictureDiff {
  PictureState state = PictureState::kUnreadable;
  std::string reason;  ///< One line for people.
  std::optional<PixelDiff> pixels;
  std::optional<SvgDiff> svg;
  std::uintmax_t baseline_bytes = 0, current_bytes = 0;
  /// What drew them, as the files themselves say ("mapproof:renderer" or "Software" of a PNG, the
  /// generator's comment of an SVG); empty if they do not.
  std::string baseline_renderer, current_renderer;
};

/// Compares two PNG or two SVG files. What is wrong with their content is data: kUnreadable.
///
/// @param heat  If given, gets heat_map of two PNGs of one size that are not identical, else
/// nothing.
/// @throws IoError if a file cannot be opened or exceeds 2^28 bytes.
/// @throws InvalidInput if the options cannot be used.
/// @note Files of the same bytes, and PNGs that differ in their texts alone, are not decoded. Else
///       two pictures of 4 bytes a pixel are held, and a byte a pixel where they differ. Uses
///       oneTBB's threads; the result does not depend on them.
PictureDiff picture_diff(const std::filesystem::path& baseline,
                         const std::filesystem::path& current, const PictureOptions& options = {},
                         Image* heat = nullptr);

/// The baseline in pale grey, changed pixels red, those yellow that noise or smoothing explains.
/// Empty (0 x 0) if the files are no PNGs, cannot be read, are identical or their sizes differ.
/// @throws as picture_diff.
Image heat_map(const std::filesystem::path& baseline, const std::filesystem::path& current,
               const PictureOptions& options = {});

}  // namespace mapproof
