#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reports/diff/svg/svg_diff.hpp"
#include "reports/diff/verdict/tolerances.hpp"

namespace mapproof {

/// The result for two image files. kIdentical means equal values: equal pixels, or equal elements
/// of SVGs.
enum class ImageState { kIdentical, kWithinTolerance, kDifferent, kUnreadable };

/// The state in words: "within tolerance".
std::string_view name(ImageState state);

/// Pixels x to x + width - 1 and y to y + height - 1, from the upper left corner.
struct PixelBox {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;

  bool operator==(const PixelBox&) const = default;
};

struct ImageSize {
  int width = 0;
  int height = 0;

  bool operator==(const ImageSize&) const = default;
};

struct ImageOptions {
  std::vector<PixelBox> ignored =
      {};  ///< Pixels that are not compared; parts outside the image have no effect.
  double noise = ImageTolerances::kNoise;  ///< Of 255, 0 to 64: allowed difference of one pixel in
                                           ///< a flat region.
  double mean_noise = ImageTolerances::kMeanNoise;  ///< Of 255, 0 to 64: allowed difference of the
                                                    ///< mean of a flat region.
  double displacement_px =
      ImageTolerances::kDisplacement_px;  ///< 0 to 4: allowed movement of a part of an image.
  double changed_share =
      ImageTolerances::kChangedShare;  ///< 0 to 1: allowed share of changed pixels.
  double svg_distance =
      ImageTolerances::kSvgDistance;  ///< Pixels as drawn, >= 0: allowed movement of SVG geometry.
  double svg_colour = ImageTolerances::kSvgColour;  ///< Of 255, 0 to 255: allowed difference of a
                                                    ///< channel of an SVG colour.
};

/// The comparison of two images, pixel by pixel. If the sizes differ by more than a few pixels,
/// only the sizes are set; else the rest is of the part that both have.
struct PixelDiff {
  ImageSize baseline, current;
  std::int64_t differing = 0;    ///< Pixels with any difference, without the ignored ones.
  std::int64_t changed = 0;      ///< Of them, those that neither noise nor anti-aliasing explains.
  std::int64_t antialiased = 0;  ///< Of them, those on edges that anti-aliasing explains.
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

struct ImageDiff {
  ImageState state = ImageState::kUnreadable;
  std::string reason;  ///< One line for readers.
  std::optional<PixelDiff> pixels;
  std::optional<SvgDiff> svg;
  bool is_decoded = false;  ///< Whether all pixels of both files were decoded, and none is damaged.
  std::uintmax_t baseline_bytes = 0, current_bytes = 0;
  /// The renderers, as stored in the files ("mapproof:renderer" or "Software" of a PNG, the
  /// generator's comment of an SVG); empty if not stored.
  std::string baseline_renderer, current_renderer;
};

}  // namespace mapproof
