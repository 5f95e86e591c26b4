#pragma once

#include <string>
#include <utility>
#include <vector>

#include "render/image/image.hpp"
#include "render/plot/drawing.hpp"

namespace mapproof {

/// @throws InvalidInput, with the drawing's id, if a side of its image would have no pixel or more
///         than 20,000.
void require_image_size(const Drawing& drawing);

/// The drawing as pixels, at its own dpi. Safe from any thread, the same pixels each time.
/// @throws InvalidInput as require_image_size().
Image to_image(const Drawing& drawing);

/// What a PNG file holds about the drawing, as keywords and text.
std::vector<std::pair<std::string, std::string>> png_words(const Drawing& drawing);

/// to_image as a PNG file with the figure's id, title, records and description as text chunks.
std::string to_png(const Drawing& drawing);

/// The drawing as a PDF file: text stays text, the date is fixed. The same bytes each time.
std::string to_pdf(const Drawing& drawing);

/// The drawing as an EPS file, without a date. Cairo makes pixels of what is translucent, which EPS
/// does not know. The same bytes each time.
std::string to_eps(const Drawing& drawing);

}  // namespace mapproof
