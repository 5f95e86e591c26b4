#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reports/diff/diff_result.hpp"
#include "reports/diff/diff_settings.hpp"
#include "reports/diff/images/image_changes.hpp"
#include "reports/html/templates.hpp"

namespace mapproof {

/// An image within the page.
struct ShownImage {
  std::string uri;                ///< "data:image/png;base64,…".
  std::optional<ImageSize> size;  ///< In pixels; none: an SVG.
  std::string renderer;           ///< Its renderer, as stored in its file; may be empty.
};

/// The images of one item, in the format that differs most, PNG before SVG.
struct ShownImages {
  std::string format;  ///< "png", "svg"; empty: none is shown.
  std::optional<ShownImage> baseline, current, heat;
  std::optional<PixelBox> cluster;  ///< The largest cluster of changed pixels, if any.
  std::string no_heat;              ///< Why two images have no heat map; empty if they have one.
  std::string absent;  ///< Why no image is shown; empty if one is shown, or if there is none.
};

struct ImageBudget {
  std::size_t largest_bytes = std::size_t{16} << 20;  ///< Of one file.
  /// Of the page: the first images and tables fill it, the others are not shown.
  std::size_t page_bytes = 5'000'000;
  std::size_t heat_maps = 100;  ///< The others have none.
};

/// One self-contained page on a comparison (docs/diff.md): verdicts and causes, images of the
/// differing items, tables of movements, checkboxes for approval. It fetches nothing, which its
/// content security policy also forbids; it is readable without a script. Images are data of <img>,
/// never markup.
///
/// Reads the images again: they must be those that were compared.
/// @throws IoError if a template fails. Images that cannot be read are left out; the page states
/// so.
std::string diff_html(const DiffResult& result, const DiffSettings& settings,
                      const Templates& templates, const ImageBudget& budget = {});

}  // namespace mapproof
