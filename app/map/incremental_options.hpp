#pragma once

#include "app/map/observations.hpp"
#include "app/map/one_sensor.hpp"

namespace mapproof {

/// Throws for what cannot be done while a file is followed.
/// @throws InvalidInput naming the option, and saying why.
void require_followable(const MapInput& input, const MapOptions& options);

}  // namespace mapproof
