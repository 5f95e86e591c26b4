#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/model/fit.hpp"
#include "core/model/map_record.hpp"
#include "core/model/map_uncertainty.hpp"
#include "core/model/sensor.hpp"

namespace mapproof {

/// One map as a file of its own (mapproof.map); a NaN row of positions is null.
/// @param uncertainty  Of its landmarks, as many as the map has.
/// @param sensors    Of a joint map.
/// @param fit        Of its data to the map.
std::string map_json(const MapRecord& map, const std::optional<MapUncertainty>& uncertainty = {},
                     const std::optional<MapSensors>& sensors = {},
                     const std::optional<Fit>& fit = {});

/// @param source  What to call the file in errors. @throws IoError with the location, of what is
/// wrong
///                with its uncertainty or sensors, too.
MapRecord parse_map(std::string_view text, const std::string& source);

/// The uncertainty in a map's file; empty if it has none. @throws IoError as parse_map.
std::optional<MapUncertainty> parse_map_uncertainty(std::string_view text,
                                                    const std::string& source);

/// The fit in a map's file; empty if it has none. @throws IoError as parse_map.
std::optional<Fit> parse_map_fit(std::string_view text, const std::string& source);

/// One map as RFC 4180: name,x_m,y_m,true_x_m,true_y_m,error_m,anchor; empty where unknown.
/// Without the frame of the ground truth the columns are x,y and there is no error. With a
/// uncertainty the half axes of the ellipse and the angle of the longer one from the x axis follow.
/// Names are kept as they are, so a spreadsheet may take one that starts with = + - or @ for a
/// formula.
std::string map_csv(const MapRecord& map, const std::optional<MapUncertainty>& uncertainty = {});

}  // namespace mapproof
