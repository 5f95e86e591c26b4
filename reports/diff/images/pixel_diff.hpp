#pragma once

#include <cstdint>

#include "render/image/image.hpp"
#include "reports/diff/images/change_map.hpp"
#include "reports/diff/images/image_changes.hpp"

namespace mapproof {

struct PixelComparison {
  PixelDiff pixels;
  ChangeMap marks;  ///< Of the part that both have; empty if the sizes differ by more.
};

/// Compares two images, as docs/diff-images.md describes. A larger tolerance never finds a change
/// where a smaller one finds none.
/// @param current  Consumed; its ignored pixels are overwritten.
/// @throws InvalidInput if the options cannot be used.
/// @note Linear time; equal tiles cost a comparison of their bytes. Images that differ are judged
///       once for each step of tolerance up to the options'. Parallel over tiles.
PixelComparison pixel_diff(const Image& baseline, Image current, const ImageOptions& options = {});

/// Whether two sizes differ by so few pixels that the part which both images have is compared.
bool have_common_part(const ImageSize& a, const ImageSize& b);

/// The upper left part of an image. @param size  At most that of the image.
Image upper_left(const Image& image, const ImageSize& size);

/// Of pixels; tests set smaller ones.
struct StripLimits {
  std::int64_t whole = std::int64_t{1} << 26;  ///< An image of no more is one strip.
  std::int64_t strip = std::int64_t{1} << 23;  ///< Else a strip has so many, but 64 rows at least.
  std::int64_t heat = std::int64_t{1} << 24;   ///< Of the heat map of an image of several strips.
};

/// Compares two images that are given in strips, from the top. A large image has several, which are
/// judged each for itself; the 32 rows above a strip are judged with it, so that nothing is cut in
/// two.
class StripDiff {
 public:
  /// @param options    Must outlive this.
  /// @param with_heat  Whether heat() is wanted.
  StripDiff(const ImageSize& baseline, const ImageSize& current, const ImageOptions& options,
            bool with_heat, const StripLimits& limits = {});

  /// How many of the next rows of both images add() takes; 0: no more, as the images are compared,
  /// or their sizes differ by too much.
  int next_rows() const { return next_rows_; }

  void add(Image baseline, Image current);

  /// Of what was added, all of it at the end.
  PixelDiff pixels() const;
  /// Whether pixels in ignored boxes differ, and no others.
  bool differs_where_ignored() const { return is_hidden_ && pixels_.differing == 0; }

  /// As heat_map(); of an image of several strips and too many pixels one pixel for each square of
  /// 2, 4, 8 or 16 pixels a side, which is red if one of its pixels is. Empty if nothing differs.
  HeatMap heat() &&;

 private:
  void plan();
  void take_over(const PixelComparison& part, int top, int owned_to);
  void add_heat(HeatMap part, int from, int to);

  ImageSize size_;  ///< Of the part that both have.
  const ImageOptions* options_;
  bool with_heat_;
  StripLimits limits_;
  int rows_done_ = 0;   ///< Added.
  int rows_owned_ = 0;  ///< Of them, those whose judgement is in the result.
  int next_rows_ = 0;
  Image above_baseline_, above_current_;  ///< The last rows of the strip before.
  PixelDiff pixels_;
  ChangedClusters clusters_;
  bool is_hidden_ = false;  ///< Whether pixels differed before boxes were ignored.
  int heat_scale_ = 1;
  bool any_heat_ = false;
  HeatMap heat_;
};

}  // namespace mapproof
