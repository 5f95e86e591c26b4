#pragma once

#include <string>

#include "render/image/image.hpp"
#include "render/theme/theme.hpp"

namespace mapproof::test {

/// A small page: 480 x 360 pixels.
Theme baseline_theme();

/// Compares with tests/baselines/NAME.png. What is not alike, and what has no baseline, is left in
/// the build's folder `visual` as NAME.png; the target accept_baselines makes it the baseline.
/// @return Empty if the picture is as it was, else what differs.
std::string difference_from_baseline(const std::string& name, const Image& image);

}  // namespace mapproof::test
