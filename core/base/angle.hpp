#pragma once

namespace mapproof {

/// The angle less full turns: in (-pi, pi].
double wrapped(double angle_rad);

}  // namespace mapproof
