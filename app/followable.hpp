#pragma once

#include "app/own_input.hpp"
#include "app/own_map.hpp"

namespace mapproof {

/// Throws for what cannot be done while a file is followed.
/// @throws InvalidInput naming the option, and saying why.
void require_followable(const OwnInput& input, const OwnMapOptions& options);

}  // namespace mapproof
