#pragma once

#include <string>
#include <string_view>

#include "core/model/map_record.hpp"

namespace mapproof {

/// One map as a file of its own (mapproof.map); a NaN row of positions is null.
std::string map_json(const MapRecord& map);

/// @param source  What to call the file in errors. @throws IoError with the place.
MapRecord parse_map(std::string_view text, const std::string& source);

/// One map as RFC 4180: name,x_m,y_m,true_x_m,true_y_m,error_m,anchor; empty where unknown.
/// Without the frame of the truth the columns are x,y and there is no error. Names are kept as they
/// are, so a spreadsheet may take one that starts with = + - or @ for a formula.
std::string map_csv(const MapRecord& map);

}  // namespace mapproof
