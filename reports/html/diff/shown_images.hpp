#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "reports/diff/diff_result.hpp"
#include "reports/diff/diff_settings.hpp"
#include "reports/diff/images/image_changes.hpp"

namespace mapproof {

/// An image within the page.
struct ShownImage {
  std::string uri;  ///< "data:image/png;base64,…".
  /// In pixels; none: an SVG of a file, or a heat map whose pixels are not those of the images
  /// beside it.
  std::optional<ImageSize> size;
  std::string note;  ///< For readers: its renderer, or how it was made; may be empty.
};

/// The images of one item, in the format that differs most, PNG before SVG.
struct ShownImages {
  std::string format;  ///< "png", "svg"; empty: none is shown.
  std::optional<ShownImage> baseline, current, heat;
  std::optional<ShownImage> change;  ///< What changed in the values, as SVG: change_figure().
  std::optional<ShownImage> narrow_change;  ///< The same for a phone, its panels in one column.
  std::optional<PixelBox> cluster;   ///< The largest cluster of changed pixels, if any,
  ImageSize cluster_in;              ///< in images of this size.
  double changed_share = 0.0;        ///< Of the heat map's pixels, or without one of the images'.
  std::string no_heat;               ///< Why two images have no heat map; empty if they have one.
  std::string absent;  ///< Why no image is shown; empty if one is shown, or if there is none.
};

inline constexpr std::size_t kPageBytes = 5'000'000;

struct ImageBudget {
  std::size_t largest_bytes = std::size_t{16} << 20;  ///< Of one file.
  /// Of the page: the first images and tables fill it, the others are not shown.
  std::size_t page_bytes = kPageBytes;
  std::size_t heat_maps = 100;  ///< The others have none.
};

/// Reads the images of each item, in order, and makes the heat maps of images that differ, also
/// within tolerance, and the figures of what changed. The images must be those that were compared.
/// Identical and unreadable images are not shown, and those that cannot be read any more are left
/// out, with the reason. Images are embedded as the bytes of their files.
/// @note Reads several items at a time, by oneTBB; the result does not depend on it. Holds all
/// images in memory.
std::vector<ShownImages> shown_images(const DiffResult& result, const DiffSettings& settings,
                                      const ImageBudget& budget = {});

/// Whether the item has a cause that others before it, which are shown in full, have as well.
bool is_repeated(const DiffResult& result, const DiffItem& item);

/// Of a cause that several items share, the first items are shown in full.
inline constexpr std::ptrdiff_t kExamples = 3;

/// The parts of a page that images and tables may fill; styles, scripts and the rest of the markup
/// need what is left.
inline constexpr double kImageShare = 0.6;
inline constexpr double kTableShare = 0.32;

}  // namespace mapproof
