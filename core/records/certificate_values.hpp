#pragma once

#include <nlohmann/json.hpp>

#include "core/json/json_cursor.hpp"
#include "core/model/certificate.hpp"

namespace mapproof {

/// A certificate; what nothing was proved of is null.
nlohmann::ordered_json certificate_value(const Certificate& certificate);

/// @throws IoError with the place.
Certificate read_certificate(const JsonCursor& value);

}  // namespace mapproof
