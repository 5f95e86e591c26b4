#pragma once

#include <string>

#include "core/model/map_record.hpp"
#include "core/model/map_uncertainty.hpp"
#include "render/plot/figure.hpp"

namespace mapproof {

/// Puts the ellipses of a map under what its figure shows, and describes them in the caption. Where
/// some are as large as the map, the frame cuts them, and a note counts them.
/// @param figure  map_figure() of the record.
/// @throws InvalidInput unless there is a covariance a landmark.
void add_ellipses(const MapRecord& record, const MapUncertainty& uncertainty, Figure& figure);

/// What the ellipses of a map include, and what they do not: a sentence or two.
std::string ellipse_words(const MapUncertainty& uncertainty);

}  // namespace mapproof
