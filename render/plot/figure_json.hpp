#pragma once

#include <string>
#include <string_view>

#include "render/plot/figure.hpp"

namespace mapproof {

/// The figure as JSON (docs/schemas/figure.schema.json): doubles round-trip, NaN is null, a line
/// feed at the end. The same figure gives the same bytes.
std::string figure_to_json(const Figure& figure);

/// The figure that such JSON holds. @throws IoError with `path` and the JSON pointer of what is
/// wrong.
Figure figure_from_json(std::string_view text, const std::string& path);

}  // namespace mapproof
