#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reports/diff/diff_result.hpp"
#include "reports/diff/diff_settings.hpp"
#include "reports/diff/images/picture_changes.hpp"
#include "reports/html/diff/diff_html.hpp"
#include "reports/html/templates.hpp"

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

/// `text` byte by byte as it may stand in a fragment, an id or an attribute: letters, digits and
/// "-._/" as they are, every other byte as %XX. Two texts never become one.
std::string url_text(std::string_view text);

/// One self-contained page on a comparison (docs/diff.md): verdicts and causes, pictures of what
/// differs, tables of what moved, ticks for approval. Nothing is fetched, and its content security
/// policy forbids it; without a script it can be read. Pictures are data of <img>, never markup.
///
/// Reads the pictures again: they have to be those that were compared.
/// @throws IoError if a template fails. Pictures that cannot be read are left out, and it is said.
std::string diff_html(const DiffResult& result, const DiffSettings& settings,
                      const Templates& templates, const PictureBudget& budget = {});

}  // namespace mapproof
