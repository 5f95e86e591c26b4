#pragma once

#include <string>
#include <string_view>

namespace mapproof {

/// Whether a text is a date alone, or one with a time and a zone: "2026-11-29 16:51 UTC".
bool is_date(std::string_view text);

/// A sentence or a title as a page shows it: no line ends within a quantity, "16 m", "K = 7",
/// "4-D", nor within a date, its time and its zone. Spaces become no-break ones (U+00A0) there,
/// hyphens no-break hyphens (U+2011). Units are m, km, mm, s, ms, µs, min, h, ppm, MiB and %.
/// @note O(size of the text)
std::string page_text(std::string_view text);

/// What a title adds to the heading above it: "noise 0.1 m" of "Indoors, noise 0.1 m" or "Indoors:
/// noise 0.1 m" below "Indoors"; below another heading the whole title.
std::string title_below(std::string_view heading, std::string_view title);

}  // namespace mapproof
