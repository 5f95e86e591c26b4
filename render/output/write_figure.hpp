#pragma once

#include <string>

#include "core/base/files/output_folder.hpp"
#include "render/output/file_format.hpp"
#include "render/plot/figure.hpp"
#include "render/theme/theme.hpp"

namespace mapproof {

/// A whole SVG file, also fit to stand in an HTML page beside others: every id begins with the
/// figure's, the width is the page's to choose. The same figure and theme give the same bytes.
/// @throws InvalidInput if the figure cannot be drawn (see `problem`).
std::string figure_svg(const Figure& figure, const Theme& theme);

/// A PNG file with the figure's id and records as text chunks. Otherwise as figure_svg.
std::string figure_png(const Figure& figure, const Theme& theme);

/// A PDF file with selectable text and a fixed date. Otherwise as figure_svg.
std::string figure_pdf(const Figure& figure, const Theme& theme);

/// Writes ID.svg, ID.png, ID.pdf and ID.figure.json, or as the formats say ID.eps, ID.csv (see
/// figure_csv()) and ID.py (see figure_script()), each at once or not at all.
/// @return The SVG file's text, as of figure_svg; empty if it is none of the formats.
/// @throws InvalidInput as figure_svg; IoError if a file cannot be written.
std::string write_figure(const Figure& figure, const Theme& theme, const OutputFolder& folder,
                         const FileFormats& formats = usual_formats());

}  // namespace mapproof
