#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/diff/diff_result.hpp"
#include "reports/diff/diff_settings.hpp"

namespace mapproof {

/// A picture within the page.
struct ShownPicture {
  std::string uri;                  ///< "data:image/png;base64,…".
  std::optional<PictureSize> size;  ///< In pixels; none: an SVG.
  std::string renderer;             ///< What drew it, as its file says; may be empty.
};

/// The pictures of one item: of the format that differs most, PNG before SVG.
struct ShownPictures {
  std::string format;  ///< "png", "svg"; empty: none is shown.
  std::optional<ShownPicture> baseline, current, heat;
  std::optional<PixelBox> cluster;  ///< The largest, where there is one.
  std::string no_heat;              ///< Why two pictures have no heat map; empty if they have.
  std::string absent;  ///< Why nothing is shown; empty if something is, or there is nothing.
};

struct PictureBudget {
  std::size_t largest_bytes = std::size_t{16} << 20;  ///< Of one file.
  std::size_t all_bytes = std::size_t{64} << 20;      ///< Of all files; the rest is not shown.
  std::size_t heat_maps = 100;                        ///< The rest has none.
};

/// Reads what the page shows of each item, in their order, and makes the heat maps of PNGs that
/// differ, within tolerance too. Identical and unreadable pictures are not shown. Files stay as
/// they are on disk.
/// @note Several items at a time, by oneTBB; the result does not depend on it. Holds all.
std::vector<ShownPictures> shown_pictures(const DiffResult& result, const DiffSettings& settings,
                                          const PictureBudget& budget = {});

}  // namespace mapproof
